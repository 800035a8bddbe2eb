#include "config/shape/stl/stl.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "config/declare/reading.hpp"
#include "config/shape/stl/closed_surface.hpp"
#include "config/shape/stl/stl_file.hpp"

namespace recoil::config {

Entries<Stl> Stl::keys() {
  return {{.name = "file",
           .member = &Stl::file,
           .required = true,
           .doc = "the file, its path seen from the folder of the case",
           .example = R"("fragment.stl")"},
          {.name = "scale",
           .member = &Stl::scale,
           .unit = "m",
           .positive = true,
           .required = true,
           .doc = "length of 1 in the file, which has no units itself",
           .example = R"("1 mm")"},
          {.name = "digest",
           .member = &Stl::digest,
           .optional = true,
           .doc = "of the file's bytes, as resolved cases have it: with another one the file is refused",
           .example = R"("cbf29ce484222325")"}};
}

void Stl::check(const TableReading& reading) {
  if (!reading.good("file") || !reading.good("scale")) return;
  const std::filesystem::path path = input_file(reading, "file");
  if (path.empty()) return;
  StlFile read = read_stl(path);
  if (!read.problem.empty()) return reading.wrong("file", read.problem, read.help);
  if (reading.has("digest") && digest != read.digest)
    return reading.wrong("digest",
                         fmt::format("{} is not the file that this case was resolved with", path.string()),
                         "bring that one back, or run the case anew");
  digest = read.digest;
  for (Vec<3>& p : read.surface.points) p *= scale;
  if (const SurfaceFault fault = fault_of(read.surface); !fault.problem.empty())
    return reading.wrong("file", path.filename().string() + ": " + fault.problem, fault.help);
  surface = std::make_shared<const ClosedSurface>(std::move(read.surface));
}

double Stl::distance_in_space(const Vec<3>& x) const { return surface->distance(x); }

Bounds Stl::bounds(const Domain& /*domain*/) const {
  return surface ? Bounds{surface->lo().c, surface->hi().c} : Bounds{};
}

}  // namespace recoil::config
