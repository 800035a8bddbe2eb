#include "config/shape/stl/stl_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>

namespace recoil::config {

namespace {

constexpr std::size_t header = 84, record = 50;  // bytes of a binary file: before the triangles, and of one

/// Gathers triangles; equal points become one.
class Collector {
 public:
  void add(const Vec<3>& point) {
    std::array<double, 3> key{};
    for (std::size_t d = 0; d < 3; ++d) key[d] = point[static_cast<int>(d)] + 0.0;  // -0 is 0
    const auto [found, fresh] = seen_.try_emplace(key, static_cast<int>(surface.points.size()));
    if (fresh) surface.points.push_back({key});
    corner_[filled_++] = found->second;
    if (filled_ < 3) return;
    filled_ = 0;
    const auto [a, b, c] = corner_;
    if (a != b && b != c && c != a)
      surface.corners.push_back(corner_);  // else it has no area, and no edge of its own
  }
  bool between_triangles() const { return filled_ == 0; }

  Triangles surface;

 private:
  std::map<std::array<double, 3>, int> seen_;
  std::array<int, 3> corner_{};
  std::size_t filled_ = 0;
};

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t n = 0;
  for (std::size_t i = 0; i < 4; ++i)
    n |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << 8 * i;
  return n;
}

StlFile binary(std::string_view bytes, std::size_t triangles, const std::string& name) {
  Collector all;
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec<3> p;
      for (std::size_t d = 0; d < 3; ++d)
        p[static_cast<int>(d)] =
            std::bit_cast<float>(number_at(bytes, header + t * record + 12 + 12 * corner + 4 * d));
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        return {{},
                fmt::format("{}: triangle {} has a corner that is no number", name, t + 1),
                "export it again"};
      all.add(p);
    }
  return {std::move(all.surface), "", ""};
}

/// Words of a text and the lines that they stand in.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  /// The next word; empty at the end.
  std::string_view next() {
    std::size_t begin = 0;
    while (begin < rest_.size() && is_blank(rest_[begin])) line_ += rest_[begin++] == '\n';
    rest_.remove_prefix(begin);
    std::size_t end = 0;
    while (end < rest_.size() && !is_blank(rest_[end])) ++end;
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }
  /// To the end of the line: names of solids may be anything.
  void skip_line() { rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); }
  int line() const { return line_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
  std::string_view rest_;
  int line_ = 1;
};

/// FNV-1a of 64 bits (Fowler, Noll & Vo), in hexadecimal digits.
std::string digest_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return fmt::format("{:016x}", hash);
}

bool read_number(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

StlFile text(std::string_view bytes, const std::string& name) {
  Collector all;
  Words words(bytes);
  const auto wrong = [&](const std::string& what) {
    return StlFile{{}, fmt::format("{}, line {}: {}", name, words.line(), what), "export it again"};
  };
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "solid" || word == "endsolid") {
      words.skip_line();
    } else if (word == "vertex") {
      Vec<3> p;
      for (int d = 0; d < 3; ++d)
        if (const auto number = words.next(); !read_number(number, p[d]))
          return wrong(fmt::format("'{}' is not a coordinate", number));
      all.add(p);
    } else if (word == "endloop") {
      if (!all.between_triangles()) return wrong("a facet that is no triangle");
    } else if (word == "normal") {
      for (int d = 0; d < 3; ++d) words.next();
    } else if (word != "facet" && word != "outer" && word != "loop" && word != "endfacet") {
      return wrong(fmt::format("'{}' does not belong to an STL file", word.substr(0, 40)));
    }
  }
  if (!all.between_triangles()) return wrong("the file ends within a triangle");
  return {std::move(all.surface), "", ""};
}

}  // namespace

StlFile parse_stl(std::string_view bytes, const std::string& name) {
  const std::size_t triangles = bytes.size() >= header ? number_at(bytes, header - 4) : 0;
  const bool is_text = bytes.starts_with("solid");
  const std::size_t needed = header + triangles * record;
  StlFile file;
  if (bytes.size() == needed)
    file = binary(bytes, triangles, name);
  else if (is_text)
    file = text(bytes, name);
  else
    return {
        {},
        fmt::format(
            "{} is no STL file, or cut short: it does not begin with 'solid', and as a binary file it would "
            "have {} triangles in {} bytes, but has {} bytes",
            name, triangles, needed, bytes.size()),
        "export it again as STL"};
  if (file.problem.empty() && file.surface.corners.empty())
    return {{}, fmt::format("{} holds no triangle", name), "export it again as STL"};
  return file;
}

StlFile read_stl(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) return {{}, fmt::format("{} cannot be read", path.string()), ""};
  StlFile file = parse_stl(bytes, path.filename().string());
  file.digest = digest_of(bytes);
  return file;
}

}  // namespace recoil::config
