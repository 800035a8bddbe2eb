#include "app/sweep/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "config/units.hpp"
#include "format/csv.hpp"

namespace recoil::app {

namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string head(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

/// Of a key: a unit only where its values are numbers.
std::string head(const SweptKey& key) { return head(key.key, key.numbers.empty() ? "" : key.unit); }

/// Beside results, that may have the name of a key: of a velocity at the start and at the end.
std::string head_among_results(const SweptKey& key) { return "set." + head(key); }

/// A value of a key as the table has it: a number in the unit of the key, or the text without its quotes.
std::string value_cell(const SweptKey& key, const std::string& text) {
  const bool quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  const std::string bare = quoted ? text.substr(1, text.size() - 2) : text;
  if (key.numbers.empty()) return bare;
  const config::Quantity q = config::parse_any_quantity(bare, key.key);
  if (!q.ok()) return bare;
  return format_number(q.unit == key.unit ? q.written
                       : key.unit.empty() ? q.value
                                          : config::in_unit(q.value, key.unit));
}

bool varies(const SweptKey& key) { return key.is_range || key.values.size() > 1; }

/// "t=2mm, m=steel": the keys that vary, but for one.
std::string place_of(const std::vector<SweptKey>& keys, std::size_t along, const FoundThreshold& f) {
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (k != along && varies(keys[k]))
      text += fmt::format("{}{}={}", text.empty() ? "" : ", ", keys[k].key, f.values[k]);
  return text;
}

std::string side_of(const Threshold& t) {
  if (t.changes() == 0) return t.holds_above() ? "everywhere" : "nowhere";
  return t.holds_above() ? "above" : "below";
}

std::string sentence(const SweptKey& key, const std::string& condition, const FoundThreshold& f) {
  const Threshold& t = f.search;
  if (!f.problem.empty()) return f.problem;
  if (t.changes() == 0)
    return fmt::format("'{}' holds {} of the range {} to {}, in {} runs: no threshold there", condition,
                       t.holds_above() ? "at all points" : "at no point", key.values.front(),
                       key.values.back(), t.runs());
  std::string text = fmt::format("{} = {} ± {}; '{}' holds {} it ({} runs)", key.key,
                                 range_value(rounded_in_range(t.middle()), key.unit),
                                 range_value(std::stod(fmt::format("{:.2g}", t.half_width())), key.unit),
                                 condition, t.holds_above() ? "above" : "below", t.runs());
  if (t.changes() > 1)
    text += fmt::format("; it changes {} times in the range, this is the first", t.changes());
  return text;
}

}  // namespace

std::string sweep_csv(const SweepTable& table) {
  std::string text;
  for (const SweptKey& key : table.keys) text += csv_cell(head_among_results(key)) + ',';
  text += "run,verdict";
  for (const SweepColumn& c : table.columns) text += ',' + csv_cell(head(c.quantity, c.unit));
  text += '\n';
  for (const SweepRow& row : table.rows) {
    for (std::size_t k = 0; k < table.keys.size(); ++k)
      text += csv_cell(value_cell(table.keys[k], row.values[k])) + ',';
    text += csv_cell(row.run) + ',' + row.verdict;
    for (const double x : row.numbers) text += ',' + format_number(x);
    text += '\n';
  }
  return text;
}

std::string sweep_markdown(const SweepTable& table, const std::vector<std::size_t>& shown) {
  std::vector<std::size_t> keys;
  for (std::size_t k = 0; k < table.keys.size(); ++k)
    if (varies(table.keys[k])) keys.push_back(k);
  std::string heads = "|", rule = "|";
  const auto column = [&](const std::string& name) { heads += ' ' + name + " |", rule += "---|"; };
  for (const std::size_t k : keys) column(head_among_results(table.keys[k]));
  column("verdict");
  for (const std::size_t c : shown)
    column(head(table.columns[c].quantity, table.columns[c].unit == "1" ? "" : table.columns[c].unit));
  std::string text = fmt::format("# {}\n\n{}\n{}\n", table.title, heads, rule);
  for (const SweepRow& row : table.rows) {
    text += '|';
    for (const std::size_t k : keys) text += ' ' + value_cell(table.keys[k], row.values[k]) + " |";
    text += ' ' + row.verdict + " |";
    for (const std::size_t c : shown) text += ' ' + format_number(row.numbers[c], 6) + " |";
    text += '\n';
  }
  return text;
}

std::string threshold_csv(const std::vector<SweptKey>& keys, std::size_t along,
                          const std::vector<FoundThreshold>& found) {
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (k != along) text += csv_cell(head(keys[k])) + ',';
  text += csv_cell(head(keys[along])) + ',' + csv_cell(head("half-width", keys[along].unit)) +
          ",holds,changes,runs\n";
  for (const FoundThreshold& f : found) {
    for (std::size_t k = 0; k < keys.size(); ++k)
      if (k != along) text += csv_cell(value_cell(keys[k], f.values[k])) + ',';
    const bool good = f.problem.empty();
    text += fmt::format("{},{},{},{},{}\n", good ? format_number(f.search.middle()) : "nan",
                        good ? format_number(f.search.half_width()) : "nan",
                        good ? side_of(f.search) : "not known", f.search.changes(), f.search.runs());
  }
  return text;
}

std::string threshold_text(const std::vector<SweptKey>& keys, std::size_t along, const std::string& condition,
                           const std::vector<FoundThreshold>& found) {
  std::string text;
  for (const FoundThreshold& f : found) {
    const std::string place = place_of(keys, along, f);
    text += fmt::format("{}{}{}\n", place, place.empty() ? "" : ": ", sentence(keys[along], condition, f));
  }
  return text;
}

}  // namespace recoil::app
