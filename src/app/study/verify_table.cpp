#include "app/study/verify_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "app/check/count_text.hpp"
#include "core/nothing.hpp"
#include "format/csv.hpp"

namespace recoil::app {

namespace {

using Json = nlohmann::ordered_json;

double number(const Json& j, const char* key) {
  return j.contains(key) && j[key].is_number() ? j[key].get<double>() : nothing;
}

std::string text(const Json& j, const char* key) {
  return j.contains(key) && j[key].is_string() ? j[key].get<std::string>() : "";
}

std::string with_unit(double x, const std::string& unit) {
  if (!std::isfinite(x)) return "none";
  return fmt::format("{:.5g}{}{}", x, unit.empty() ? "" : " ", unit);
}

/// Part of the reference, or where that is 0 the difference itself.
std::string part_of(double difference, double reference, const std::string& unit, const char* form) {
  if (!std::isfinite(difference)) return "-";
  if (reference == 0)
    return fmt::format(fmt::runtime(std::string(form) + "{}{}"), difference, unit.empty() ? "" : " ", unit);
  return fmt::format(fmt::runtime(std::string(form) + " %"), 100 * difference / std::abs(reference));
}

VerifiedValue flag_value(const std::string& quantity, const Json& j) {
  const auto word = [&](const char* key) {
    return !j[key].is_boolean() ? "none" : j[key].get<bool>() ? "true" : "false";
  };
  const auto size = [&](const char* key) {
    return j[key].is_boolean() ? (j[key].get<bool>() ? 1.0 : 0.0) : nothing;
  };
  VerifiedValue v;
  v.quantity = quantity;
  v.kind = "flag";
  v.ours = word("value"), v.reference = word("reference");
  v.value = size("value"), v.target = size("reference");
  v.error = "-", v.tolerance = "-";
  return v;
}

VerifiedValue number_value(const std::string& quantity, const Json& j) {
  VerifiedValue v;
  v.quantity = quantity;
  v.unit = text(j, "unit") == "1" ? "" : text(j, "unit");
  v.kind = text(j, "kind").empty() ? "value" : text(j, "kind");
  v.value = number(j, "value"), v.target = number(j, "reference");
  v.ours = with_unit(v.value, v.unit);
  v.reference = with_unit(v.target, v.unit);
  v.error = v.tolerance = "-";
  if (v.kind != "value") {
    v.reference = (v.kind == "at-most" ? "≤ " : "≥ ") + v.reference;
  } else {
    v.error = part_of(v.value - v.target, v.target, v.unit, "{:+.2g}");
    v.tolerance = "± " + part_of(number(j, "tolerance"), v.target, v.unit, "{:.2g}");
  }
  return v;
}

VerifiedValue value_of(const std::string& quantity, const Json& j) {
  VerifiedValue v = j["reference"].is_boolean() ? flag_value(quantity, j) : number_value(quantity, j);
  v.pass = j.value("pass", false);
  v.has_source = !text(j, "source").empty();
  v.source = v.has_source ? text(j, "source") : text(j, "why");
  if (const std::string problem = text(j, "problem"); !problem.empty()) v.ours += " (" + problem + ")";
  return v;
}

std::string escaped(std::string s) {
  for (std::size_t at = 0; (at = s.find('|', at)) != std::string::npos; at += 2) s.insert(at, "\\");
  return s;
}

std::string section(const VerifiedCase& c) {
  std::string out = fmt::format("\n## {}\n\n{}\n\n", c.name, c.title);
  if (!c.problem.empty()) return out + fmt::format("**FAIL**: {}\n", c.problem);
  out += fmt::format("{} of {} met; {} cells with matter, {} steps, {:.3g} s of processor time.\n\n",
                     static_cast<long>(c.values.size()) - c.failures(), c.values.size(), c.cells, c.steps,
                     c.cpu_s);
  for (const std::string& doubt : c.doubts) out += fmt::format("Doubtful: {}\n\n", doubt);
  out +=
      "| quantity | reference | source | ours | error | tolerance | verdict "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const VerifiedValue& v : c.values)
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", escaped(v.quantity), v.reference,
                       v.source.empty() ? "-" : escaped(v.source), escaped(v.ours), v.error, v.tolerance,
                       v.pass ? "pass" : "**FAIL**");
  return out;
}

std::string quoted(const std::string& s) {
  std::string out = "\"";
  for (const char c : s) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

Json json_number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

}  // namespace

long VerifiedCase::failures() const {
  const auto failed =
      std::count_if(values.begin(), values.end(), [](const VerifiedValue& v) { return !v.pass; });
  return problem.empty() ? failed : std::max<long>(failed, 1);
}

