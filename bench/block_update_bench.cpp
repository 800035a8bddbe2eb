// The innermost kernel: one Euler substage of one body in one block, inside the body and at its surface.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

#include "dynamics/block_update.hpp"
#include "sample.hpp"

namespace recoil::bench {

namespace {

enum class Where { interior, surface };

/// The block of the first body that is farthest from all surfaces, or has the most cut cells. -1: none.
template <int Dim>
int pick_block(const State<Dim>& state, Where where) {
  int best = -1;
  std::int64_t most = 0;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const BodyBlock<Dim>& b = state.bodies[0].at(slot);
    if (!b.present || b.near_surface != (where == Where::surface)) continue;
    const auto score =
        where == Where::surface ? static_cast<std::int64_t>(b.geometry.cuts.size()) : cells_with_matter(b);
    if (score <= most) continue;
    most = score;
    best = slot;
  }
  return best;
}

/// A step of length zero does all the work and leaves the state as it is.
template <int Dim>
void block_update(benchmark::State& timer, Where where) {
  Sample<Dim> sample(load("bench/cases/block_" + std::to_string(Dim) + "d.toml"), 10);
  State<Dim>& state = sample.state;
  const int slot = pick_block(state, where);
  if (slot < 0) return timer.SkipWithError("no block of this kind");
  Body<Dim>& body = state.bodies[0];
  ExactEdgeAccount<Dim> edges;
  Counters counters;
  for (BodyBlock<Dim>& b : body.blocks) b.stencil.swap(b.average);  // as a stage does
  Scratch& scratch = sample.team.scratch(0);
  for (auto _ : timer) {
    const Scratch::Frame frame(scratch);
    update_block(state, body, slot, FaceTime::now, 0.0, 1.0, edges, counters, scratch);
    benchmark::DoNotOptimize(body.at(slot).contents.data());
    benchmark::ClobberMemory();
  }
  const auto cells = static_cast<double>(cells_with_matter(body.at(slot)));
  timer.counters[rate_name] = benchmark::Counter(cells * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
  timer.counters["cells"] = cells;
  timer.counters["cut-cells"] = static_cast<double>(body.at(slot).geometry.cuts.size());
}

template <int Dim>
void add() {
  const std::string name = "block/" + std::to_string(Dim) + "d/";
  benchmark::RegisterBenchmark((name + "interior").c_str(), block_update<Dim>, Where::interior);
  benchmark::RegisterBenchmark((name + "surface").c_str(), block_update<Dim>, Where::surface);
}

}  // namespace

void add_block_updates() {
  add<1>();
  add<2>();
  add<3>();
}

}  // namespace recoil::bench
