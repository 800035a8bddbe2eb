#include "config/formula/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <regex>
#include <utility>

#include "core/error.hpp"

namespace recoil::config {

namespace {

/// A unit as a factor of that of its quantity.
struct Unit {
  const char* name;
  double size;
};
constexpr std::array lengths{Unit{"km", 1e3}, Unit{"m", 1}, Unit{"cm", 1e-2}, Unit{"mm", 1e-3},
                             Unit{"um", 1e-6}};
constexpr std::array times{Unit{"s", 1}, Unit{"ms", 1e-3}, Unit{"us", 1e-6}, Unit{"ns", 1e-9}};
constexpr std::array pressures{Unit{"GPa", 1e9}, Unit{"MPa", 1e6}, Unit{"kPa", 1e3}, Unit{"Pa", 1}};

/// What the parser did not understand, in our words.
std::string fault_of(const mu::Parser::exception_type& e) {
  switch (e.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return fmt::format("knows no '{}'", e.GetToken());
    case mu::ecUNEXPECTED_EOF:
      return "ends too early";
    case mu::ecMISSING_PARENS:
      return "lacks a parenthesis";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return fmt::format("lacks a '*' before '{}'", e.GetToken());
    case mu::ecTOO_MANY_PARAMS:
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("gives a function a wrong number of values at character {}", e.GetPos() + 1);
    default:
      return fmt::format("cannot be read at character {}", e.GetPos() + 1);
  }
}

}  // namespace

/// What the formula reads.
struct Formula::Parts {
  Vector x{};
  double now = 0;
  std::array<double, lengths.size()> length{};
  std::array<double, times.size()> time{};
  std::array<double, pressures.size()> pressure{};
  mu::Parser parser;

  template <std::size_t N>
  void define(const std::array<Unit, N>& units, std::array<double, N>& values) {
    for (std::size_t u = 0; u < N; ++u) parser.DefineVar(units[u].name, &values[u]);
  }
};

/// The units in which numbers are said, in SI.
struct Formula::UnitSizes {
  double length = 1, time = 1, pressure = 1;
};

Formula::Formula(const std::string& text, const std::vector<std::string>& axes, Of of)
    : parts_(std::make_unique<Parts>()) {
  static const std::regex assigns("(^|[^<>=!])=($|[^=])");
  if (std::regex_search(text, assigns)) throw InputError("assigns with '='");
  mu::Parser& parser = parts_->parser;
  try {
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t d = 0; d < axes.size(); ++d) parser.DefineVar(axes[d], &parts_->x[d]);
    parts_->define(lengths, parts_->length);
    parts_->define(times, parts_->time);
    if (of == Of::place_and_time) {
      parser.DefineVar("t", &parts_->now);
      parts_->define(pressures, parts_->pressure);
    }
    parser.SetExpr(text);
    at({});
    int values = 0;
    parser.Eval(values);
    if (values != 1) throw InputError("holds a comma between two values");
  } catch (const mu::Parser::exception_type& e) {
    throw InputError(fault_of(e));
  }
}

Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

double Formula::at(const Vector& x, double time) const { return at(x, time, UnitSizes{}); }

double Formula::at(const Vector& x, double time, const UnitSizes& sizes) const {
  const auto set = [](const auto& units, auto& values, double size) {
    for (std::size_t u = 0; u < units.size(); ++u) values[u] = units[u].size * size;
  };
  for (std::size_t d = 0; d < x.size(); ++d) parts_->x[d] = x[d] * sizes.length;
  parts_->now = time * sizes.time;
  set(lengths, parts_->length, sizes.length);
  set(times, parts_->time, sizes.time);
  set(pressures, parts_->pressure, sizes.pressure);
  return parts_->parser.Eval();
}

bool Formula::has_dimension(const std::vector<Vector>& places, const Dimension& dimension) const {
  constexpr int largest = 24;  // binary digits: powers of units do not overflow, a bare number is passed
  constexpr double tolerance = 1e-9;
  constexpr double some_time = 0.7e-6;  // s, where the formula knows the time
  struct Digits {
    int length, time, pressure;
  };
  const auto agrees = [&](const Vector& x, const Digits& of) {
    const UnitSizes sizes{std::ldexp(1, of.length), std::ldexp(1, of.time), std::ldexp(1, of.pressure)};
    const double one = at(x, some_time);
    const double other = std::ldexp(
        at(x, some_time, sizes),
        -(dimension.length * of.length + dimension.time * of.time + dimension.pressure * of.pressure));
    if (!std::isfinite(one) || !std::isfinite(other)) return true;
    return std::abs(other - one) <= tolerance * std::max(std::abs(one), std::abs(other));
  };
  const auto agrees_at = [&](const Vector& x) {
    for (int n = -largest; n <= largest; ++n)
      if (!agrees(x, {n, 0, 0}) || !agrees(x, {0, n, 0}) || !agrees(x, {n, n, 0}) || !agrees(x, {0, 0, n}))
        return false;
    return true;
  };
  return std::ranges::all_of(places, [&](const Vector& x) {
    return agrees_at(x) && agrees_at({-x[0], -x[1], -x[2]});
  });
}

}  // namespace recoil::config
