#include "gauge/gauges.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "state/contact_sums.hpp"

namespace recoil {

namespace {

using Kind = config::Gauge::Kind;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

template <int Dim>
int number_of(const State<Dim>& state, const std::string& name) {
  for (int m = 0; m < state.count(); ++m)
    if (state.bodies[m].name == name) return m;
  throw InternalError("internal error: a gauge of a body that does not exist: " + name);
}

/// The columns of one kind of gauge, in the order in which its readings are appended.
struct ColumnList {
  const RunUnits& units;
  std::vector<SeriesColumn> columns{};

  void one(const char* name, const std::string& unit, double to_unit = 1) {
    columns.push_back({name, unit, to_unit});
  }
  void axes(const std::string& name, const std::string& unit, double to_unit = 1) {
    for (const std::string& axis : units.axes) columns.push_back({name + "." + axis, unit, to_unit});
  }
};

/// Places of the sums over the cells in contact, then of the maxima.
template <int Dim>
struct At {
  static constexpr std::size_t area = 0, traction = 1, velocity = 2, gap = 3, power = 4, square = 5,
                               force = 6, shear = force + Dim, sums = shear + Dim, widest = sums,
                               deepest = sums + 1;
};

void contact_columns(ColumnList& list, const RunUnits& units, bool directed) {
  list.one("traction", "GPa", 1e-9);
  list.one("velocity", "m/s");
  list.one("area", units.area);
  for (const char* name : {"gap", "widest-gap", "deepest-overlap"}) list.one(name, "dx");
  list.axes("force", units.force);
  list.axes("impulse", units.momentum);
  list.one("work", units.energy);
  for (const char* name : {"normal-force", "tangential-force"}) list.one(name, units.force);
  for (const char* name : {"normal-impulse", "tangential-impulse"}) list.one(name, units.momentum);
  list.one("friction", "1");
  list.one("traction-scatter", "GPa", 1e-9);
  if (!directed) return;
  list.one("force.along", units.force);
  list.one("impulse.along", units.momentum);
}

std::vector<SeriesColumn> columns_of(Kind kind, const RunUnits& units, bool directed) {
  ColumnList list{units};
  switch (kind) {
    case Kind::surface_velocity:
      list.one("velocity", "m/s");
      list.axes("velocity", "m/s");
      list.axes("position", "mm", 1e3);
      break;
    case Kind::point:
      list.one("pressure", "GPa", 1e-9);
      list.axes("velocity", "m/s");
      for (const std::string& c : units.stresses) list.columns.push_back({"stress." + c, "GPa", 1e-9});
      list.one("density", "kg/m3");
      list.one("von-mises", "GPa", 1e-9);
      list.one("plastic-strain", "1");
      list.one("temperature", "K");
      break;
    case Kind::body:
      list.axes("velocity", "m/s");
      list.axes("position", "mm", 1e3);
      list.axes("lowest", "mm", 1e3);
      list.axes("highest", "mm", 1e3);
      list.one("mass", units.mass);
      list.one("kinetic", units.energy);
      list.one("internal", units.energy);
      list.one("plastic-strain", "1");
      break;
    case Kind::contact:
      contact_columns(list, units, directed);
      break;
    case Kind::bar:
      for (const char* name :
           {"length", "foot-radius", "radius", "volume-radius", "contact-radius", "lift-off"})
        list.one(name, "mm", 1e3);
      for (const char* name : {"plastic-strain", "axis-plastic-strain"}) list.one(name, "1");
      list.one("rim-lift-off", "mm", 1e3);
      break;
    case Kind::attitude:
      for (const char* name : {"inclination", "inclination.front-half", "inclination.front-third", "course"})
        list.one(name, "deg", 180 / std::numbers::pi);
      for (const char* name : {"speed", "head.x", "head.y"}) list.one(name, "m/s");
      list.one("spin", "rad/s");
      break;
    case Kind::peak_stress:
      list.one("stress", "GPa", 1e-9);
      list.one("time", "us", 1e6);
      break;
  }
  return list.columns;
}

template <int Dim>
void append(std::vector<double>& row, const Vec<Dim>& v) {
  row.insert(row.end(), v.c.begin(), v.c.end());
}

}  // namespace

template <int Dim>
Gauges<Dim>::Gauges(const config::Case& c, const State<Dim>& state, const parallel::World& world,
                    const std::filesystem::path& folder, OrderedSums& sums)
    : world_(world),
      units_(run_units(c.domain.geometry)),
      grid_(state.grid()),
      dx_(state.grid().dx),
      folder_(folder) {
  for (const config::Gauge& from : c.gauges) {
    Gauge g{.kind = from.kind,
            .due = Due(from.every),
            .point = {},
            .series = {},
            .file = {},
            .radius = from.radius,
            .direction = {},
            .part = {}};
    g.series.name = from.name;
    if (g.kind == Kind::contact) {
      const int a = number_of(state, from.pair[0]), b = number_of(state, from.pair[1]);
      g.body = std::min(a, b);
      g.turned = a > b;
      // Records follow the normal out of the lower-numbered body, or out of the deformable one of a rigid
      // pair.
      g.outward = g.turned != state.bodies[g.body].rigid.has_value() ? -1 : 1;
      g.pair = pair_number(g.body, std::max(a, b), state.count());
    } else {
      g.body = number_of(state, from.body);
    }
    declare(g, from, c.bodies, state, sums);
    if (world.rank() == 0) open(g, folder);
    gauges_.push_back(std::move(g));
  }
}

template <int Dim>
void Gauges<Dim>::declare(Gauge& g, const config::Gauge& from, const std::vector<config::Body>& bodies,
                          const State<Dim>& state, OrderedSums& sums) {
  g.point.body = g.body;
  for (int d = 0; d < Dim; ++d) {
    g.point.at[d] = from.at[d];
    g.direction[d] = from.direction[d];
  }
  if (g.kind == Kind::contact) g.item = sums.item(At<Dim>::sums, 2);
  if (g.kind == Kind::surface_velocity) g.item = sums.item(surface_sums<Dim>);
  if (g.kind == Kind::point) g.item = sums.item(point_sums<Dim>);
  if (g.kind == Kind::attitude) g.item = sums.item(attitude_sums);
  if (g.kind == Kind::bar) {
    g.item = bar_item(grid_, sums);
    g.bar.body = g.body;
    g.bar.wall = number_of(state, from.wall);
    const auto speed = [&](int m) {
      for (const config::Body& b : bodies)
        if (b.name == state.bodies[m].name) return b.velocity[Dim - 1];
      return 0.0;
    };
    g.bar.foot_low = !(speed(g.bar.body) > speed(g.bar.wall));
  }
  if (g.kind == Kind::peak_stress) {
    Vec<Dim> to;
    for (int d = 0; d < Dim; ++d) to[d] = from.to[d];
    g.line = stress_line(g.body, g.point.at, to, from.stations);
    g.item = line_items(g.line, sums);
    g.series.over = {"distance", "mm", 1e3};
    const double length = norm(to - g.point.at);
    for (int k = 1; k <= from.stations; ++k) g.series.time.push_back(length * k / from.stations);
  }
}

template <int Dim>
void Gauges<Dim>::open(Gauge& g, const std::filesystem::path& folder) {
  g.series.columns = columns_of(g.kind, units_, g.direction != Vec<Dim>{});
  g.series.values.assign(g.series.columns.size(), std::vector<double>(g.series.time.size(), nothing));
  std::vector<std::string> names{g.series.over.name + " [" + g.series.over.unit + "]"};
  for (const SeriesColumn& c : g.series.columns) names.push_back(c.name + " [" + c.unit + "]");
  g.file.emplace(folder / (g.series.name + ".csv"), names);
}

template <int Dim>
bool Gauges<Dim>::needs_totals(double time) const {
  for (const Gauge& g : gauges_)
    if (g.kind == Kind::body && g.due.at(time)) return true;
  return false;
}

namespace {

/// Adds the contacts of a pair in this rank's blocks. Forces act on the lower-numbered body.
template <int Dim>
void probe_contact(const State<Dim>& state, int pair, const Vec<Dim>& at, double radius, int item,
                   OrderedSums& sums) {
  using A = At<Dim>;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    std::span<double> row;
    for (const Contact<Dim>& c : state.contacts[slot]) {
      const int lower = std::min(c.first, c.second), higher = std::max(c.first, c.second);
      if (!counts(state, c) || pair_number(lower, higher, state.count()) != pair) continue;
      if (radius > 0 && norm(c.point - at) > radius) continue;
      if (row.empty()) row = sums.add(item, state.mesh.block(slot).order);
      const double sign = c.first == lower ? 1 : -1, gap = c.gap / state.grid().dx;
      const Vec<Dim> force = force_on_lower(c), shear = (sign * c.area) * c.shear;
      row[A::area] += c.area;
      row[A::traction] += c.traction * c.area;
      row[A::square] += c.traction * c.traction * c.area;
      row[A::velocity] += c.work_velocity * c.area;
      row[A::gap] += c.gap * c.area;
      row[A::power] += power_to_lower(c);
      for (int d = 0; d < Dim; ++d) {
        const auto k = static_cast<std::size_t>(d);
        row[A::force + k] += force[d];
        row[A::shear + k] += shear[d];
      }
      row[A::widest] = std::max(row[A::widest], gap);
      row[A::deepest] = std::max(row[A::deepest], -gap);
    }
  }
}

/// Root mean square over the area of the traction's departure from its mean.
template <int Dim>
double scatter(std::span<const double> now) {
  using A = At<Dim>;
  const double mean = now[A::traction] / now[A::area];
  return std::sqrt(std::max(0.0, now[A::square] / now[A::area] - mean * mean));
}

}  // namespace

