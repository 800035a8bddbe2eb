#include "config/section/formula.hpp"

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

/// A unit as a factor of those of length and time.
struct Unit {
  const char* name;
  double size;
};
constexpr std::array lengths{Unit{"km", 1e3}, Unit{"m", 1}, Unit{"cm", 1e-2}, Unit{"mm", 1e-3},
                             Unit{"um", 1e-6}};
constexpr std::array times{Unit{"s", 1}, Unit{"ms", 1e-3}, Unit{"us", 1e-6}, Unit{"ns", 1e-9}};

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

struct Formula::Parts {
  Vector x{};
  std::array<double, lengths.size()> length{};
  std::array<double, times.size()> time{};
  mu::Parser parser;
};

Formula::Formula(const std::string& text, const std::vector<std::string>& axes)
    : parts_(std::make_unique<Parts>()) {
  static const std::regex assigns("(^|[^<>=!])=($|[^=])");
  if (std::regex_search(text, assigns)) throw InputError("assigns with '='");
  mu::Parser& parser = parts_->parser;
  try {
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t d = 0; d < axes.size(); ++d) parser.DefineVar(axes[d], &parts_->x[d]);
    for (std::size_t u = 0; u < lengths.size(); ++u) parser.DefineVar(lengths[u].name, &parts_->length[u]);
    for (std::size_t u = 0; u < times.size(); ++u) parser.DefineVar(times[u].name, &parts_->time[u]);
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

double Formula::at(const Vector& x) const { return at(x, 1, 1); }

double Formula::at(const Vector& x, double length_unit, double time_unit) const {
  for (std::size_t d = 0; d < x.size(); ++d) parts_->x[d] = x[d] * length_unit;
  for (std::size_t u = 0; u < lengths.size(); ++u) parts_->length[u] = lengths[u].size * length_unit;
  for (std::size_t u = 0; u < times.size(); ++u) parts_->time[u] = times[u].size * time_unit;
  return parts_->parser.Eval();
}

bool Formula::has_dimension(const std::vector<Vector>& places, int length, int time) const {
  constexpr int largest = 24;  // binary digits: powers of units do not overflow, a bare number is passed
  constexpr double tolerance = 1e-9;
  const auto agrees = [&](const Vector& x, int of_length, int of_time) {
    const double one = at(x);
    const double other = std::ldexp(at(x, std::ldexp(1, of_length), std::ldexp(1, of_time)),
                                    -(length * of_length + time * of_time));
    if (!std::isfinite(one) || !std::isfinite(other)) return true;
    return std::abs(other - one) <= tolerance * std::max(std::abs(one), std::abs(other));
  };
  const auto agrees_at = [&](const Vector& x) {
    for (int digits = -largest; digits <= largest; ++digits)
      if (!agrees(x, digits, 0) || !agrees(x, 0, digits) || !agrees(x, digits, digits)) return false;
    return true;
  };
  return std::ranges::all_of(places, [&](const Vector& x) {
    return agrees_at(x) && agrees_at({-x[0], -x[1], -x[2]});
  });
}

}  // namespace recoil::config
