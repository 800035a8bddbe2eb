#include "app/sweep/swept_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "config/document.hpp"
#include "config/units.hpp"

namespace recoil::app {

namespace {

constexpr const char* source_name = "--set";
constexpr int most_values = 10000;
constexpr std::size_t longest_name = 200;  // of a folder

/// A part of a text and where it begins.
struct Part {
  std::string text;
  std::size_t begin = 0;
};

/// Parts between separators that stand outside of quotes and brackets, without blanks around them.
std::vector<Part> split(const std::string& text, char separator, std::size_t begin) {
  std::vector<Part> parts{{"", begin}};
  int depth = 0;
  char quote = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    if (quote) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else {
      depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    }
    if (c == separator && !quote && depth == 0)
      parts.push_back({"", i + 1});
    else
      parts.back().text += c;
  }
  for (Part& p : parts) {
    const std::size_t first = std::min(p.text.find_first_not_of(" \t"), p.text.size());
    p.begin += first;
    p.text = p.text.substr(first, p.text.find_last_not_of(" \t") + 1 - first);
  }
  return parts;
}

/// One --set, its line among them, and where mistakes in it go.
struct Reading {
  const std::string& text;
  int line;
  config::Diagnostics& out;

  void error(const Part& part, std::string message, std::string help) const {
    out.error({source_name, line, static_cast<int>(part.begin) + 1,
               std::max(1, static_cast<int>(part.text.size()))},
              std::move(message), std::move(help));
  }
};

std::string without_quotes(const std::string& text) {
  const bool quoted =
      text.size() > 1 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return quoted ? text.substr(1, text.size() - 2) : text;
}

config::Quantity quantity_in(const std::string& text) {
  return config::parse_any_quantity(without_quotes(text), "a value");
}

double in_unit(const config::Quantity& q, const std::string& unit) {
  if (q.unit == unit) return q.written;
  return unit.empty() ? q.value : config::in_unit(q.value, unit);
}

void add_even_values(SweptKey& key, double from, double to, int count) {
  for (int k = 0; k < count; ++k) {
    key.numbers.push_back(rounded_in_range(from + (to - from) * k / (count - 1)));
    key.values.push_back(range_value(key.numbers.back(), key.unit));
  }
}

/// The N of FROM:TO:N; 0: it is none.
int count_in(const std::string& text) {
  int n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  return error == std::errc() && end == text.data() + text.size() && n >= 2 && n <= most_values ? n : 0;
}

void read_range(SweptKey& key, const std::vector<Part>& ends, const Reading& in) {
  const config::Quantity from = quantity_in(ends[0].text), to = quantity_in(ends[1].text);
  for (const auto& [q, part] : {std::pair{from, ends[0]}, std::pair{to, ends[1]}})
    if (!q.ok())
      return in.error(part, q.problem,
                      q.help.empty() ? "a range is FROM:TO:N, e.g. 200m/s:800m/s:7" : q.help);
  if (config::dimension_name(from.unit) != config::dimension_name(to.unit))
    return in.error(ends[1],
                    fmt::format("'{}' and '{}' have different dimensions", ends[0].text, ends[1].text),
                    "both ends of a range have the same unit, e.g. 200m/s:800m/s:7");
  const int count = ends.size() < 3 ? 2 : count_in(ends[2].text);
  if (count == 0)
    return in.error(ends[2], fmt::format("'{}' is no number of values", ends[2].text),
                    fmt::format("FROM:TO:N has N values, a whole number from 2 to {}", most_values));
  key.unit = from.unit;
  const double last = in_unit(to, key.unit);
  if (last == from.written) return in.error(ends[1], "the range is empty", "give two different ends");
  key.is_range = true;
  add_even_values(key, from.written, last, count);
}

/// The values as numbers, where they all are.
void find_numbers(SweptKey& key) {
  std::string unit;
  std::vector<double> numbers;
  for (const std::string& text : key.values) {
    const config::Quantity q = quantity_in(text);
    if (!q.ok()) return;
    if (numbers.empty()) unit = q.unit;
    if (config::dimension_name(q.unit) != config::dimension_name(unit)) return;
    numbers.push_back(in_unit(q, unit));
  }
  key.unit = unit;
  key.numbers = numbers;
}

void read_list(SweptKey& key, const std::vector<Part>& parts, const Reading& in) {
  for (const Part& p : parts) {
    if (p.text.empty())
      return in.error(p, "a value is missing", "values have one comma between them: 0.2mm,0.1mm");
    if (std::ranges::find(key.values, p.text) != key.values.end())
      return in.error(p, fmt::format("the value {} is there twice", p.text), "omit one of them");
    key.values.push_back(p.text);
  }
  find_numbers(key);
}

SweptKey read_one(const Reading& in) {
  SweptKey key;
  const std::size_t equals = in.text.find('=');
  if (equals == 0 || equals == std::string::npos) {
    in.error({in.text, 0}, fmt::format("'{}' sets nothing", in.text),
             "write KEY=V1,V2,... or KEY=FROM:TO:N, e.g. mesh.finest=0.2mm,0.1mm");
    return key;
  }
  key.key = in.text.substr(0, in.text.find_last_not_of(" \t", equals - 1) + 1);
  const std::vector<Part> parts = split(in.text, ',', equals + 1), ends = split(in.text, ':', equals + 1);
  if (parts.size() == 1 && (ends.size() == 2 || ends.size() == 3))
    read_range(key, ends, in);
  else
    read_list(key, parts, in);
  return key;
}

/// 64 bits that differ where texts do (FNV-1a).
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t h = 14695981039346656037ULL;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return h;
}

}  // namespace