template <int Dim>
void Gauges<Dim>::collect(const State<Dim>& state, OrderedSums& sums, bool at_rest, bool all) {
  for (Gauge& g : gauges_) {
    const bool followed = every_step(g) || g.kind == Kind::contact;
    if (!all && !followed && !g.due.at(state.time)) continue;
    if (g.kind == Kind::surface_velocity && at_rest) probe_surface_at_rest(state, g.point, g.item, sums);
    if (g.kind == Kind::surface_velocity && !at_rest) probe_surface(state, g.point, g.item, sums);
    if (g.kind == Kind::contact && !at_rest) probe_contact(state, g.pair, g.point.at, g.radius, g.item, sums);
    if (g.kind == Kind::point) probe_point(state, g.body, g.point.at, g.item, sums);
    if (g.kind == Kind::bar) collect_bar(state, g.bar, g.item, sums);
    if (g.kind == Kind::peak_stress) collect_line(state, g.line, g.item, sums);
    if (g.kind != Kind::attitude) continue;
    g.frame = find_frame(state, g.body, world_);
    collect_attitude(state, g.body, g.frame, g.item, sums);
  }
}

template <int Dim>
void Gauges<Dim>::read_surface_velocity(Gauge& g, double dt, const OrderedSums& sums) {
  const auto reading = read_surface<Dim>(sums.total(g.item));
  follow_surface(g.point, reading, dt);
  row_.push_back(reading.found ? dot(reading.velocity, reading.normal) : nothing);
  for (int d = 0; d < Dim; ++d) row_.push_back(reading.found ? reading.velocity[d] : nothing);
  append(row_, g.point.at);
}

