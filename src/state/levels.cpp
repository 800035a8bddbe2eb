#include "state/levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "field/window.hpp"

namespace recoil {

namespace {

template <int Dim>
std::size_t cells_in(const Mesh<Dim>& mesh) {
  return static_cast<std::size_t>(mesh.grid().layout().size());
}

template <int Dim>
Index<Dim> coarser_index(Index<Dim> i) {
  for (int d = 0; d < Dim; ++d) i[d] >>= 1;
  return i;
}

/// The coarser cells that hold these.
template <int Dim>
Box<Dim> coarser_box(const Box<Dim>& cells) {
  Box<Dim> b{coarser_index(cells.lo), cells.hi};
  for (int d = 0; d < Dim; ++d) b.hi[d] = (cells.hi[d] + 1) >> 1;
  return b;
}

/// Of the parabola through the means of three cells, which has no extremum of its own (van Leer's limiter): a
/// quarter of its difference over the middle cell. Its lower and higher half have the mean less this and
/// more.
[[gnu::always_inline]] inline double quarter_slope(double low, double here, double high) {
  const double a = here - low, b = high - here;
  if (!(a * b > 0)) return 0;
  const double central = 0.5 * std::abs(a + b), most = 2 * std::min(std::abs(a), std::abs(b));
  return std::copysign(0.25 * std::min(central, most), a);
}

/// Values of a window of coarser cells, and of the finer cells in them.
template <int Dim>
struct Parent {
  const Window<Dim>& window;
  const double* value;  // [window]

  double at(const Index<Dim>& finer) const {
    const int k = window.at(coarser_index(finer));
    double v = value[k];
    for (int d = 0; d < Dim; ++d) {
      const int st = window.stride(d);
      const double q = quarter_slope(value[k - st], value[k], value[k + st]);
      v += (finer[d] & 1) != 0 ? q : -q;
    }
    return v;
  }
};

/// The axes (bits) whose mirrors turn the sign of each component of contents and primitives.
template <int Dim, std::size_t count>
auto signed_components() {
  std::array<typename Window<Dim>::template Component<double>, count> components;
  for (std::size_t c = 0; c < count; ++c)
    for (int d = 0; d < Dim; ++d)
      if (component_sign<Dim>(static_cast<int>(c), 1U << d) < 0) components[c].odd_axes |= 1U << d;
  return components;
}

/// Contents per volume of the cells of a window.
template <int Dim>
double* densities(const State<Dim>& state, int body, const Window<Dim>& w, Scratch& scratch) {
  constexpr std::size_t count = Components<Dim>::contents;
  const Body<Dim>& b = state.bodies[body];
  const auto n = static_cast<std::size_t>(w.size());
  double* q = scratch.take<double>(n * count);
  double* v = scratch.take<double>(n);
  w.gather([&](int s) { return b.present(s) ? b.at(s).contents.raw().data() : nullptr; },
           signed_components<Dim, count>(), Beyond::extend, q);
  w.gather([&](int s) { return b.present(s) ? b.at(s).volume.raw().data() : nullptr; }, 0.0, Beyond::extend,
           v);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < count; ++c) q[c * n + k] = v[k] > 0 ? q[c * n + k] / v[k] : 0.0;
  return q;
}

/// Cells of one body in a stand-in.
template <int Dim>
class Filling {
 public:
  Filling(State<Dim>& state, int slot, int body, FieldSet fields, Scratch& scratch)
      : state_(state),
        mesh_(state.mesh),
        by_(state.mesh.stand_in(slot)),
        slot_(slot),
        body_(body),
        fields_(fields),
        scratch_(scratch),
        n_(cells_in(state.mesh)) {}

