#pragma once

#include <algorithm>
#include <cmath>

#include "state/body.hpp"

namespace recoil {

/// One cell in which two bodies touch, as the walls of the last stage of a step have it.
template <int Dim>
struct ContactCell {
  int first = 0, second = 0;  ///< bodies; the first is deformable, and the lower-numbered one if both are
  Index<Dim> cell{};          ///< global
  Vec<Dim> point;             ///< m, middle of the first one's surface
  Vec<Dim> normal;            ///< out of the first
  double area = 0;            ///< m^(Dim-1), per radian where axisymmetric
  double traction = 0;        ///< Pa, along the normal, at most 0
  Vec<Dim> velocity;          ///< m/s, of the first one's wall
  Vec<Dim> shear_force;       ///< on the first, across the normal
  double gap = 0;             ///< m, sum of the two signed distances there; below 0: overlap
};

/// Slope of a level set at an own cell from neighbours in the block; one-sided at the block's edges.
template <int Dim>
Vec<Dim> slope_in_block(const FieldArray<double>& phi, const Box<Dim>& layout, const Index<Dim>& local,
                        double dx) {
  Vec<Dim> slope;
  for (int d = 0; d < Dim; ++d) {
    Index<Dim> lo = local, hi = local;
    if (local[d] > layout.lo[d]) --lo[d];
    if (local[d] + 1 < layout.hi[d]) ++hi[d];
    if (hi[d] > lo[d]) slope[d] = (phi[layout.at(hi)] - phi[layout.at(lo)]) / ((hi[d] - lo[d]) * dx);
  }
  return slope;
}

/// The signed distance to a body at a point near a cell of a block, from the cell's centre and slope.
template <int Dim>
double distance_near(const State<Dim>& state, const Body<Dim>& body, int slot, int cell,
                     const Vec<Dim>& point) {
  const Box<Dim> layout = state.grid().layout();
  const Index<Dim> local = layout.index(cell);
  const auto& phi = body.at(slot).phi;
  return phi[cell] + dot(slope_in_block(phi, layout, local, state.grid().dx),
                         point - state.grid().centre(state.mesh.block(slot).cells.lo + local));
}

/// Area that two surfaces in a cell share, facing each other: the smaller of what each shows along the other.
template <int Dim>
double facing_area(const Vec<Dim>& first, const Vec<Dim>& second) {
  const Vec<Dim> difference = first - second;
  if (!(norm(difference) > 0)) return 0;
  const Vec<Dim> e = unit(difference);
  return std::max(0.0, std::min(dot(first, e), -dot(second, e)));
}

namespace contact_detail {

template <int Dim>
bool has_one_partner(const Wall<Dim>& wall) {
  return (wall.partners & (wall.partners - 1)) == 0;
}

template <int Dim>
ContactCell<Dim> describe(const State<Dim>& state, int slot, int first, int second, std::size_t at) {
  const Body<Dim>&one = state.bodies[first], &other = state.bodies[second];
  const BodyBlock<Dim>&a = one.at(slot), &b = other.at(slot);
  const CutCell<Dim>& cut = a.geometry.cuts[at];
  const Wall<Dim>& wall = a.walls[at];
  const auto cell = static_cast<std::size_t>(cut.cell);
  ContactCell<Dim> c;
  c.first = first, c.second = second;
  c.cell = state.mesh.block(slot).cells.lo + state.grid().layout().index(cut.cell);
  c.point = cut.point;
  c.normal = wall.normal;
  c.traction = wall.traction;
  c.velocity = wall.face_velocity;
  c.gap = distance_near(state, one, slot, cut.cell, cut.point) +
          distance_near(state, other, slot, cut.cell, cut.point);
  const int facing = b.geometry.index.empty() ? -1 : b.geometry.index[cell];
  if (other.rigid)
    c.area = std::max(0.0, dot(cut.surface, c.normal));
  else if (facing >= 0)
    c.area = facing_area(cut.surface, b.geometry.cuts[facing].surface);
  // With one partner the force on the wall is that of this contact; with more only its normal part is known.
  if (has_one_partner(wall))
    c.shear_force = wall.force - dot(wall.force, c.normal) * c.normal;
  else if (facing >= 0 && !other.rigid && has_one_partner(b.walls[facing]))
    c.traction = b.walls[facing].traction;
  return c;
}

}  // namespace contact_detail

/// Calls f(ContactCell) for every cell of a block in which bodies touch; each pair once. After a step.
template <int Dim, class F>
void for_each_contact(const State<Dim>& state, int slot, F&& f) {
  for (int m = 0; m < state.count(); ++m) {
    const Body<Dim>& body = state.bodies[m];
    if (body.rigid || !body.present(slot)) continue;
    const BodyBlock<Dim>& b = body.at(slot);
    for (std::size_t w = 0; w < std::min(b.walls.size(), b.geometry.cuts.size()); ++w)
      for (std::uint32_t bits = b.walls[w].partners; bits != 0; bits &= bits - 1) {
        const int other = __builtin_ctz(bits);
        const Body<Dim>& partner = state.bodies[other];
        if (!partner.present(slot) || (!partner.rigid && other < m)) continue;
        f(contact_detail::describe(state, slot, m, other, w));
      }
  }
}

}  // namespace recoil
