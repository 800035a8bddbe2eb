#include "dynamics/damage/nonlocal_damage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <variant>

#include "core/error.hpp"
#include "dynamics/failed_matter.hpp"
#include "field/window.hpp"

namespace recoil {

namespace {

/// Beside a void damage grows at least by this part of a cell's own tension. A cell between voids cannot
/// contract, which is what its matter would do: its tension stays, and the mean, of cells without stress,
/// never breaks it.
constexpr double own_beside_void = 0.5;

/// What damage grows by in the cells of one body in one block: means, and beside voids at least a part of the
/// cell's own tension.
template <int Dim>
class MeanDrive {
 public:
  MeanDrive(const State<Dim>& state, const Body<Dim>& body, int slot, int reach, Scratch& scratch)
      : window_(state.mesh, slot, reach), reach_(reach), round_(state.grid(slot).has_radius()) {
    const auto n = static_cast<std::size_t>(window_.size());
    drive_ = scratch.take<double>(n * count);
    window_.gather([&](int s) { return body.present(s) ? data_of(body.at(s)) : nullptr; },
                   std::array<typename Window<Dim>::template Component<double>, count>{}, Beyond::mirror,
                   drive_);
    weights_ = scratch.take<double>(static_cast<std::size_t>(around({}).size()));
    const double dx = state.grid(slot).dx;
    std::size_t k = 0;
    for_each(around({}), [&](const Index<Dim>& j) {
      double square = 0;
      for (int d = 0; d < Dim; ++d) square += static_cast<double>(j[d]) * j[d];
      weights_[k++] = body.material.damage_average.weight(std::sqrt(square) * dx);
    });
  }

  /// @returns false where there is no matter.
  bool mean(const Index<Dim>& i, double damage, double dt, DamagePoint& point) const {
    const auto n = static_cast<std::size_t>(window_.size());
    if (!(drive_[window_.at(i)] > 0)) return false;
    DamageDrive::Values sum{};
    std::size_t k = 0;
    for_each(around(i), [&](const Index<Dim>& j) {
      const double* at = drive_ + window_.at(j);
      const double weight = weights_[k++] * at[0];
      if (!(weight > 0)) return;
      sum[0] += weight;
      for (std::size_t c = 1; c < count; ++c) sum[c] += weight * at[c * n];
    });
    point = DamageDrive::mean(sum, damage, dt);
    if (const double part = own_part(i); part > 0) bear_at_least(part, drive_ + window_.at(i), point);
    return true;
  }

 private:
  /// Whether a cell has a void: it holds failed matter without any stress.
  bool has_void(const Index<Dim>& i) const {
    const auto n = static_cast<std::size_t>(window_.size());
    const double* at = drive_ + window_.at(i);
    return at[0] > 0 && at[DamageDrive::principal * n] == 0 && at[DamageDrive::pressure * n] == 0;
  }
  /// The part of a cell's own tension that counts: none, where no cell around has a void; all, where voids
  /// are on both sides along an axis, or beside a cell at the axis or centre of symmetry.
  double own_part(const Index<Dim>& i) const {
    Box<Dim> next{i, i};
    for (int d = 0; d < Dim; ++d) --next.lo[d], next.hi[d] += 2;
    bool beside = false;
    for_each(next, [&](const Index<Dim>& j) { beside = beside || has_void(j); });
    if (!beside) return 0;
    for (int d = 0; d < Dim; ++d) {
      Index<Dim> low = i, high = i;
      --low[d], ++high[d];
      const bool at_axis = round_ && d == 0 && i[0] == 0;
      if (has_void(high) && (at_axis || has_void(low))) return 1;
    }
    return own_beside_void;
  }
  /// Takes a part of a cell's own tension where that is more than the mean.
  void bear_at_least(double part, const double* own, DamagePoint& point) const {
    const auto n = static_cast<std::size_t>(window_.size());
    const double principal = part * own[DamageDrive::principal * n],
                 pressure = part * own[DamageDrive::pressure * n];
    if (principal > 0) point.principal = std::max(point.principal, principal);
    if (pressure < 0) point.pressure = std::min(point.pressure, pressure);
  }