  void run() {
    Body<Dim>& body = state_.bodies[body_];
    const bool there =
        std::any_of(by_.from.begin(), by_.from.end(), [&](int s) { return s >= 0 && body.present(s); });
    if (!there) {
      if (body.present(slot_)) leave_block(body, slot_);
      return;
    }
    BodyBlock<Dim>& b = body.at(slot_);
    b.present = true;
    const bool volumes = fields_.has(Field::contents) || fields_.has(Field::volume);
    if (volumes) b.contents.raw().resize(n_ * Components<Dim>::contents), b.volume.raw().resize(n_);
    if (fields_.has(Field::phi)) b.phi.raw().resize(n_);
    if (fields_.has(Field::stencil)) b.stencil.raw().resize(n_ * Components<Dim>::primitives);
    if (by_.from_coarser) mark_full(b);
    if (by_.from_coarser)
      from_coarser(b, volumes);
    else
      from_finer(b, volumes);
  }

 private:
  std::size_t place(int slot, const Index<Dim>& i) const {
    return static_cast<std::size_t>(mesh_.grid().layout().at(i - mesh_.block(slot).cells.lo));
  }

  /// Coarser blocks have no surface. Blocks beside them may: what they read here is full of matter.
  void mark_full(BodyBlock<Dim>& b) {
    if (mesh_.block(slot_).level > 0 || b.role.raw().size() == n_) return;
    b.role.raw().assign(n_, donates | regular | valued);
    const double far = far_cells * mesh_.grid().dx;
    b.phi_midstep.raw().assign(n_, -far), b.phi_next.raw().assign(n_, -far);
    for (Geometry<Dim>* g : {&b.geometry, &b.end_geometry}) {
      g->kind.raw().assign(n_, CellKind::full);
      g->index.raw().assign(n_, -1);
    }
  }

  void from_coarser(BodyBlock<Dim>& b, bool volumes) {
    const Scratch::Frame frame(scratch_);
    const Body<Dim>& body = state_.bodies[body_];
    const Window<Dim> w(mesh_, by_.from[0], 1, coarser_box(by_.cells));
    const auto wide = static_cast<std::size_t>(w.size());
    const Grid<Dim>& grid = mesh_.grid(slot_);
    if (fields_.has(Field::phi)) {
      const double* phi = body.at(by_.from[0]).phi.raw().data();
      for_each(by_.cells, [&](const Index<Dim>& i) {
        b.phi.raw()[place(slot_, i)] = phi[place(by_.from[0], coarser_index(i))];
      });
    }
    if (volumes) {
      const double* q = densities(state_, body_, w, scratch_);
      for_each(by_.cells, [&](const Index<Dim>& i) {
        const double full = grid.full_volume(i);
        b.volume.raw()[place(slot_, i)] = q[w.at(coarser_index(i))] > 0 ? full : 0;
      });
      for (std::size_t c = 0; c < Components<Dim>::contents; ++c)
        for_each(by_.cells, [&](const Index<Dim>& i) {
          b.contents.raw()[c * n_ + place(slot_, i)] =
              Parent<Dim>{w, q + c * wide}.at(i) * grid.full_volume(i);
        });
    }
    if (fields_.has(Field::stencil)) {
      constexpr std::size_t count = Components<Dim>::primitives;
      double* v = scratch_.take<double>(wide * count);
      w.gather([&](int s) { return body.present(s) ? body.at(s).stencil.raw().data() : nullptr; },
               signed_components<Dim, count>(), Beyond::extend, v);
      for (std::size_t c = 0; c < count; ++c)
        for_each(by_.cells, [&](const Index<Dim>& i) {
          b.stencil.raw()[c * n_ + place(slot_, i)] = Parent<Dim>{w, v + c * wide}.at(i);
        });
    }
  }

  /// f(child's block, its place there, part of the volume) for the finer cells in a cell.
  template <class F>
  void for_each_finer(const Index<Dim>& i, F&& f) const {
    const Grid<Dim>& grid = mesh_.grid(slot_);
    for (unsigned c = 0; c < by_.from.size(); ++c) {
      Index<Dim> finer;
      for (int d = 0; d < Dim; ++d) finer[d] = 2 * i[d] + static_cast<int>(c >> d & 1U);
      for (const int s : by_.from)
        if (s >= 0 && state_.bodies[body_].present(s) && mesh_.block(s).cells.contains(finer))
          f(state_.bodies[body_].at(s), place(s, finer),
            mesh_.grid(s).full_volume(finer) / grid.full_volume(i));
    }
  }

