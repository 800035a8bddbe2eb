#include "config/shape/round/revolution.hpp"

#include <algorithm>
#include <cstddef>

namespace recoil::config {

double profile_distance(std::span<const Corner> profile, const Meridian& at) {
  const Vec<2> x{{at.radius, at.along}};
  return outline_distance(profile, x, x,
                          [](const Corner& a, const Corner& b) { return a[0] == 0 && b[0] == 0; });
}

std::vector<Corner> joined_to_axis(std::vector<Corner> profile) {
  if (profile.empty() || profile.front() == profile.back()) return profile;
  const Corner first{0, profile.front()[1]}, last{0, profile.back()[1]};
  if (profile.back() != last && profile.back() != first) profile.push_back(last);
  if (profile.front() != first && profile.back() != first) profile.push_back(first);
  return profile;
}

Entries<Revolution> Revolution::keys() {
  Entries<Revolution> keys{{.name = "profile",
                            .member = Custom<Revolution>{Key::Type::any, false, read_profile, write_profile},
                            .required = true,
                            .doc = "corners in order, each a pair [radius, along the axis]; flat faces join "
                                   "its ends to the axis, but one "
                                   "that ends where it begins is a ring",
                            .example = R"([["0 mm", "0 mm"], ["4 mm", "8 mm"], ["4 mm", "20 mm"]])"}};
  for (auto& key : centre_keys<Revolution>("the place of the axis at 0 of the profile; without it the origin",
                                           "direction of its axis (3d); without it z"))
    keys.push_back(key);
  return keys;
}

void Revolution::read_profile(Revolution& shape, const TableReading& reading, const Key& key) {
  shape.profile = read_corners(reading, key, 2, {"radius", "along"});
  check_radii(shape.profile, reading, "profile");
  shape.profile = joined_to_axis(shape.profile);
}

std::string Revolution::write_profile(const Revolution& shape, const char* /*name*/, const Writing& /*how*/) {
  return write_corners(shape.profile);
}

void Revolution::check(const TableReading& reading) const {
  check_on_axis(centre, reading);
  if (reading.good("profile") && !(area_of(profile) > 0))
    reading.wrong("profile", "this profile encloses nothing", "give corners that do not all lie on one line");
}

Bounds Revolution::bounds(const Domain& domain) const {
  if (profile.empty()) return {};
  double radius = 0, low = profile[0][1], high = low;
  for (const Corner& c : profile) {
    radius = std::max(radius, c[0]);
    low = std::min(low, c[1]);
    high = std::max(high, c[1]);
  }
  const Vector a = domain.geometry == Geometry::axisymmetric ? Vector{0, 1, 0} : axis;
  Vector ends[2];
  for (std::size_t d = 0; d < 3; ++d)
    ends[0][d] = centre[d] + low * a[d], ends[1][d] = centre[d] + high * a[d];
  return Bounds::around(ends[0], radius).with(Bounds::around(ends[1], radius));
}

}  // namespace recoil::config
