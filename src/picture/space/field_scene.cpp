#include "picture/space/field_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/nothing.hpp"
#include "picture/field_plane.hpp"
#include "picture/field_scalar.hpp"

namespace recoil {

namespace {

constexpr double far_cells = 2;  // a dump has all cells that are nearer to a surface

}  // namespace

FieldScene::FieldScene(const VtkhdfFile& dump, const std::string& field, const RunUnits& units,
                       const std::vector<std::string>& bodies)
    : cells_(dump.grid) {
  const FieldScalar wanted = find_scalar(field, units);
  values_ = values_of(dump.grid, wanted);
  label_ = field == "contact-state" ? "contact" : wanted.label;
  signed_ = wanted.signed_values;
  std::vector<std::string> names, solid;
  for (BodyField& body : bodies_of(dump.grid)) {
    names.push_back(body.name);
    if (!holds_matter(dump.grid, body.level_set)) continue;
    solid.push_back(body.name);
    if (bodies.empty() || std::ranges::find(bodies, body.name) != bodies.end())
      bodies_.push_back({static_cast<int>(names.size()) - 1, std::move(body.level_set)});
  }
  for (const std::string& body : bodies)
    if (std::ranges::find(solid, body) == solid.end())
      throw InputError(fmt::format("there is no deformable body '{}' at that time\n   = help: there are {}",
                                   body, fmt::join(solid, ", ")));
  const std::vector<double> own = as_doubles(find_array(dump.grid, "body").values);
  nearest_.assign(values_.size(), std::numeric_limits<double>::infinity());
  owner_.assign(values_.size(), -1);
  for (std::size_t m = 0; m < bodies_.size(); ++m)
    for (std::size_t k = 0; k < values_.size(); ++k) {
      nearest_[k] = std::min(nearest_[k], bodies_[m].level_set[k]);
      if (static_cast<int>(std::lround(own[k])) == bodies_[m].number) owner_[k] = static_cast<int>(m);
    }
  std::set<double> seen;
  for (const double v : values_)
    if ((field == "contact" || field == "fragment") && !std::isnan(v)) seen.insert(v);
  categories_ = categories_of(field, names, seen);
}

double FieldScene::distance(const Vec<3>& x) const {
  const int own = cells_.at(x);
  const double h = cells_.finest();
  if (own < 0) return far_cells * h;
  const double phi = nearest_[static_cast<std::size_t>(own)], width = cells_.width(own);
  if (std::abs(phi) > 2 * width) return phi > 0 ? phi - 0.9 * width : phi + 0.9 * width;
  const CellLookup::Corners c = cells_.around(x);
  double sum = 0;
  for (std::size_t n = 0; n < 8; ++n)
    sum += c.weight[n] *
           (c.cell[n] < 0 ? far_cells * h : std::min(nearest_[static_cast<std::size_t>(c.cell[n])], 8 * h));
  return sum;
}

double FieldScene::level_set(const Vec<3>& x, int body) const {
  const CellLookup::Corners c = cells_.around(x);
  double sum = 0, weight = 0;
  for (std::size_t n = 0; n < 8; ++n) {
    if (c.cell[n] < 0) continue;
    sum +=
        c.weight[n] * bodies_[static_cast<std::size_t>(body)].level_set[static_cast<std::size_t>(c.cell[n])];
    weight += c.weight[n];
  }
  return weight > 0 ? sum / weight : nothing;
}

int FieldScene::body(const Vec<3>& x) const {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int m = 0; m < bodies(); ++m)
    if (const double phi = level_set(x, m); phi < least) least = phi, best = m;
  return best;
}

bool FieldScene::counts(int cell, int body) const {
  return cell >= 0 && owner_[static_cast<std::size_t>(cell)] == body &&
         !std::isnan(values_[static_cast<std::size_t>(cell)]);
}

double FieldScene::value(const Vec<3>& x, int body) const {
  const CellLookup::Corners c = cells_.around(x);
  double sum = 0, weight = 0, most = -1, main = nothing;
  for (std::size_t n = 0; n < 8; ++n) {
    if (!counts(c.cell[n], body)) continue;
    const double v = values_[static_cast<std::size_t>(c.cell[n])];
    sum += c.weight[n] * v;
    weight += c.weight[n];
    if (c.weight[n] > most) most = c.weight[n], main = v;
  }
  if (weight > 1e-6) return categories_.empty() ? sum / weight : main;
  // Slivers have no state of their own: the nearest cell that has one.
  const double h = cells_.finest();
  double best = nothing, least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 125; ++n) {
    const int i = n % 5 - 2, j = n / 5 % 5 - 2, k = n / 25 - 2;
    const Vec<3> away{{1.0 * i, 1.0 * j, 1.0 * k}};
    const int cell = cells_.at(x + away * h);
    if (dot(away, away) < least && counts(cell, body))
      least = dot(away, away), best = values_[static_cast<std::size_t>(cell)];
  }
  return best;
}

}  // namespace recoil
