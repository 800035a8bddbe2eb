#include "gauge/attitude.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace recoil {

namespace {

using Plane = std::array<double, 2>;

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// Places of mass, moments and second moments of a part in a row; the whole has its motion behind them.
enum : std::size_t { mass, x, y, xx, xy, yy, part_sums, px = part_sums, py, turning, whole_sums };

/// All fragments of cells of one body in this rank's blocks: f(mass, place, momentum), the last two in the
/// plane. A fragment of a cut cell counts at the middle of the cell.
template <int Dim, class F>
void for_each_cell_of(const State<Dim>& state, const Body<Dim>& body, F&& f) {
  using C = Components<Dim>;
  for (int slot = 0; slot < state.mesh.local() && Dim > 1; ++slot) {
    if (body.rigid || !body.present(slot)) continue;
    const BodyBlock<Dim>& b = body.at(slot);
    const Block<Dim>& block = state.mesh.block(slot);
    const std::size_t n = b.volume.size();
    for_each(block.cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(state.grid().layout().at(i - block.cells.lo));
      if (!(b.contents[k] > 0)) return;
      const Vec<Dim> c = state.grid(slot).centre(i);
      f(b.contents[k], Plane{c[0], c[Dim > 1 ? 1 : 0]},
        Plane{b.contents[C::u * n + k], b.contents[(C::u + (Dim > 1 ? 1 : 0)) * n + k]});
    });
  }
}

/// Those of a body, and of what other bodies have taken up of it.
template <int Dim, class F>
void for_each_fragment(const State<Dim>& state, int body, F&& f) {
  for_each_part(state, body, [&](int m) { for_each_cell_of(state, state.bodies[m], f); });
}

/// Brings the places of a body that reaches across a periodic edge to one side of it, about a middle.
struct Unfolding {
  Plane period{}, middle{};  // m; a period of 0: the axis is not periodic

  double unfolded(double at, std::size_t d) const {
    return period[d] > 0 ? at - period[d] * std::round((at - middle[d]) / period[d]) : at;
  }
  Plane operator()(const Plane& r) const { return {unfolded(r[0], 0), unfolded(r[1], 1)}; }
};

template <int Dim>
Unfolding about(const State<Dim>& state, const Plane& middle) {
  Unfolding u{{}, middle};
  const Grid<Dim>& grid = state.grid();
  for (int d = 0; d < std::min(Dim, 2); ++d)
    if (grid.periodic(d)) u.period[static_cast<std::size_t>(d)] = grid.cells[d] * grid.dx;
  return u;
}

/// The middle of a body along periodic axes, by the mean direction on the circle that such an axis is.
/// Collective where there is one.
template <int Dim>
Unfolding about_its_middle(const State<Dim>& state, int body, const parallel::World& world) {
  Unfolding u = about(state, {});
  if (u.period == Plane{}) return u;
  ExactSums sums;
  const int item = sums.item(4);
  const SumRow row = sums.add(item);
  for_each_fragment(state, body, [&](double m, const Plane& r, const Plane&) {
    for (std::size_t d = 0; d < 2; ++d) {
      const double turn = u.period[d] > 0 ? 2 * std::numbers::pi * r[d] / u.period[d] : 0;
      row[2 * d] += m * std::cos(turn), row[2 * d + 1] += m * std::sin(turn);
    }
  });
  sums.reduce(world);
  const auto total = sums.total(item);
  for (std::size_t d = 0; d < 2; ++d)
    u.middle[d] = u.period[d] * std::atan2(total[2 * d + 1], total[2 * d]) / (2 * std::numbers::pi);
  return u;
}

void add_part(std::span<ExactSum> to, double m, const Plane& r) {
  to[mass] += m;
  to[x] += m * r[0], to[y] += m * r[1];
  to[xx] += m * r[0] * r[0], to[xy] += m * r[0] * r[1], to[yy] += m * r[1] * r[1];
}

/// Second moments per mass about the part's own centre.
struct Spread {
  double xx, xy, yy;

  explicit Spread(std::span<const double> s)
      : xx(s[recoil::xx] / s[mass] - s[x] * s[x] / (s[mass] * s[mass])),
        xy(s[recoil::xy] / s[mass] - s[x] * s[y] / (s[mass] * s[mass])),
        yy(s[recoil::yy] / s[mass] - s[y] * s[y] / (s[mass] * s[mass])) {}
  double angle() const { return 0.5 * std::atan2(2 * xy, xx - yy); }
  double largest() const { return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy); }
};

