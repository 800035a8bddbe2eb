#pragma once

#include <string>

#include "config/declare/entry.hpp"

/// Keys that several tables have.
namespace recoil::config {

template <class T>
Entry<T> every_key(double T::*member, const char* doc) {
  return {.name = "every", .member = member, .unit = "s", .least = 0, .doc = doc, .example = R"("0.1 us")"};
}

template <class T>
Entry<T> body_key(const char* name, std::string T::*member, const char* doc) {
  return {.name = name,
          .member = member,
          .required = true,
          .rule = Rule::body,
          .doc = doc,
          .example = R"("target")"};
}

/// A position that must lie in the domain.
template <class T>
Entry<T> place_key(const char* name, Vector T::*member, const char* doc) {
  return {.name = name,
          .member = member,
          .unit = "m",
          .required = true,
          .rule = Rule::inside_domain,
          .doc = doc,
          .example = R"({ x = "1 mm" })"};
}

/// Of gauges.
inline constexpr const char* every_record = "time between two records; 0: every step";
inline constexpr const char* watched_body = "the body that is measured";

}  // namespace recoil::config
