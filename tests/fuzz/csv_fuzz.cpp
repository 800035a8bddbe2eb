// A table of any bytes: it is read, or an InputError names its line.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "format/csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace recoil;
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("recoil_csv_fuzz_" + std::to_string(getpid()));
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const CsvTable table = read_csv(file);
    require(table.rows.size() == table.lines.size(), "every row has its line");
    for (const auto& row : table.rows)
      require(row.size() == table.columns.size(), "every row has every column");
    for (const std::string& name : table.columns) try {
        table.numbers(name);
      } catch (const InputError&) {
      }
  } catch (const InputError&) {
  }
  std::filesystem::remove(file);
  return 0;
}
