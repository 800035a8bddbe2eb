#include "config/declare/write.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>

namespace recoil::config {

std::string written_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool is_control = code < 0x20 || code == 0x7f;  // which TOML takes in no other form
    if (is_control)
      out += fmt::format("\\u{:04X}", code);
    else
      out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
  return out + '"';
}

std::string written_number(double value) { return fmt::format("{}", value); }

std::string written_quantity(double value, const std::string& unit) {
  return unit.empty() || unit == "1" ? written_number(value)
                                     : fmt::format("\"{} {}\"", written_number(value), unit);
}

std::string written_range(double lo, double hi, const std::string& unit) {
  return fmt::format("[{}, {}]", written_quantity(lo, unit), written_quantity(hi, unit));
}

std::string written_list(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& t : texts) parts.push_back(written_text(t));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string Writing::vector(const Vector& v, const std::string& unit) const {
  std::vector<WrittenKey> parts;
  for (std::size_t d = 0; d < axes.size(); ++d) parts.push_back({axes[d], written_quantity(v[d], unit)});
  return inline_table(parts);
}

std::string inline_table(const std::vector<WrittenKey>& keys) {
  std::vector<std::string> parts;
  for (const WrittenKey& k : keys) parts.push_back(fmt::format("{} = {}", k.name, k.value));
  return fmt::format("{{ {} }}", fmt::join(parts, ", "));
}

}  // namespace recoil::config
