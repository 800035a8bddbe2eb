#include "timestep/rigid_bodies.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "levelset/transport.hpp"
#include "parallel/exact_sums.hpp"

namespace recoil {

namespace {

/// What a body has been given since the start, as a row of numbers: impulse, moment, work.
template <int Dim>
struct Given {
  static constexpr std::size_t width = Dim + 4;
  std::array<double, width> row{};

  Vec<Dim> impulse() const {
    Vec<Dim> p;
    for (int d = 0; d < Dim; ++d) p[d] = row[d];
    return p;
  }
  Vec<3> moment() const { return {{row[Dim], row[Dim + 1], row[Dim + 2]}}; }
  double work() const { return row[width - 1]; }
};

/// Adds what one block has recorded of the contacts of body m.
template <int Dim>
void add_block(const State<Dim>& state, int slot, int m, const SumRow& row) {
  const int n = state.count();
  for (int other = 0; other < n; ++other) {
    if (other == m) continue;
    const PairRecord<Dim>& p =
        state.ledger[slot].pairs[pair_number(std::min(m, other), std::max(m, other), n)];
    const auto add = [&](std::size_t k, const ExactSum& given) {
      if (m < other)
        row[k] += given;
      else
        row[k] -= given;
    };
    for (std::size_t d = 0; d < Dim; ++d) add(d, p.exchanged.momentum.c[d]);
    for (std::size_t d = 0; d < 3; ++d) add(Dim + d, p.moment.c[d]);
    add(Given<Dim>::width - 1, p.exchanged.energy);
  }
}

template <int Dim>
std::vector<Given<Dim>> given_to(const State<Dim>& state, const parallel::World& world,
                                 const std::vector<int>& bodies) {
  ExactSums sums;
  for (std::size_t k = 0; k < bodies.size(); ++k) sums.item(Given<Dim>::width);
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (std::size_t k = 0; k < bodies.size(); ++k)
      add_block(state, slot, bodies[k], sums.add(static_cast<int>(k)));
  sums.reduce(world);
  std::vector<Given<Dim>> all(bodies.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    std::ranges::copy(sums.total(static_cast<int>(k)), all[k].row.begin());
  return all;
}

}  // namespace

template <int Dim>
void follow_velocity_histories(State<Dim>& state, double dt) {
  for (Body<Dim>& body : state.bodies)
    if (body.rigid) follow_history(*body.rigid, state.time, dt);
}

template <int Dim>
void move_rigid_bodies(State<Dim>& state, const parallel::World& world, double dt) {
  std::vector<int> free;
  for (int m = 0; m < state.count(); ++m) {
    Body<Dim>& body = state.bodies[m];
    if (!body.rigid) continue;
    if (body.rigid->mass)
      free.push_back(m);
    else
      move_rigid(*body.rigid, dt, {}, {}, 0);
  }
  if (free.empty()) return;
  const std::vector<Given<Dim>> given = given_to(state, world, free);
  for (std::size_t k = 0; k < free.size(); ++k) {
    Vec<Dim> impulse = given[k].impulse();
    if (state.grid().has_radius()) impulse[0] = 0;  // what lies on the axis moves along it
    move_rigid(*state.bodies[free[k]].rigid, dt, impulse, given[k].moment(), given[k].work());
  }
}

template <int Dim>
void place_rigid_bodies(StepRun<Dim>& step, double ahead, PhiAt where) {
  State<Dim>& state = step.state();
  if (std::ranges::none_of(state.bodies, [](const Body<Dim>& body) { return body.rigid.has_value(); }))
    return;
  step.run_queued();
  const Timers<StepPhase>::Span span(step.engine().timers, StepPhase::level_set);
  step.for_each_own([&](int slot, Scratch&) {
    for (Body<Dim>& body : state.bodies) {
      if (!body.rigid || !body.present(slot)) continue;
      BodyBlock<Dim>& b = body.at(slot);
      if (!never_moves(*body.rigid))
        place_rigid(state, body, slot, ahead, where);
      else if (where == PhiAt::midstep)  // it has stood there since it entered the block
        b.phi_midstep = b.phi;
    }
  });
  step.has_changed(where == PhiAt::midstep ? Field::phi_midstep : Field::phi);
}

template void follow_velocity_histories<1>(State<1>&, double);
template void follow_velocity_histories<2>(State<2>&, double);
template void follow_velocity_histories<3>(State<3>&, double);
template void move_rigid_bodies<1>(State<1>&, const parallel::World&, double);
template void place_rigid_bodies<1>(StepRun<1>&, double, PhiAt);
template void move_rigid_bodies<2>(State<2>&, const parallel::World&, double);
template void place_rigid_bodies<2>(StepRun<2>&, double, PhiAt);
template void move_rigid_bodies<3>(State<3>&, const parallel::World&, double);
template void place_rigid_bodies<3>(StepRun<3>&, double, PhiAt);

}  // namespace recoil