  static constexpr auto count = static_cast<std::size_t>(DamageDrive::components);
  /// Null where the field is not there: in a block that stands in for one of another level.
  static const double* data_of(const BodyBlock<Dim>& b) {
    return b.damage_drive.empty() ? nullptr : b.damage_drive.data();
  }
  Box<Dim> around(const Index<Dim>& i) const {
    Box<Dim> box{i, i};
    for (int d = 0; d < Dim; ++d) box.lo[d] -= reach_, box.hi[d] += reach_ + 1;
    return box;
  }

  Window<Dim> window_;
  int reach_;
  bool round_;
  double *drive_ = nullptr, *weights_ = nullptr;
};

/// f(cell of the block, its index, its mean state, the contents there) for every cell with matter.
template <int Dim, class F>
void for_each_mean(const State<Dim>& state, Body<Dim>& body, int slot, double dt, Scratch& scratch, F&& f) {
  const Scratch::Frame frame(scratch);
  BodyBlock<Dim>& b = body.at(slot);
  const MeanDrive<Dim> means(state, body, slot, averaged_cells(body, state.grid(slot).dx), scratch);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  const auto n = static_cast<std::size_t>(layout.size());
  for_each(b.matter, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    const double mass = b.contents[k], damage = b.contents[Components<Dim>::damage * n + k];
    DamagePoint point;
    if (!(mass > 0) || !means.mean(i, damage / mass, dt, point)) return;
    f(i, FailingCell<Dim>(body, b.contents.data() + k, n, b.volume[k]), point);
  });
}

}  // namespace

template <int Dim>
int averaged_cells(const Body<Dim>& body, double dx) {
  if (!averages_damage(body.material)) return 0;
  const double cells = std::ceil(body.material.damage_average.length / dx * (1 - 1e-12));
  require(cells <= DamageAverage::most_cells, "damage is averaged over too many cells");
  return static_cast<int>(cells);
}

template <int Dim>
int averaged_cells(const State<Dim>& state) {
  int most = 0;
  for (const Body<Dim>& body : state.bodies)
    if (!body.rigid) most = std::max(most, averaged_cells(body, state.grid().dx));
  return most;
}

template <int Dim>
void note_damage_drive(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  clear_damage_drive(b);
  const Grid<Dim>& grid = state.grid(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = grid.layout();
  const auto n = static_cast<std::size_t>(layout.size());
  for_each(b.matter, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    FailingCell<Dim>(body, b.contents.data() + k, n, b.volume[k])
        .note(grid.full_volume(i), 0, b.damage_drive.data() + k);
  });
}

template <int Dim>
void grow_by_mean(const State<Dim>& state, Body<Dim>& body, int slot, double dt, double most_damage,
                  BlockLedger<Dim>& ledger, Scratch& scratch) {
  const auto number = static_cast<std::size_t>(&body - state.bodies.data());
  for_each_mean<Dim>(state, body, slot, dt, scratch,
                     [&](const Index<Dim>& i, FailingCell<Dim> cell, const DamagePoint& point) {
                       const bool failed = cell.has_failed();
                       ledger.counters.clamped_damage += cell.grow(point, most_damage);
                       if (!failed && cell.has_failed())
                         ledger.failures[number].note(state.time, state.mesh.finest_index(slot, i));
                     });
}

template <int Dim>
void fail_at_once_by_mean(const State<Dim>& state, Body<Dim>& body, int slot, BlockLedger<Dim>& ledger,
                          Scratch& scratch) {
  const auto number = static_cast<std::size_t>(&body - state.bodies.data());
  for_each_mean<Dim>(state, body, slot, 0, scratch,
                     [&](const Index<Dim>& i, FailingCell<Dim> cell, const DamagePoint& point) {
                       if (cell.fail_at_once(point))
                         ledger.failures[number].note(state.time, state.mesh.finest_index(slot, i));
                     });
}

#define RECOIL_INSTANTIATE(Dim)                                                                          \
  template int averaged_cells<Dim>(const Body<Dim>&, double);                                            \
  template int averaged_cells<Dim>(const State<Dim>&);                                                   \
  template void note_damage_drive<Dim>(const State<Dim>&, Body<Dim>&, int);                              \
  template void grow_by_mean<Dim>(const State<Dim>&, Body<Dim>&, int, double, double, BlockLedger<Dim>&, \
                                  Scratch&);                                                             \
  template void fail_at_once_by_mean<Dim>(const State<Dim>&, Body<Dim>&, int, BlockLedger<Dim>&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
