#include "config/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <system_error>
#include <vector>

#include "config/habits/unit_habits.hpp"
#include "core/characters.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"

namespace recoil::config {

namespace {

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;

/// The units that udunits knows. Read once from its XML file: parsing it takes milliseconds.
ut_system* unit_system() {
  static const std::unique_ptr<ut_system, decltype(&ut_free_system)> all = [] {
    ut_set_error_message_handler(ut_ignore);
    return std::unique_ptr<ut_system, decltype(&ut_free_system)>(ut_read_xml(nullptr), &ut_free_system);
  }();
  if (!all)
    throw EnvironmentError("the unit definitions of udunits2 cannot be read; is libudunits2-data installed?");
  return all.get();
}

std::string_view trimmed(std::string_view s) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!s.empty() && blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && blank(s.back())) s.remove_suffix(1);
  return s;
}

/// Calls f(word) for each run of letters and puts what it returns in the word's place.
template <class F>
std::string map_words(std::string_view unit, F&& f) {
  std::string out;
  for (std::size_t i = 0; i < unit.size();) {
    std::size_t j = i;
    while (j < unit.size() && is_letter(unit[j])) ++j;
    if (j == i) {
      out += unit[i++];
    } else {
      out += f(std::string(unit.substr(i, j - i)));
      i = j;
    }
  }
  return out;
}

/// udunits writes these differently.
std::string udunits_name(std::string_view unit) {
  return map_words(unit, [](std::string word) {
    return word == "deg" ? std::string("degree") : word == "rev" ? std::string("turn") : word;
  });
}

/// Numbers hidden in a unit ("mm 5", "K @ 3") would be taken as factors and shifts; exponents are fine.
bool has_stray_number(std::string_view unit) {
  if (unit.find('@') != std::string_view::npos) return true;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (!is_digit(unit[i]) && unit[i] != '.') continue;
    const char before = i > 0 ? unit[i - 1] : ' ';
    const bool exponent =
        is_letter(before) || before == '^' || before == ')' || before == '-' || is_digit(before);
    const bool one_over = unit[i] == '1' && i == 0 && unit.size() > 1 && unit[1] == '/';
    const bool dot_between = unit[i] == '.' && is_letter(before);
    if (!exponent && !one_over && !dot_between) return true;
  }
  return false;
}

Unit parse_unit(std::string_view unit) {
  if (has_stray_number(unit) && unit != "1") return Unit(nullptr, &ut_free);
  return Unit(ut_parse(unit_system(), udunits_name(unit).c_str(), UT_UTF8), &ut_free);
}

/// A unit's product of base units ("m.s-1"), without factor and shift. Radians count as a base unit here,
/// unlike in ut_are_convertible: 100 Hz shall not pass for 100 rad/s.
std::string base_units(const ut_unit* unit) {
  std::array<char, 256> text{};
  const int n = ut_format(unit, text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION);
  if (n < 0) return "?";
  std::string_view s(text.data(), static_cast<std::size_t>(n));
  s = s.substr(0, s.find(" @"));
  const std::size_t blank = s.find(' ');
  if (blank != std::string_view::npos && (is_digit(s[0]) || s[0] == '.')) s.remove_prefix(blank + 1);
  return std::string(s);
}

struct Dimension {
  std::string_view si, name;
};

constexpr std::array dimensions{Dimension{"1", "none"},
                                Dimension{"m", "length"},
                                Dimension{"s", "time"},
                                Dimension{"kg", "mass"},
                                Dimension{"K", "temperature"},
                                Dimension{"m/s", "velocity"},
                                Dimension{"m/s2", "acceleration"},
                                Dimension{"Pa", "pressure"},
                                Dimension{"kg/m3", "density"},
                                Dimension{"J/(kg K)", "specific heat"},
                                Dimension{"J", "energy"},
                                Dimension{"J/kg", "specific energy"},
                                Dimension{"J/m", "energy per length"},
                                Dimension{"N", "force"},
                                Dimension{"N s", "momentum"},
                                Dimension{"kg/m2", "mass per area"},
                                Dimension{"kg/m", "mass per length"},
                                Dimension{"kg/s", "momentum per length"},
                                Dimension{"N/m", "force per length"},
                                Dimension{"kg m2", "moment of inertia"},
                                Dimension{"kg m", "moment of inertia per length"},
                                Dimension{"kg m2/s", "angular momentum"},
                                Dimension{"rad", "angle"},
                                Dimension{"rad/s", "angular velocity"},
                                Dimension{"1/s", "rate"},
                                Dimension{"m2", "area"},
                                Dimension{"m3", "volume"},
                                Dimension{"kg/mol", "molar mass"},
                                Dimension{"W/(m K)", "thermal conductivity"},
                                Dimension{"Pa s", "viscosity"}};

const Dimension* dimension_of(const ut_unit* unit) {
  const std::string base = base_units(unit);
  for (const Dimension& d : dimensions)
    if (const Unit si = parse_unit(d.si); si && base_units(si.get()) == base) return &d;
  return nullptr;
}

