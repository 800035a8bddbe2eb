#pragma once

#include <fmt/format.h>
#include <hdf5.h>

#include <cstdint>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace recoil {

/// An open object of HDF5, closed on leaving the scope.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*closer)(hid_t), const char* what) : id_(id), closer_(closer) {
    if (id < 0) throw EnvironmentError(fmt::format("HDF5 cannot {}", what));
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) closer_(id_);
  }
  operator hid_t() const { return id_; }

  /// Closes now, so that a full disk is noticed.
  void close() {
    const hid_t id = std::exchange(id_, -1);
    check(closer_(id), "close the file");
  }
  static void check(herr_t status, const char* what) {
    if (status < 0) throw EnvironmentError(fmt::format("HDF5 cannot {}", what));
  }

 private:
  hid_t id_;
  herr_t (*closer_)(hid_t);
};

/// HDF5 prints its errors by default; ours are exceptions. Restores what was set before.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The type of HDF5 for a number in memory.
template <class T>
hid_t hdf5_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, unsigned char>) return H5T_NATIVE_UINT8;
}

}  // namespace recoil
