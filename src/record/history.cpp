#include "record/history.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace recoil {

namespace {

std::vector<std::string> columns_for(const std::vector<std::string>& names, const RunUnits& u) {
  std::vector<std::string> all{"time [us]"};
  for (const std::string& name : names) {
    const auto add = [&](const std::string& what, const std::string& unit) {
      all.push_back(fmt::format("{}.{} [{}]", name, what, unit));
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
  Account<Dim> exchange, edges;
  Vec<3> moment;
};

template <int Dim>
void add_columns(std::vector<double>& row, double s, std::size_t turns, const BodyTotals<Dim>& body,
                 const Passed<Dim>& passed, const Drift& drift) {
  const auto& [exchange, edges, moment] = passed;
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
                      const std::vector<bool>& rigid, const RunUnits& units, CsvMode mode)
    : rigid_(rigid), whole_(units.whole), turns_(units.turns.size()) {
  std::vector<std::string> shown;
  for (std::size_t m = 0; m < names.size(); ++m)
    if (!rigid[m]) shown.push_back(names[m]);
  shown.push_back("total");
  file_.emplace(path, columns_for(shown, units), std::vector<std::string>{}, mode);
}

template <int Dim>
void History<Dim>::row(const Totals<Dim>& t, const std::vector<Drift>& drifts) {
  values_.assign(1, t.time * 1e6);
  BodyTotals<Dim> all;
  Passed<Dim> passed;  // from rigid bodies, through the edges
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
    add_columns(values_, whole_, turns_, b, {exchange, t.edges[m], moment}, drifts[++line]);
    all.mass += b.mass, all.momentum += b.momentum, all.kinetic += b.kinetic, all.energy += b.energy;
    all.volume += b.volume, all.angular_momentum += b.angular_momentum;
    accumulate(passed.edges, t.edges[m]);
  }
  add_columns(values_, whole_, turns_, all, passed, drifts[0]);
  file_->row(values_);
}

template class History<1>;
template class History<2>;
template class History<3>;

}  // namespace recoil