template <int Dim>
void Gauges<Dim>::read_body(const BodyTotals<Dim>& b) {
  append(row_, b.momentum * (1 / b.mass));
  append(row_, b.place * (1 / b.mass));
  append(row_, b.lowest);
  append(row_, b.highest);
  row_.insert(row_.end(), {units_.whole * b.mass, units_.whole * b.kinetic, units_.whole * b.internal(),
                           b.plastic_strain});
}

template <int Dim>
double Gauges<Dim>::along(const Gauge& g, const std::array<double, 3>& v) const {
  double sum = 0;
  for (int d = 0; d < Dim; ++d) sum += g.direction[d] * v[d];
  return sum;
}

template <int Dim>
void Gauges<Dim>::follow_contact(Gauge& g, double dt, const OrderedSums& sums) {
  using A = At<Dim>;
  const std::span<const double> now = sums.total(g.item);
  double shear = 0;
  for (std::size_t d = 0; d < Dim; ++d) shear += now[A::shear + d] * now[A::shear + d];
  g.normal_impulse -= dt * now[A::traction];
  g.tangential_impulse += dt * std::sqrt(shear);
  PairSample& p = g.part;
  p.area = now[A::area], p.traction = now[A::traction], p.velocity = now[A::velocity], p.gap = now[A::gap];
  p.work += dt * now[A::power];
  for (std::size_t d = 0; d < Dim; ++d) {
    p.force[d] = now[A::force + d];
    p.impulse[d] += dt * p.force[d];
  }
  p.widest_gap = std::max(now[A::widest], 0.0);
  p.deepest_overlap = -std::max(now[A::deepest], 0.0);
}

