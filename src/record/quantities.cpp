#include "record/quantities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include "config/expected_columns.hpp"
#include "config/units.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"
#include "format/csv.hpp"

namespace recoil {

namespace {

/// Those of the names that begin like a word: with as many of its parts as some name has.
std::vector<std::string> names_like(const std::string& word, const std::vector<std::string>& names) {
  std::vector<std::string> found;
  for (std::size_t dot = word.rfind('.'); dot != std::string::npos && dot > 0;
       dot = word.rfind('.', dot - 1)) {
    for (const std::string& name : names)
      if (name.starts_with(word.substr(0, dot + 1))) found.push_back(name);
    if (!found.empty()) return found;
  }
  return names;
}

[[noreturn]] void unknown(const std::string& quantity, const std::string& what, const std::string& word,
                          const std::vector<std::string>& known) {
  const std::string near = did_you_mean(word, known);
  throw InputError(fmt::format(
      "error: the quantity '{}': {}\n   = help: {}", quantity, what,
      !near.empty() ? near : fmt::format("known are: {}", fmt::join(names_like(word, known), ", "))));
}

double number_of(const std::string& quantity, const std::string& text, const std::string& si_unit) {
  const config::Quantity q = config::parse_quantity(text, si_unit, quantity);
  if (q.ok()) return q.value;
  throw InputError(fmt::format("error: the quantity '{}': {}{}{}", quantity, q.problem,
                               q.help.empty() ? "" : "\n   = help: ", q.help));
}

/// What is requested of a column: `gauge.NAME.COLUMN.reduction@argument`.
struct Request {
  std::string quantity, gauge, column, reduction, argument;
};

Request parse_request(const std::string& quantity) {
  Request r;
  r.quantity = quantity;
  const std::size_t at = quantity.find('@');
  std::string name = quantity.substr(0, at);
  if (at != std::string::npos) r.argument = quantity.substr(at + 1);
  name.erase(0, std::string("gauge.").size());
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos)
    throw InputError(fmt::format(
        "error: the quantity '{}' does not name a column\n   = help: e.g. gauge.{}.velocity@3.8us", quantity,
        name));
  r.gauge = name.substr(0, dot);
  r.column = name.substr(dot + 1);
  const std::size_t last = r.column.rfind('.');
  const std::string tail = last == std::string::npos ? "" : r.column.substr(last + 1);
  if (config::is_reduction(tail)) {
    r.reduction = tail;
    r.column.erase(last);
  } else if (at != std::string::npos) {
    r.reduction = "at";
  } else {
    throw InputError(fmt::format(
        "error: the quantity '{}' does not say which value of the record\n"
        "   = help: append @TIME, .peak, .last, .pullback, .max, .min, .mean@FROM..TO, .rms@FROM..TO, "
        ".slope@FROM..TO, .arrival@LEVEL or .until@LEVEL",
        quantity));
  }
  const bool bare = r.reduction == "peak" || r.reduction == "last" || r.reduction == "pullback";
  const bool either = r.reduction == "max" || r.reduction == "min";
  if (!either && bare != r.argument.empty())
    throw InputError(fmt::format("error: the quantity '{}': '{}' {}", quantity, r.reduction,
                                 bare ? "takes nothing after '@'" : "needs an argument after '@'"));
  return r;
}

struct Window {
  double from = 0, to = 0;
};

/// @param over what the record runs over: time or distance.
Window parse_window(const Request& r, const std::string& text, const SeriesColumn& over) {
  const std::size_t dots = text.find("..");
  const std::string unit = config::si_unit_of(over.unit);
  if (dots == std::string::npos)
    throw InputError(fmt::format("error: the quantity '{}': '{}' is not a span of {}\n   = help: e.g. {}",
                                 r.quantity, text, over.name, unit == "s" ? "0.2us..0.5us" : "2mm..5mm"));
  const Window w{number_of(r.quantity, text.substr(0, dots), unit),
                 number_of(r.quantity, text.substr(dots + 2), unit)};
  if (!(w.to > w.from))
    throw InputError(fmt::format(
        "error: the quantity '{}': the span of {} is empty\n   = help: its smaller end comes first: FROM..TO",
        r.quantity, over.name));
  return w;
}

double size_of(const CsvTable& table, const std::string& column) {
  const std::string unit = table.unit(column);
  if (unit.empty())
    throw InputError(
        fmt::format("error: the column '{}' of '{}' has no unit\n   = help: write it like `time [us]`",
                    column, table.path.string()));
  return config::unit_size(unit);
}

/// The reference curve in FILE:COLUMN; time or distance is the file's first column.
Curve read_reference(const Quantities& q, const Request& r, const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0)
    throw InputError(
        fmt::format("error: the quantity '{}' does not name a reference\n"
                    "   = help: e.g. .error@3us..5us:reference.csv:velocity",
                    r.quantity));
  const CsvTable table = read_csv(q.folder / text.substr(0, colon));
  const std::string column = text.substr(colon + 1);
  Curve curve{table.numbers(table.columns.front()), table.numbers(column)};
  const double time = size_of(table, table.columns.front()), value = size_of(table, column);
  for (double& t : curve.t) t *= time;
  for (double& y : curve.y) y *= value;
  if (!std::is_sorted(curve.t.begin(), curve.t.end()))
    throw InputError(fmt::format("error: the times in '{}' do not increase", table.path.string()));
  return curve;
}