  void from_finer(BodyBlock<Dim>& b, bool volumes) {
    const double far = far_cells * mesh_.grid().dx;
    const auto mean = [&](FieldArray<double> BodyBlock<Dim>::*field, std::size_t count, bool sums,
                          double missing) {
      for_each(by_.cells, [&](const Index<Dim>& i) {
        const std::size_t k = place(slot_, i);
        double parts = 0;
        double* to = (b.*field).raw().data() + k;
        for (std::size_t c = 0; c < count; ++c) to[c * n_] = 0;
        for_each_finer(i, [&](const BodyBlock<Dim>& finer, std::size_t at, double part) {
          parts += part;
          for (std::size_t c = 0; c < count; ++c)
            to[c * n_] += (sums ? 1.0 : part) * (finer.*field).raw()[c * n_ + at];
        });
        if (parts == 0) std::fill_n(to, 1, missing);
      });
    };
    if (fields_.has(Field::phi)) mean(&BodyBlock<Dim>::phi, 1, false, far);
    if (volumes) mean(&BodyBlock<Dim>::contents, Components<Dim>::contents, true, 0);
    if (volumes) mean(&BodyBlock<Dim>::volume, 1, true, 0);
    if (fields_.has(Field::stencil)) mean(&BodyBlock<Dim>::stencil, Components<Dim>::primitives, false, 0);
  }

  State<Dim>& state_;
  const Mesh<Dim>& mesh_;
  const StandIn<Dim>& by_;
  int slot_, body_;
  FieldSet fields_;
  Scratch& scratch_;
  std::size_t n_;  // cells of a block
};

}  // namespace

template <int Dim>
State<Dim> empty_on(Mesh<Dim>&& mesh, const State<Dim>& from) {
  State<Dim> to{std::move(mesh), {},        {},          from.contact,   {},
                from.time,       from.step, from.travel, FieldSet::all()};
  const auto slots = static_cast<std::size_t>(to.mesh.slots()),
             local = static_cast<std::size_t>(to.mesh.local());
  for (const Body<Dim>& body : from.bodies) {
    Body<Dim>& b = to.bodies.emplace_back();
    b.name = body.name, b.material = body.material, b.temperature = body.temperature, b.rigid = body.rigid;
    b.detonation = body.detonation;
    b.fragments_of = body.fragments_of;
    b.blocks.resize(slots);
  }
  to.contacts.resize(local);
  to.loads = from.loads;
  BlockLedger<Dim> none;
  const std::size_t n = from.bodies.size();
  none.pairs.resize(n * (n - 1) / 2), none.edges.resize(n), none.failures.resize(n), none.released.resize(n);
  none.loads.resize(from.loads.empty() ? 0 : n);
  to.ledger.assign(local, none);
  return to;
}

template <int Dim>
void fill_stand_ins(State<Dim>& state, FieldSet fields, parallel::Team& team) {
  const auto& all = state.mesh.stand_ins_in_order();
  const auto group = [&](int s) {
    return state.mesh.stand_in(s).from_coarser ? state.mesh.block(s).level : state.mesh.levels();
  };
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    std::vector<int> slots;  // whose values follow from those of groups before
    while (last < all.size() && group(all[last]) == group(all[first])) slots.push_back(all[last++]);
    parallel::for_each_block(team, slots, [&](int slot, Scratch& scratch) {
      for (int m = 0; m < state.count(); ++m)
        if (!state.bodies[m].rigid) Filling<Dim>(state, slot, m, fields, scratch).run();
    });
  }
}

template <int Dim>
void join_blocks(const State<Dim>& from, const std::array<int, power<Dim>(2)>& children, int body,
                 const Box<Dim>& cells, BodyBlock<Dim>& to) {
  const Body<Dim>& old = from.bodies[body];
  const Box<Dim> layout = from.grid().layout();
  const auto n = static_cast<std::size_t>(layout.size());
  const double far = far_cells * from.grid().dx;
  for (const int s : children) {
    if (s < 0 || !old.present(s)) continue;
    const BodyBlock<Dim>& b = old.at(s);
    const Box<Dim> finer = from.mesh.block(s).cells;
    for_each(finer, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(layout.at(i - finer.lo));
      const auto up = static_cast<std::size_t>(layout.at(coarser_index(i) - cells.lo));
      to.volume.raw()[up] += b.volume.raw()[k];
      for (std::size_t c = 0; c < Components<Dim>::contents; ++c)
        to.contents.raw()[c * n + up] += b.contents.raw()[c * n + k];
      to.phi.raw()[up] = b.phi.raw()[k] < 0 ? -far : far;
    });
  }
}

