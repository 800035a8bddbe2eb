#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/section/domain.hpp"
#include "format/run_units.hpp"
#include "format/vtkhdf.hpp"
#include "picture/colour_map.hpp"
#include "picture/outline.hpp"
#include "picture/raster.hpp"
#include "picture/space/scene.hpp"

namespace recoil {

/// A dump of a run, chosen by time.
struct ChosenDump {
  std::filesystem::path path;
  double time_s = 0;
};

/// All dumps of `directory`/fields, in order. @throws InputError where there are none.
std::vector<ChosenDump> all_dumps(const std::filesystem::path& directory);

/// The dump nearest to a time [s] (none: the last) among those of `directory`/fields. @throws InputError
/// where there are none, or the time lies beyond the last one (by more than a thousandth).
ChosenDump choose_dump(const std::filesystem::path& directory, std::optional<double> time_s);

/// The plane across an axis of a 3-D domain at 0, or in the middle of a domain that does not hold 0.
Cut middle_cut(const config::Domain& domain, std::size_t axis);

/// Whether there is matter inside of a body of that signed distance: not in a rigid one.
bool holds_matter(const UnstructuredGrid& grid, const std::vector<double>& phi);

/// One field in the plane, on even cells: what a picture needs. In 1-d one row of cells.
struct FieldPlane {
  PlaneArray values;                   ///< in the unit of the label; NaN: no matter
  std::vector<std::string> bodies;     ///< names
  std::vector<PlaneArray> level_sets;  ///< signed distance to each body [m], NaN far from everything
  PlaneArray
      matter;  ///< the least of those of bodies that hold matter: not of rigid ones; positive elsewhere
  std::string label;                   ///< "pressure [GPa]"
  bool signed_values = false;          ///< a diverging colour map suits
  std::vector<Category> categories{};  ///< of a field of few values: what each means, and a colour for it
  double time_s = 0;
};

/// Takes a field out of a dump, by the name of a scalar (find_scalar). "body", "contact" and "contact-state"
/// come with categories; no body has no value.
/// @param cut through a 3-D grid.
/// @throws InputError for a name that the dump does not hold.
FieldPlane field_plane(const VtkhdfFile& dump, const std::string& name, const RunUnits& units, Cut cut = {});

/// The two directions that span an oblique plane, of length 1: the one across is horizontal where z is up.
std::array<Vec<3>, 2> axes_of(const SpacePlane& plane);

/// The same in an oblique plane through a 3-D grid, at the width of the smallest cells: each place has the
/// value of the cell that holds it, level sets are linear between the middles of cells. Coordinates are along
/// axes_of(), from the origin of space.
FieldPlane field_plane(const VtkhdfFile& dump, const std::string& name, const RunUnits& units,
                       const SpacePlane& plane);

}  // namespace recoil
