#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "app/check/checks.hpp"
#include "app/check/prediction.hpp"
#include "core/error.hpp"
#include "material/damage/damage.hpp"
#include "record/state_survey.hpp"

namespace recoil::app {

namespace {

/// A plate between its two releases: that from its own free rear, and that from the rear of its partner.
struct Plate {
  int body = 0;
  double thickness = 0, partner_thickness = 0;  // m
  bool rear_free = false, partner_rear_free = false, partner_rigid = false;
  const ShockState &shock, &partner_shock;
  const Material &material, &partner_material;
};

/// The tension where two releases meet, and when.
struct Pull {
  double tension = 0, time = 0;  // Pa, s
};

/// Stress over particle velocity of a shocked state [Pa s/m].
double impedance_of(const ShockState& s) { return s.velocity > 0 ? s.stress / s.velocity : 0; }

/// Linear waves: with `P` in the plate and `P1` left by the release from the partner, both releases together
/// leave the tension `P - P1`; `P1` is `P (Zp - Z)/(Zp + Z)` of a stiffer partner, 0 of a softer one, which
/// lets go. None where the releases meet outside of the plate.
std::optional<Pull> pull_in(const Plate& plate, double contact, double stress) {
  if (!plate.rear_free || !plate.partner_rear_free || plate.partner_rigid) return std::nullopt;
  const double head = release_head_speed(plate.shock, plate.material),
               partner_head = release_head_speed(plate.partner_shock, plate.partner_material);
  const double enters =  // through the face of contact
      plate.partner_thickness / plate.partner_shock.shock_speed + plate.partner_thickness / partner_head;
  const double leaves = plate.thickness / plate.shock.shock_speed;  // from the rear
  const double meet = 0.5 * (enters + leaves + plate.thickness / head), depth = head * (meet - enters);
  if (!(depth > 0 && depth < plate.thickness) || !std::isfinite(meet)) return std::nullopt;
  const double z = impedance_of(plate.shock), zp = impedance_of(plate.partner_shock);
  const double left = std::max(0.0, (zp - z) / (zp + z));
  return Pull{stress * (1 - left), contact + meet};
}

void warn_of(LoadedCase& loaded, const config::Body& body, const Material& material, const Pull& pull,
             double borne) {
  const double spall = material.facts.spall_strength;
  const std::string threshold =
      std::isnan(spall) ? std::string("its spall strength") : fmt::format("{:.3g} GPa", spall * 1e-9);
  loaded.found.warning(
      body.material_place,
      fmt::format(
          "releases will pull '{}' with about {:.3g} GPa at {:.3g} us, and its material counts as torn "
          "at {:.3g} GPa; without damage it does not break, and the run will be doubtful or stop",
          body.name, pull.tension * 1e-9, pull.time * 1e6, borne * 1e-9),
      fmt::format("end the run before, or take a material with base = \"{}\" and damage = {{ kind = "
                  "\"tensile\", threshold = "
                  "\"{}\", time = \"0.02 us\" }}: `recoil new spall` writes an example",
                  body.material, threshold));
}

void check_pair(LoadedCase& loaded, const PlatePair& pair, std::set<int>& warned) {
  const config::Case& c = loaded.contents;
  const PlatePrediction p = predict(pair, c, loaded.materials);
  const Material &flyer = loaded.materials[pair.flyer], &target = loaded.materials[pair.target];
  const Plate plates[] = {
      {pair.flyer, pair.flyer_thickness, pair.target_thickness, pair.flyer_rear_free, pair.target_rear_free,
       p.target_rigid, p.flyer_shock, p.target_shock, flyer, target},
      {pair.target, pair.target_thickness, pair.flyer_thickness, pair.target_rear_free, pair.flyer_rear_free,
       p.flyer_rigid, p.target_shock, p.flyer_shock, target, flyer}};
  for (const Plate& plate : plates) {
    const config::Body& body = c.bodies[plate.body];
    if (body.rigid || can_fail(plate.material.damage) || warned.contains(plate.body)) continue;
    const auto pull = pull_in(plate, p.contact, p.stress);
    const double borne = borne_tension(plate.material, c.limits);
    if (!pull || !(pull->tension > borne) || !(pull->time < std::min(c.time.end, p.sides))) continue;
    warned.insert(plate.body);
    warn_of(loaded, body, plate.material, *pull, borne);
  }
}

}  // namespace

void check_tension(LoadedCase& loaded) {
  std::set<int> warned;
  for (const PlatePair& pair : find_plate_pairs(loaded.contents)) {
    try {
      check_pair(loaded, pair, warned);
    } catch (const PhysicsError&) {  // no impact state: `recoil check` says so
    }
  }
}

}  // namespace recoil::app