template <int Dim>
std::int64_t cut_block(const State<Dim>& from, int slot, int body, const Box<Dim>& cells, BodyBlock<Dim>& to,
                       const std::function<bool(const Contents<Dim>&, double)>& admissible,
                       Scratch& scratch) {
  constexpr std::size_t count = Components<Dim>::contents;
  const Scratch::Frame frame(scratch);
  const Box<Dim> layout = from.grid().layout();
  const auto n = static_cast<std::size_t>(layout.size());
  const BodyBlock<Dim>& old = from.bodies[body].at(slot);
  const Box<Dim> parents = coarser_box(cells);
  const Window<Dim> w(from.mesh, slot, 1, parents);
  const double* q = densities(from, body, w, scratch);
  const Grid<Dim> grid = from.mesh.level_grid(from.mesh.block(slot).level - 1);
  std::int64_t flat = 0;
  constexpr int children = power<Dim>(2);
  for_each(parents, [&](const Index<Dim>& i) {
    const auto up = static_cast<std::size_t>(w.cell(i));
    const double whole = old.volume.raw()[up];
    std::array<Contents<Dim>, children> part{};
    std::array<double, children> volume{};
    std::array<std::size_t, children> at{};
    Contents<Dim> left;
    for (std::size_t c = 0; c < count; ++c) left[c] = old.contents.raw()[c * n + up];
    const Contents<Dim> sum = left;
    for (int m = 0; m < children; ++m) {
      Index<Dim> f;
      for (int d = 0; d < Dim; ++d) f[d] = 2 * i[d] + (m >> d & 1);
      at[m] = static_cast<std::size_t>(layout.at(f - cells.lo));
      volume[m] = whole > 0 ? grid.full_volume(f) : 0;
      for (std::size_t c = 0; c < count; ++c) {
        part[m][c] =
            whole > 0 ? Parent<Dim>{w, q + c * static_cast<std::size_t>(w.size())}.at(f) * volume[m] : 0;
        left[c] -= part[m][c];
      }
    }
    bool good = true;
    for (int m = 0; m < children && whole > 0; ++m) {
      for (std::size_t c = 0; c < count; ++c) part[m][c] += left[c] * volume[m] / whole;
      good = good && admissible(part[m], volume[m]);
    }
    if (!good) ++flat;
    Contents<Dim> rest = sum;
    for (int m = 0; m < children; ++m) {
      to.volume.raw()[at[m]] = volume[m];
      to.phi.raw()[at[m]] = old.phi.raw()[up];
      for (std::size_t c = 0; c < count; ++c) {
        if (!good) part[m][c] = sum[c] * volume[m] / whole;
        if (m + 1 == children) part[m][c] = rest[c];  // so that nothing is lost by rounding
        rest[c] -= part[m][c];
        to.contents.raw()[c * n + at[m]] = part[m][c];
      }
    }
  });
  return flat;
}

#define RECOIL_INSTANTIATE(Dim)                                                                       \
  template State<Dim> empty_on<Dim>(Mesh<Dim>&&, const State<Dim>&);                                  \
  template void fill_stand_ins<Dim>(State<Dim>&, FieldSet, parallel::Team&);                          \
  template void join_blocks<Dim>(const State<Dim>&, const std::array<int, power<Dim>(2)>&, int,       \
                                 const Box<Dim>&, BodyBlock<Dim>&);                                   \
  template std::int64_t cut_block<Dim>(const State<Dim>&, int, int, const Box<Dim>&, BodyBlock<Dim>&, \
                                       const std::function<bool(const Contents<Dim>&, double)>&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
