#include "record/state_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <variant>

#include "dynamics/inadmissible.hpp"
#include "dynamics/primitives.hpp"
#include "gauge/point_state.hpp"
#include "material/eos/isentrope.hpp"
#include "parallel/archive.hpp"
#include "state/places.hpp"

namespace recoil {

namespace {

constexpr double whole_fill = 0.99;  // part of a cell from which on it counts as whole
constexpr double judged_fill =
    0.5;  // part of a cell, without voids, from which on strain and heat are judged
constexpr double no_strain = -1e-6;        // plastic strain below it is negative, beyond rounding
constexpr double no_heat = 1e-3;           // K below the start, by plastic work
constexpr double least_noise = 3;          // K below the isentrope: 5 MPa of noise at rest in copper is 0.7 K
constexpr double noise_of_stress = 0.005;  // of the stress of the impact, that the temperature may be off by
constexpr double noise_of_melting = 0.01;  // of the way to melting: strength hardly depends on so little
constexpr long recent_steps = 100;

/// Bulk modulus at rest [Pa].
double bulk_modulus(const Material& m) {
  const double c = bulk_sound_speed(m);
  return density(m) * c * c;
}

/// Melting temperature at rest density [K]; NaN where neither the material nor its strength model has one.
double melting_at_rest(const Material& m, const TemperatureLaw& law) {
  return law.melts() ? law.melting_at(solid_density(m)) : melting_temperature(m.strength, 1);
}

/// How far below the isentrope a temperature may lie [K]: as far as an error of the pressure takes it, of a
/// small part of the stress `rho c V/2` of an impact of like on like, or a small part of what is left to the
/// melting temperature, by which strength depends on it.
double noise_of(const Material& m, const TemperatureLaw& law, double closing_speed) {
  const double rho = density(m), error = noise_of_stress * 0.5 * rho * bulk_sound_speed(m) * closing_speed;
  const double per_heat = (pressure(m.eos, rho, 1e3) - pressure(m.eos, rho, 0)) / 1e3;  // dp/de [kg/m3]
  double noise = least_noise;
  if (const double melting = melting_at_rest(m, law); !std::isnan(melting))
    noise = std::max(noise, noise_of_melting * (melting - m.thermal.initial_temperature));
  return per_heat > 0 ? std::max(noise, error / (per_heat * m.thermal.specific_heat)) : noise;
}

/// What is solid of a fragment: all of it, but of failed matter.
template <int Dim>
double solid_part(const Body<Dim>& body, int slot, std::size_t k) {
  const BodyBlock<Dim>& b = body.at(slot);
  if (!(b.contents[k] > 0 && has_failed(b, k) && b.volume[k] > 0)) return 1;
  return 1 - point_state(body, contents_of(b, static_cast<int>(k)), b.volume[k]).void_fraction;
}

}  // namespace

double borne_tension(const Material& material, const config::Limits& limits) {
  if (can_fail(material.damage) || !has_tension(material.eos)) return infinite;
  const double spall = material.facts.spall_strength;
  return std::isnan(spall) ? limits.largest_tension * bulk_modulus(material) : limits.spall_strength * spall;
}

template <int Dim>
StateSurvey<Dim>::StateSurvey(const State<Dim>& state, const config::Limits& limits, double closing_speed,
                              const std::vector<double>& over_isentrope)
    : most_fill_(limits.volume_fraction), lines_(state.bodies.size()) {
  for (const Body<Dim>& body : state.bodies) {
    const Material& m = body.material;
    Bounds& b = bounds_.emplace_back();
    if (body.rigid) continue;
    b.tension = borne_tension(m, limits);
    b.noise = noise_of(m, body.temperature, closing_speed);
    if (!over_isentrope.empty()) b.start = over_isentrope[bounds_.size() - 1];
    b.softens = !std::isnan(melting_temperature(m.strength, 1));
    b.no_strength = !has_strength(m.strength);
  }
}

template <int Dim>
void StateSurvey<Dim>::merge(Finding& into, const Finding& more) {
  into.count += more.count;
  into.amount += more.amount;
  into.first = std::min(into.first, more.first);
  into.last = std::max(into.last, more.last);
  // The largest excess; among equal ones the earliest, then the first cell.
  if (more.excess < 0) return;
  const auto key = [](const Finding& f) { return std::tuple(-f.excess, f.time); };
  const auto before = [&] {
    for (int d = 0; d < Dim; ++d)
      if (more.cell[d] != into.cell[d]) return more.cell[d] < into.cell[d];
    return false;
  };
  if (into.excess < 0 || key(more) < key(into) || (key(more) == key(into) && before())) {
    into.excess = more.excess, into.worst = more.worst, into.bound = more.bound, into.time = more.time;
    into.cell = more.cell;
  }
}

template <int Dim>
void StateSurvey<Dim>::merge(Line& into, const Line& more) {
  into.cells += more.cells;
  into.cell_steps += more.cell_steps;  // whole numbers
  for (std::size_t k = 0; k < state_checks; ++k) merge(into.found[k], more.found[k]);
  into.averaged += more.averaged;
  into.averaged_first = std::min(into.averaged_first, more.averaged_first);
  // The place is that of the latest one, in the block with the most of them.
  const auto key = [](const Line& l) {
    return std::tuple(-l.averaged_last, -l.averaged_most, l.averaged_order);
  };
  if (more.averaged > 0 && (into.averaged == more.averaged || key(more) < key(into))) {
    into.averaged_place = more.averaged_place;
    into.averaged_most = more.averaged_most;
    into.averaged_order = more.averaged_order;
  }
  into.averaged_last = std::max(into.averaged_last, more.averaged_last);
}

/// Adds a state that is found. @param weight of the state, of the amount that is found.
template <int Dim>
void StateSurvey<Dim>::note(const Look& look, Line& line, StateCheck check, const Index<Dim>& cell,
                            const Excess& e) {
  if (e.excess <= 0) return;  // true for NaN as well: an error of its own
  Finding f;
  f.count = static_cast<std::int64_t>(look.steps);
  f.amount += look.steps * e.amount;
  f.first = f.last = f.time = look.state.time;
  f.excess = e.excess, f.worst = e.value, f.bound = e.bound;
  f.cell = look.state.mesh.finest_index(look.slot, cell);
  merge(line.found[static_cast<std::size_t>(check)], f);
}

template <int Dim>
void StateSurvey<Dim>::look_at_cell(const Look& look, int m, const Index<Dim>& cell, std::size_t k) const {
  const State<Dim>& state = look.state;
  Line& line = look.lines[m];
  const int slot = look.slot;
  const Body<Dim>& body = state.bodies[m];
  const BodyBlock<Dim>& b = body.at(slot);
  const double volume = b.volume[k], full = state.grid(slot).full_volume(cell), fill = volume / full;
  const auto found = [&](StateCheck check, const Excess& e) { note(look, line, check, cell, e); };
  if (fill < judged_fill) return;
  const PointState<Dim> p = point_state(body, contents_of(b, static_cast<int>(k)), volume);
  if (fill * (1 - p.void_fraction) < judged_fill) return;  // voids are no matter
  found(StateCheck::negative_strain, {no_strain - p.plastic_strain, p.plastic_strain, 0});
  const TemperatureLaw& law = body.temperature;
  const bool by_energy = law.thermal().rule == Thermal::Rule::energy;
  const double solid = p.density * p.distension / (1 - p.void_fraction);
  const double coldest =
      bounds_[m].start * (by_energy ? law.on_isentrope(solid) : law.thermal().initial_temperature);
  const double rho0 = density(body.material);
  if (!body.detonation) {  // temperatures of products are not known
    const double heating = p.unmelted - coldest,
                 capacity = b.contents[k] * law.thermal().specific_heat;  // J/K
    // Errors of a gas are a part of its temperature, whatever that is.
    const double hotter =
        is_gas(body.material.eos) ? std::max(1.0, coldest / law.thermal().initial_temperature) : 1;
    found(StateCheck::negative_heat,
          {-(by_energy ? hotter * bounds_[m].noise : no_heat) - heating, heating, 0, -heating * capacity});
  }
  if (fill < whole_fill) return;
  const DensityRange range = density_range(body.material.eos);
  const double least = range.least * rho0, most = range.most * rho0;
  const double sparse = p.damage >= failed_damage ? 0 : least - p.density;
  found(StateCheck::density,
        {std::max(sparse, p.density - most), p.density, p.density > rho0 ? most : least});
  const Bounds& bounds = bounds_[m];
  const double tension = largest_principal(p);
  found(StateCheck::tension, {tension - bounds.tension, tension, bounds.tension});
  // Matter that melts does so by the temperature that it has; where plastic work alone heats, its state is
  // held against that of its energy as well. A fluid has no strength to lose.
  if (!law.melts() && !bounds.softens) return;
  const double melting =
      law.melts() ? p.melts_at : melting_temperature(body.material.strength, p.compression);
  const double hot = by_energy ? p.unmelted : law.by_energy(p.density, p.thermal_energy);
  if (p.unmelted >= melting)
    found(StateCheck::molten, {p.unmelted - melting, p.temperature, melting});
  else
    found(bounds.no_strength ? StateCheck::molten : StateCheck::melting, {hot - melting, hot, melting});
}

template <int Dim>
void StateSurvey<Dim>::look_at_block(const Look& look) const {
  const State<Dim>& state = look.state;
  const int slot = look.slot;
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  std::vector<double> all(static_cast<std::size_t>(layout.size()), 0.0), most(all.size(), 0.0);
  std::vector<int> owner(all.size(), -1);
  for (int m = 0; m < state.count(); ++m) {
    const Body<Dim>& body = state.bodies[m];
    if (body.rigid || !body.present(slot)) continue;
    for_each(cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
      const double volume = body.at(slot).volume[k];
      if (volume == 0) return;
      ++look.lines[m].cells;
      if (volume > most[k]) most[k] = volume, owner[k] = m;
      all[k] += volume * solid_part(body, slot, k);
      if (volume > 0 && body.at(slot).contents[k] > 0) look_at_cell(look, m, i, k);
    });
  }
  for_each(cells, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    const double fill = all[k] / state.grid(slot).full_volume(i);
    if (fill > most_fill_)
      note(look, look.lines[owner[k]], StateCheck::overfilled, i,
           {fill - most_fill_, fill, most_fill_, fill - 1});
  });
}

