#include "interface/surface_view.hpp"
#include "state/level_set_view.hpp"

#include <cstddef>

namespace recoil {

namespace {

/// Copies one array of a body into a new window.
template <int Dim, class T, class Of>
const T* gather(const Window<Dim>& window, const Body<Dim>& body, T missing, Beyond beyond, Scratch& scratch,
                Of&& of) {
  T* out = scratch.take<T>(static_cast<std::size_t>(window.size()));
  window.gather([&](int s) { return body.present(s) ? of(body.at(s)).data() : nullptr; }, missing, beyond,
                out);
  return out;
}

template <int Dim>
bool has_touched(const SurfaceView<Dim>& v, int m, int partner, const Box<Dim>& cells) {
  if (!v.contact[m]) return false;
  bool found = false;
  for_each(cells, [&](const Index<Dim>& j) { found = found || v.touched(m, partner, j); });
  return found;
}

}  // namespace

template <int Dim>
double SurfaceView<Dim>::distance(int m, const Vec<Dim>& x) const {
  return phi[m] ? interpolate(state.grid(), window.box(), phi[m], x)
                : distance_at(*body(m).rigid, pose[m], x);
}

template <int Dim>
Vec<Dim> SurfaceView<Dim>::normal(int m, const Index<Dim>& i) const {
  return phi_normal(window.box(), phi[m], i, dx());
}

template <int Dim>
bool SurfaceView<Dim>::was_in_contact(int m, int other, const Index<Dim>& i) const {
  Box<Dim> around{i, i};
  for (int d = 0; d < Dim; ++d) --around.lo[d], around.hi[d] += 2;
  return has_touched(*this, m, other, around) || has_touched(*this, other, m, around);
}

template <int Dim>
SurfaceView<Dim> view_surfaces(State<Dim>& state, int slot, const Sight& sight, Scratch& scratch) {
  using Block = BodyBlock<Dim>;
  const std::size_t n = state.bodies.size();
  SurfaceView<Dim> v{state,
                     slot,
                     Window<Dim>(state.mesh, slot, sight.halo),
                     scratch.take_filled<const double*>(n, nullptr),
                     scratch.take_filled<const std::uint8_t*>(n, nullptr),
                     scratch.take_filled<const std::uint32_t*>(n, nullptr),
                     scratch.take_filled<const int*>(n, nullptr),
                     scratch.take_filled<RigidPose<Dim>>(n, RigidPose<Dim>{})};
  const auto phi = sight.when == PhiAt::midstep ? &Block::phi_midstep : &Block::phi;
  for (std::size_t m = 0; m < n; ++m) {
    const Body<Dim>& body = state.bodies[m];
    if (body.rigid) v.pose[m] = pose_after(*body.rigid, 0);
    if (!body.present(slot)) continue;
    if (!body.rigid || sight.rigid_phi) v.phi[m] = view_level_set(state.grid(), body, v.window, phi, scratch);
    if (body.rigid) continue;
    v.contact[m] = gather(
        v.window, body, std::uint32_t{0}, Beyond::extend, scratch,
        [](const Block& b) -> const auto& { return b.contact; });
    if (!sight.cells_of_walls) continue;
    v.role[m] = gather(
        v.window, body, std::uint8_t{0}, Beyond::extend, scratch,
        [](const Block& b) -> const auto& { return b.role; });
    v.wall[m] = gather(
        v.window, body, -1, Beyond::mirror, scratch,
        [](const Block& b) -> const auto& { return b.geometry.index; });
  }
  return v;
}

#define RECOIL_INSTANTIATE(Dim)     \
  template struct SurfaceView<Dim>; \
  template SurfaceView<Dim> view_surfaces<Dim>(State<Dim>&, int, const Sight&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
