#include "config/shape/round/cone.hpp"

#include <array>

#include "config/shape/round/revolution.hpp"

namespace recoil::config {

double frustum_distance(const Meridian& at, double a, double b, double length) {
  return profile_distance(std::array<Corner, 4>{{{0, 0}, {a, 0}, {b, length}, {0, length}}}, at);
}

Entries<Cone> Cone::keys() {
  Entries<Cone> keys = line_keys<Cone>("middle of the base", "the tip");
  keys.push_back({.name = "radius",
                  .member = &Cone::radius,
                  .unit = "m",
                  .positive = true,
                  .required = true,
                  .doc = "of the base",
                  .example = R"("5 mm")"});
  return keys;
}

Entries<Frustum> Frustum::keys() {
  Entries<Frustum> keys = line_keys<Frustum>("middle of one face", "middle of the other");
  const auto radius = [](const char* name, double Frustum::*member, const char* doc) {
    return Entry<Frustum>{.name = name,
                          .member = member,
                          .unit = "m",
                          .least = 0,
                          .required = true,
                          .doc = doc,
                          .example = R"("5 mm")"};
  };
  keys.push_back(radius("from-radius", &Frustum::from_radius, "of the face at `from`"));
  keys.push_back(radius("to-radius", &Frustum::to_radius, "of the face at `to`"));
  return keys;
}

void Frustum::check(const TableReading& reading) {
  check_line(reading);
  if (reading.good("from-radius") && reading.good("to-radius") && from_radius == 0 && to_radius == 0)
    reading.wrong("to-radius", "both radii of this frustum are 0", "one of them may be: that is a cone");
}

}  // namespace recoil::config
