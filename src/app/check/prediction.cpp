#include "app/check/prediction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <variant>

#include "config/geometry.hpp"

namespace recoil::app {

namespace {

using config::Body;
using config::Case;
using config::endless;
using config::Extent;
using config::Geometry;

/// Whether a body has a pressure or a temperature of its own at the start.
bool starts_otherwise(const Body& body) { return body.pressure.value_or(0) != 0 || body.temperature; }

/// Predictions start from the state of rest: neither what detonates nor what starts otherwise is in it.
bool is_left_out(const Body& body) { return !body.detonation.points.empty() || starts_otherwise(body); }

/// Whether two bodies lie side by side over some width across `axis`.
bool beside(const Extent& a, const Extent& b, std::size_t axis, int dim) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
    if (d != axis && !(std::min(a.hi[d], b.hi[d]) > std::max(a.lo[d], b.lo[d]))) return false;
  return true;
}

/// How far the middle of what two bodies share is from its nearest free side: half of the least width, or all
/// of it from a plane of symmetry or an axis. Nowhere if it runs from one edge to the other and no edge is
/// open [m].
double half_width(const Extent& a, const Extent& b, std::size_t axis, const config::Domain& domain) {
  double least = endless;
  for (std::size_t d = 0; d < static_cast<std::size_t>(config::dimension(domain.geometry)); ++d) {
    if (d == axis) continue;
    const double lo = std::max({a.lo[d], b.lo[d], domain.lo[d]}),
                 hi = std::min({a.hi[d], b.hi[d], domain.hi[d]});
    const auto held = [&](std::size_t end, bool reaches) {
      return domain.boundary[d][end] != config::Boundary::outflow && reaches;
    };
    const bool low = held(0, lo <= domain.lo[d]), high = held(1, hi >= domain.hi[d]);
    if (low && high) continue;
    least = std::min(least, low || high ? hi - lo : 0.5 * (hi - lo));
  }
  return least;
}

/// Whether nothing lies between `from` and `to` along the axis over the width of `body`.
bool nothing_between(const std::vector<Extent>& all, std::size_t body, std::size_t axis, int dim, double from,
                     double to) {
  const double slack = 1e-9 * (1 + std::abs(from));
  for (std::size_t m = 0; m < all.size(); ++m)
    if (m != body && all[m].plain && beside(all[m], all[body], axis, dim) && all[m].lo[axis] < to + slack &&
        all[m].hi[axis] > from - slack)
      return false;
  return true;
}

/// Whether the ends of a plain shape along an axis are flat: of a cylinder in 3d only those along its own.
bool flat_along(const config::Shape& shape, std::size_t axis, Geometry geometry) {
  const auto* cylinder = std::get_if<config::Cylinder>(&shape.form);
  return !cylinder || geometry != Geometry::space || std::abs(cylinder->axis[axis]) > 0.5;
}

/// The pair whose face `low.hi` meets `high.lo`, if they close in.
std::optional<PlatePair> pair_along(const Case& c, const std::vector<Extent>& all, std::size_t low,
                                    std::size_t high, std::size_t axis) {
  const int dim = config::dimension(c.domain.geometry);
  const Extent &a = all[low], &b = all[high];
  if (!flat_along(c.bodies[low].shape, axis, c.domain.geometry) ||
      !flat_along(c.bodies[high].shape, axis, c.domain.geometry))
    return std::nullopt;
  const double gap = b.lo[axis] - a.hi[axis];
  const double closing = c.bodies[low].velocity[axis] - c.bodies[high].velocity[axis];
  if (!a.plain || !b.plain || !beside(a, b, axis, dim) || !(gap > -1e-9) || !std::isfinite(gap) ||
      !(closing > 0))
    return std::nullopt;
  for (std::size_t m = 0; m < all.size(); ++m)
    if (m != low && m != high && all[m].plain && beside(all[m], a, axis, dim) &&
        all[m].lo[axis] >= a.hi[axis] - 1e-9 && all[m].hi[axis] <= b.lo[axis] + 1e-9)
      return std::nullopt;
  const auto speed = [&](std::size_t m) { return std::abs(c.bodies[m].velocity[axis]); };
  const bool low_flies = speed(low) >= speed(high);
  PlatePair p;
  p.flyer = static_cast<int>(low_flies ? low : high);
  p.target = static_cast<int>(low_flies ? high : low);
  p.axis = static_cast<int>(axis);
  p.direction = low_flies ? 1 : -1;
  p.gap = std::max(gap, 0.0);
  p.half_width = half_width(a, b, axis, c.domain);
  p.closing = closing;
  const double low_thickness = a.hi[axis] - a.lo[axis], high_thickness = b.hi[axis] - b.lo[axis];
  const bool low_free =
      nothing_between(all, low, axis, dim, a.lo[axis], a.lo[axis]) && a.lo[axis] > c.domain.lo[axis];
  const bool high_free =
      nothing_between(all, high, axis, dim, b.hi[axis], b.hi[axis]) && b.hi[axis] < c.domain.hi[axis];
  p.flyer_thickness = low_flies ? low_thickness : high_thickness;
  p.target_thickness = low_flies ? high_thickness : low_thickness;
  p.flyer_rear_free = low_flies ? low_free : high_free;
  p.target_rear_free = low_flies ? high_free : low_free;
  return p;
}

/// The impact state; a rigid partner keeps its velocity and the whole difference falls to the other.
Impact match(const PlatePrediction& p, const Material& flyer, const Material& target) {
  if (!p.flyer_rigid && !p.target_rigid) return match_impact(flyer, target, p.pair.closing);
  Impact impact;
  if (p.target_rigid) {
    impact.flyer = shock_at_velocity(flyer, p.pair.closing);
    impact.stress = impact.flyer.stress;
  } else {
    impact.velocity = p.pair.closing;
    impact.target = shock_at_velocity(target, p.pair.closing);
    impact.stress = impact.target.stress;
  }
  return impact;
}

/// Time after impact at which the release from a rear face unloads the interface.
double whole_release(const ShockState& s, const Material& m, double thickness) {
  return s.plastic_strain > 0 || shear_modulus(m) == 0
             ? unloading_time(s, m, thickness)
             : thickness / s.shock_speed + thickness / release_head_speed(s, m);
}

double head_of_release(const ShockState& s, const Material& m, double thickness) {
  return thickness / s.shock_speed + thickness / release_head_speed(s, m);
}

void predict_parting(PlatePrediction& p, const Impact& impact, const Material& flyer,
                     const Material& target) {
  p.opens = endless;
  const bool leaves = p.target_rigid || (!p.flyer_rigid && flyer_leaves(impact, flyer, target));
  const bool stays = p.flyer_rigid || (!p.target_rigid && impact.flyer.stress > 0 &&
                                       impact.flyer.stress / impact.flyer.velocity >
                                           impact.target.stress / impact.target.velocity * (1 + 1e-9));
  if (leaves) {
    if (!p.pair.flyer_rear_free) return;
    p.parting = Parting::by_flyer_release;
    p.opens = p.contact + whole_release(impact.flyer, flyer, p.pair.flyer_thickness);
    // The target's own release has taken part of the stress by then, and less of the flyer's opens the
    // contact.
    p.opens_is_bound = p.pair.target_rear_free && !p.target_rigid &&
                       p.contact + head_of_release(impact.target, target, p.pair.target_thickness) < p.opens;
  } else if (!stays) {  // whichever rear unloads it first
    for (const auto& [is_free, shock, material, thickness] :
         {std::tuple(p.pair.flyer_rear_free, &impact.flyer, &flyer, p.pair.flyer_thickness),
          std::tuple(p.pair.target_rear_free, &impact.target, &target, p.pair.target_thickness)})
      if (is_free) p.opens = std::min(p.opens, p.contact + whole_release(*shock, *material, thickness));
    if (std::isfinite(p.opens)) p.parting = Parting::neutral;
  } else if (p.pair.target_rear_free && !p.target_rigid) {
    // Little stress is left by then: already the elastic head of the release opens the contact, and it runs
    // back through matter that is nearly at rest density.
    p.parting = Parting::by_target_release;
    p.opens = p.contact +
              p.pair.target_thickness * (1 / impact.target.shock_speed + 1 / longitudinal_speed(target));
  }
}

void predict_rear(PlatePrediction& p, const Impact& impact, const Material& flyer, const Material& target) {
  const double length = p.pair.target_thickness;
  const ShockState& s = impact.target;
  if (s.has_precursor) {
    p.precursor_arrival = p.contact + length / s.precursor_speed;
    p.precursor_surface_velocity = 2 * s.precursor_velocity;
  }
  p.shock_arrival = p.contact + length / s.shock_speed;
  p.plateau_surface_velocity = s.velocity + unloading_velocity(s, target);
  p.release_arrival = p.overtaking_depth = endless;
  if (p.flyer_rigid || !p.pair.flyer_rear_free) return;
  const double start = head_of_release(impact.flyer, flyer, p.pair.flyer_thickness);
  const double head = release_head_speed(s, target);
  p.release_arrival = p.contact + start + length / head;
  if (head > s.shock_speed) p.overtaking_depth = s.shock_speed * head * start / (head - s.shock_speed);
}

/// The plateau is a bound already where the release would overtake the shock at this multiple of the target's
/// thickness: shocks in matter that hardens are spread, and the release takes their rear first. Measured with
/// aluminium on copper at 200 m/s: 3.5 % lower at 1.4, 7.6 % at 1.2 (docs/changes/0024).
constexpr double overtaking_margin = 1.4;

/// One-dimensional waves end where the releases from the sides arrive.
void keep_before_sides(PlatePrediction& p) {
  const double release = std::max(p.flyer_shock.release_speed, p.target_shock.release_speed);
  p.sides = p.contact + p.pair.half_width / release;
  if (std::isfinite(p.opens) && p.opens > p.sides) {
    p.opens = endless;
    p.parting = Parting::by_sides;
  }
  p.plateau_is_bound =
      p.shock_arrival > 0 &&
      (p.overtaking_depth < overtaking_margin * p.pair.target_thickness || p.shock_arrival > p.sides);
}

std::string shock_line(const std::string& name, const ShockState& s) {
  std::string text = fmt::format("    {:<12} shock {:.0f} m/s, {:.0f} kg/m3, pressure {:.4g} GPa", name,
                                 s.shock_speed, s.density, s.pressure * 1e-9);
  if (s.has_precursor)
    text += fmt::format("; precursor {:.0f} m/s, elastic limit {:.4g} GPa", s.precursor_speed,
                        s.precursor_stress * 1e-9);
  else if (s.plastic_strain == 0 && s.yield > 0)
    text += "; elastic";
  return text + '\n';
}

std::string rear_lines(const PlatePrediction& p, const std::string& target) {
  std::string text = fmt::format("  rear face of '{}'\n", target);
  if (p.precursor_arrival)
    text += fmt::format("    {:<12} precursor, to {}{:.4g} m/s\n",
                        fmt::format("{:.4g} us", *p.precursor_arrival * 1e6),
                        *p.precursor_arrival > p.sides ? "at most " : "", p.precursor_surface_velocity);
  text += fmt::format("    {:<12} shock, {} {:.4g} m/s\n", fmt::format("{:.4g} us", p.shock_arrival * 1e6),
                      p.plateau_is_bound ? "to at most" : "towards", p.plateau_surface_velocity);
  if (std::isfinite(p.release_arrival)) {
    const bool overtaken = p.overtaking_depth < p.pair.target_thickness;
    text += overtaken
                ? fmt::format(
                      "    the release from the flyer's rear overtakes the shock at a depth of {:.3g} mm: "
                      "lower and later than that\n",
                      p.overtaking_depth * 1e3)
                : fmt::format(
                      "    {:<12} release from the flyer's rear; it would overtake the shock at {:.3g} mm\n",
                      fmt::format("{:.4g} us", p.release_arrival * 1e6), p.overtaking_depth * 1e3);
  }
  return text;
}

std::string parting_line(const PlatePrediction& p, const std::string& flyer) {
  switch (p.parting) {
    case Parting::by_flyer_release:
      return fmt::format(
          "  opens {} {:.3g} us: the release from the rear of '{}' pulls, its rear goes on at {:.4g} "
          "m/s{}\n",
          p.opens_is_bound ? "before" : "about", p.opens * 1e6, flyer, p.flyer_rear_after,
          p.opens_is_bound ? "; the release from the rear of the target has taken part of the stress by then"
                           : "");
    case Parting::by_target_release:
      return fmt::format(
          "  stays in contact until the release from the rear of the target comes, about {:.3g} us\n",
          p.opens * 1e6);
    case Parting::neutral:
      return fmt::format("  unloaded without a pull (equal impedances) about {:.3g} us\n", p.opens * 1e6);
    case Parting::open:
      return "  no parting from free rear faces\n";
    case Parting::by_sides:
      return "  opens at a time that one-dimensional waves do not tell: releases from the sides come first\n";
    case Parting::never:
      return "  never opens: the contact is bonded\n";
  }
  return {};
}

}  // namespace