template <int Dim>
void Gauges<Dim>::read_contact(const Gauge& g, const PairSample& p, const OrderedSums& sums) {
  using A = At<Dim>;
  const double sign = units_.whole * (g.turned ? -1 : 1);
  const bool touching = p.area > 0;
  row_.push_back(touching ? p.traction / p.area : 0);
  row_.push_back(touching ? g.outward * p.velocity / p.area : nothing);
  row_.push_back(units_.whole * p.area);
  row_.push_back(touching ? p.gap / p.area / dx_ : nothing);
  row_.push_back(touching ? p.widest_gap : nothing);
  row_.push_back(touching ? p.deepest_overlap : nothing);
  for (std::size_t d = 0; d < Dim; ++d) row_.push_back(sign * p.force[d]);
  for (std::size_t d = 0; d < Dim; ++d) row_.push_back(sign * p.impulse[d]);
  row_.push_back(sign * p.work);
  const std::span<const double> now = sums.total(g.item);
  double shear = 0;
  for (std::size_t d = 0; d < Dim; ++d) shear += now[A::shear + d] * now[A::shear + d];
  row_.insert(row_.end(), {units_.whole * -now[A::traction], units_.whole * std::sqrt(shear),
                           units_.whole * g.normal_impulse, units_.whole * g.tangential_impulse});
  row_.push_back(g.normal_impulse > 0 ? g.tangential_impulse / g.normal_impulse : nothing);
  row_.push_back(touching ? scatter<Dim>(now) : nothing);
  if (g.direction == Vec<Dim>{}) return;
  row_.push_back(sign * along(g, p.force));
  row_.push_back(sign * along(g, p.impulse));
}

template <int Dim>
void Gauges<Dim>::read_shape(Gauge& g, const OrderedSums& sums) {
  if (g.kind == Kind::bar) {
    const BarReading r = read_bar(grid_, g.bar, sums.total(g.item));
    row_ = {r.length,         r.foot_radius,         r.radius,
            r.volume_radius,  r.contact_radius,      r.lift_off,
            r.plastic_strain, r.axis_plastic_strain, r.rim_lift_off};
  } else {
    const Attitude a = read_attitude(g.frame, sums.total(g.item));
    row_ = {a.inclination, a.front_half, a.front_third, a.course, a.speed, a.head_x, a.head_y, a.spin};
  }
}

