#include "app/run/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "config/units.hpp"

namespace recoil::app {

namespace {

std::string in_its_unit(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{:.5g}", value) : config::format_quantity(value, unit, 5);
}

/// "+2.3", "-156": two digits, and all of those before the point.
std::string percent(double value, bool with_plus) {
  const std::string text = std::abs(value) < 10 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
  return with_plus && value >= 0 ? "+" + text : text;
}

std::string expected_text(const config::Expectation& e) {
  if (e.is_flag) return e.flag ? "true" : "false";
  const std::string value = in_its_unit(e.value, e.unit);
  if (e.at_most) return "at most " + value;
  if (e.at_least) return "at least " + value;
  const double part = e.value != 0 ? std::abs(e.tolerance / e.value) : 0;
  return part > 0 ? fmt::format("{} +- {} %", value, percent(100 * part, false))
                  : fmt::format("{} +- {}", value, in_its_unit(e.tolerance, e.unit));
}

/// How far off, of the value, for two-sided expectations.
std::string error_text(const CheckResult& r) {
  const config::Expectation& e = r.expected;
  if (e.is_flag || e.at_most || e.at_least || e.value == 0 || !std::isfinite(r.measured.value)) return "";
  return fmt::format("  ({} %)", percent(100 * (r.measured.value - e.value) / std::abs(e.value), true));
}

void tell_expectations(Reporter& reporter, const std::vector<CheckResult>& all) {
  const auto failed = std::count_if(all.begin(), all.end(), [](const CheckResult& r) { return !r.pass; });
  if (all.empty()) return;
  const std::string verdict = failed > 0 ? fmt::format("expectations: {} of {} failed", failed, all.size())
                                         : fmt::format("expectations: all {} met", all.size());
  if (failed > 0)
    reporter.insist(verdict);
  else
    reporter.say(verdict);
  for (const CheckResult& r : all) {
    std::string line = fmt::format("  {} {}: {}, expected {}{}", r.pass ? "pass" : "FAIL",
                                   r.expected.quantity, written(r), expected_text(r.expected), error_text(r));
    if (!r.measured.problem.empty()) line += "; " + r.measured.problem;
    if (r.pass)
      reporter.say(line);
    else
      reporter.insist(line);
  }
}

}  // namespace

std::string written(const CheckResult& r) {
  if (r.measured.is_flag) return r.measured.flag ? "true" : "false";
  return std::isfinite(r.measured.value) ? in_its_unit(r.measured.value, r.expected.unit) : "none";
}

void tell_validity(Reporter& reporter, const Verdict& v) {
  const std::string name = name_of(v.kind);
  reporter.insist(fmt::format("verdict: {}", name));
  for (const Reason& r : v.reasons) reporter.insist(fmt::format("  {}: {}", name, r.text));
  for (const std::string& cure : v.cures) reporter.insist("   = help: " + cure);
  for (const auto* list : {&v.remarks, &v.notes})
    for (const std::string& line : *list) reporter.say("  " + line);
}

void tell_verdict(Reporter& reporter, const Summary& s) {
  reporter.say(
      fmt::format("finished at {:.6g} us: {} steps in {:.3g} s, {:.3g} million cell stages per second",
                  s.time * 1e6, s.steps, s.wall_s, s.rate));
  for (const Drift& d : s.budgets)
    reporter.say(fmt::format("budget of {}: mass {:.1e}, momentum {:.1e}, energy {:.1e}", d.name, d.mass,
                             d.momentum, d.energy));
  for (const auto& [name, count] : s.floors)
    if (count != 0) reporter.say(fmt::format("limited: {} {}", name, count));
  tell_expectations(reporter, s.expect);
  tell_validity(reporter, s.verdict);
}

}  // namespace recoil::app
