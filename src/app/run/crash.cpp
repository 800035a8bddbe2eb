#include "app/run/crash.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <exception>

#include "app/commands.hpp"
#include "app/plot/field_plotter.hpp"
#include "app/run/checkpoint_folder.hpp"
#include "config/geometry.hpp"
#include "core/build_info.hpp"
#include "field/components.hpp"
#include "format/json_files.hpp"
#include "format/vtkhdf.hpp"
#include "picture/canvas.hpp"
#include "state/places.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

constexpr int listed_around = 2, drawn_around = 20;  // cells on each side of the place

std::string in_mm(const auto& x) {
  std::string text;
  for (const double c : x) text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", c * 1e3);
  return "(" + text + ") mm";
}

/// One fragment as its contents have it: also where no equation of state admits it.
template <int Dim>
std::string fragment_line(const BodyBlock<Dim>& b, std::size_t k, const Vec<Dim>& x, double full) {
  using C = Components<Dim>;
  const std::size_t n = b.volume.size();
  const double mass = b.contents[k], volume = b.volume[k];
  std::string velocity;
  double kinetic = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    const double u = b.contents[(C::u + d) * n + k] / mass;
    velocity += fmt::format("{}{:.6g}", d > 0 ? ", " : "", u);
    kinetic += 0.5 * u * u;
  }
  return fmt::format("  {}: {:.4g} of a cell, {:.6g} kg/m3, ({}) m/s, {:.6g} J/kg\n", in_mm(x.c),
                     volume / full, mass / volume, velocity, b.contents[C::energy * n + k] / mass - kinetic);
}

/// The fragments in the cells around a place, as far as this process holds them.
template <int Dim>
std::string states_around(const State<Dim>& state, const std::vector<double>& place) {
  Vec<Dim> x;
  for (int d = 0; d < Dim; ++d) x[d] = place[static_cast<std::size_t>(d)];
  std::string text;
  for (const Body<Dim>& body : state.bodies) {
    std::string lines;
    for (int slot = 0; slot < state.mesh.local(); ++slot) {
      if (body.rigid || !body.present(slot)) continue;
      const Grid<Dim>& grid = state.grid(slot);
      const Index<Dim> middle = grid.cell_of(x);
      Index<Dim> beyond = middle;
      for (int d = 0; d < Dim; ++d) ++beyond[d];
      const Box<Dim> around = Box<Dim>{middle, beyond}.grown(listed_around);
      for_each_place(state, slot, [&](const Index<Dim>& i, std::size_t k) {
        if (around.contains(i) && body.at(slot).volume[k] != 0)
          lines += fragment_line(body.at(slot), k, grid.centre(i), grid.full_volume(i));
      });
    }
    if (!lines.empty()) text += "states of " + body.name + " around\n" + lines;
  }
  return text;
}

template <int Dim>
std::string counted(const State<Dim>& state) {
  std::string text = "counted so far\n";
  Counters sum;
  for (const BlockLedger<Dim>& ledger : state.ledger) sum += ledger.counters;
  for (const auto& [name, count] : sum.list())
    if (*count != 0) text += fmt::format("  {} {}\n", name, *count);
  return text;
}

/// The commands that lead to the failure again.
std::string how_to_repeat(const fs::path& run, double last_step) {
  std::string text =
      fmt::format("to repeat\n  recoil run {} -o NEW_FOLDER\n", (run / "case.resolved.toml").string());
  const auto saved = checkpoints_of(run);
  if (saved.empty() || !(last_step > 0)) return text;
  return text + fmt::format(
                    "to repeat the last steps, with the fields of each (results after {} are replaced)\n"
                    "  recoil resume {} --from {} --set output.fields.every={:.3g}ns\n",
                    saved.back().filename().string(), run.string(), saved.back().filename().string(),
                    last_step * 1e9);
}

/// The pressure around a place, or all of it.
void draw(const fs::path& run, const config::Case& c, const ChosenDump& fields, const fs::path& picture,
          const std::vector<double>& place) {
  PlotOptions options;
  options.folder = run.string();
  options.what = {"pressure"};
  options.file = picture.string();
  const auto axes = config::axes_of(c.domain.geometry);
  const double reach = drawn_around * c.mesh.finest;
  for (std::size_t d = 0; d < 2 && place.size() > 1; ++d)
    options.window +=
        fmt::format("{}{}={:.9g}m..{:.9g}m", d > 0 ? "," : "", axes[d], place[d] - reach, place[d] + reach);
  if (place.size() > 2) options.slice = fmt::format("{}={:.9g}m", axes[2], place[2]);
  write_picture(picture, FieldPlotter(options).draw(fields));
}

}  // namespace

template <int Dim>
fs::path write_crash(const fs::path& run, const config::Case& c, const State<Dim>& state,
                     const Failure& failure, const std::function<UnstructuredGrid()>& fields, int rank) {
  const fs::path folder = run / "crash", name = folder / fmt::format("process_{}", rank);
  fs::create_directories(folder);
  std::string text = failure.text + '\n';
  if (!failure.body.empty()) text += "body " + failure.body + '\n';
  if (!failure.place.empty()) text += "place " + in_mm(failure.place) + '\n';
  text += fmt::format("time {:.9g} us, step {}, last dt {:.6g} ns, process {}\nrecoil {}\n", state.time * 1e6,
                      state.step, failure.last_step * 1e9, rank, build_info::full_version);
  if (!failure.place.empty()) text += states_around(state, failure.place);
  text += counted(state) + how_to_repeat(run, failure.last_step);
  write_atomically(name.string() + ".txt", text);  // before anything is tried that may fail as well
  try {
    write_vtkhdf(name.string() + ".hdf", fields(), state.time);
    draw(run, c, {name.string() + ".hdf", state.time}, name.string() + ".png", failure.place);
  } catch (const std::exception& e) {
    write_atomically(name.string() + ".txt", text + "no picture: " + e.what() + '\n');
  }
  return folder;
}

#define RECOIL_INSTANTIATE(Dim)                                                               \
  template fs::path write_crash<Dim>(const fs::path&, const config::Case&, const State<Dim>&, \
                                     const Failure&, const std::function<UnstructuredGrid()>&, int);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil::app
