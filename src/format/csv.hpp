#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace recoil {

/// One cell of a row: a number (written so that reading gives the same bits) or a text.
using CsvCell = std::variant<double, std::string>;

enum class CsvMode {
  create,  ///< a new file, an old one of that name is lost
  append   ///< goes on after the last complete row; the header must be the same
};

/// Writes one table: '#'-comment lines, one header line, rows. Names carry their unit: `time [us]`.
class CsvWriter {
 public:
  /// @throws EnvironmentError where the file cannot be opened; InputError where `append` meets another
  /// header; InternalError for an empty list of columns.
  CsvWriter(const std::filesystem::path& path, std::vector<std::string> columns,
            const std::vector<std::string>& comments = {}, CsvMode mode = CsvMode::create);

  /// Adds a row of numbers, one per column. @throws EnvironmentError on a full disk.
  void row(std::span<const double> values);
  /// Adds a row of numbers and texts, one per column; texts are quoted where needed.
  void row(std::span<const CsvCell> cells);
  void row(std::initializer_list<CsvCell> cells) { row(std::span(cells.begin(), cells.size())); }
  /// Hands everything written so far to the system. @throws EnvironmentError.
  void flush();

  const std::vector<std::string>& columns() const { return columns_; }

 private:
  void write(const std::string& line);

  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::ofstream file_;
};

/// A table as read: cells are kept as text, so that columns of words work too.
struct CsvTable {
  std::filesystem::path path;
  std::vector<std::string> columns;            ///< header names, units included
  std::vector<std::vector<std::string>> rows;  ///< rows[i].size() == columns.size()
  std::vector<std::size_t> lines;              ///< line number in the file of each row, from 1
  std::vector<std::string> comments;           ///< without the '#'

  /// Position of the column called `name`, with its unit (`time [us]`) or without (`time`).
  /// @throws InputError naming the columns that exist.
  std::size_t index(std::string_view name) const;
  bool has(std::string_view name) const;
  /// The column as numbers, one per row. @throws InputError with file and line at the first other thing.
  std::vector<double> numbers(std::string_view name) const;
  /// The column as text, one per row. @throws InputError where there is no such column.
  std::vector<std::string> texts(std::string_view name) const;
  /// What stands in brackets behind the name of the column ("us"), or nothing.
  std::string unit(std::string_view name) const;
};

/// Reads a table as CsvWriter writes it, also one from elsewhere (quotes, CRLF, blank lines).
/// @throws InputError with file and line for a missing file, header or cell.
CsvTable read_csv(const std::filesystem::path& path);

/// Removes the rows whose first column is later than `last` (in the unit of the file) and a torn last
/// line, as a resumed run needs. The file is replaced in one step. @throws InputError, EnvironmentError.
void truncate_csv(const std::filesystem::path& path, double last);

/// The shortest decimal that reads back to the same double; nan, inf and -inf as such.
std::string format_number(double value);

/// With so many digits, for tables that people read; "-" for nan and infinities.
std::string format_number(double value, int digits);

}  // namespace recoil
