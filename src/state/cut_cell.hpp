#pragma once

#include <array>
#include <cstdint>

#include "core/vec.hpp"
#include "field/components.hpp"
#include "field/field_array.hpp"

namespace recoil {

enum class CellKind : std::uint8_t { empty, full, cut };

/// The geometry of a cell that the surface of a body cuts, from the level set. Areas [m^(Dim-1)] and volumes
/// [m^Dim] are weighted with r where the domain is axisymmetric, with its square where spherical.
template <int Dim>
struct CutCell {
  int cell = 0;                                   // in the layout of its block
  bool failed = false;                            // its matter, in the end-of-step geometry
  std::array<std::array<double, 2>, Dim> open{};  // open area of the [low, high] face across each axis
  // Middle of the open part of the [low, high] face across each axis, from the middle of the face, in dx.
  std::array<std::array<Vec<Dim>, 2>, Dim> open_middle{};
  double hoop_area = 0;  // of the fragment, as Grid::hoop_area
  double volume = 0;     // V_phi
  Vec<Dim> centroid;     // of the fragment, from the cell's centre, in dx
  Vec<Dim> surface;      // area vector A_I of the surface, out of the body, by closure
  Vec<Dim> point;        // x_I [m], the middle of the surface in the cell
  double mismatch = 0;   // (V - V_phi)/A_I [m], how far phi lags behind V
};

/// The kinds of all cells of a block, for one body, and the list of those that are cut.
template <int Dim>
struct Geometry {
  FieldArray<CellKind> kind;
  FieldArray<int> index;  // place in cuts, or -1
  FieldArray<CutCell<Dim>> cuts;

  /// @param field geometry or end_geometry: which of the two this is.
  explicit Geometry(Field field) : kind(field), index(field), cuts(field) {}
};

/// The state of a surface in one cut cell: the fit through the matter behind it, and what the wall does to
/// it. One for each entry of Geometry::cuts.
template <int Dim>
struct Wall {
  using C = Components<Dim>;
  // the fit's part of Donors::parts; fixed for a step
  int first_donor = 0, donors = 0;
  Vec<Dim> donor_centre;  // weighted mean of the donors' places from x_I, in dx
  double corner = 0;      // 0 to 1: how much it lies at a corner of the body that touches another one
  // the fit of this stage
  Primitives<Dim> value{};  // at x_I
  Primitives<Dim> range{};  // largest minus smallest value of the donors; extra: of S_zz in 3-D
  std::array<Vec<Dim>, C::primitives> gradient{};  // per dx
  // the wall of this stage
  Vec<Dim> normal;             // out of the body
  double traction = 0;         // sigma* of the contact [Pa]; where free, minus the pressure of loads
  Vec<Dim> shear;              // tau* of the contact on the outward normal [Pa], 0 without friction
  Vec<Dim> face_velocity;      // of the main part of the wall
  Vec<Dim> velocity;           // area mean over its parts
  Vec<Dim> mean_velocity;      // of the stages so far, with the weights of the scheme
  std::uint32_t partners = 0;  // bit of every body that it touches
  // rates of the fragment's volume and contents, and the integral of the velocity gradient, by the wall
  double volume_rate = 0;
  Vec<Dim> force;
  double power = 0;
  std::array<Vec<Dim>, Dim> stretching{};  // [i][j]: integral of u_i n_j

  /// Length of the diagonal of the box that the donors' velocities are in [m/s].
  double velocity_range() const {
    Vec<Dim> u;
    for (int d = 0; d < Dim; ++d) u[d] = range[C::u + d];
    return norm(u);
  }
};

/// A cell whose average takes part in fits, as the block of the fits sees it.
struct DonorCell {
  int slot = 0, cell = 0;
  unsigned flips = 0;  // bit d: mirrored along axis d
};

/// The part of a donor in one fit.
template <int Dim>
struct Donor {
  int place = 0;          // in Donors::cells
  double weight = 0;      // of the mean
  Vec<Dim> slope_weight;  // of the gradient, per dx
};

/// The donors of all fits of a block: each cell once, and fit after fit what part which cell has.
template <int Dim>
struct Donors {
  FieldArray<DonorCell> cells;
  FieldArray<Donor<Dim>> parts;

  explicit Donors(Field field) : cells(field), parts(field) {}
};

/// A cell beyond a surface that a reconstruction reads, and the wall that gives it its value.
template <int Dim>
struct GhostCell {
  int cell = 0;
  int slot = -1, wall = 0;  // -1: no wall near
  unsigned flips = 0;       // between here and the wall
  Vec<Dim> normal;          // of the body at the foot point
  Vec<Dim> from_wall;       // foot point minus the wall's x_I [m], in the wall's own frame
  double distance = 0;      // [m] along the normal, positive outside
};

/// A cell's new volume and contents, found from an old state and put in place when all are known.
template <int Dim>
struct Update {
  int cell = 0;
  double volume = 0;
  Contents<Dim> contents{};
};

}  // namespace recoil
