#include "interface/donors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <variant>

#include "core/constants.hpp"
#include "core/error.hpp"
#include "core/multiversion.hpp"
#include "dynamics/primitives.hpp"
#include "interface/candidates.hpp"
#include "interface/coefficients.hpp"
#include "state/beside_contact.hpp"
#include "state/level_set_view.hpp"
#include "state/places.hpp"

namespace recoil {

namespace {

// Donors lie within these distances [dx] from the surface point, and their weights fall with the square of
// the distance at these rates [1/dx^2]. Along a flat surface the reach is wide: the layers of cells that a
// slanted surface cuts then hold every phase of the cut, and a fit depends less on its own. It ends where the
// weight has fallen to a seventeenth; with a weight of a third at its end the fits of a surface at 45 degrees
// grow unstable. Where the radius of curvature is 10 dx or less, reach and rate are those across: a wide fit
// would leave the layers along the surface. At the rim of a contact it is narrower still: traction and
// velocity have a kink there, and a fit across it gives pressed walls too little stress and free ones too
// much. In 3-D, which has two directions along the surface, a wider one would cost too much.
constexpr double reach_across = 2.35, decay_across = 0.6, decay_wide = 0.3;
template <int Dim>
constexpr double decay_along = Dim == 3 ? 0.35 : 0.15;
constexpr double end_exponent = 2.84, most_curved = 0.1;
constexpr double decay_at_rim = 1.2, rim_curved = 0.02;
// Curvature times dx up to which a surface has no corner (a radius of 6.7 dx); from twice as much on it has.
constexpr double corner_curved = 0.15;
// Part of the way from the donors to the surface that a fit does not go at a corner where friction or glue
// holds: with all of it glued bodies gain energy there (docs/decisions/0076).
constexpr double lost_at_corner = 0.25;
constexpr int fit_reach = 7;  // the widest box reaches 6 cells, the surface point lies at most 1 away

/// Where the donors of one fit lie, and how their weights fall with the distance from the surface point.
template <int Dim>
struct Reach {
  Vec<Dim> normal;  // of the surface
  double along = 0, decay = 0;
  Index<Dim> half;  // cells around that of the surface point
  int widened = 0;  // a box of so many cells, the same in all directions, where the matter is far; else 0

  double weight(double across2, double along2) const {
    return widened == 0 ? std::exp(-decay_across * across2 - decay * along2)
                        : std::exp(-decay_wide * (across2 + along2));
  }
};

/// @param curvature of the surface, times dx. @param rim Rims::near().
template <int Dim>
Reach<Dim> reach_of(const Vec<Dim>& surface, double curvature, double rim, int widened) {
  const double bent = std::min(std::abs(curvature) / most_curved, 1.0);
  const double decay = decay_along<Dim> + bent * (decay_across - decay_along<Dim>);
  Reach<Dim> r{unit(surface), 0, decay + rim * (decay_at_rim - decay), {}, widened};
  r.along = std::max(reach_across, std::sqrt(end_exponent / r.decay));
  for (int d = 0; d < Dim; ++d) {
    const double tangent = std::sqrt(std::max(0.0, 1 - r.normal[d] * r.normal[d]));
    const double extent = reach_across * std::abs(r.normal[d]) + r.along * tangent;
    r.half[d] = widened > 0 ? widened : static_cast<int>(std::lround(extent));
  }
  return r;
}

/// Mean curvature of a level set at a cell, times dx.
template <int Dim>
double curvature_at(const Window<Dim>& w, const double* phi, int k, double dx) {
  double sum = 0;
  for (int d = 0; d < Dim; ++d) sum += phi[k - w.stride(d)] + phi[k + w.stride(d)] - 2 * phi[k];
  return sum / (dx * std::max(Dim - 1, 1));
}

/// Where the surface of a body presses on others, and whether it slides there without friction: the cells
/// that it cuts, by what they touched in the last step.
template <int Dim>
class Rims {
 public:
  Rims(const State<Dim>& state, const Body<Dim>& body, const Window<Dim>& w, Scratch& scratch) : window_(w) {
    const auto n = static_cast<std::size_t>(w.size());
    auto* partners = scratch.take<std::uint32_t>(n);
    w.gather([&](int s) { return body.present(s) ? body.at(s).contact.data() : nullptr; }, 0U, Beyond::mirror,
             partners);
    any_ = std::any_of(partners, partners + n, [](std::uint32_t p) { return p != 0; });
    if (!any_) return;
    auto* kind = scratch.take<CellKind>(n);
    w.gather([&](int s) { return body.present(s) ? body.at(s).geometry.kind.data() : nullptr; },
             CellKind::empty, Beyond::extend, kind);
    surface_ = scratch.take<Surface>(n);
    const std::uint32_t sliding = sliding_partners(state, body);
    for (std::size_t k = 0; k < n; ++k)
      surface_[k] = kind[k] != CellKind::cut       ? Surface::none
                    : (partners[k] & sliding) != 0 ? Surface::slides
                    : partners[k] != 0             ? Surface::held
                                                   : Surface::free;
  }

