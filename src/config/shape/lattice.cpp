#include "config/shape/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "config/declare/reading.hpp"
#include "config/shape/shape.hpp"

namespace recoil::config {

namespace {

constexpr double most_copies = 10000;

}  // namespace

Entries<Lattice> Lattice::keys() {
  return {key_of_shape<Lattice>("what is repeated"),
          {.name = "count",
           .member = &Lattice::count,
           .required = true,
           .doc = "number of copies along each axis; 1 along those left out",
           .example = "{ x = 3 }"},
          {.name = "pitch",
           .member = &Lattice::pitch,
           .unit = "m",
           .required = true,
           .doc = "from one copy to the next along each axis",
           .example = R"({ x = "5 mm" })"}};
}

void Lattice::check(const TableReading& reading) {
  if (!reading.good("count") || !reading.good("pitch") || !reading.good("shape")) return;
  double all = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const Node* given =
        d < reading.in.axes.size() ? reading.record.node("count")->find(reading.in.axes[d]) : nullptr;
    if (!given) count[d] = 1;
    if (count[d] < 1 || count[d] != std::floor(count[d]))
      return reading.wrong("count", fmt::format("{} is no number of copies", count[d]),
                           "e.g. count = { x = 3 }");
    if (count[d] > 1 && pitch[d] == 0)
      return reading.wrong(
          "pitch",
          fmt::format("'pitch' is 0 along {}, where there are {} copies", reading.in.axes[d], count[d]),
          "give the distance from one copy to the next, e.g. pitch = { x = \"5 mm\" }");
    all *= count[d];
  }
  if (reading.in.geometry == Geometry::axisymmetric && count[0] > 1)
    return reading.wrong("count", "an axisymmetric shape can be repeated along z only", "leave out r");
  if (all > most_copies)
    return reading.wrong("count",
                         fmt::format("these are {} copies; at most {} are possible", all, most_copies),
                         "repeat fewer");
  make_copies();
}

void Lattice::make_copies() {
  copies.clear();
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        Moved copy;
        copy.shape = shape;
        copy.shift = {i * pitch[0], j * pitch[1], k * pitch[2]};
        copies.push_back({copy, shape.front().place});
      }
  around.assign(copies.size(), {});
}

template <int Dim>
double Lattice::distance(const Vec<Dim>& x, const Domain& domain) const {
  double least = 1e300;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    // Also a bound of the distance to the copy, and inside of its box none at all.
    const double box = around[i].distance(x);
    if (box > 0 && box >= least) continue;
    const double own = distance_to(copies[i], x, domain);
    least = std::min(least, box > 0 ? std::max(box, own) : own);
  }
  return least;
}

Lattice Lattice::continued(const Domain& domain) const {
  Lattice all = *this;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    all.copies[i] = config::continued(copies[i], domain);
    all.around[i] = bounds_of(all.copies[i], domain);
  }
  return all;
}

double Lattice::thickness(const Domain& domain) const {
  double least = 1e300;
  for (const Shape& copy : copies) least = std::min(least, config::thickness(copy, domain));
  return least;
}

Bounds Lattice::bounds(const Domain& domain) const {
  Bounds all = bounds_of(copies.front(), domain);
  for (const Shape& copy : copies) all = all.with(bounds_of(copy, domain));
  return all;
}

#define RECOIL_INSTANTIATE(Dim) template double Lattice::distance<Dim>(const Vec<Dim>&, const Domain&) const;
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil::config
