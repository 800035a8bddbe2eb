#include "record/field_dump.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/closest.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"
#include "dynamics/primitives.hpp"
#include "gauge/contact_fields.hpp"
#include "gauge/point_state.hpp"
#include "parallel/archive.hpp"
#include "record/rigid_places.hpp"

namespace recoil {

namespace {

constexpr double near_surface = 2;  // dx

/// What a dump holds of one cell, apart from the floats that follow it: variables, then phi of all bodies.
template <int Dim>
struct CellHead {
  Index<Dim> cell{};
  std::int32_t level = 0;
  std::int32_t body = -1;
  std::uint32_t contact = 0;
};

/// Those whose names are wanted, all where none is named; the part of each cell that is full always.
std::vector<FieldVariable> chosen(const std::vector<std::string>& wanted) {
  std::vector<FieldVariable> variables;
  for (const FieldVariable& v : field_variables()) {
    const bool always = std::string_view(v.name) == "volume-fraction";
    if (always || wanted.empty() || std::find(wanted.begin(), wanted.end(), v.name) != wanted.end())
      variables.push_back(v);
  }
  return variables;
}

int floats_of(const std::vector<FieldVariable>& variables) {
  int n = 0;
  for (const FieldVariable& v : variables) n += v.components;
  return n;
}

/// Places of the stresses of PointState in the order xx, yy, zz, xy, yz, xz; -1: zero.
template <int Dim>
constexpr std::array<int, 6> stress_order() {
  if constexpr (Dim == 1) return {0, 1, 2, -1, -1, -1};
  if constexpr (Dim == 2) return {0, 1, 3, 2, -1, -1};
  return {0, 1, 5, 2, 4, 3};
}

template <int Dim>
void write_state(const FieldVariable& v, const PointState<Dim>& p, float* to) {
  const std::string_view name = v.name;
  const auto put = [&](double x) { *to++ = static_cast<float>(x); };
  if (name == "pressure") put(p.pressure * 1e-9);
  if (name == "velocity")
    for (int d = 0; d < 3; ++d) put(d < Dim ? p.velocity[d < Dim ? d : 0] : 0);
  if (name == "density") put(p.density);
  if (name == "plastic-strain") put(p.plastic_strain);
  if (name == "temperature") put(p.temperature);
  if (name == "molten") put(p.molten);
  if (name == "damage") put(p.damage);
  if (name == "void-fraction")
    put(p.distension > 1 ? 1 - (1 - p.void_fraction) / p.distension : p.void_fraction);
  if (name == "stress")
    for (const int c : stress_order<Dim>()) put(c < 0 ? 0 : p.stress[c] * 1e-9);
  if (name == "von-mises") put(p.von_mises * 1e-9);
}

/// Whether the surface of a body runs through a cell; before the first step nothing is cut yet.
template <int Dim>
bool is_surface(const BodyBlock<Dim>& b, std::size_t k, double dx) {
  return b.geometry.index.empty() ? std::abs(b.phi[k]) < 0.5 * dx : b.geometry.index[k] >= 0;
}

void write_contact(const FieldVariable& v, const SurfaceContact& c, float* to) {
  const std::string_view name = v.name;
  if (name == "contact-state") *to = static_cast<float>(c.state);
  if (name == "gap") *to = static_cast<float>(c.gap * 1e3);
  if (name == "contact-traction") *to = static_cast<float>(c.traction * 1e-9);
}

/// One cell of one block in the making.
template <int Dim>
struct CellView {
  const State<Dim>& state;
  int slot;
  Index<Dim> i;   // global
  std::size_t k;  // in the layout
  double full;