std::vector<PlatePair> find_plate_pairs(const Case& c) {
  std::vector<Extent> all;
  for (const Body& body : c.bodies) all.push_back(extent_of(body.shape, c.domain.geometry));
  std::vector<PlatePair> pairs;
  const auto dim = static_cast<std::size_t>(config::dimension(c.domain.geometry));
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b)
      for (std::size_t axis = 0; a != b && axis < dim; ++axis)
        if (!(c.bodies[a].rigid && c.bodies[b].rigid) && !is_left_out(c.bodies[a]) &&
            !is_left_out(c.bodies[b]))
          if (const auto pair = pair_along(c, all, a, b, axis)) pairs.push_back(*pair);
  return pairs;
}

double unloading_velocity(const ShockState& s, const Material& m) {
  const double shear = shear_modulus(m);
  const double elastic_impedance = s.density * s.release_speed;
  double elastic = 0;  // stress given up before the matter yields the other way
  if (shear > 0)
    elastic = s.plastic_strain > 0 ? elastic_impedance * s.release_speed * s.yield / shear : s.stress;
  elastic = std::min(elastic, s.stress);
  const double bulk_impedance = 0.5 * (s.density * s.bulk_speed + solid_density(m) * bulk_sound_speed(m));
  return (elastic > 0 ? elastic / elastic_impedance : 0) + (s.stress - elastic) / bulk_impedance;
}

