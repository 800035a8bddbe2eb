#include "problem/centroid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace recoil {

namespace {

constexpr int search_halvings = 4;  // of the widest side of a box in which the body is looked for
constexpr int searches = 16;        // at most; each one is in the box that the last has found
constexpr double settled = 0.9;     // part of its sides that a box keeps in the last search

constexpr int halvings(int dim) { return dim == 1 ? 16 : dim == 2 ? 9 : 7; }

template <int Dim>
using Distance = std::function<double(const Vec<Dim>&)>;

template <int Dim>
struct Corners {
  Vec<Dim> lo, hi;  // m

  Vec<Dim> middle() const { return 0.5 * (lo + hi); }
};

/// Halves a box until it lies inside or outside, or its widest side is at most `finest` [m].
/// f(box, part of it that is inside) for all but those outside.
template <int Dim, class F>
void halve(const Distance<Dim>& distance, const Corners<Dim>& box, double finest, F& f) {
  const Vec<Dim> side = box.hi - box.lo, middle = box.middle();
  const double s = distance(middle), reach = 0.5 * norm(side);
  if (s >= reach) return;
  if (s <= -reach) return f(box, 1.0);
  const int widest = main_axis(side);
  if (side[widest] <= finest) {
    const double narrowest = *std::min_element(side.c.begin(), side.c.end());
    return f(box, std::clamp(0.5 - s / narrowest, 0.0, 1.0));
  }
  Corners<Dim> half = box;
  half.hi[widest] = middle[widest];
  halve(distance, half, finest, f);
  half.hi[widest] = box.hi[widest];
  half.lo[widest] = middle[widest];
  halve(distance, half, finest, f);
}

/// The widest side of a box, halved so often [m].
template <int Dim>
double part_of(const Corners<Dim>& box, int times) {
  const Vec<Dim> side = box.hi - box.lo;
  return std::ldexp(side[main_axis(side)], -times);
}

/// A box that holds what of the body lies in the given one, and little more.
template <int Dim>
Corners<Dim> tightened(const Distance<Dim>& distance, Corners<Dim> box) {
  for (int search = 0; search < searches; ++search) {
    Corners<Dim> found;
    for (int d = 0; d < Dim; ++d) {
      found.lo[d] = std::numeric_limits<double>::infinity();
      found.hi[d] = -found.lo[d];
    }
    auto extend = [&](const Corners<Dim>& part, double /*inside*/) {
      for (int d = 0; d < Dim; ++d) {
        found.lo[d] = std::min(found.lo[d], part.lo[d]);
        found.hi[d] = std::max(found.hi[d], part.hi[d]);
      }
    };
    halve(distance, box, part_of(box, search_halvings), extend);
    if (!(found.lo[0] <= found.hi[0])) return box;
    bool smaller = false;
    for (int d = 0; d < Dim; ++d)
      smaller = smaller || found.hi[d] - found.lo[d] < settled * (box.hi[d] - box.lo[d]);
    box = found;
    if (!smaller) break;
  }
  return box;
}

}  // namespace

template <int Dim>
Vec<Dim> centroid(const Distance<Dim>& distance, const Vec<Dim>& lo, const Vec<Dim>& hi, int radial_power) {
  const Corners<Dim> box = tightened(distance, Corners<Dim>{lo, hi});
  double volume = 0;
  Vec<Dim> moment;
  auto add = [&](const Corners<Dim>& part, double inside) {
    const Vec<Dim> x = part.middle();
    double own = inside * (radial_power == 0 ? 1 : radial_power == 1 ? std::abs(x[0]) : x[0] * x[0]);
    for (int d = 0; d < Dim; ++d) own *= part.hi[d] - part.lo[d];
    volume += own;
    moment += own * (x - box.middle());
  };
  halve(distance, box, part_of(box, halvings(Dim)), add);
  Vec<Dim> at = box.middle();
  if (volume > 0) at += (1 / volume) * moment;
  if (radial_power == 1) at[0] = 0;
  return at;
}

template Vec<1> centroid<1>(const Distance<1>&, const Vec<1>&, const Vec<1>&, int);
template Vec<2> centroid<2>(const Distance<2>&, const Vec<2>&, const Vec<2>&, int);
template Vec<3> centroid<3>(const Distance<3>&, const Vec<3>&, const Vec<3>&, int);

}  // namespace recoil