  double volume(const Body<Dim>& body) const {
    return body.rigid || !body.present(slot) ? 0 : body.at(slot).volume[k];
  }
  /// Signed distance, cut off; where a body keeps none, it is far outside of it or deep inside a rigid one.
  double phi(const Body<Dim>& body) const {
    const double far = far_cells * state.grid().dx;
    if (body.present(slot)) return std::clamp(body.at(slot).phi[k], -far, far);
    if (!body.rigid) return far;
    return std::clamp(distance_at(*body.rigid, pose_after(*body.rigid, 0), state.grid(slot).centre(i)), -far,
                      far);
  }
  bool shown() const {
    for (const Body<Dim>& body : state.bodies)
      if (volume(body) > 0 || (body.present(slot) && std::abs(phi(body)) < near_surface * state.grid().dx))
        return true;
    return false;
  }
};

template <int Dim>
void pack_cell(const CellView<Dim>& c, const std::vector<FieldVariable>& variables,
               const std::vector<std::uint32_t>& touched, const Fragments<Dim>* fragments,
               std::vector<float>& floats, parallel::Bytes& out) {
  const auto& bodies = c.state.bodies;
  CellHead<Dim> head{c.i, c.state.mesh.block(c.slot).level};
  double most = 0, all = 0;
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    const double v = c.volume(bodies[m]);
    all += v;
    if (v > most) most = v, head.body = static_cast<std::int32_t>(m);
  }
  std::fill(floats.begin(), floats.end(), static_cast<float>(nothing));
  float* at = floats.data();
  const Body<Dim>* body = head.body < 0 ? nullptr : &bodies[head.body];
  bool good = false;
  PointState<Dim> state;
  if (body != nullptr) {
    head.contact = body->at(c.slot).contact[c.k];
    const Contents<Dim> q = contents_of(body->at(c.slot), static_cast<int>(c.k));
    good = most >= shown_fill * c.full && q[0] > 0;
    if (good) state = point_state(*body, q, most);
  }
  const bool surface = body != nullptr && is_surface(body->at(c.slot), c.k, c.state.grid().dx);
  SurfaceContact contact;
  if (surface)
    contact = surface_contact(c.state, c.slot, head.body, static_cast<int>(c.k), touched[head.body]);
  for (const FieldVariable& v : variables) {
    if (surface) write_contact(v, contact, at);
    if (std::string_view(v.name) == "volume-fraction")
      *at = static_cast<float>(all / c.full);
    else if (std::string_view(v.name) == "level")
      *at = static_cast<float>(head.level);
    else if (std::string_view(v.name) == "fragment" && body != nullptr && fragments != nullptr)
      *at = static_cast<float>(1 + fragments->at(head.body, c.slot, static_cast<int>(c.k)));
    else if (good)
      write_state(v, state, at);
    at += v.components;
  }
  for (const Body<Dim>& b : bodies) *at++ = static_cast<float>(c.phi(b));
  parallel::pack(out, head);
  parallel::pack(out, floats.data(), floats.size());
}

template <int Dim>
parallel::Bytes pack_blocks(const State<Dim>& state, const std::vector<FieldVariable>& variables,
                            const std::vector<std::uint32_t>& touched, const Fragments<Dim>* fragments) {
  parallel::Bytes out;
  std::vector<float> floats(static_cast<std::size_t>(floats_of(variables)) + state.bodies.size());
  const Box<Dim> layout = state.grid().layout();
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const Box<Dim> cells = state.mesh.block(slot).cells;
    const bool any = std::any_of(state.bodies.begin(), state.bodies.end(),
                                 [&](const Body<Dim>& body) { return body.present(slot); });
    if (!any) continue;
    for_each(cells, [&](const Index<Dim>& i) {
      const CellView<Dim> c{state, slot, i, static_cast<std::size_t>(layout.at(i - cells.lo)),
                            state.grid(slot).full_volume(i)};
      if (c.shown()) pack_cell(c, variables, touched, fragments, floats, out);
    });
  }
  return out;
}

/// Corners follow from whole numbers alone, so that neighbours have the same ones to the bit.
template <int Dim>
void add_cell(UnstructuredGrid& grid, const Grid<Dim>& cells, const Index<Dim>& i) {
  double lower[3] = {0, 0, 0}, upper[3] = {0, 0, 0};
  for (int d = 0; d < Dim; ++d) {
    lower[d] = cells.origin[d] + i[d] * cells.dx;
    upper[d] = cells.origin[d] + (i[d] + 1) * cells.dx;
  }
  add_box_cell(grid, Dim, lower, upper);
}

