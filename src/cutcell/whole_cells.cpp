#include "cutcell/whole_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <variant>

namespace recoil {

namespace {

/// A cell that is inside although its corners are not (a sheet thinner than a cell) shows this part of it.
constexpr double least_shown = 0.05;

template <int Dim>
void scale(BodyBlock<Dim>& b, std::size_t k, double factor) {
  const std::size_t n = b.volume.size();
  for (std::size_t c = 0; c < Components<Dim>::contents; ++c) b.contents[c * n + k] *= factor;
}

template <int Dim>
void empty(BodyBlock<Dim>& b, std::size_t k) {
  const std::size_t n = b.volume.size();
  b.volume[k] = 0;
  for (std::size_t c = 0; c < Components<Dim>::contents; ++c) b.contents[c * n + k] = 0;
}

/// Contents of a volume that is filled with the value of a ghost cell.
template <int Dim>
void fill_from_ghost(const Material& material, BodyBlock<Dim>& b, std::size_t k, double volume) {
  using C = Components<Dim>;
  const std::size_t n = b.volume.size();
  const double *w = b.stencil.data() + k, rho = w[C::rho * n], mass = rho * volume;
  double* q = b.contents.data() + k;
  double energy = std::visit(
      [&](const auto& eos) {
        double e = frozen(eos, w[C::crushed * n]).energy(rho, w[C::p * n]);
        if constexpr (std::remove_cvref_t<decltype(eos)>::barotropic) e += w[C::extra * n];
        return e;
      },
      material.eos);
  for (std::size_t d = 0; d < Dim; ++d) {
    const double u = w[(C::u + d) * n];
    q[(C::u + d) * n] = mass * u;
    energy += 0.5 * u * u;
  }
  q[C::rho * n] = mass;
  q[C::energy * n] = mass * energy;
  for (std::size_t c = C::s; c < C::contents; ++c) q[c * n] = mass * w[c * n];
  b.volume[k] = volume;
}

/// Calls f(place in the block, volume of the whole cell) for every cell of a block.
template <int Dim, class F>
void for_each_place(const State<Dim>& state, int slot, F&& f) {
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid().layout();
  for_each(cells, [&](const Index<Dim>& i) {
    f(static_cast<std::size_t>(layout.at(i - cells.lo)), state.grid().full_volume(i));
  });
}

}  // namespace

template <int Dim>
void to_whole_cells(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters) {
  BodyBlock<Dim>& b = body.at(slot);
  if (!b.near_surface) return;
  for_each_place(state, slot, [&](std::size_t k, double full) {
    if (!(b.phi[k] < 0)) return empty(b, k);
    if (!(b.volume[k] > 0)) {
      ++counters.real_cells_without_contents;
      return empty(b, k);
    }
    if (b.volume[k] == full) return;
    scale(b, k, full / b.volume[k]);
    b.volume[k] = full;
  });
}

template <int Dim>
void centre_donors(BodyBlock<Dim>& b) {
  for (CutCell<Dim>& cut : b.geometry.cuts) cut.centroid = {};
}

template <int Dim>
void to_cut_cells(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters) {
  BodyBlock<Dim>& b = body.at(slot);
  if (!b.near_surface) return;
  for_each_place(state, slot, [&](std::size_t k, double full) {
    const CellKind kind = b.end_geometry.kind[k];
    double part = kind == CellKind::full ? full : 0;
    if (kind == CellKind::cut) part = b.end_geometry.cuts[b.end_geometry.index[k]].volume;
    if (b.phi[k] < 0) part = std::max(part, least_shown * full);
    if (!(part > 0)) return empty(b, k);
    if (b.volume[k] > 0) {
      scale(b, k, part / b.volume[k]);
      b.volume[k] = part;
    } else if ((b.role[k] & valued) != 0) {
      fill_from_ghost(body.material, b, k, part);
    } else {
      ++counters.uncovered_cells_without_value;
    }
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                     \
  template void to_whole_cells<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&); \
  template void centre_donors<Dim>(BodyBlock<Dim>&);                                \
  template void to_cut_cells<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
