#include "config/shape/round/ogive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/shape/outline.hpp"

namespace recoil::config {

Entries<Ogive> Ogive::keys() {
  Entries<Ogive> keys = line_keys<Ogive>("middle of the rear face", "the tip");
  keys.push_back({.name = "radius",
                  .member = &Ogive::radius,
                  .unit = "m",
                  .positive = true,
                  .required = true,
                  .doc = "of the cylinder",
                  .example = R"("5 mm")"});
  keys.push_back({.name = "nose",
                  .member = &Ogive::nose,
                  .unit = "m",
                  .positive = true,
                  .optional = true,
                  .doc = "length of the ogive; what is left of the whole length is the cylinder",
                  .example = R"("15 mm")"});
  keys.push_back(
      {.name = "calibre-radius",
       .member = &Ogive::nose_ratio,
       .least = 0.5,
       .optional = true,
       .doc = "calibre radius head in place of `nose`: radius of the ogive's arc over the diameter",
       .example = "3",
       .when = [](const Ogive&) { return false; }});
  return keys;
}

void Ogive::check(const TableReading& reading) {
  check_line(reading);
  const bool by_length = reading.has("nose"), by_ratio = reading.has("calibre-radius");
  if (by_length == by_ratio) {
    reading.in.out.error(reading.record.key_place(by_length ? "calibre-radius" : "nose"),
                         by_length ? "'nose' says already how slender the ogive is"
                                   : "an ogive needs the length of its nose, 'nose' or 'calibre-radius'",
                         by_length ? "remove one of 'nose' and 'calibre-radius'" : "e.g. calibre-radius = 3");
    return;
  }
  if (!reading.good(by_length ? "nose" : "calibre-radius") || !reading.good("radius")) return;
  const char* key = by_length ? "nose" : "calibre-radius";
  if (by_ratio) nose = radius * std::sqrt(4 * nose_ratio - 1);
  if (nose < radius * (1 - 1e-12))
    reading.wrong(key, "a tangent ogive is at least as long as its radius",
                  fmt::format("half a ball is {:.6g} mm long; for a flat nose use a frustum", 1e3 * radius));
  const double whole = size();
  if (whole > 0 && nose > whole * (1 + 1e-9))
    reading.wrong(
        key,
        fmt::format("the nose is {:.6g} mm long, but the whole body only {:.6g} mm", 1e3 * nose, 1e3 * whole),
        "make the body longer or the nose blunter");
}

double Ogive::distance_in_half_plane(const Meridian& at) const {
  const double r = at.radius, z = at.along, whole = size(), shank = std::max(0.0, whole - nose);
  const double arc = 0.5 * (radius * radius + nose * nose) / radius;
  // The arc's centre lies in the plane where the nose begins, beyond the axis.
  const double cr = r + arc - radius, cz = z - shank, from_centre = std::hypot(cr, cz);
  const double tip_r = arc - radius;  // of the tip, seen from the centre, as `nose` is its height
  const bool before_tip = cz * tip_r <= cr * nose;
  double nearest = cz >= 0 && before_tip ? std::abs(from_centre - arc) : std::hypot(r, z - whole);
  const Vec<2> x{{r, z}};
  nearest = std::min(nearest, std::sqrt(edge_distance2({0, 0}, {radius, 0}, x)));
  if (shank > 0) nearest = std::min(nearest, std::sqrt(edge_distance2({radius, 0}, {radius, shank}, x)));
  const bool inside = z > 0 && (z <= shank ? r < radius : from_centre < arc);
  return inside ? -nearest : nearest;
}

}  // namespace recoil::config
