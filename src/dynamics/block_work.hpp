#pragma once

#include <cstddef>
#include <cstdint>

#include "dynamics/face_values.hpp"
#include "state/body.hpp"

namespace recoil::detail {

/// A block beside blocks of other levels, of one body.
template <int Dim>
struct LevelSides {
  const Mesh<Dim>& mesh;
  Body<Dim>& body;
  int slot;
};

/// Cells that a reconstruction reads on each side of a face.
inline constexpr int face_reach = 3;

/// The arrays of one block's update. Window arrays hold [component][window cells] and one vector more, so
/// that rows may be read in whole vectors; the others [component][cells].
template <int Dim>
struct Work {
  const Grid<Dim>& grid;
  Window<Dim> window;
  Box<Dim> cells;               // of the block that hold matter
  std::size_t n = 0, wide = 0;  // of those cells, of the window's
  std::size_t held = 0;         // primitives that may differ from zero: the first ones
  double *primitive = nullptr, *impedance = nullptr, *stress = nullptr;
  double* shear = nullptr;                 // shear modulus
  std::uint8_t* role = nullptr;            // null where every cell has a value
  bool fails = false;                      // the matter can fail
  bool flattens = false;                   // values at faces are flattened in strong shocks
  std::uint8_t* failed = nullptr;          // FailedCell of each cell of the window; null: nothing has failed
  std::uint8_t* never_yields = nullptr;    // 1 where matter never yields; null: nowhere
  std::uint8_t* beside_contact = nullptr;  // 1 where it lies beside a contact as well; null: nowhere
  bool still = false;                      // all cells of the window are: no face lets anything pass (AtRest)
  bool whole = false;                      // cells are whole and real, or not there at all (ghost fluid)
  const LevelSides<Dim>* sides = nullptr;  // null: all blocks around are of its level
  HalfStep ahead{};                        // dt 0: three stages
  double* open = nullptr;      // 1 where a cell has a value for half a step, else 0; null: all have
  double* own = nullptr;       // likewise 1 where that is its own average, else 0
  double* rate = nullptr;      // [contents]
  double* gradient = nullptr;  // [i * Dim + j]: integral of du_i/dx_j
  double* radial = nullptr;    // with a radius: mean over the two r-faces of the star velocities

  /// Contents that flow: without damage all but that, which stands last.
  std::size_t carried() const { return carried_contents<Dim>(fails); }

  Row<Dim> row(std::ptrdiff_t first, std::ptrdiff_t step, int count) const {
    return {primitive,      stress, impedance,    wide,
            first,          step,   count,        ahead.dt > 0 ? &ahead : nullptr,
            fails,          failed, never_yields, shear,
            beside_contact, role,   flattens};
  }
};

}  // namespace recoil::detail
