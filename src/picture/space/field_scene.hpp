#pragma once

#include <string>
#include <vector>

#include "format/run_units.hpp"
#include "format/vtkhdf.hpp"
#include "picture/colour_map.hpp"
#include "picture/space/cell_lookup.hpp"
#include "picture/space/scene.hpp"

namespace recoil {

/// The deformable bodies of a dump of a 3-D run with one of its fields. Of rigid bodies a dump holds only the
/// part that is near to deformable ones.
class FieldScene : public Scene {
 public:
  /// @param field name of a scalar (find_scalar). @param bodies that are shown; none: all.
  /// @throws InputError for a name that the dump does not hold, and for a body that it has not.
  FieldScene(const VtkhdfFile& dump, const std::string& field, const RunUnits& units,
             const std::vector<std::string>& bodies = {});

  SpaceBox box() const override { return cells_.box(); }
  double cell() const override { return cells_.finest(); }
  double distance(const Vec<3>& x) const override;
  int body(const Vec<3>& x) const override;
  double value(const Vec<3>& x, int body) const override;

  const std::string& label() const { return label_; }  ///< "pressure [GPa]"
  bool signed_values() const { return signed_; }       ///< a diverging colour map suits
  const std::vector<Category>& categories() const { return categories_; }
  const CellLookup& cells() const { return cells_; }
  /// The body's signed distance, linear between the middles of cells; NaN far from everything.
  double level_set(const Vec<3>& x, int body) const;
  int bodies() const { return static_cast<int>(bodies_.size()); }

 private:
  struct Shown {
    int number;                     // in the dump
    std::vector<double> level_set;  // of each cell [m]
  };
  bool counts(int cell, int body) const;

  CellLookup cells_;
  std::vector<Shown> bodies_;
  std::vector<double> nearest_, values_;
  std::vector<int> owner_;  // of each cell: place in bodies_; -1: none of them
  std::string label_;
  bool signed_ = false;
  std::vector<Category> categories_;
};

}  // namespace recoil
