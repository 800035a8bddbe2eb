#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>

#include "app/load_case.hpp"
#include "core/error.hpp"
#include "problem/start.hpp"
#include "state/fields.hpp"
#include "timestep/step.hpp"

namespace recoil::bench {

/// The lists of timed kernels; main() asks for them.
void add_block_updates();
void add_steps();

/// The counter that all of them report: 10^6 cells with matter times stages of a step, per second of this
/// thread.
inline constexpr const char* rate_name = "Mcell-stage/s";

/// A case of this source tree, named from its root. @throws InputError with all its mistakes.
inline app::LoadedCase load(const std::string& file) {
  app::LoadedCase loaded = app::load_case(std::string(RECOIL_SOURCE_DIR) + "/" + file, {});
  if (loaded.found.has_errors()) throw InputError(loaded.found.text());
  return loaded;
}

/// A case with some steps under way, on one thread.
template <int Dim>
struct Sample {
  parallel::World world;
  parallel::Team team{1};
  Stepping stepping;
  State<Dim> state;

  Sample(const app::LoadedCase& loaded, int first_steps)
      : stepping{.cfl = loaded.contents.time.cfl, .fixed_dt = {}},
        state(make_state<Dim>(loaded.contents, loaded.materials, world)) {
    Engine engine{world, team, {}};
    prepare_start(state, engine);
    for (int n = 0; n < first_steps; ++n) advance(state, stepping, 1.0, engine);
  }
};

/// Fragments that hold matter. A cell that two bodies share counts twice: each of them computes it.
template <int Dim>
std::int64_t cells_with_matter(const BodyBlock<Dim>& b) {
  return std::count_if(b.volume.begin(), b.volume.end(), [](double v) { return v > 0; });
}

template <int Dim>
std::int64_t cells_with_matter(const State<Dim>& state) {
  std::int64_t sum = 0;
  for (const Body<Dim>& body : state.bodies)
    for (const BodyBlock<Dim>& b : body.blocks) sum += cells_with_matter(b);
  return sum;
}

/// What a body's blocks hold: arrays over all cells of a block, and lists of cut cells and what belongs to
/// them.
struct Memory {
  double arrays = 0, lists = 0;  // bytes
  double cuts = 0;               // mid-step
};

template <int Dim>
Memory memory_of(const State<Dim>& state) {
  Memory m;
  for (const Body<Dim>& body : state.bodies)
    for (const BodyBlock<Dim>& b : body.blocks) {
      for_each_field<Dim>([&](const auto& d) {
        for_each_array(b.*d.member, [&](const auto& array) {
          using T = typename std::remove_cvref_t<decltype(array)>::value_type;
          const bool list = d.extent == Extent::cuts || std::is_same_v<T, CutCell<Dim>>;
          (list ? m.lists : m.arrays) += static_cast<double>(array.size() * sizeof(T));
        });
      });
      m.cuts += static_cast<double>(b.walls.size());
    }
  return m;
}

}  // namespace recoil::bench
