#include "config/shape/moved.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "config/declare/reading.hpp"
#include "config/shape/shape.hpp"
#include "core/turn.hpp"

namespace recoil::config {

namespace {

bool is_turned(const Moved& m) { return m.angle != 0; }

}  // namespace

Entries<Moved> Moved::keys() {
  const std::vector<Geometry> turning{Geometry::planar, Geometry::space}, space{Geometry::space};
  const auto direction = [&](const char* name, Vector Moved::*member, const char* doc) {
    return Entry<Moved>{.name = name,
                        .member = member,
                        .rule = Rule::direction,
                        .doc = doc,
                        .example = "{ x = 1 }",
                        .only_in = space,
                        .when = [](const Moved&) { return false; }};
  };
  return {
      key_of_shape<Moved>("what is moved"),
      {.name = "angle",
       .member = &Moved::angle,
       .unit = "rad",
       .doc = "turned by it: planar counter-clockwise, 3d about `axis` as a right-handed screw",
       .example = R"("30 deg")",
       .only_in = turning,
       .when = is_turned},
      {.name = "axis",
       .member = &Moved::axis,
       .rule = Rule::direction,
       .doc = "direction of the axis of turning; without it z",
       .example = "{ y = 1 }",
       .only_in = space,
       .when = is_turned},
      direction("turn-from", &Moved::turn_from,
                "a direction in the shape as it is given; in place of `angle` and `axis`"),
      direction("turn-to", &Moved::turn_to, "where that direction points afterwards, by the shortest turn"),
      {.name = "centre",
       .member = &Moved::centre,
       .unit = "m",
       .doc = "the point about which it turns; without it the origin",
       .example = R"({ x = "1 mm" })",
       .only_in = turning,
       .when = is_turned},
      {.name = "shift",
       .member = &Moved::shift,
       .unit = "m",
       .doc = "shifted by this after turning",
       .example = R"({ x = "1 mm" })"}};
}

void Moved::check(const TableReading& reading) {
  if (reading.has("turn-from") != reading.has("turn-to"))
    reading.refuse(reading.has("turn-to") ? "turn-to" : "turn-from", "'turn-from' and 'turn-to' go together",
                   "or give 'angle' and 'axis'");
  else if (reading.has("turn-from"))
    turn_by_directions(reading);
  if (reading.has("axis") && !reading.has("angle"))
    reading.refuse("axis", "'axis' needs 'angle'", "e.g. angle = \"30 deg\"");
  if (!has_radius(reading.in.geometry) || shift[0] == 0) return;
  if (reading.in.geometry == Geometry::spherical)
    reading.wrong("shift", "a spherical shape stays about the centre", "leave out 'shift'");
  else
    reading.wrong("shift", "an axisymmetric shape can be shifted along z only", "leave out r");
}

void Moved::turn_by_directions(const TableReading& reading) {
  for (const char* key : {"angle", "axis"})
    if (reading.has(key))
      return reading.refuse(key, "'turn-from' and 'turn-to' say already how the shape is turned",
                            "remove them, or 'angle' and 'axis'");
  if (!reading.good("turn-from") || !reading.good("turn-to")) return;
  const Vec<3> a{turn_from}, b{turn_to};
  Vec<3> normal = cross(a, b);
  angle = std::atan2(norm(normal), dot(a, b));
  if (norm(normal) < 1e-12) {  // about any axis across
    const int least = std::abs(a[0]) < 0.6 ? 0 : 1;
    Vec<3> other;
    other[least] = 1;
    normal = cross(a, other);
    angle = dot(a, b) > 0 ? 0 : std::numbers::pi;
  }
  axis = normalised(normal.c);
}

Domain Moved::seen_from_shape(const Domain& domain) const {
  constexpr double far = 1e9;  // m; a turned shape meets no edge
  Domain seen = domain;
  for (std::size_t d = 0; d < 3; ++d) {
    seen.lo[d] = angle != 0 ? -far : domain.lo[d] - shift[d];
    seen.hi[d] = angle != 0 ? far : domain.hi[d] - shift[d];
  }
  return seen;
}

template <int Dim>
Vec<Dim> Moved::moved_back(Vec<Dim> x) const {
  x -= first_components<Dim>(shift);
  if (angle == 0) return x;
  if constexpr (Dim == 2) return turned_back(angle, centre, x);
  if constexpr (Dim == 3) {
    const Vec<3> c{centre};
    return c + turned(x - c, Vec<3>{axis}, -angle);
  }
  return x;
}

template <int Dim>
double Moved::distance(const Vec<Dim>& x, const Domain& domain) const {
  return distance_to(shape.front(), moved_back(x), seen_from_shape(domain));
}

Moved Moved::continued(const Domain& domain) const {
  Moved all = *this;
  all.shape.front() = config::continued(shape.front(), seen_from_shape(domain));
  return all;
}

double Moved::thickness(const Domain& domain) const {
  return config::thickness(shape.front(), seen_from_shape(domain));
}

Bounds Moved::bounds(const Domain& domain) const {
  const Bounds own = bounds_of(shape.front(), seen_from_shape(domain));
  if (angle == 0) return own.moved(shift);
  Vec<3> middle, half;
  for (int d = 0; d < 3; ++d) {
    const auto e = static_cast<std::size_t>(d);
    middle[d] = 0.5 * (own.lo[e] + own.hi[e]);
    half[d] = 0.5 * (own.hi[e] - own.lo[e]);
  }
  if (!std::isfinite(norm(half))) return {};
  const Vec<3> c{centre}, about = domain.geometry == Geometry::space ? Vec<3>{axis} : Vec<3>{{0, 0, 1}};
  const Vec<3> now = c + turned(middle - c, about, angle);
  return Bounds::around(now.c, norm(half)).moved(shift);
}

#define RECOIL_INSTANTIATE(Dim) template double Moved::distance<Dim>(const Vec<Dim>&, const Domain&) const;
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil::config
