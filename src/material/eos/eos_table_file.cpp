#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "material/eos/eos_table.hpp"

namespace recoil {

namespace {

constexpr double most_points = 1e7;
constexpr double density_unit = 1e3, pressure_unit = 1e9, energy_unit = 1e6;  // g/cm3, GPa, MJ/kg

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Five numbers of 15 or 22 characters and five digits, which say which of them are there.
std::string_view without_flags(std::string_view line) {
  while (!line.empty() && blank(line.back())) line.remove_suffix(1);
  if (line.size() != 80 && line.size() != 115) return line;
  const std::string_view flags = line.substr(line.size() - 5);
  return flags.find_first_not_of("01") == std::string_view::npos ? line.substr(0, line.size() - 5) : line;
}

/// Numbers may stand against each other, "1.0E+00-2.0E+00". @returns false where something is no number.
bool add_numbers(std::string_view line, std::vector<double>& numbers) {
  const char *at = line.data(), *const end = at + line.size();
  while (true) {
    while (at != end && blank(*at)) ++at;
    if (at == end) return true;
    if (*at == '+') ++at;
    double x = 0;
    const auto [next, error] = std::from_chars(at, end, x);
    if (error != std::errc() || !std::isfinite(x)) return false;
    numbers.push_back(x);
    at = next;
  }
}

/// Whether a line heads a table: 0, 1 or 2, material, table, number of words, and a word such as "r".
bool is_header(std::string_view line, int& table) {
  std::vector<double> numbers;
  const std::size_t letter = line.find_first_of("rRcC");
  if (letter == std::string_view::npos || !add_numbers(line.substr(0, letter), numbers)) return false;
  if (numbers.size() < 4 || numbers[0] > 2 || numbers[2] != std::floor(numbers[2])) return false;
  table = static_cast<int>(numbers[2]);
  return true;
}

EosTableFile fail(std::string problem) {
  return {{},
          std::move(problem),
          "a table 301 of SESAME as text: nr, nt, densities in g/cm3, temperatures in K, pressures in GPa, "
          "energies in MJ/kg"};
}

/// Of the words of a table 301.
EosTableFile table_of(const std::vector<double>& words) {
  if (words.size() < 2) return fail("it holds no table 301");
  const double nr = words[0], nt = words[1];
  if (!(nr >= 1 && nt >= 1 && nr * nt < most_points) || nr != std::floor(nr) || nt != std::floor(nt))
    return fail(fmt::format(
        "it begins with {:g} and {:g}, which are no numbers of densities and temperatures", nr, nt));
  const auto rows = static_cast<std::size_t>(nr), columns = static_cast<std::size_t>(nt);
  const std::size_t needed = 2 + rows + columns + 2 * rows * columns;
  if (words.size() < needed)
    return fail(fmt::format("it has {} words; {} densities and {} temperatures need {}", words.size(), rows,
                            columns, needed));
  EosTableFile file;
  RawEosTable& t = file.table;
  const double* at = words.data() + 2;
  for (std::size_t i = 0; i < rows; ++i) t.density.push_back(*at++ * density_unit);
  for (std::size_t j = 0; j < columns; ++j) t.temperature.push_back(*at++);
  t.pressure.resize(rows * columns);
  t.energy.resize(rows * columns);
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < rows; ++i) {
      t.pressure[i * columns + j] = at[j * rows + i] * pressure_unit;
      t.energy[i * columns + j] = at[(columns + j) * rows + i] * energy_unit;
    }
  return file;
}

}  // namespace

EosTableFile parse_eos_table(std::string_view text) {
  std::vector<double> words;
  bool wanted = true;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    int table = 0;
    if (is_header(line, table)) {
      wanted = table == 301;
      continue;
    }
    if (wanted && !add_numbers(without_flags(line), words))
      return fail(fmt::format("line {} holds something that is no number", number));
  }
  return table_of(words);
}

EosTableFile read_eos_table(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path))
    return {{},
            "there is no file " + path.string(),
            "its path is seen from the folder of the file that names it"};
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EosTableFile file = parse_eos_table(text);
  if (!file.problem.empty()) file.problem = path.string() + ": " + file.problem;
  return file;
}

std::string to_text(const RawEosTable& t, const std::string& comment) {
  const std::size_t rows = t.density.size(), columns = t.temperature.size();
  std::vector<double> words{static_cast<double>(rows), static_cast<double>(columns)};
  for (const double rho : t.density) words.push_back(rho / density_unit);
  words.insert(words.end(), t.temperature.begin(), t.temperature.end());
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < rows; ++i) words.push_back(t.pressure[i * columns + j] / pressure_unit);
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < rows; ++i) words.push_back(t.energy[i * columns + j] / energy_unit);
  std::string text = "# " + comment + "\n" + fmt::format(" 0 0 301 {} r\n", words.size());
  for (std::size_t k = 0; k < words.size(); ++k)
    text += fmt::format("{:22.15E}{}", words[k], k % 5 == 4 || k + 1 == words.size() ? "\n" : "");
  return text;
}

}  // namespace recoil