VerifiedCase read_verified(const std::filesystem::path& run) {
  VerifiedCase c;
  std::ifstream file(run / "summary.json");
  const Json all = Json::parse(file, nullptr, false);
  if (all.is_discarded() || !all.contains("expect")) {
    c.problem = "the run wrote no summary.json";
    return c;
  }
  c.version = text(all, "version");
  c.exit_code = all.value("exit", 0);
  c.cpu_s = number(all, "cpu_s");
  c.steps = all.value("steps", 0L);
  c.cells = all.value("cells", 0L);
  for (const Json& reason : all.value("reasons", Json::array())) c.doubts.push_back(text(reason, "text"));
  for (const auto& [quantity, j] : all["expect"].items()) c.values.push_back(value_of(quantity, j));
  return c;
}

VerifyCount count(const std::vector<VerifiedCase>& cases) {
  VerifyCount n;
  for (const VerifiedCase& c : cases) {
    ++n.cases;
    n.failures += c.failures();
    for (const VerifiedValue& v : c.values) {
      ++n.values;
      n.references += v.has_source ? 1 : 0;
    }
  }
  return n;
}

std::string verify_markdown(const std::vector<VerifiedCase>& cases,
                            const std::vector<std::string>& overrides) {
  const VerifyCount n = count(cases);
  std::string out =
      "# Validation\n\nWritten by `recoil verify`: each case below is run and compared with its "
      "`expected.toml`, which gives the source\n"
      "of each number and the reason for its tolerance. Nothing here is typed by hand.\n\n";
  out += fmt::format(
      "{}, {}, {} of them against a published, exact or independently computed reference: {}.\n\n",
      counted(n.cases, "case", "cases"), counted(n.values, "check", "checks"), n.references,
      n.failures == 0 ? "all met" : fmt::format("**{} failed**", n.failures));
  std::set<std::string> versions;
  for (const VerifiedCase& c : cases)
    if (!c.version.empty()) versions.insert(c.version);
  for (const std::string& v : versions) out += fmt::format("Computed with recoil {}.\n", v);
  for (const std::string& o : overrides) out += fmt::format("In every case: `--set {}`.\n", o);
  double together = 0;
  for (const VerifiedCase& c : cases) together += std::isfinite(c.cpu_s) ? c.cpu_s : 0;
  out += fmt::format("Together {:.3g} min of processor time.\n", together / 60);
  out += "\n| case | checks | met | processor time |\n|---|---|---|---|\n";
  for (const VerifiedCase& c : cases)
    out += fmt::format("| {} | {} | {} | {:.3g} s |\n", c.name, c.values.size(),
                       c.failures() == 0 ? "all" : fmt::format("**{} failed**", c.failures()), c.cpu_s);
  for (const VerifiedCase& c : cases) out += section(c);
  return out;
}

std::string verify_csv(const std::vector<VerifiedCase>& cases) {
  std::string out = "case,quantity,unit,kind,reference,value,error,tolerance,pass,source\n";
  for (const VerifiedCase& c : cases)
    for (const VerifiedValue& v : c.values)
      out +=
          fmt::format("{},{},{},{},{},{},{},{},{},{}\n", c.name, quoted(v.quantity),
                      v.unit.empty() ? "1" : v.unit, v.kind, format_number(v.target), format_number(v.value),
                      quoted(v.error), quoted(v.tolerance), v.pass, quoted(v.source));
  return out;
}

std::string verify_json(const std::vector<VerifiedCase>& cases) {
  const VerifyCount n = count(cases);
  Json all{{"cases", n.cases}, {"checks", n.values}, {"references", n.references}, {"failures", n.failures}};
  all["results"] = Json::object();
  for (const VerifiedCase& c : cases) {
    Json one{{"title", c.title},        {"version", c.version},
             {"exit", c.exit_code},     {"cpu_s", json_number(c.cpu_s)},
             {"steps", c.steps},        {"cells", c.cells},
             {"failures", c.failures()}};
    if (!c.problem.empty()) one["problem"] = c.problem;
    one["doubts"] = c.doubts;
    one["values"] = Json::object();
    for (const VerifiedValue& v : c.values)
      one["values"][v.quantity] = {{"kind", v.kind},
                                   {"unit", v.unit.empty() ? "1" : v.unit},
                                   {"reference", json_number(v.target)},
                                   {"value", json_number(v.value)},
                                   {"error", v.error},
                                   {"tolerance", v.tolerance},
                                   {"pass", v.pass},
                                   {"source", v.source}};
    all["results"][c.name] = std::move(one);
  }
  return all.dump(2) + "\n";
}

}  // namespace recoil::app