std::string si_unit(const SeriesColumn& column) {
  return column.unit == "1" ? "1" : config::si_unit_of(column.unit);
}

/// The largest or smallest value, of the whole record or of a span of time.
double extreme(const Request& r, const Curve& curve, const SeriesColumn& over) {
  if (curve.t.empty()) return nothing;
  const Window w =
      r.argument.empty() ? Window{curve.t.front(), curve.t.back()} : parse_window(r, r.argument, over);
  if (curve.t.size() == 1 && r.argument.empty()) return curve.y.front();
  return r.reduction == "max" ? most_over(curve, w.from, w.to) : least_over(curve, w.from, w.to);
}

double reduce(const Quantities& q, const Request& r, const TimeSeries& series, std::size_t column) {
  const Curve curve = curve_of(series, column);
  if (r.reduction == "at")
    return value_at(curve, number_of(r.quantity, r.argument, config::si_unit_of(series.over.unit)));
  if (r.reduction == "peak") return peak_of(curve).value;
  if (r.reduction == "pullback") return pull_back_of(curve).fall;
  if (r.reduction == "last") return curve.y.empty() ? nothing : curve.y.back();
  if (r.reduction == "max" || r.reduction == "min") return extreme(r, curve, series.over);
  if (r.reduction == "arrival")
    return arrival_at(curve, number_of(r.quantity, r.argument, si_unit(series.columns[column])));
  if (r.reduction == "until")
    return last_at(curve, number_of(r.quantity, r.argument, si_unit(series.columns[column])));
  const std::size_t colon = r.reduction == "error" ? r.argument.find(':') : std::string::npos;
  const Window w = parse_window(r, r.argument.substr(0, colon), series.over);
  if (r.reduction == "mean") return mean_over(curve, w.from, w.to);
  if (r.reduction == "rms") return rms_over(curve, w.from, w.to);
  if (r.reduction == "slope") return slope_over(curve, w.from, w.to);
  const std::string where = colon == std::string::npos ? "" : r.argument.substr(colon + 1);
  return distance_over(curve, read_reference(q, r, where), w.from, w.to);
}

double measure_gauge(const Quantities& q, const std::string& name) {
  const Request r = parse_request(name);
  std::vector<std::string> names;
  for (const TimeSeries& s : q.gauges) {
    names.push_back(s.name);
    if (s.name != r.gauge) continue;
    const std::size_t column = s.find(r.column);
    if (column < s.columns.size()) return reduce(q, r, s, column);
    std::vector<std::string> columns;
    for (const SeriesColumn& c : s.columns) columns.push_back(c.name);
    unknown(name, fmt::format("gauge '{}' has no column '{}'", r.gauge, r.column), r.column, columns);
  }
  unknown(name, fmt::format("there is no gauge '{}'", r.gauge), r.gauge, names);
}

/// The gauge and the column that a quantity speaks of; a column past the end: it names none.
std::pair<const TimeSeries*, std::size_t> column_named_in(const Quantities& q, const std::string& quantity) {
  for (const TimeSeries& s : q.gauges) {
    const std::string begin = "gauge." + s.name + ".";
    if (!quantity.starts_with(begin)) continue;
    std::string column = quantity.substr(begin.size(), quantity.find('@') - begin.size());
    if (s.find(column) == s.columns.size()) column = column.substr(0, column.rfind('.'));
    return {&s, s.find(column)};
  }
  return {nullptr, 0};
}

