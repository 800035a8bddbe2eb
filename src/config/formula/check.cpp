#include "config/formula/check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace recoil::config {

namespace {

constexpr const char* functions =
    "sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, asinh, acosh, atanh, exp, ln, "
    "log (of base e), log2, log10, sqrt, abs, sign, rint, min, max, sum, avg";

/// Places within the domain that lie on no plane of symmetry of it.
std::vector<Vector> places_in(const Vector& lo, const Vector& hi) {
  std::vector<Vector> places;
  for (const Vector& part :
       {Vector{0.137, 0.211, 0.843}, Vector{0.618, 0.419, 0.271}, Vector{0.893, 0.769, 0.557},
        Vector{0.021, 0.947, 0.389}, Vector{0.977, 0.033, 0.691}, Vector{0.371, 0.583, 0.017}}) {
    Vector& x = places.emplace_back();
    for (std::size_t d = 0; d < x.size(); ++d) x[d] = lo[d] + part[d] * (hi[d] - lo[d]);
  }
  return places;
}

/// What stands in the parentheses that open before `begin`.
std::string argument_at(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  for (int depth = 1; end < text.size(); ++end) {
    depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
    if (depth == 0) break;
  }
  return text.substr(begin, end - begin);
}

/// A formula of a case, with what it may speak of.
struct Checked {
  const TableReading& reading;
  const char* key;
  const std::string& text;
  const FormulaGoal& goal;

  const std::vector<std::string>& axes() const { return reading.in.axes; }
};

/// The first function of pure numbers that is given a number with a unit, with what it is given; empty: none
/// is.
std::pair<std::string, std::string> function_of_units(const Checked& c, const std::vector<Vector>& places) {
  static const std::regex call(
      R"(\b(sin|cos|tan|asin|acos|atan|sinh|cosh|tanh|asinh|acosh|atanh|exp|ln|log|log2|log10|rint)\s*\()");
  for (auto at = std::sregex_iterator(c.text.begin(), c.text.end(), call); at != std::sregex_iterator();
       ++at) {
    const std::string argument = argument_at(c.text, static_cast<std::size_t>(at->position() + at->length()));
    if (!Formula(argument, c.axes(), c.goal.of).has_dimension(places, {})) return {(*at)[1], argument};
  }
  return {};
}

void check_dimension(const Checked& c) {
  const std::vector<Vector> places = places_in(c.reading.in.lo, c.reading.in.hi);
  const Formula formula(c.text, c.axes(), c.goal.of);
  if (!c.reading.in.knows_domain || formula.has_dimension(places, c.goal.dimension)) return;
  const auto [function, argument] = function_of_units(c, places);
  if (!function.empty()) {
    const bool timed = Formula(argument, c.axes(), c.goal.of).has_dimension(places, {0, 1, 0});
    return c.reading.wrong(
        c.key,
        fmt::format("the formula of '{}' is no {}: {} needs a pure number, and is given one with a unit",
                    c.key, c.goal.noun, function),
        fmt::format("divide by a unit: {}({})", function, timed ? "t/us" : c.axes().front() + "/mm"));
  }
  c.reading.wrong(
      c.key,
      fmt::format("the formula of '{}' is no {}: numbers need units, and coordinates are lengths{}", c.key,
                  c.goal.noun, c.goal.of == Formula::Of::place_and_time ? ", t is a time" : ""),
      c.text.find_first_of("<>=") == std::string::npos
          ? fmt::format("e.g. {} = {}", c.key, c.goal.example)
          : fmt::format("so do numbers in comparisons: {} > 20*mm ? {} : 0", c.axes().front(),
                        c.goal.one_of));
}

}  // namespace

void check_formula(const TableReading& reading, const char* key, const std::string& text,
                   const FormulaGoal& goal) {
  if (!reading.has(key) || !reading.good(key)) return;
  try {
    check_dimension({reading, key, text, goal});
  } catch (const InputError& e) {
    const bool timed = goal.of == Formula::Of::place_and_time;
    reading.wrong(
        key, fmt::format("the formula of '{}' {}", key, e.what()),
        fmt::format("coordinates are {}{}, units km, m, cm, mm, um, s, ms, us, ns{}, functions {}; e.g. {} = "
                    "{}",
                    fmt::join(reading.in.axes, ", "), timed ? ", the time is t" : "",
                    timed ? ", GPa, MPa, kPa, Pa" : "", functions, key, goal.example));
  }
}

}  // namespace recoil::config
