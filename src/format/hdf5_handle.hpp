#pragma once

#include <fmt/format.h>
#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <string>
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

/// A file of HDF5 that is made in memory and then written as a whole. HDF5 1.10 cannot close a file that a
/// full disk has cut short: the program would crash when it ends.
class Hdf5Image {
 public:
  Hdf5Image() : file_(made()) {}
  operator hid_t() const { return file_; }

  /// The bytes of the file. Everything in it must have been closed.
  std::string bytes() {
    Hdf5Handle::check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "make a file");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    std::string all(static_cast<std::size_t>(size > 0 ? size : 0), '\0');
    Hdf5Handle::check(size > 0 && H5Fget_file_image(file_, all.data(), all.size()) == size ? 0 : -1,
                      "make a file");
    return all;
  }

 private:
  static Hdf5Handle made() {
    constexpr std::size_t growth = std::size_t{1} << 20;  // bytes
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set the options of a file");
    Hdf5Handle::check(H5Pset_fapl_core(access, growth, 0), "make a file in memory");
    return {H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "make a file in memory"};
  }

  Hdf5Handle file_;
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
