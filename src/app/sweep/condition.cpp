#include "app/sweep/condition.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "config/units.hpp"
#include "core/error.hpp"

namespace recoil::app {

namespace {

constexpr const char* example = "--find 'body.plate.failed-mass > 0' or --find event.ricochet";

std::string without_blanks(const std::string& s) {
  const std::size_t first = s.find_first_not_of(" \t");
  return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(" \t") + 1 - first);
}

void check_dimension(const Condition& c, const std::string& unit) {
  if (config::is_comparable(c.value, c.unit, unit)) return;
  throw InputError(
      fmt::format("--find '{}': '{}' has dimension [{}], but the quantity has [{}]\n   = help: compare it "
                  "with a value in {}",
                  c.text, without_blanks(c.text.substr(c.text.find(c.comparison) + c.comparison.size())),
                  config::dimension_name(c.unit), config::dimension_name(unit), unit));
}

}  // namespace

void Condition::check(const Quantities& known) const {
  if (!comparison.empty()) return check_dimension(*this, unit_of(known, quantity));
  if (!known.flags.contains(quantity))
    throw InputError(
        fmt::format("--find '{}' is a number, not a yes or no\n   = help: compare it, e.g. --find '{} > 0'",
                    text, quantity));
}

bool Condition::holds(const RunQuantities& run) const {
  const double found = value_of(run, quantity);  // throws where there is no such quantity
  check(run.found);
  if (comparison.empty()) return run.found.flags.at(quantity);
  if (std::isnan(found) && quantity.starts_with("gauge."))
    throw InputError(
        fmt::format("--find '{}': {}\n   = help: choose a quantity that every run has, such as "
                    "the largest value of a column: gauge.NAME.COLUMN.max",
                    text, "a run has no value there"));
  if (comparison == ">") return found > value;
  if (comparison == ">=") return found >= value;
  return comparison == "<" ? found < value : found <= value;
}

Condition parse_condition(const std::string& text) {
  Condition c;
  c.text = text;
  const std::size_t at = text.find_first_of("<>=!");
  c.quantity = without_blanks(text.substr(0, at));
  if (c.quantity.empty() || c.quantity.find_first_of(" \t") != std::string::npos)
    throw InputError(fmt::format("--find '{}' names no quantity\n   = help: write {}", text, example));
  if (at == std::string::npos) return c;
  c.comparison =
      text.substr(at, text.substr(at).starts_with("<=") || text.substr(at).starts_with(">=") ? 2 : 1);
  if (c.comparison == "=" || c.comparison == "!")
    throw InputError(
        fmt::format("--find '{}': a threshold needs one of < <= > >=\n   = help: write {}", text, example));
  const std::string right = without_blanks(text.substr(at + c.comparison.size()));
  const config::Quantity q = config::parse_any_quantity(right, "--find");
  if (!q.ok())
    throw InputError(fmt::format("--find '{}': {}\n   = help: {}", text, q.problem,
                                 q.help.empty() ? std::string("write ") + example : q.help));
  c.value = q.value;
  c.unit = q.unit;
  return c;
}

}  // namespace recoil::app
