#include "gauge/contact_fields.hpp"

#include <cmath>
#include <limits>

#include "gauge/contact_cells.hpp"

namespace recoil {

namespace {

constexpr double slip = 1e-5;     // of the bulk speed of sound
constexpr double opposed = -0.7;  // cosine between normals of surfaces that face each other

template <int Dim>
Vec<Dim> velocity_of(const Body<Dim>& body, int slot, int cell, const Vec<Dim>& x) {
  if (body.rigid) return velocity_at(*body.rigid, x);
  const BodyBlock<Dim>& b = body.at(slot);
  const int at = b.geometry.index.empty() ? -1 : b.geometry.index[cell];
  const bool known = at >= 0 && static_cast<std::size_t>(at) < b.walls.size();
  return known ? b.walls[at].face_velocity : Vec<Dim>{};
}

template <int Dim>
bool slides(const State<Dim>& state, int slot, int m, const CutCell<Dim>& at, const Wall<Dim>& wall) {
  const double limit = slip * bulk_sound_speed(state.bodies[m].material);
  for (std::uint32_t bits = wall.partners; bits != 0; bits &= bits - 1) {
    const Body<Dim>& partner = state.bodies[__builtin_ctz(bits)];
    if (!partner.present(slot)) continue;
    const Vec<Dim> jump = wall.face_velocity - velocity_of(partner, slot, at.cell, at.point);
    if (norm(jump - dot(jump, wall.normal) * wall.normal) > limit) return true;
  }
  return false;
}

}  // namespace

template <int Dim>
std::vector<std::uint32_t> have_touched(const State<Dim>& state, const parallel::World& world) {
  const int n = state.count();
  std::vector<std::int64_t> met(static_cast<std::size_t>(n * (n - 1) / 2));
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const auto& pairs = state.ledger[slot].pairs;
    for (std::size_t p = 0; p < pairs.size(); ++p) met[p] += pairs[p].exchanged.momentum != Vec<Dim>{};
  }
  world.sum(met);
  std::vector<std::uint32_t> touched(static_cast<std::size_t>(n));
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      if (met[pair_number(a, b, n)] == 0) continue;
      touched[a] |= 1U << b;
      touched[b] |= 1U << a;
    }
  return touched;
}

template <int Dim>
SurfaceContact surface_contact(const State<Dim>& state, int slot, int m, int cell, std::uint32_t touched) {
  SurfaceContact c;
  const Body<Dim>& body = state.bodies[m];
  const BodyBlock<Dim>& b = body.at(slot);
  const double dx = state.grid().dx;
  const Box<Dim> layout = state.grid().layout();
  const int at = b.geometry.index.empty() ? -1 : b.geometry.index[cell];
  const Wall<Dim>* wall = at >= 0 && static_cast<std::size_t>(at) < b.walls.size() ? &b.walls[at] : nullptr;
  if (wall) c.traction = wall->traction;
  if (wall && wall->partners != 0)
    c.state =
        slides(state, slot, m, b.geometry.cuts[at], *wall) ? ContactState::slipping : ContactState::touching;
  const Vec<Dim> n = slope_in_block(b.phi, layout, layout.index(cell), dx);
  double nearest = far_cells * dx;
  for (int q = 0; q < state.count(); ++q) {
    const Body<Dim>& other = state.bodies[q];
    if (q == m || !other.present(slot)) continue;
    const auto& phi = other.at(slot).phi;
    const double there = phi[cell];
    if (!(there < far_cells * dx)) continue;
    nearest = std::min(nearest, there);
    const Vec<Dim> k = slope_in_block(phi, layout, layout.index(cell), dx);
    const bool facing = dot(n, k) < opposed * norm(n) * norm(k);
    if (c.state == ContactState::free && facing && (touched >> q & 1U) != 0) c.state = ContactState::opened;
  }
  c.gap = nearest < far_cells * dx ? b.phi[cell] + nearest : std::numeric_limits<double>::quiet_NaN();
  return c;
}

#define RECOIL_INSTANTIATE(Dim)                                                                     \
  template std::vector<std::uint32_t> have_touched<Dim>(const State<Dim>&, const parallel::World&); \
  template SurfaceContact surface_contact<Dim>(const State<Dim>&, int, int, int, std::uint32_t);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