/// Room for the cells of a dump, so that no array is copied while it grows.
template <int Dim>
void reserve(UnstructuredGrid& grid, std::size_t cells) {
  const std::size_t corners = std::size_t{1} << Dim;
  grid.points.reserve(3 * corners * cells);
  grid.connectivity.reserve(corners * cells);
  grid.offsets.reserve(cells + 1);
  grid.types.reserve(cells);
}

/// The grid of what pack_blocks() has packed.
template <int Dim>
UnstructuredGrid unpack_grid(const State<Dim>& state, const std::vector<parallel::Bytes>& all,
                             const std::vector<FieldVariable>& variables) {
  UnstructuredGrid grid;
  const std::size_t bodies = state.bodies.size();
  std::vector<std::vector<float>> columns(variables.size() + bodies);
  std::vector<std::int32_t> body, contact;
  std::vector<float> floats(static_cast<std::size_t>(floats_of(variables)) + bodies);
  std::size_t packed = 0;
  for (const auto& bytes : all) packed += bytes.size();
  const std::size_t cells = packed / (sizeof(CellHead<Dim>) + floats.size() * sizeof(float));
  reserve<Dim>(grid, cells);
  body.reserve(cells), contact.reserve(cells);
  for (std::size_t c = 0; c < columns.size(); ++c)
    columns[c].reserve(cells * static_cast<std::size_t>(c < variables.size() ? variables[c].components : 1));
  for (const auto& bytes : all) {
    parallel::Unpacker reader(bytes);
    while (!reader.empty()) {
      const auto head = reader.read<CellHead<Dim>>();
      reader.read(floats.data(), floats.size());
      add_cell(grid, state.mesh.level_grid(head.level), head.cell);
      body.push_back(head.body);
      contact.push_back(static_cast<std::int32_t>(head.contact));
      const float* from = floats.data();
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const int n = c < variables.size() ? variables[c].components : 1;
        columns[c].insert(columns[c].end(), from, from + n);
        from += n;
      }
    }
  }
  merge_points(grid);
  for (std::size_t c = 0; c < variables.size(); ++c)
    grid.cell_arrays.push_back({variables[c].array, variables[c].components, std::move(columns[c])});
  grid.cell_arrays.push_back({"body", 1, std::move(body)});
  grid.cell_arrays.push_back({"contact", 1, std::move(contact)});
  for (std::size_t m = 0; m < bodies; ++m)
    grid.cell_arrays.push_back(
        {"level_set_" + state.bodies[m].name + "_m", 1, std::move(columns[variables.size() + m])});
  grid.whole_arrays = rigid_arrays(rigid_places(state));
  return grid;
}

}  // namespace

const std::vector<FieldVariable>& field_variables() {
  static const std::vector<FieldVariable> all{
      {"pressure", "pressure_GPa", "pressure [GPa]", 1, true},
      {"velocity", "velocity_m_per_s", "velocity [m/s]", 3, false},
      {"density", "density_kg_per_m3", "density [kg/m\u00b3]", 1, false},
      {"plastic-strain", "plastic_strain", "plastic strain", 1, false},
      {"temperature", "temperature_K", "temperature [K]", 1, false},
      {"molten", "molten", "molten part", 1, false},
      {"damage", "damage", "damage: 1 failed", 1, false},
      {"void-fraction", "void_fraction", "void fraction", 1, false},
      {"stress", "stress_GPa", "stress [GPa]", 6, true},
      {"von-mises", "von_mises_GPa", "von Mises stress [GPa]", 1, false},
      {"volume-fraction", "volume_fraction", "volume fraction", 1, false},
      {"fragment", "fragment", "fragment: number in fragments.csv", 1, false},
      {"level", "level", "level of the cells: 0 the finest", 1, false},
      {"contact-state", "contact_state", "contact: 0 free, 1 touching, 2 slipping, 3 opened", 1, false},
      {"gap", "gap_mm", "gap [mm]", 1, true},
      {"contact-traction", "contact_traction_GPa", "contact traction [GPa]", 1, true}};
  return all;
}

