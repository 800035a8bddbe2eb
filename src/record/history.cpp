#include "record/history.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace recoil {

namespace {

/// A body in the table, and whether it has a load.
struct HistoryLine {
  std::string name;
  bool loaded = false;
};

std::vector<std::string> columns_for(const std::vector<HistoryLine>& lines, const RunUnits& u) {
  std::vector<std::string> all{"time [us]"};
  for (const HistoryLine& line : lines) {
    const auto add = [&](const std::string& what, const std::string& unit) {
      all.push_back(fmt::format("{}.{} [{}]", line.name, what, unit));
    };
    const auto add_axes = [&](const std::string& what, const std::string& unit) {
      for (const std::string& axis : u.axes) add(what + "." + axis, unit);
    };
    const auto add_turns = [&](const std::string& what) {
      for (const std::string& axis : u.turns) add(what + "." + axis, u.angular_momentum);
    };
    add("mass", u.mass);
    add_axes("momentum", u.momentum);
    add_turns("angular-momentum");
    add("kinetic", u.energy);
    add("internal", u.energy);
    add("volume", u.volume);
    add_axes("exchange.impulse", u.momentum);
    add_turns("exchange.moment");
    add("exchange.work", u.energy);
    add("edges.mass", u.mass);
    add_axes("edges.momentum", u.momentum);
    add("edges.energy", u.energy);
    if (line.loaded) {
      add_axes("load.impulse", u.momentum);
      add_turns("load.moment");
      add("load.work", u.energy);
    }
    for (const char* what : {"drift.mass", "drift.momentum", "drift.energy"}) add(what, "1");
  }
  return all;
}

template <int Dim>
void add_vector(std::vector<double>& row, double scale, const Vec<Dim>& v) {
  for (int d = 0; d < Dim; ++d) row.push_back(scale * v[d]);
}

/// Of vectors about the origin: the last components, as RunUnits::turns.
void add_turns(std::vector<double>& row, std::size_t turns, const Vec<3>& v) {
  row.insert(row.end(), v.c.end() - static_cast<std::ptrdiff_t>(turns), v.c.end());
}

/// What a body has received, or passed on.
template <int Dim>
struct Passed {
  Account<Dim> exchange, edges, load;
  Vec<3> moment, load_moment;
  bool loaded = false;
};

template <int Dim>
void add_columns(std::vector<double>& row, double s, std::size_t turns, const BodyTotals<Dim>& body,
                 const Passed<Dim>& passed, const Drift& drift) {
  const auto& [exchange, edges, load, moment, load_moment, loaded] = passed;
  row.push_back(s * body.mass);
  add_vector(row, s, body.momentum);
  add_turns(row, turns, body.angular_momentum);
  row.push_back(s * body.kinetic);
  row.push_back(s * body.internal());
  row.push_back(s * body.volume);
  add_vector(row, s, exchange.momentum);
  add_turns(row, turns, moment);
  row.push_back(s * exchange.energy);
  row.push_back(s * edges.mass);
  add_vector(row, s, edges.momentum);
  row.push_back(s * edges.energy);
  if (loaded) {
    add_vector(row, s, load.momentum);
    add_turns(row, turns, load_moment);
    row.push_back(s * load.energy);
  }
  row.insert(row.end(), {drift.mass, drift.momentum, drift.energy});
}

template <int Dim>
void accumulate(Account<Dim>& sum, const Account<Dim>& a) {
  sum.mass += a.mass;
  sum.energy += a.energy;
  sum.momentum += a.momentum;
}

}  // namespace

template <int Dim>
History<Dim>::History(const std::filesystem::path& path, const std::vector<std::string>& names,
                      const std::vector<bool>& rigid, const std::vector<bool>& loaded, const RunUnits& units,
                      CsvMode mode)
    : rigid_(rigid), loaded_(loaded), whole_(units.whole), turns_(units.turns.size()) {
  std::vector<HistoryLine> shown;
  for (std::size_t m = 0; m < names.size(); ++m)
    if (!rigid[m]) shown.push_back({names[m], loaded[m]});
  shown.push_back({"total", any_loaded()});
  file_.emplace(path, columns_for(shown, units), std::vector<std::string>{}, mode);
}

template <int Dim>
void History<Dim>::row(const Totals<Dim>& t, const std::vector<Drift>& drifts) {
  values_.assign(1, t.time * 1e6);
  BodyTotals<Dim> all;
  Passed<Dim> passed;  // from rigid bodies, through the edges, by loads
  passed.loaded = any_loaded();
  std::size_t line = 0;
  for (std::size_t m = 0; m < t.bodies.size(); ++m) {
    const Account<Dim> exchange = received(t, static_cast<int>(m));
    const Vec<3> moment = received_moment(t, static_cast<int>(m));
    if (rigid_[m]) {
      accumulate(passed.exchange, {-exchange.mass, -exchange.energy, -exchange.momentum});
      passed.moment -= moment;
      continue;
    }
    const BodyTotals<Dim>& b = t.bodies[m];
    add_columns(values_, whole_, turns_, b,
                {exchange, t.edges[m], t.loads[m], moment, t.load_moments[m], loaded_[m]}, drifts[++line]);
    all.mass += b.mass, all.momentum += b.momentum, all.kinetic += b.kinetic, all.energy += b.energy;
    all.volume += b.volume, all.angular_momentum += b.angular_momentum;
    accumulate(passed.edges, t.edges[m]);
    accumulate(passed.load, t.loads[m]);
    passed.load_moment += t.load_moments[m];
  }
  add_columns(values_, whole_, turns_, all, passed, drifts[0]);
  file_->row(values_);
}

template <int Dim>
std::vector<bool> loaded_bodies(const State<Dim>& state) {
  std::vector<bool> loaded(state.bodies.size(), false);
  for (const SurfaceLoad<Dim>& load : state.loads) loaded[static_cast<std::size_t>(load.body)] = true;
  return loaded;
}

template std::vector<bool> loaded_bodies<1>(const State<1>&);
template std::vector<bool> loaded_bodies<2>(const State<2>&);
template std::vector<bool> loaded_bodies<3>(const State<3>&);
template class History<1>;
template class History<2>;
template class History<3>;

}  // namespace recoil