PlatePrediction predict(const PlatePair& pair, const Case& c, const std::vector<Material>& materials) {
  const auto f = static_cast<std::size_t>(pair.flyer), t = static_cast<std::size_t>(pair.target);
  const auto axis = static_cast<std::size_t>(pair.axis);
  PlatePrediction p;
  p.pair = pair;
  p.flyer_rigid = c.bodies[f].rigid;
  p.target_rigid = c.bodies[t].rigid;
  p.contact = pair.gap / pair.closing;
  const Impact impact = match(p, materials[f], materials[t]);
  p.velocity = c.bodies[t].velocity[axis] + pair.direction * impact.velocity;
  p.stress = impact.stress;
  p.flyer_shock = impact.flyer;
  p.target_shock = impact.target;
  if (c.contact.between(c.bodies[f].name, c.bodies[t].name).mode == config::ContactChoice::Mode::bonded) {
    p.parting = Parting::never;
    p.opens = endless;
  } else {
    predict_parting(p, impact, materials[f], materials[t]);
  }
  if (!p.flyer_rigid)
    p.flyer_rear_after = p.velocity - pair.direction * unloading_velocity(impact.flyer, materials[f]);
  if (!p.target_rigid && pair.target_rear_free && std::isfinite(pair.target_thickness))
    predict_rear(p, impact, materials[f], materials[t]);
  keep_before_sides(p);
  return p;
}