  /// Whether any part of the surface within the widest reach of a fit from cell i slides along another body.
  bool slides_near(const Index<Dim>& i) const {
    if (!any_) return false;
    const double reach = std::sqrt(end_exponent / decay_along<Dim>);
    Box<Dim> around{i, i};
    for (int d = 0; d < Dim; ++d) ++around.hi[d];
    bool slides = false;
    for_each(around.grown(static_cast<int>(reach)), [&](const Index<Dim>& j) {
      double square = 0;
      for (int d = 0; d < Dim; ++d) square += (j[d] - i[d]) * (j[d] - i[d]);
      slides = slides || (square <= reach * reach && surface_[window_.at(j)] == Surface::slides);
    });
    return slides;
  }

  /// How much cell i lies at the rim of a contact, 0 to 1: not at all unless both pressed and free parts of
  /// the surface are within the widest reach of a fit; then by how curved the free part is there. Flat
  /// surfaces that do not meet everywhere at once have no rim.
  double near(const Index<Dim>& i, const double* phi, double dx) const {
    if (!any_) return 0;
    const double reach = std::sqrt(end_exponent / decay_along<Dim>);
    Box<Dim> around{i, i};
    for (int d = 0; d < Dim; ++d) ++around.hi[d];
    bool pressed = false;
    double curvature = 0;
    for_each(around.grown(static_cast<int>(reach)), [&](const Index<Dim>& j) {
      double square = 0;
      for (int d = 0; d < Dim; ++d) square += (j[d] - i[d]) * (j[d] - i[d]);
      if (square > reach * reach) return;
      const int k = window_.at(j);
      pressed = pressed || is_pressed(k);
      if (surface_[k] == Surface::free)
        curvature = std::max(curvature, std::abs(curvature_at(window_, phi, k, dx)));
    });
    return pressed ? std::min(curvature / rim_curved, 1.0) : 0;
  }

  struct Corner {
    double part = 0;    // 0 to 1
    bool held = false;  // by friction or glue
  };
  /// How much cell i lies at a corner of the body that touches another one: not at all unless one of the
  /// cells around it is pressed; then by how curved the surface is in the most curved of them.
  Corner corner(const Index<Dim>& i, const double* phi, double dx) const {
    if (Dim == 1 || !any_) return {};
    Box<Dim> around{i, i};
    for (int d = 0; d < Dim; ++d) ++around.hi[d];
    bool pressed = false, held = false;
    double curvature = 0;
    for_each(around.grown(1), [&](const Index<Dim>& j) {
      const int k = window_.at(j);
      pressed = pressed || is_pressed(k);
      held = held || surface_[k] == Surface::held;
      if (surface_[k] != Surface::none)
        curvature = std::max(curvature, std::abs(curvature_at(window_, phi, k, dx)));
    });
    return {pressed ? std::clamp(curvature / corner_curved - 1, 0.0, 1.0) : 0, held};
  }

 private:
  enum class Surface : std::uint8_t { none, free, slides, held };
  bool is_pressed(int k) const { return surface_[k] == Surface::slides || surface_[k] == Surface::held; }

