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
    add("mass", u.mass);
    add_axes("momentum", u.momentum);
    add("kinetic", u.energy);
    add("internal", u.energy);
    add("volume", u.volume);
    add_axes("exchange.impulse", u.momentum);
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

template <int Dim>
void add_columns(std::vector<double>& row, double s, const BodyTotals<Dim>& body,
                 const Account<Dim>& exchange, const Account<Dim>& edges, const Drift& drift) {
  row.push_back(s * body.mass);
  add_vector(row, s, body.momentum);
  row.push_back(s * body.kinetic);
  row.push_back(s * body.internal());
  row.push_back(s * body.volume);
  add_vector(row, s, exchange.momentum);
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
    : rigid_(rigid), whole_(units.whole) {
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
  Account<Dim> from_rigid, edges;
  std::size_t line = 0;
  for (std::size_t m = 0; m < t.bodies.size(); ++m) {
    const Account<Dim> exchange = received(t, static_cast<int>(m));
    if (rigid_[m]) {
      accumulate(from_rigid, {-exchange.mass, -exchange.energy, -exchange.momentum});
      continue;
    }
    const BodyTotals<Dim>& b = t.bodies[m];
    add_columns(values_, whole_, b, exchange, t.edges[m], drifts[++line]);
    all.mass += b.mass, all.momentum += b.momentum, all.kinetic += b.kinetic, all.energy += b.energy;
    all.volume += b.volume;
    accumulate(edges, t.edges[m]);
  }
  add_columns(values_, whole_, all, from_rigid, edges, drifts[0]);
  file_->row(values_);
}

template class History<1>;
template class History<2>;
template class History<3>;

}  // namespace recoil
