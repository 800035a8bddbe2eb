#pragma once

#include <set>
#include <string>
#include <vector>

#include "format/run_units.hpp"
#include "format/unstructured_grid.hpp"
#include "picture/colour_map.hpp"

namespace recoil {

/// One number per cell of a dump.
struct FieldScalar {
  static constexpr int magnitude = -1;

  std::string name;            ///< as cases and commands write it: "pressure", "velocity.x", "stress.zz"
  std::string array;           ///< that holds it
  std::string label;           ///< for people: "velocity x [m/s]"
  int component = 0;           ///< of the array, or its `magnitude`
  bool signed_values = false;  ///< both signs mean something: a diverging colour map suits
};

/// The scalar of a name: a variable as cases write it, with a component of vectors and tensors where one is
/// wanted ("velocity" is its magnitude; in 1-d its one component), or "body", "contact".
/// @throws InputError for a name that no dump has.
FieldScalar find_scalar(const std::string& name, const RunUnits& units);

/// Every scalar of a dump but magnitudes, in the order of its arrays; "body" and "contact" last.
std::vector<FieldScalar> scalars_of(const UnstructuredGrid& grid, const RunUnits& units);

/// Its values, one per cell. @throws InputError where the grid does not hold it.
std::vector<double> values_of(const UnstructuredGrid& grid, const FieldScalar& scalar);

/// A body of a dump.
struct BodyField {
  std::string name;
  std::vector<double> level_set;  ///< signed distance [m], one per cell
};

/// The bodies of a dump, in their order.
std::vector<BodyField> bodies_of(const UnstructuredGrid& grid);

/// What the values of a scalar mean that has only a few ("body", "contact", "contact-state",
/// "fragment" where there are not too many), and a colour
/// for each; none of other scalars.
std::vector<Category> categories_of(const std::string& name, const std::vector<std::string>& bodies,
                                    const std::set<double>& values);

}  // namespace recoil
