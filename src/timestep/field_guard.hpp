#pragma once

#include <cstdint>
#include <vector>

#include "state/fields.hpp"

namespace recoil {

#ifdef NDEBUG

template <int Dim>
struct FieldGuard {
  FieldGuard(const State<Dim>&, int, const FieldAccess&) {}
};

#else

/// While it lives, this thread may touch the fields of `access` only; where it ends, no other field of the
/// block may have changed. @throws InternalError (from FieldArray); ends the program where a field that the
/// phase may only read has changed.
template <int Dim>
class FieldGuard {
 public:
  FieldGuard(const State<Dim>& state, int slot, const FieldAccess& access);
  ~FieldGuard();
  FieldGuard(const FieldGuard&) = delete;
  FieldGuard& operator=(const FieldGuard&) = delete;

 private:
  const State<Dim>& state_;
  int slot_;
  const FieldAccess& access_;
  std::vector<std::uint64_t> before_;
};

#endif

}  // namespace recoil