std::string name_of(const ut_unit* unit) {
  const Dimension* d = dimension_of(unit);
  return d ? std::string(d->name) : base_units(unit);
}

/// Reports a unit that cannot be what was meant. @return whether it was one.
bool is_habit(Quantity& q, std::string_view text) {
  const std::string_view meant = meant_by(q.unit);
  if (meant.empty()) return false;
  q.problem = fmt::format("unknown unit '{}' in '{}'", q.unit, text);
  q.help = fmt::format("did you mean '{}'?", meant);
  return true;
}

/// Help for a unit that udunits does not know.
std::string nearest_unit(std::string_view unit) {
  static const std::vector<std::string> common{"m",   "mm",  "cm",  "um",  "nm",   "km",   "s",  "ms",   "us",
                                               "ns",  "ps",  "min", "kg",  "g",    "mg",   "K",  "degC", "Pa",
                                               "kPa", "MPa", "GPa", "bar", "kbar", "Mbar", "J",  "kJ",   "MJ",
                                               "N",   "kN",  "W",   "rad", "deg",  "in",   "rpm"};
  bool found = false;
  const std::string better = map_words(unit, [&](std::string word) {
    if (parse_unit(word)) return word;
    const std::string near = closest(word, common);
    if (near.empty() || (word.size() == 1 && edit_distance(word, near) > 0)) return word;
    found = true;
    return near;
  });
  if (found && parse_unit(better)) return "did you mean '" + better + "'?";
  return "units are written like mm, us, km/s, g/cm3, GPa, J/(kg K), deg";
}

/// SI = zero + factor * value.
struct Scale {
  double zero, factor;
};

Scale scale(ut_unit* from, ut_unit* to) {
  const std::unique_ptr<cv_converter, decltype(&cv_free)> c(ut_get_converter(from, to), &cv_free);
  require(c != nullptr, "units of one dimension convert");
  const double zero = cv_convert_double(c.get(), 0);
  return {zero, cv_convert_double(c.get(), 1) - zero};
}

double convert(double value, ut_unit* from, ut_unit* to) {
  const Scale s = scale(from, to);
  return s.zero + s.factor * value;
}

struct Split {
  bool number = false;
  bool infinite = false;  // "nan", "inf", or beyond the range of numbers
  double value = 0;
  std::string_view digits;  // the number as written
  std::string_view rest;
};

/// Converts a number as written. Where the units differ by a power of ten only the exponent is moved, so that
/// "0.05 mm", "50 um" and 5e-5 are the same double.
double convert_text(std::string_view digits, double value, ut_unit* from, ut_unit* to) {
  const Scale s = scale(from, to);
  const int power = static_cast<int>(std::lround(std::log10(s.factor)));
  if (s.zero != 0 || std::abs(s.factor / std::pow(10.0, power) - 1) > 1e-15) return s.zero + s.factor * value;
  const std::size_t e = digits.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) {
    const std::string_view after = digits.substr(e + (digits.substr(e + 1).starts_with('+') ? 2 : 1));
    std::from_chars(after.data(), after.data() + after.size(), exponent);
  }
  const std::string moved = fmt::format("{}e{}", digits.substr(0, e), exponent + power);
  double result = 0;
  const auto [end, error] = std::from_chars(moved.data(), moved.data() + moved.size(), result);
  return error == std::errc() ? result : s.factor * value;
}

Split split_number(std::string_view text) {
  Split s;
  std::string_view t = text;
  if (t.starts_with('+')) t.remove_prefix(1);
  const std::string_view digits = t.starts_with('-') ? t.substr(1) : t;
  for (const char* word : {"nan", "inf", "NaN", "Inf", "INF", "NAN"})
    if (digits.starts_with(word)) s.infinite = true;
  if (digits.empty() || !(is_digit(digits[0]) || digits[0] == '.')) return s;  // keeps "inf" and "nan" out
  const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), s.value);
  if (error != std::errc() || !std::isfinite(s.value)) {
    s.infinite = true;
    return s;
  }
  s.number = true;
  s.digits = std::string_view(t.data(), static_cast<std::size_t>(end - t.data()));
  s.rest = trimmed(t.substr(static_cast<std::size_t>(end - t.data())));
  return s;
}

std::string example(std::string_view si) {
  if (si.empty() || si == "1") return "a number, e.g. 0.5 or \"50 %\"";
  const auto is = [&](std::string_view unit) { return si == unit; };
  return "a number and a unit, e.g. \"" +
         std::string(is("m")       ? "0.5 mm"
                     : is("s")     ? "10 us"
                     : is("m/s")   ? "450 m/s"
                     : is("Pa")    ? "1.2 GPa"
                     : is("rad")   ? "10 deg"
                     : is("kg/m3") ? "8.93 g/cm3"
                                   : "1 " + std::string(si)) +
         "\"";
}

