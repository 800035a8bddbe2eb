#pragma once

#include "config/declare/entry.hpp"

namespace recoil::config {

/// The key of an extent along one axis, of a struct with the members `lo` and `hi`.
template <class T>
Entry<T> extent_along(const char* axis, const char* doc) {
  return {.name = axis,
          .member = Extents<T>{&T::lo, &T::hi},
          .unit = "m",
          .doc = doc,
          .example = R"(["0 mm", "10 mm"])"};
}

}  // namespace recoil::config