  const Window<Dim>& window_;
  Surface* surface_ = nullptr;
  bool any_ = false;
};

/// Four numbers that are computed with at once.
using Four [[gnu::vector_size(32)]] = double;

/// How far the matter of the cells of a row lies from a surface point [dx], and whether it donates to its
/// fit.
template <int Dim>
struct RowPlaces {
  static constexpr int longest = (2 * fit_reach + 1 + 3) / 4 * 4;  // in whole Fours
  using Numbers = std::array<double, longest>;
  alignas(Four) Numbers across2, along2;  // squares of the distances across and along the surface
  alignas(Four) std::array<std::int64_t, longest> donates;
};

/// @param start of the row: its cells along all axes but the first, from the surface point. @param lowest its
/// first cell. @param at the surface point, in cells. @param centroid, fill of its cells and of three more.
template <int Dim>
RECOIL_MULTIVERSION void place_row(int count, const Vec<Dim>& start, int lowest, double at,
                                   const Reach<Dim>& reach, const std::array<const double*, Dim>& centroid,
                                   const double* fill, RowPlaces<Dim>& row) {
  constexpr double across2_most = reach_across * reach_across;
  const double along2_most = reach.along * reach.along, widened = reach.widened;
  for (int c = 0; c < count; c += 4) {
    const Four columns{0, 1, 2, 3};
    Four across{}, square{}, full;
    std::array<Four, Dim> x;
    for_each_axis<Dim>([&](auto d) RECOIL_INLINE {
      std::memcpy(&x[d], centroid[d] + c, sizeof(Four));
      x[d] = (d == 0 ? (lowest + c + columns) - at : start[d] + Four{}) + x[d];
      across += x[d] * reach.normal[d];
      square += x[d] * x[d];
    });
    std::memcpy(&full, fill + c, sizeof(Four));
    const Four across2 = across * across, rest = square - across2, along2 = rest > 0 ? rest : Four{};
    auto holds = full > 0;
    if (reach.widened == 0)
      holds &= (across2 <= across2_most) & (along2 <= along2_most);
    else
      for (const Four& v : x) holds &= (v <= widened) & (v >= -widened);
    std::memcpy(&row.across2[c], &across2, sizeof(Four));
    std::memcpy(&row.along2[c], &along2, sizeof(Four));
    std::memcpy(&row.donates[c], &holds, sizeof(Four));
  }
}

/// The donors around one surface point. Appends to `donors`; where they lie goes to `slope_weight`.
template <int Dim>
int collect(const Grid<Dim>& grid, const Window<Dim>& w, const Vec<Dim>& point, const Reach<Dim>& reach,
            Candidates<Dim>& candidates, Donors<Dim>& donors) {
  Vec<Dim> at;
  Box<Dim> rows;
  for (int d = 0; d < Dim; ++d) {
    at[d] = (point[d] - grid.origin[d]) / grid.dx - 0.5;
    const int centre = static_cast<int>(std::floor(at[d] + 0.5));
    rows.lo[d] = std::max(centre - reach.half[d], w.box().lo[d]);
    rows.hi[d] = std::min(centre + reach.half[d] + 1, w.box().hi[d]);
  }
  const int width = rows.extent(0);
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  const std::size_t before = donors.parts.size();
  RowPlaces<Dim> row;
  for_each(rows, [&](Index<Dim> i) {
    const int first = w.at(i);
    if (!candidates.look_up(i, first, width)) return;
    Vec<Dim> start;
    for (int d = 1; d < Dim; ++d) start[d] = i[d] - at[d];
    const double* fill = candidates.fills(first);
    const auto centroid = candidates.centroids(first);
    place_row<Dim>(width, start, i[0], at[0], reach, centroid, fill, row);
    for (int c = 0; c < width; ++c, ++i[0]) {
      if (row.donates[c] == 0) continue;
      Vec<Dim> x;
      for (int d = 0; d < Dim; ++d) x[d] = i[d] - at[d] + centroid[d][c];
      donors.parts.push_back({candidates.place(i, first + c, donors.cells),
                              reach.weight(row.across2[c], row.along2[c]) * fill[c], x});
    }
  });
  return static_cast<int>(donors.parts.size() - before);
}

/// Whether a cell holds failed matter that is not compressed: with a void, so without stress.
template <int Dim>
bool is_dust(const Body<Dim>& body, const BodyBlock<Dim>& b, std::size_t k) {
  return has_failed(b, k) && b.contents[k] <= density(body.material) * b.volume[k];
}

}  // namespace

template <int Dim>
void choose_donors(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.donors.cells.clear();
  b.donors.parts.clear();
  b.walls.assign(b.geometry.cuts.size(), {});
  if (b.geometry.cuts.empty()) return;
  const Window<Dim> w(state.mesh, slot, fit_reach, b.matter);
  Candidates<Dim> candidates(state, body, w, scratch);
  const double* phi = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi, scratch);
  const Rims<Dim> rims(state, body, w, scratch);
  const bool elastic = std::holds_alternative<Elastic>(body.material.strength);
  for (std::size_t m = 0; m < b.walls.size(); ++m) {
    Wall<Dim>& wall = b.walls[m];
    wall.first_donor = static_cast<int>(b.donors.parts.size());
    const CutCell<Dim>& cut = b.geometry.cuts[m];
    const Index<Dim> i = w.index_of(cut.cell);
    const double curvature = curvature_at(w, phi, w.at(i), state.grid().dx);
    const double rim = rims.near(i, phi, state.grid().dx);
    const auto corner = rims.corner(i, phi, state.grid().dx);
    wall.corner = corner.part;
    for (const int widened : {0, 4, 6})
      if (wall.donors == 0)
        wall.donors = collect(state.grid(), w, cut.point, reach_of<Dim>(cut.surface, curvature, rim, widened),
                              candidates, b.donors);
    if (wall.donors > 0) {
      find_coefficients(wall, b.donors, unit(cut.surface), elastic && rims.slides_near(i));
      if (corner.held) wall.donor_centre *= 1 - lost_at_corner * corner.part;
    } else {
      ++(is_dust(body, b, static_cast<std::size_t>(cut.cell)) ? counters.cuts_of_dust
                                                              : counters.cuts_without_donor);
    }
  }
  for (const auto& cell : b.donors.cells)
    require(!state.mesh.is_stand_in(cell.slot), "cells of one size around a surface");
}

#define RECOIL_INSTANTIATE(Dim) \
  template void choose_donors<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
