#pragma once

#include <limits>
#include <string>

namespace recoil {

/// The value of a model's member until somebody gives it one. A member that starts with a number
/// instead has that number as its default.
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// One constant of a model: what a file calls it, its unit, its place in the struct, its range.
/// The lists of these drive reading, checking, help and the schema.
template <class Model>
struct Parameter {
  const char* name;         // key in a file
  const char* unit;         // SI unit of the member; "1" for pure numbers
  double Model::*member;    // NaN in a default-constructed model: the key is required
  double minimum, maximum;  // allowed range, both ends included, SI
  const char* doc;          // one line

  constexpr double fallback() const { return Model{}.*member; }
  constexpr bool required() const { return fallback() != fallback(); }
};

/// A text that a model needs, such as the name of a file: always required.
template <class Model>
struct TextParameter {
  const char* name;
  std::string Model::*member;
  const char* doc;
  const char* example;
};

}  // namespace recoil