/// Number and unit of a text; the SI value is left to the caller.
Quantity split_quantity(std::string_view text, const Split& s, std::string_view si, std::string_view name) {
  Quantity q;
  if (s.infinite) {
    q.problem = fmt::format("'{}' must be finite, but is '{}'", name, text);
    q.help = "write " + example(si);
    return q;
  }
  if (!s.number) {
    q.problem = fmt::format("'{}' is not a quantity: '{}' needs a number and a unit", text, name);
    q.help = "write " + example(si);
    return q;
  }
  q.written = s.value;
  q.unit = std::string(s.rest);
  if (s.rest.size() > 1 && s.rest[0] == ',' && is_digit(s.rest[1])) {
    q.problem = fmt::format("'{}' has a decimal comma", text);
    q.help = "use a decimal point";
  }
  return q;
}

}  // namespace

Quantity parse_quantity(std::string_view text, std::string_view si_unit, std::string_view name) {
  const std::string_view si = si_unit.empty() ? "1" : si_unit;
  const Split split = split_number(trimmed(text));
  Quantity q = split_quantity(text, split, si, name);
  if (!q.ok()) return q;
  if (q.unit.empty() && si != "1") {
    q.problem = fmt::format("'{}' has no unit, but '{}' needs one of [{}]", text, name, dimension_name(si));
    q.help = "write " + example(si);
    return q;
  }
  if (is_habit(q, text)) return q;
  const Unit unit = parse_unit(q.unit.empty() ? "1" : q.unit), target = parse_unit(si);
  require(target != nullptr, "a key's own unit is known");
  if (!unit) {
    q.problem = fmt::format("unknown unit '{}' in '{}'", q.unit, text);
    q.help = nearest_unit(q.unit);
    return q;
  }
  if (base_units(unit.get()) != base_units(target.get())) {
    q.problem = fmt::format("'{}' has dimension [{}], but '{}' needs [{}]", text, name_of(unit.get()), name,
                            name_of(target.get()));
    const std::string_view degrees = si == "K" ? degrees_of(q.unit) : "";
    q.help = degrees.empty() ? "write " + example(si) : std::string(degrees);
    return q;
  }
  q.value = convert_text(split.digits, q.written, unit.get(), target.get());
  if (!std::isfinite(q.value)) {
    q.problem = fmt::format("'{}' must be finite, but '{}' is beyond the range of numbers", name, text);
    q.help = "write " + example(si);
  }
  return q;
}

Quantity parse_any_quantity(std::string_view text, std::string_view name) {
  const Split split = split_number(trimmed(text));
  Quantity q = split_quantity(text, split, "m/s", name);
  if (!q.ok() || q.unit.empty()) {
    q.value = q.written;
    return q;
  }
  if (is_habit(q, text)) return q;
  const Unit unit = parse_unit(q.unit);
  const Dimension* d = unit ? dimension_of(unit.get()) : nullptr;
  if (!unit) {
    q.problem = fmt::format("unknown unit '{}' in '{}'", q.unit, text);
    q.help = nearest_unit(q.unit);
  } else if (!d) {
    q.problem = fmt::format("'{}' has dimension [{}], which no result has", text, base_units(unit.get()));
  } else {
    q.value = convert_text(split.digits, q.written, unit.get(), parse_unit(d->si).get());
    if (!std::isfinite(q.value)) q.problem = fmt::format("'{}' is beyond the range of numbers", text);
  }
  return q;
}

namespace {

struct Pair {
  Unit unit, si;
};

Pair known_unit(std::string_view unit) {
  Pair p{parse_unit(unit.empty() ? "1" : unit), Unit(nullptr, &ut_free)};
  if (!p.unit) throw InputError(fmt::format("unknown unit '{}'; {}", unit, nearest_unit(unit)));
  const Dimension* d = dimension_of(p.unit.get());
  if (!d)
    throw InputError(fmt::format("unit '{}' has an unusual dimension [{}]", unit, base_units(p.unit.get())));
  p.si = parse_unit(d->si);
  return p;
}

}  // namespace

double unit_size(std::string_view unit) {
  const Pair p = known_unit(unit);
  return scale(p.unit.get(), p.si.get()).factor;
}

double in_unit(double si, std::string_view unit) {
  const Pair p = known_unit(unit);
  return convert(si, p.si.get(), p.unit.get());
}

std::string format_quantity(double si, std::string_view unit, int digits) {
  const std::string number = fmt::format("{:.{}g}", in_unit(si, unit), digits);
  return unit.empty() || unit == "1" ? number : fmt::format("{} {}", number, unit);
}

std::string dimension_name(std::string_view unit) {
  const Unit u = parse_unit(unit.empty() ? "1" : unit);
  if (!u) throw InputError(fmt::format("unknown unit '{}'", unit));
  return name_of(u.get());
}

bool is_comparable(double value, std::string_view given, std::string_view needed) {
  return (value == 0 && given.empty()) || dimension_name(given) == dimension_name(needed);
}

std::string si_unit_of(std::string_view unit) {
  const Unit u = parse_unit(unit.empty() ? "1" : unit);
  const Dimension* d = u ? dimension_of(u.get()) : nullptr;
  return d ? std::string(d->si) : std::string();
}

}  // namespace recoil::config