template <int Dim>
void Gauges<Dim>::read(Gauge& g, double time, double dt, const OrderedSums& sums,
                       const std::vector<PairSample>& pairs, const Totals<Dim>* totals) {
  row_.clear();
  switch (g.kind) {
    case Kind::surface_velocity:
      return read_surface_velocity(g, dt, sums);
    case Kind::body:
      return read_body(totals->bodies[g.body]);
    case Kind::contact:
      return read_contact(g, g.radius > 0 ? g.part : pairs[g.pair], sums);
    case Kind::bar:
    case Kind::attitude:
      return read_shape(g, sums);
    case Kind::peak_stress:
      return follow_line(g.line, time, dt, g.item, sums);
    case Kind::point: {
      const auto found = sums.total(g.item);
      const bool there = sums.any(g.item);
      // Sums keep the density first; people want the pressure first.
      const auto at = [&](std::size_t k) { row_.push_back(there ? found[k] : nothing); };
      at(1 + Dim);
      for (std::size_t d = 0; d < Dim; ++d) at(1 + d);
      for (std::size_t k = 0; k < PointState<Dim>::stresses; ++k) at(2 + Dim + k);
      at(0);
      for (std::size_t k = point_sums<Dim> - 3; k < point_sums<Dim>; ++k) at(k);
    }
  }
}

template <int Dim>
void Gauges<Dim>::write_line(Gauge& g) {
  std::vector<std::string> names = g.file->columns();
  g.file.emplace(folder_ / (g.series.name + ".csv"), std::move(names));
  for (std::size_t k = 0; k < g.series.time.size(); ++k)
    g.file->row({g.series.time[k] * g.series.over.to_unit,
                 g.line.stations[k].peak * g.series.columns[0].to_unit,
                 g.line.stations[k].time * g.series.columns[1].to_unit});
}

template <int Dim>
void Gauges<Dim>::write(Gauge& g, double time) {
  if (g.kind == Kind::peak_stress) return;
  if (!g.series.time.empty() && !(time > g.series.time.back())) return;
  g.series.time.push_back(time);
  written_.assign(1, time * 1e6);
  for (std::size_t c = 0; c < row_.size(); ++c) {
    g.series.values[c].push_back(row_[c]);
    written_.push_back(row_[c] * g.series.columns[c].to_unit + 0.0);  // no -0 in files
  }
  g.file->row(written_);
}

template <int Dim>
void Gauges<Dim>::share_points() {
  if (world_.size() == 1) return;
  parallel::Bytes bytes;
  for (const Gauge& g : gauges_)
    if (g.kind == Kind::surface_velocity)
      parallel::pack(bytes, g.point);
    else if (g.kind == Kind::peak_stress)
      parallel::pack(bytes, g.line.stations.data(), g.line.stations.size());
  if (bytes.empty()) return;
  world_.broadcast(bytes);
  parallel::Unpacker reader(bytes);
  for (Gauge& g : gauges_)
    if (g.kind == Kind::surface_velocity)
      g.point = reader.read<SurfacePoint<Dim>>();
    else if (g.kind == Kind::peak_stress)
      reader.read(g.line.stations.data(), g.line.stations.size());
}

template <int Dim>
void Gauges<Dim>::record(double time, double dt, const OrderedSums& sums,
                         const std::vector<PairSample>& pairs, const Totals<Dim>* totals, bool all) {
  for (Gauge& g : gauges_) {
    const bool due = all || g.due.at(time);
    if (world_.rank() == 0 && g.kind == Kind::contact) follow_contact(g, dt, sums);
    if (world_.rank() == 0 && (due || every_step(g))) {
      read(g, time, dt, sums, pairs, totals);
      if (due) write(g, time);
    }
    if (due) g.due.done(time);
  }
  share_points();
}

template <int Dim>
void Gauges<Dim>::flush() {
  for (Gauge& g : gauges_) {
    if (!g.file) continue;
    if (g.kind == Kind::peak_stress) write_line(g);
    g.file->flush();
  }
}

template <int Dim>
std::vector<TimeSeries> Gauges<Dim>::series() const {
  std::vector<TimeSeries> all;
  for (const Gauge& g : gauges_) {
    TimeSeries& s = all.emplace_back(g.series);
    for (std::size_t k = 0; k < g.line.stations.size(); ++k)
      s.values[0][k] = g.line.stations[k].peak, s.values[1][k] = g.line.stations[k].time;
  }
  return all;
}

template class Gauges<1>;
template class Gauges<2>;
template class Gauges<3>;

}  // namespace recoil