template <int Dim>
void StateSurvey<Dim>::look(const State<Dim>& state, parallel::Team* team) {
  const int local = state.mesh.local();
  std::vector<std::vector<Line>> blocks(static_cast<std::size_t>(local),
                                        std::vector<Line>(state.bodies.size()));
  const auto steps = state.step - last_;
  const auto work = [&](int slot, int) {
    look_at_block({state, slot, static_cast<double>(steps), blocks[slot]});
  };
  if (team != nullptr && team->threads() > 1)
    team->run(local, work);
  else
    for (int slot = 0; slot < local; ++slot) work(slot, 0);
  last_ = state.step;
  for (Line& line : lines_) line.cells = 0;
  for (const auto& block : blocks)
    for (std::size_t m = 0; m < lines_.size(); ++m) {
      Line more = block[m];
      more.cell_steps = static_cast<double>(more.cells * steps);
      merge(lines_[m], more);
    }
}

template <int Dim>
double StateSurvey<Dim>::cell_steps() const {
  double all = 0;
  for (const Line& line : lines_) all += line.cell_steps;
  return all;
}

template <int Dim>
typename StateSurvey<Dim>::Recent StateSurvey<Dim>::recent(const State<Dim>& state,
                                                           const parallel::World& world) {
  std::array<std::int64_t, 2> sums{};
  for (const auto& ledger : state.ledger) sums[0] += ledger.counters.averaged_states;
  for (const Line& line : lines_) sums[1] += line.cells;
  world.sum(sums);
  marks_.push_back({state.step, sums[0]});
  while (marks_.size() > 1 && marks_[1].step <= state.step - recent_steps) marks_.erase(marks_.begin());
  const std::int64_t before = marks_.front().step <= state.step - recent_steps ? marks_.front().averaged : 0;
  return {sums[0] - before, static_cast<double>(sums[1] * recent_steps)};
}

