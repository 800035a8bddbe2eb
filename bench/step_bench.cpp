// Whole steps of small cases, with the share of each part of a step and the memory that cells take.

#include <benchmark/benchmark.h>

#include <chrono>
#include <string>

#include "sample.hpp"

namespace recoil::bench {

namespace {

constexpr double stages = 3;  // of a step

template <int Dim>
void add_shares(benchmark::State& timer, const Timers<StepPhase>& timers, double seconds) {
  for (int p = 0; p < static_cast<int>(StepPhase::count); ++p) {
    const auto part = static_cast<StepPhase>(p);
    timer.counters[std::string("% ") + name_of(part)] = 100 * timers.seconds(part) / seconds;
  }
}

/// The number of steps is fixed, so that every run computes the same.
template <int Dim>
void step(benchmark::State& timer, const char* file, int first_steps) {
  Sample<Dim> sample(load(file), first_steps);
  Engine engine{sample.world, sample.team, {}};
  double cells = 0;  // summed over the steps
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : timer) {
    cells += static_cast<double>(cells_with_matter(sample.state));
    advance(sample.state, sample.stepping, 1.0, engine);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const auto steps = static_cast<double>(timer.iterations());
  const Memory memory = memory_of(sample.state);
  timer.counters[rate_name] = benchmark::Counter(stages * cells * 1e-6, benchmark::Counter::kIsRate);
  timer.counters["cells"] = cells / steps;
  timer.counters["cut-cells"] = memory.cuts;
  timer.counters["bytes/cell"] = memory.arrays * steps / cells;
  timer.counters["bytes/cut-cell"] = memory.lists / memory.cuts;
  add_shares<Dim>(timer, engine.timers, wall.count());
}

template <int Dim>
void add(const char* name, const char* file, int first_steps, int measured) {
  benchmark::RegisterBenchmark(name, step<Dim>, file, first_steps)
      ->Iterations(measured)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void add_steps() {
  add<1>("step/1d/flyer", "cases/flyer_al_cu/case.toml", 50, 400);
  add<2>("step/2d/disc-planar", "bench/cases/disc_on_block.toml", 10, 40);
  add<2>("step/2d/taylor-axisymmetric", "bench/cases/taylor_bar.toml", 20, 200);
  add<3>("step/3d/bar", "bench/cases/bar_3d.toml", 4, 10);
}

}  // namespace recoil::bench