std::string describe(const PlatePrediction& p, const Case& c) {
  const std::string& flyer = c.bodies[p.pair.flyer].name;
  const std::string& target = c.bodies[p.pair.target].name;
  const std::string axis = config::axes_of(c.domain.geometry)[p.pair.axis];
  std::string text = fmt::format("  '{}' meets '{}' at {:.4g} us, closing at {:.4g} m/s along {}\n", flyer,
                                 target, p.contact * 1e6, p.pair.closing, axis);
  text += fmt::format("  interface     {:.4g} m/s, {:.4g} GPa\n", p.velocity, p.stress * 1e-9);
  if (!p.flyer_rigid) text += shock_line(flyer, p.flyer_shock);
  if (!p.target_rigid) text += shock_line(target, p.target_shock);
  if (p.shock_arrival > 0) text += rear_lines(p, target);
  text += parting_line(p, flyer);
  if (std::isfinite(p.sides))
    text += fmt::format("  all this until releases from the sides arrive, in the middle about {:.3g} us\n",
                        p.sides * 1e6);
  return text;
}

std::vector<TouchPrediction> predict_touches(const Case& c, const std::vector<Material>& materials,
                                             const std::vector<PlatePair>& plates) {
  std::vector<TouchPrediction> all;
  for (const Approach& a : first_meetings(find_approaches(c))) {
    const bool is_plates = std::any_of(plates.begin(), plates.end(), [&](const PlatePair& p) {
      return std::minmax(p.flyer, p.target) == std::minmax(a.first, a.second);
    });
    const bool first_rigid = c.bodies[a.first].rigid, second_rigid = c.bodies[a.second].rigid;
    if (is_plates || a.time > c.time.end || (first_rigid && second_rigid)) continue;
    if (is_left_out(c.bodies[a.first]) || is_left_out(c.bodies[a.second])) continue;
    PlatePrediction pair;
    pair.pair.closing = a.closing;
    pair.flyer_rigid = first_rigid;
    pair.target_rigid = second_rigid;
    const Impact impact = match(pair, materials[a.first], materials[a.second]);
    all.push_back({a, impact.stress, impact.flyer, impact.target});
  }
  return all;
}