template <int Dim>
std::vector<typename StateSurvey<Dim>::Line> StateSurvey<Dim>::own_lines(
    const State<Dim>& state, const AveragedStates* averaged) const {
  std::vector<Line> lines = lines_;
  if (averaged == nullptr || averaged->lines.empty()) return lines;
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (std::size_t m = 0; m < lines.size(); ++m) {
      const AveragedStates::Line& from = averaged->at(slot, m);
      if (from.count == 0) continue;
      Line more;
      more.averaged = more.averaged_most = from.count;
      more.averaged_first = from.first, more.averaged_last = from.last, more.averaged_place = from.place;
      more.averaged_order = state.mesh.block(slot).order;
      merge(lines[m], more);
    }
  return lines;
}

template <int Dim>
std::vector<BodyEvidence> StateSurvey<Dim>::told(const State<Dim>& state,
                                                 const std::vector<Line>& lines) const {
  std::vector<Line> judged = lines;  // fragments that other bodies have taken up count with their source
  for (std::size_t m = 0; m < lines.size(); ++m)
    if (const int source = state.bodies[m].fragments_of; source >= 0)
      merge(judged[static_cast<std::size_t>(source)], lines[m]);
  std::vector<BodyEvidence> all;
  for (std::size_t m = 0; m < lines.size(); ++m) {
    if (state.bodies[m].rigid || state.bodies[m].fragments_of >= 0) continue;
    const Line& line = judged[m];
    BodyEvidence& e = all.emplace_back();
    e.name = state.bodies[m].name;
    e.by_energy = state.bodies[m].material.thermal.rule == Thermal::Rule::energy;
    e.cell_steps = e.looked_at = line.cell_steps;
    e.averaged = line.averaged;
    e.averaged_first = line.averaged_first, e.averaged_last = line.averaged_last;
    e.averaged_place = line.averaged_place;
    for (std::size_t k = 0; k < state_checks; ++k) {
      const Finding& f = line.found[k];
      e.states[k] = {f.count, f.amount.value(), f.first, f.last, f.worst, f.bound, f.time, {}};
      const Vec<Dim> x = state.grid().centre(f.cell);
      for (int d = 0; d < Dim; ++d) e.states[k].place[d] = x[d];
    }
  }
  return all;
}

