#include "format/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "format/json_files.hpp"

namespace recoil {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n#") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' ? ' ' : c;  // one row is one line
  }
  return out + "\"";
}

/// A cell or line in a message: of a long one its beginning.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  return text.size() > longest ? std::string(text.substr(0, longest)) + "..." : std::string(text);
}

std::string header_line(const std::vector<std::string>& columns) {
  std::vector<std::string> names;
  for (const auto& name : columns) names.push_back(quoted(name));
  return fmt::format("{}\n", fmt::join(names, ","));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Cuts one line into cells. A quoted cell may hold commas; "" inside it is one quote.
std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  std::string cell;
  bool in_quotes = false, was_quoted = false;
  const auto finish = [&] {
    cells.push_back(was_quoted ? cell : std::string(trimmed(cell)));
    cell.clear();
    was_quoted = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (in_quotes) {
      if (c == '"' && i + 1 < line.size() && line[i + 1] == '"')
        cell += line[++i];
      else if (c == '"')
        in_quotes = false;
      else
        cell += c;
    } else if (c == '"' && trimmed(cell).empty()) {
      in_quotes = was_quoted = true;
      cell.clear();
    } else if (c == ',') {
      finish();
    } else if (!was_quoted || (c != ' ' && c != '\t' && c != '\r')) {
      cell += c;
    }
  }
  finish();
  return cells;
}

std::string_view without_unit(std::string_view name) { return trimmed(name.substr(0, name.find('['))); }

bool parse_number(std::string_view text, double& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

std::string whole_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw InputError(fmt::format("error: cannot read the table '{}'\n   = help: {}", path.string(),
                                 file ? "it is a folder, give a file" : "give the path of a CSV file"));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void add_row(CsvTable& table, std::string_view line, std::size_t number) {
  auto cells = split(line);
  if (table.columns.empty()) {
    table.columns = std::move(cells);
    return;
  }
  if (cells.size() != table.columns.size())
    throw InputError(fmt::format("error: {} cells where the header has {} columns\n  --> {}:{}\n   | {}",
                                 cells.size(), table.columns.size(), table.path.string(), number,
                                 shown(line)));
  table.rows.push_back(std::move(cells));
  table.lines.push_back(number);
}

/// Reads the table in `text`. @param drop_torn leaves out a last line that has no end of line: the
/// process died while writing it, and its numbers may be cut short.
CsvTable parse(const std::filesystem::path& path, std::string_view text, bool drop_torn) {
  CsvTable table;
  table.path = path;
  std::size_t number = 0;
  while (!text.empty()) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos && drop_torn && !table.columns.empty()) break;
    const auto line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (line.empty()) continue;
    if (line.front() == '#')
      table.comments.emplace_back(trimmed(line.substr(1)));
    else
      add_row(table, line, number);
  }
  if (table.columns.empty())
    throw InputError(
        fmt::format("error: '{}' has no header line\n   = help: the first line that is not a "
                    "comment names the columns, like: time [us],velocity [m/s]",
                    path.string()));
  return table;
}

}  // namespace

std::string format_number(double value) { return fmt::format("{}", value); }

std::string format_number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
}

CsvWriter::CsvWriter(const std::filesystem::path& path, std::vector<std::string> columns,
                     const std::vector<std::string>& comments, CsvMode mode)
    : path_(path), columns_(std::move(columns)) {
  require(!columns_.empty(), "a CSV table needs at least one column");
  std::error_code ignored;
  const bool fresh = mode == CsvMode::create || !std::filesystem::exists(path) ||
                     std::filesystem::file_size(path, ignored) == 0;
  if (!fresh) {
    const std::string text = whole_file(path);
    if (text.back() != '\n') truncate_csv(path, std::numeric_limits<double>::infinity());
    const auto old = parse(path, text, true);
    if (old.columns != columns_)
      throw InputError(fmt::format("error: '{}' has other columns ({}) than the rows to append ({})",
                                   path.string(), fmt::join(old.columns, ","), fmt::join(columns_, ",")));
  }
  file_.open(path, fresh ? std::ios::trunc : std::ios::app);
  if (!file_) throw EnvironmentError(fmt::format("cannot open '{}' for writing", path.string()));
  if (fresh) {
    for (const auto& comment : comments) write(fmt::format("# {}\n", comment));
    write(header_line(columns_));
  }
  flush();
}

void CsvWriter::write(const std::string& line) {
  file_ << line;
  if (!file_) throw EnvironmentError(fmt::format("cannot write '{}': is the disk full?", path_.string()));
}

void CsvWriter::row(std::span<const double> values) {
  require(values.size() == columns_.size(), "a CSV row has one value per column");
  fmt::memory_buffer line;
  for (std::size_t i = 0; i < values.size(); ++i)
    fmt::format_to(std::back_inserter(line), "{}{}", i == 0 ? "" : ",", values[i]);
  line.push_back('\n');
  write(fmt::to_string(line));
}

void CsvWriter::row(std::span<const CsvCell> cells) {
  require(cells.size() == columns_.size(), "a CSV row has one cell per column");
  std::string line;
  for (const auto& cell : cells) {
    if (!line.empty() || &cell != cells.data()) line += ',';
    const auto* number = std::get_if<double>(&cell);
    line += number != nullptr ? format_number(*number) : quoted(std::get<std::string>(cell));
  }
  write(line + "\n");
}

void CsvWriter::flush() {
  file_.flush();
  if (!file_) throw EnvironmentError(fmt::format("cannot write '{}': is the disk full?", path_.string()));
}

bool CsvTable::has(std::string_view name) const {
  for (const auto& column : columns)
    if (column == name || without_unit(column) == name) return true;
  return false;
}

std::size_t CsvTable::index(std::string_view name) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == name) return i;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (without_unit(columns[i]) == name) return i;
  throw InputError(fmt::format("error: no column '{}' in '{}'\n   = help: it has {}", name, path.string(),
                               fmt::join(columns, ", ")));
}

std::vector<double> CsvTable::numbers(std::string_view name) const {
  const std::size_t column = index(name);
  std::vector<double> values;
  values.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double value = 0;
    if (!parse_number(rows[i][column], value))
      throw InputError(fmt::format(
          "error: '{}' in column '{}' is not a number\n  --> {}:{}\n   = help: the lines below the "
          "header hold numbers with commas between them, nan where there is none",
          shown(rows[i][column]), shown(columns[column]), path.string(), lines[i]));
    values.push_back(value);
  }
  return values;
}

std::vector<std::string> CsvTable::texts(std::string_view name) const {
  const std::size_t column = index(name);
  std::vector<std::string> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(row[column]);
  return values;
}

std::string CsvTable::unit(std::string_view name) const {
  const std::string& full = columns[index(name)];
  const auto open = full.find('['), close = full.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return full.substr(open + 1, close - open - 1);
}

CsvTable read_csv(const std::filesystem::path& path) { return parse(path, whole_file(path), false); }

void truncate_csv(const std::filesystem::path& path, double last) {
  const std::string text = whole_file(path);
  const auto table = parse(path, text, true);
  const auto times = table.numbers(table.columns.front());
  std::vector<bool> drop;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (drop.size() < table.lines[i]) drop.resize(table.lines[i], false);
    drop[table.lines[i] - 1] = times[i] > last;
  }
  std::string kept;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const auto end = text.find('\n', begin);
    if (end == std::string::npos) break;  // torn
    if (number >= drop.size() || !drop[number]) kept.append(text, begin, end + 1 - begin);
    begin = end + 1;
  }
  write_atomically(path, kept);
}

}  // namespace recoil