template <int Dim>
double bytes_of_dumped_cell(const std::vector<std::string>& variables, std::size_t bodies) {
  constexpr double corners = 1 << Dim, number = sizeof(double);
  const double floats =
      sizeof(float) * (static_cast<double>(floats_of(chosen(variables))) + static_cast<double>(bodies));
  const double packed = sizeof(CellHead<Dim>) + floats;
  const double grid = corners * (3 + 1) * number + number + 1, arrays = floats + 2 * sizeof(std::int32_t);
  // A point for about each cell: its entry in a table by place, two places of that table, itself.
  const double merged = 64 + 2 * number + 3 * number;
  return packed + grid + arrays + merged;
}

template <int Dim>
UnstructuredGrid gather_fields(const State<Dim>& state, const parallel::World& world,
                               const std::vector<FieldVariable>& variables, const Fragments<Dim>* fragments) {
  const auto all = world.gather(pack_blocks(state, variables, have_touched(state, world), fragments));
  return world.rank() == 0 ? unpack_grid(state, all, variables) : UnstructuredGrid{};
}

template <int Dim>
UnstructuredGrid own_fields(const State<Dim>& state, const std::vector<FieldVariable>& variables) {
  const std::vector<std::uint32_t> touched(state.bodies.size(), 0U);
  return unpack_grid(state, {pack_blocks<Dim>(state, variables, touched, nullptr)}, variables);
}

template <int Dim>
FieldDump<Dim>::FieldDump(std::filesystem::path folder, std::string name,
                          const std::vector<std::string>& variables)
    : folder_(std::move(folder)), name_(std::move(name)) {
  std::vector<std::string> known;
  for (const FieldVariable& v : field_variables()) known.emplace_back(v.name);
  for (const std::string& wanted : variables) {
    if (std::find(known.begin(), known.end(), wanted) != known.end()) continue;
    const std::string near = did_you_mean(wanted, known);
    throw InputError(fmt::format("error: output.fields.variables: there is no field '{}'\n   = help: {}",
                                 wanted,
                                 !near.empty() ? near : fmt::format("there are {}", fmt::join(known, ", "))));
  }
  variables_ = chosen(variables);
}

template <int Dim>
void FieldDump<Dim>::write(const State<Dim>& state, const parallel::World& world,
                           const Fragments<Dim>* fragments) {
  const UnstructuredGrid grid = gather_fields(state, world, variables_, fragments);
  const std::string file = fmt::format("{}_{:06}.hdf", name_, series_.size());
  series_.push_back({file, state.time});
  if (world.rank() != 0) return;
  write_vtkhdf(folder_ / file, grid, state.time);
  write_series(folder_ / (name_ + ".hdf.series"), series_);
}

template <int Dim>
void FieldDump<Dim>::pack(parallel::Bytes& bytes) const {
  parallel::ArchiveWriter archive(bytes);
  std::vector<std::pair<std::string, double>> written;
  for (const SeriesEntry& e : series_) written.emplace_back(e.name, e.time_s);
  archive(written);
}

template <int Dim>
void FieldDump<Dim>::unpack(parallel::Unpacker& from, bool removes) {
  parallel::ArchiveReader archive(from);
  std::vector<std::pair<std::string, double>> written;
  archive(written);
  series_.clear();
  for (const auto& [file, time] : written) series_.push_back({file, time});
  if (!removes) return;
  std::error_code ignored;
  for (std::size_t n = series_.size();; ++n)
    if (!std::filesystem::remove(folder_ / fmt::format("{}_{:06}.hdf", name_, n), ignored)) break;
  write_series(folder_ / (name_ + ".hdf.series"), series_);
}

#define RECOIL_INSTANTIATE(Dim)                                                                           \
  template double bytes_of_dumped_cell<Dim>(const std::vector<std::string>&, std::size_t);                \
  template class FieldDump<Dim>;                                                                          \
  template UnstructuredGrid gather_fields<Dim>(const State<Dim>&, const parallel::World&,                 \
                                               const std::vector<FieldVariable>&, const Fragments<Dim>*); \
  template UnstructuredGrid own_fields<Dim>(const State<Dim>&, const std::vector<FieldVariable>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
