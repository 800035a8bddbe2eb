#include "interface/opposite.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {

namespace {

constexpr double partner_gap = 1;  // surfaces farther apart [dx] do not meet in this step

/// The fitted state of a body continued from its nearest wall to x. @returns false where no wall is near.
template <int Dim>
bool state_at(const SurfaceView<Dim>& v, int m, const Vec<Dim>& x, Primitives<Dim>& value) {
  using C = Components<Dim>;
  const Body<Dim>& body = v.body(m);
  const Index<Dim> centre = v.state.grid().cell_of(x);
  Box<Dim> box;
  for (int d = 0; d < Dim; ++d) {
    box.lo[d] = std::max(centre[d] - view_reach, v.window.box().lo[d]);
    box.hi[d] = std::min(centre[d] + view_reach + 1, v.window.box().hi[d]);
  }
  double nearest = 1e300;
  const Wall<Dim>* found = nullptr;
  Vec<Dim> from_wall;
  unsigned flips = 0;
  for_each(box, [&](const Index<Dim>& j) {
    const int at = v.wall[m][v.window.at(j)];
    if (at < 0) return;
    const auto source = v.window.source(j);
    const BodyBlock<Dim>& home = body.at(source.slot);
    const Wall<Dim>& wall = home.walls[at];
    if (wall.donors == 0) return;
    const Vec<Dim> r = x - v.window.appear(j, source, home.geometry.cuts[at].point);
    if (dot(r, r) >= nearest) return;
    nearest = dot(r, r);
    found = &wall;
    from_wall = r;
    flips = source.flips;
  });
  if (!found) return false;
  for (int d = 0; d < Dim; ++d)
    if ((flips >> d & 1U) != 0) from_wall[d] = -from_wall[d];
  value = found->value;
  for (std::size_t c = C::u; c < C::ep; ++c) value[c] += dot(found->gradient[c], from_wall) / v.dx();
  if (flips != 0)
    for (std::size_t c = 0; c < value.size(); ++c)
      value[c] *= component_sign<Dim>(static_cast<int>(c), flips);
  return true;
}

}  // namespace

template <int Dim>
double SurfaceView<Dim>::distance(int m, const Vec<Dim>& x) const {
  return interpolate(state.grid(), window.box(), phi[m], x);
}

template <int Dim>
Vec<Dim> SurfaceView<Dim>::normal(int m, const Index<Dim>& i) const {
  return phi_normal(window.box(), phi[m], i, dx());
}

template <int Dim>
bool SurfaceView<Dim>::was_in_contact(int m, int partner, const Index<Dim>& i) const {
  const std::uint32_t* bits = contact[m];
  if (!bits) return false;
  Box<Dim> box{i, i};
  for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
  bool found = false;
  for_each(box, [&](const Index<Dim>& j) { found = found || (bits[window.at(j)] >> partner & 1U) != 0; });
  return found;
}

template <int Dim>
SurfaceView<Dim> view_surfaces(State<Dim>& state, int slot, PhiAt when, Scratch& scratch) {
  SurfaceView<Dim> v{state, slot, Window<Dim>(state.mesh, slot, view_reach), {}, {}, {}, {}};
  const auto n = static_cast<std::size_t>(v.window.size());
  const auto gather = [&](const Body<Dim>& body, auto missing, Beyond beyond, auto&& of) {
    auto* out = scratch.take<decltype(missing)>(n);
    v.window.gather([&](int s) { return body.present(s) ? of(body.at(s)).data() : nullptr; }, missing, beyond,
                    out);
    return out;
  };
  using Block = BodyBlock<Dim>;
  for (const Body<Dim>& body : state.bodies) {
    v.phi.push_back(nullptr);
    v.role.push_back(nullptr);
    v.contact.push_back(nullptr);
    v.wall.push_back(nullptr);
    if (!body.present(slot)) continue;
    v.phi.back() = gather(
        body, far_cells * v.dx(), Beyond::extend, [&](const Block& b) -> const auto& {
          return when == PhiAt::midstep ? b.phi_midstep : b.phi;
        });
    if (body.rigid) continue;
    v.role.back() = gather(
        body, std::uint8_t{0}, Beyond::extend, [](const Block& b) -> const auto& { return b.role; });
    v.contact.back() = gather(
        body, std::uint32_t{0}, Beyond::extend, [](const Block& b) -> const auto& { return b.contact; });
    v.wall.back() = gather(
        body, -1, Beyond::mirror, [](const Block& b) -> const auto& { return b.geometry.index; });
  }
  return v;
}

template <int Dim>
Opposite<Dim> find_opposite(const SurfaceView<Dim>& v, int m, const Vec<Dim>& x, const Index<Dim>& i) {
  Opposite<Dim> o;
  for (int q = 0; q < v.state.count(); ++q) {
    if (q == m || !v.phi[q]) continue;
    const double gap = v.distance(q, x);
    if (o.body >= 0 ? gap < o.gap : gap < partner_gap * v.dx()) {
      o.body = q;
      o.gap = gap;
    }
  }
  if (o.body < 0) return o;
  o.normal = v.normal(o.body, i);
  if (!v.body(o.body).rigid && !state_at(v, o.body, x, o.value)) o.body = -1;
  return o;
}

template <int Dim>
void clear_records(State<Dim>& state, int slot) {
  for (auto& p : state.ledger[slot].pairs) {
    const Account<Dim> kept = p.exchanged;
    p = {};
    p.exchanged = kept;
  }
}

template <int Dim>
void record_contact(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
                    const Vec<Dim>& e, double traction, double work_velocity, double booked) {
  const double area = dot(cut.surface, e);
  if (!(booked > 0) || !(area > 0) || (m > o.body && !v.body(o.body).rigid)) return;
  const int low = std::min(m, o.body), high = std::max(m, o.body);
  PairRecord<Dim>& r = v.state.ledger[v.slot].pairs[pair_number(low, high, v.state.count())];
  const double sign = m == low ? 1 : -1;
  const Vec<Dim> force = sign * traction * area * e;
  r.exchanged.momentum += booked * force;
  r.exchanged.energy += booked * sign * traction * area * work_velocity;
  r.area += area;
  r.force += force;
  r.traction += traction * area;
  r.velocity += work_velocity * area;
  r.gap += o.gap * area;
  r.place += cut.point * area;
  r.widest_gap = std::max(r.widest_gap, o.gap / v.dx());
  r.deepest_overlap = std::min(r.deepest_overlap, o.gap / v.dx());
}

#define RECOIL_INSTANTIATE(Dim)                                                                              \
  template struct SurfaceView<Dim>;                                                                          \
  template SurfaceView<Dim> view_surfaces<Dim>(State<Dim>&, int, PhiAt, Scratch&);                           \
  template Opposite<Dim> find_opposite<Dim>(const SurfaceView<Dim>&, int, const Vec<Dim>&,                   \
                                            const Index<Dim>&);                                              \
  template void clear_records<Dim>(State<Dim>&, int);                                                        \
  template void record_contact<Dim>(const SurfaceView<Dim>&, int, const Opposite<Dim>&, const CutCell<Dim>&, \
                                    const Vec<Dim>&, double, double, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