template <int Dim>
std::vector<BodyEvidence> StateSurvey<Dim>::own_evidence(const State<Dim>& state,
                                                         const AveragedStates* averaged) const {
  return told(state, own_lines(state, averaged));
}

template <int Dim>
std::vector<BodyEvidence> StateSurvey<Dim>::evidence(const State<Dim>& state, const AveragedStates* averaged,
                                                     const parallel::World& world) const {
  return told(state, gathered(own_lines(state, averaged), world));
}

template <int Dim>
std::vector<typename StateSurvey<Dim>::Line> StateSurvey<Dim>::gathered(std::vector<Line> lines,
                                                                        const parallel::World& world) {
  parallel::Bytes bytes;
  parallel::pack(bytes, lines.data(), lines.size());
  std::vector<Line> sums(lines.size());
  for (const parallel::Bytes& from : world.gather(bytes)) {
    parallel::Unpacker reader(from);
    reader.read(lines.data(), lines.size());
    for (std::size_t m = 0; m < lines.size(); ++m) merge(sums[m], lines[m]);
  }
  return sums;
}

template <int Dim>
void StateSurvey<Dim>::pack(const parallel::World& world, parallel::Bytes& bytes) const {
  const std::vector<Line> all = gathered(lines_, world);
  if (world.rank() != 0) return;
  parallel::ArchiveWriter archive(bytes);
  archive(all, last_, marks_);
}

template <int Dim>
void StateSurvey<Dim>::unpack(const parallel::World& world, parallel::Unpacker& from) {
  parallel::ArchiveReader archive(from);
  archive(lines_, last_, marks_);
  if (world.rank() != 0) lines_.assign(lines_.size(), {});
}

template class StateSurvey<1>;
template class StateSurvey<2>;
template class StateSurvey<3>;

}  // namespace recoil