/// Of the two directions of an axis the one that is nearer to another.
Plane towards(double angle, const Plane& other) {
  const Plane a{std::cos(angle), std::sin(angle)};
  const double sign = a[0] * other[0] + a[1] * other[1] < 0 ? -1 : 1;
  return {sign * a[0], sign * a[1]};
}

double angle_of(const Plane& v) { return std::atan2(v[1], v[0]); }

AttitudeFrame frame_of(std::span<const double> s) {
  AttitudeFrame f;
  f.mass = s[mass];
  if (!(f.mass > 0)) return f;
  const Spread spread(s);
  f.centre = {s[x] / f.mass, s[y] / f.mass};
  f.velocity = {s[px] / f.mass, s[py] / f.mass};
  const bool moves = std::hypot(f.velocity[0], f.velocity[1]) > 0;
  f.axis = towards(spread.angle(), moves ? f.velocity : Plane{1, 0});
  f.length = std::sqrt(12 * spread.largest());
  const double about_centre = s[turning] - f.centre[0] * s[py] + f.centre[1] * s[px];
  f.spin = about_centre / (f.mass * (spread.xx + spread.yy));
  return f;
}

}  // namespace

template <int Dim>
AttitudeFrame find_frame(const State<Dim>& state, int body, const parallel::World& world) {
  const Unfolding unfold = about_its_middle(state, body, world);
  ExactSums sums;
  const int item = sums.item(whole_sums);
  const SumRow row = sums.add(item);
  for_each_fragment(state, body, [&](double m, const Plane& at, const Plane& p) {
    const Plane r = unfold(at);
    add_part(row.sums, m, r);
    row[px] += p[0], row[py] += p[1];
    row[turning] += r[0] * p[1] - r[1] * p[0];
  });
  sums.reduce(world);
  return frame_of(sums.total(item));
}

template <int Dim>
void collect_attitude(const State<Dim>& state, int body, const AttitudeFrame& f, int item, ExactSums& sums) {
  const SumRow row = sums.add(item);
  const Unfolding unfold = about(state, f.centre);
  for_each_fragment(state, body, [&](double m, const Plane& place, const Plane& p) {
    const Plane at = unfold(place), r{at[0] - f.centre[0], at[1] - f.centre[1]};
    const double ahead = r[0] * f.axis[0] + r[1] * f.axis[1];
    // A fragment counts by its part beyond the cut, so that nothing jumps when it passes.
    const auto beyond = [&](double from) {
      return std::clamp((ahead - from) / state.grid().dx + 0.5, 0.0, 1.0);
    };
    const double half = beyond(0), third = beyond(f.length / 6);
    if (!(half > 0)) return;
    add_part(row.sums.first(part_sums), half * m, r);
    if (!(third > 0)) return;
    add_part(row.sums.subspan(part_sums, part_sums), third * m, r);
    row[2 * part_sums] += third * p[0], row[2 * part_sums + 1] += third * p[1];
  });
}

Attitude read_attitude(const AttitudeFrame& f, std::span<const double> total) {
  if (!(f.mass > 0)) return {nowhere, nowhere, nowhere, nowhere, nowhere, nowhere, nowhere, nowhere};
  const auto part = [&](std::size_t first) {
    const auto sums = total.subspan(first, part_sums);
    return sums[mass] > 0 ? angle_of(towards(Spread(sums).angle(), f.axis)) : nowhere;
  };
  Attitude a;
  a.inclination = angle_of(f.axis);
  a.front_half = part(0);
  a.front_third = part(part_sums);
  a.course = angle_of(f.velocity);
  a.speed = std::hypot(f.velocity[0], f.velocity[1]);
  a.head_x = total[2 * part_sums] / total[part_sums + mass];
  a.head_y = total[2 * part_sums + 1] / total[part_sums + mass];
  a.spin = f.spin;
  return a;
}

#define RECOIL_INSTANTIATE(Dim)                                                           \
  template AttitudeFrame find_frame<Dim>(const State<Dim>&, int, const parallel::World&); \
  template void collect_attitude<Dim>(const State<Dim>&, int, const AttitudeFrame&, int, ExactSums&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