/// `mm` over `us` is `mm/us`, `m/s` over it `m/(s us)`.
std::string unit_of_slope(const std::string& unit, const std::string& over) {
  const std::size_t bar = unit.find('/');
  if (bar == std::string::npos) return unit + "/" + over;
  std::string below = unit.substr(bar + 1);
  if (below.starts_with('(')) below = below.substr(1, below.size() - 2);
  return unit.substr(0, bar) + "/(" + below + " " + over + ")";
}

/// Says why a name is none of a number, or of a flag.
[[noreturn]] void refuse_name(const Quantities& q, const std::string& name, bool as_flag) {
  if (as_flag && q.numbers.contains(name))
    throw InputError(
        fmt::format("error: the quantity '{}' is a number, not true or false\n   = help: expect a value "
                    "with a tolerance, or a limit, e.g. {{ at-most = 1 }}",
                    name));
  if (!as_flag && q.flags.contains(name))
    throw InputError(
        fmt::format("error: the quantity '{}' is true or false, not a number\n   = help: expect true or "
                    "false of it",
                    name));
  std::set<std::string> known;
  for (const auto& [key, value] : q.numbers) known.insert(key);
  for (const auto& [key, value] : q.flags) known.insert(key);
  unknown(name, "no run of this case has such a result", name, {known.begin(), known.end()});
}

}  // namespace

std::optional<ReferenceCurve> record_of(const std::string& quantity) {
  if (!quantity.starts_with("gauge.")) return std::nullopt;
  const Request r = parse_request(quantity);
  const std::size_t first = r.argument.find(':'), last = r.argument.rfind(':');
  if (r.reduction != "error" || first == last) return ReferenceCurve{r.gauge, r.column, {}, {}};
  return ReferenceCurve{r.gauge, r.column, r.argument.substr(first + 1, last - first - 1),
                        r.argument.substr(last + 1)};
}

std::optional<ReferenceCurve> reference_curve_of(const std::string& quantity) {
  if (quantity.find(".error@") == std::string::npos) return std::nullopt;
  auto record = record_of(quantity);
  return record && !record->file.empty() ? record : std::nullopt;
}

Measured measure(const Quantities& q, const std::string& name, bool as_flag) {
  Measured m;
  m.is_flag = as_flag;
  if (as_flag) {
    const auto found = q.flags.find(name);
    if (found == q.flags.end()) refuse_name(q, name, as_flag);
    m.flag = found->second;
    m.value = m.flag ? 1 : 0;
    return m;
  }
  if (name.starts_with("gauge.")) {
    m.value = measure_gauge(q, name);
    if (std::isnan(m.value)) m.problem = "the record has no value there";
    return m;
  }
  const auto found = q.numbers.find(name);
  if (found == q.numbers.end()) refuse_name(q, name, as_flag);
  m.value = found->second;
  if (std::isnan(m.value)) m.problem = "it did not happen";
  return m;
}

std::string unit_of(const Quantities& q, const std::string& quantity) {
  if (const auto [series, column] = column_named_in(q, quantity); series) {
    const std::string name = quantity.substr(0, quantity.find('@'));
    const bool over = name.ends_with(".arrival") || name.ends_with(".until");
    if (over || column == series->columns.size()) return series->over.unit;
    const std::string& unit = series->columns[column].unit;
    return name.ends_with(".slope") ? unit_of_slope(unit, series->over.unit) : unit;
  }
  const auto at = q.units.find(quantity);
  return at == q.units.end() ? "1" : at->second;
}

CheckResult check(const Quantities& q, const config::Expectation& e) {
  CheckResult r;
  r.expected = e;
  try {
    r.measured = measure(q, e.quantity, e.is_flag);
  } catch (const InputError& error) {
    r.measured = {nothing, e.is_flag, false, error.what()};
    return r;
  }
  if (e.is_flag)
    r.pass = r.measured.flag == e.flag;
  else if (std::isnan(r.measured.value))
    r.pass = false;
  else if (e.at_most)
    r.pass = r.measured.value <= e.value;
  else if (e.at_least)
    r.pass = r.measured.value >= e.value;
  else
    r.pass = std::abs(r.measured.value - e.value) <= e.tolerance * (1 + 1e-12);
  return r;
}

}  // namespace recoil