std::string describe(const TouchPrediction& p, const Case& c) {
  const Approach& a = p.approach;
  std::string text = fmt::format("  '{}' touches '{}' at about {:.3g} us, closing at {:.4g} m/s",
                                 c.bodies[a.first].name, c.bodies[a.second].name, a.time * 1e6, a.closing);
  if (a.sliding > 0.05 * a.closing) text += fmt::format(" and sliding at {:.4g} m/s", a.sliding);
  text += fmt::format(
      "\n  at first touch {:.4g} GPa; the stress falls as soon as releases from free surfaces arrive\n",
      p.stress * 1e-9);
  if (!c.bodies[a.first].rigid) text += shock_line(c.bodies[a.first].name, p.first_shock);
  if (!c.bodies[a.second].rigid) text += shock_line(c.bodies[a.second].name, p.second_shock);
  return text;
}

std::vector<std::string> not_predicted(const Case& c) {
  std::vector<std::string> reasons;
  for (const Body& body : c.bodies) {
    if (body.takes_up_fragments() || body.rigid || !starts_otherwise(body)) continue;
    std::string start;
    if (body.pressure.value_or(0) != 0) start = fmt::format("{:.4g} GPa", *body.pressure * 1e-9);
    if (body.temperature) start += fmt::format("{}{:.4g} K", start.empty() ? "" : " and ", *body.temperature);
    reasons.push_back(
        fmt::format("impacts of '{}' are not predicted: it starts at {}, and predictions hold for matter "
                    "without pressure and at the temperature of its material",
                    body.name, start));
  }
  return reasons;
}

}  // namespace recoil::app