std::string range_value(double number, const std::string& unit) {
  return fmt::format("{:.10g}{}{}", number, unit.empty() ? "" : " ", unit);
}

double rounded_in_range(double number) {
  return std::strtod(fmt::format("{:.10g}", number).c_str(), nullptr);
}

std::vector<SweptKey> read_swept_keys(const std::vector<std::string>& texts, config::Diagnostics& out) {
  std::string all;
  for (const std::string& text : texts) all += text + '\n';
  out.source(source_name, all);
  std::vector<SweptKey> keys;
  int line = 0;
  for (const std::string& text : texts) {
    const Reading in{text, ++line, out};
    SweptKey key = read_one(in);
    const bool twice = std::ranges::any_of(keys, [&](const SweptKey& k) { return k.key == key.key; });
    if (twice && !key.key.empty())
      in.error({key.key, 0}, fmt::format("'{}' is set twice", key.key), "give all its values in one --set");
    keys.push_back(std::move(key));
  }
  return keys;
}

std::vector<Combination> combinations_of(const std::vector<SweptKey>& keys) {
  std::vector<Combination> all{{}};
  for (const SweptKey& key : keys) {
    std::vector<Combination> longer;
    for (const Combination& c : all)
      for (std::size_t k = 0; k < key.values.size(); ++k) {
        longer.push_back(c);
        longer.back().push_back(k);
      }
    all = std::move(longer);
  }
  return all;
}

std::vector<std::string> changes_of(const std::vector<SweptKey>& keys, const Combination& at) {
  std::vector<std::string> changes;
  for (std::size_t k = 0; k < keys.size(); ++k) changes.push_back(keys[k].key + "=" + keys[k].values[at[k]]);
  return changes;
}

std::string folder_name(const std::vector<std::string>& changes) {
  std::string whole, name;
  for (const std::string& change : changes) whole += (whole.empty() ? "" : ",") + change;
  for (const char c : whole) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (c == ' ' || c == '"') continue;
    name += plain || std::string("._-+=,").find(c) != std::string::npos ? c : '_';
  }
  if (name.size() > longest_name)
    name = fmt::format("{}_{:016x}", name.substr(0, longest_name), hash_of(whole));
  return name.empty() ? "run" : name;
}

}  // namespace recoil::app
