#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "field/components.hpp"

namespace recoil {

/// The longest row of cells or faces that one call takes.
inline constexpr int longest_row = 96;
/// Rows of cells may be rounded up to whole vectors: what is computed beyond their end is not used.
inline constexpr int vector_length = 4;
constexpr int whole_vectors(int count) { return (count + vector_length - 1) / vector_length * vector_length; }
/// Room for a row with what is read beyond its end.
inline constexpr int row_room = longest_row + 8;

/// What a step of one stage knows of its middle; arrays over the cells of a window.
struct HalfStep {
  double dt = 0, per_dx = 0;  // s of the whole step, and over dx
  double* loading = nullptr;  // 1/|S| where a cell yields and goes on loading, else 0
  // [Components::primitives]: changes of half a step by each axis, then by the widening of rings, from
  // central differences; the same by each axis from upwind differences. Null: none.
  std::array<double*, 4> change{};
  std::array<double*, 3> leaning{};
  // [Components::primitives]: what half a step across the axis of a sweep changes; null: nothing
  double* across = nullptr;
};

/// What has failed in a cell.
enum FailedCell : std::uint8_t { intact = 0, failed_matter = 1, with_void = 2 };

/// Contents that flow: of matter that cannot fail all but the damage, which stands last.
template <int Dim>
constexpr std::size_t carried_contents(bool fails) {
  return fails ? Components<Dim>::contents : Components<Dim>::damage;
}

/// Where a row of cells, or of faces, reads. Arrays hold every component of every cell of a window. Cell i of
/// a row of cells is `first + i`; face i of a row of faces lies between cells `first + i - step` and `first +
/// i`.
template <int Dim>
struct Row {
  const double* primitive = nullptr;   // [Components::primitives][cells]
  const double* stress = nullptr;      // [cells] sigma_nn = S_nn - p along the row's axis
  const double* impedance = nullptr;   // [cells] rho c_L
  std::size_t cells = 0;               // of the window
  std::ptrdiff_t first = 0, step = 1;  // step: distance in memory along the axis
  int count = 0;
  const HalfStep* ahead = nullptr;               // null: values of the start of the stage are wanted
  bool fails = false;                            // the matter can fail, and carries its damage
  const std::uint8_t* failed = nullptr;          // FailedCell of the window's cells; null: nothing has failed
  const std::uint8_t* never_yields = nullptr;    // 1 in cells of matter that never yields; null: in none
  const double* shear = nullptr;                 // [cells] shear modulus
  const std::uint8_t* beside_contact = nullptr;  // 1 in cells whose faces lose less; null: in none
  const std::uint8_t* role = nullptr;            // Role of the cells; null: all are regular
  bool flattens = false;                         // values at faces are flattened in strong shocks

  std::size_t carried() const { return carried_contents<Dim>(fails); }
};

/// Primitives of a row of cells at one of their two faces across an axis.
template <int Dim>
struct FaceValues {
  static constexpr int room = row_room;
  alignas(64) double value[Components<Dim>::primitives][room];
  alignas(64) double stress[room];  // sigma_nn
};

/// Flux per area along the axis, and the star velocities.
template <int Dim>
struct FaceFlux {
  double* flux = nullptr;      // [Components::contents][faces]
  double* velocity = nullptr;  // [Dim][faces]
  std::size_t faces = 0;       // distance between components
  std::ptrdiff_t first = 0;    // place of the row's first face

  double* flux_of(std::size_t component) const { return flux + component * faces + first; }
  double* velocity_along(std::size_t axis) const { return velocity + axis * faces + first; }
};

}  // namespace recoil
