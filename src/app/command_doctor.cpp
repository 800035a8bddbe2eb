#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/data_folder.hpp"
#include "app/launch.hpp"
#include "app/machine.hpp"
#include "app/report/page_bundle.hpp"
#include "core/build_info.hpp"
#include "format/vtkhdf.hpp"
#include "material/library.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// What was found of one thing; `cure` is empty where all is well.
struct Finding {
  const char* what;
  std::string text, cure;
  bool fails = false;  // nothing runs like this
};

std::string gigabytes(double bytes) {
  return std::isfinite(bytes) ? fmt::format("{:.1f} GB", bytes * 1e-9) : "not known";
}

Finding data() {
  const std::size_t materials = list_materials(material_folders()).size();
  return {"data", fmt::format("{} materials in {}", materials, data_folder().string()),
          materials > 0 ? "" : "set RECOIL_DATA to the folder that holds materials/, cases/ and templates/",
          materials == 0};
}

Finding processors() {
  return {"processors", fmt::format("{}; threads use them all in 2d and 3d", machine_processors()), ""};
}

Finding memory() {
  const double bytes = machine_memory();
  return {"memory", gigabytes(bytes), bytes < 1e9 ? "below 1 GB only 1d and small plane cases fit" : ""};
}

Finding disk() {
  std::error_code error;
  const auto space = fs::space(".", error);
  const bool writes = access(".", W_OK) == 0;
  const double bytes = error ? 0 : static_cast<double>(space.available);
  const std::string cure = !writes       ? "this folder cannot be written to: give runs another one with -o"
                           : bytes < 1e9 ? "free some space: a plane run takes tens of MB, a 3d one gigabytes"
                                         : "";
  return {"disk", fmt::format("{} free here", gigabytes(bytes)), cure};
}

Finding mpi() {
  const std::string file = on_path("mpirun");
  return {"MPI", file.empty() ? "no mpirun" : file,
          file.empty() ? "-n needs it: install Debian's openmpi-bin; threads (-j) work without" : ""};
}

/// Writes a cell to a file and reads it.
Finding hdf5() {
  const fs::path file = fs::temp_directory_path() / fmt::format("recoil_doctor_{}.hdf", getpid());
  UnstructuredGrid grid;
  add_box_cell(grid, 1, {0, 0, 0}, {1, 0, 0});
  Finding found{"HDF5", "a field file was written and read", ""};
  try {
    write_vtkhdf(file, grid, 0);
    if (read_vtkhdf(file).grid.cells() != 1) throw std::runtime_error("it came back changed");
  } catch (const std::exception& e) {
    found = {"HDF5", e.what(), "look at the space and rights of " + fs::temp_directory_path().string(), true};
  }
  std::error_code ignored;
  fs::remove(file, ignored);
  return found;
}

/// Units and signs in messages are not all ASCII.
Finding locale() {
  std::string name;
  for (const char* variable : {"LANG", "LC_CTYPE", "LC_ALL"})
    if (const char* value = std::getenv(variable); value && *value) name = value;
  const bool good = name.find("UTF-8") != std::string::npos || name.find("utf8") != std::string::npos;
  return {"locale", name.empty() ? "none" : name,
          good ? "" : "export LC_ALL=C.UTF-8, or some signs will look odd"};
}

Finding report_page() {
  const bool there = !page_bundle().empty();
  return {"report", there ? "runs leave report.html" : "runs leave no report.html",
          there ? "" : "install Debian's nodejs and npm and build again"};
}

Finding movies() {
  const std::string file = on_path("img2webp");
  return {"movies", file.empty() ? "no img2webp" : file,
          file.empty() ? "`recoil movie` needs it for .webp: install Debian's webp" : ""};
}

}  // namespace

int doctor() {
  using namespace build_info;
  bool fails = false;
  fmt::print("ok    {:<11} {} ({}{})\n", "recoil", full_version, build_type, native ? ", native" : "");
  for (const Finding& f :
       {data(), processors(), memory(), disk(), mpi(), hdf5(), locale(), report_page(), movies()}) {
    fmt::print("{:<5} {:<11} {}\n", f.fails ? "FAIL" : f.cure.empty() ? "ok" : "warn", f.what, f.text);
    if (!f.cure.empty()) fmt::print("                  = help: {}\n", f.cure);
    fails = fails || f.fails;
  }
  return fails ? exit_environment : exit_finished;
}

}  // namespace recoil::app
