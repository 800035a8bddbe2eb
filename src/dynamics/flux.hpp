#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "dynamics/face_values.hpp"
#include "dynamics/half_step/face_half_step.hpp"
#include "dynamics/primitives.hpp"
#include "kernels/row_kernels.hpp"
#include "kernels/strong_shocks.hpp"
#include "material/eos/any_eos.hpp"
#include "material/eos/isentrope.hpp"

namespace recoil {

namespace detail {

/// A gas may thin out to any density: its weights have to see changes of any size, as far as a product of six
/// measures of smoothness is a number. [(kg/m3)^2, Pa^2]
inline constexpr double density_scale_of_gas = 1e-45, stress_scale_of_gas = 1e-40;

/// S_nn of a 3-d axis 2 is not stored: it follows from the trace.
template <int Dim, int Axis, class Values>
[[gnu::always_inline]] inline double normal_deviator(const Values& w, std::ptrdiff_t i) {
  using C = Components<Dim>;
  if constexpr (Dim == 3 && Axis == 2)
    return -(w[C::s][i] + w[C::s + 1][i]);
  else
    return w[C::s + C::stress(Axis, Axis)][i];
}

/// Draws all values at the faces of a row of cells towards those of the cells.
/// @param kept how much of the differences is left, see flatten().
template <int Dim>
void flatten_row(const Row<Dim>& in, const double* kept, int to, FaceValues<Dim>& low,
                 FaceValues<Dim>& high) {
  using C = Components<Dim>;
  for (std::size_t c = 0; c < C::primitives; ++c)
    flatten(in.primitive + c * in.cells + in.first, kept, in.count, {low.value[c] + to, high.value[c] + to});
  flatten(in.stress + in.first, kept, in.count, {low.stress + to, high.stress + to});
}

/// Of the density at rest: no solid is thinner.
inline constexpr double thinnest_solid = 0.6;

/// Flattens the values at the faces of a row where a strong shock passes, see find_strong_shocks(), and in
/// more than one dimension in vapour, see find_thin_matter(). In 1-D no cell of vapour was seen to lose more
/// than it has, and metals that evaporate have more ghosts out of bounds with it (docs/decisions/0071).
template <int Dim, int Axis>
void flatten_where_needed(const Row<Dim>& in, double rho0, int to, FaceValues<Dim>& low,
                          FaceValues<Dim>& high) {
  using C = Components<Dim>;
  const auto of = [&](int c) { return in.primitive + c * in.cells + in.first; };
  const ShockRow row{in.stress + in.first,
                     of(C::u + Axis),
                     in.impedance + in.first,
                     of(C::rho),
                     in.role ? in.role + in.first : nullptr,
                     regular,
                     in.step};
  alignas(64) double kept[row_room];
  if (find_strong_shocks(row, in.count, kept)) flatten_row(in, kept, to, low, high);
  if (Dim > 1 && find_thin_matter(of(C::rho), in.step, thinnest_solid * rho0, in.count, kept))
    flatten_row(in, kept, to, low, high);
}

}  // namespace detail

/// Values of a row of cells at their low and high faces across `Axis`: WENO5-Z, or MP5 where the
/// matter of five cells never yields (Row::never_yields), of the characteristic-like sigma +- Z u and tau +-
/// Z_s v and of the remaining primitives, written from place `to` on, moved to the middle of the step where
/// it has one stage (Row::ahead). p is left to solve_faces(). Across axis 2 in 3-D S_zz and S_xx - S_yy are
/// reconstructed, so that a wave along z is one along x turned.
/// @param Shear false for fluids: no shear waves at all.
template <int Dim, int Axis, bool Shear>
void reconstruct(const AnyEos& eos, const Row<Dim>& in, int to, FaceValues<Dim>& low, FaceValues<Dim>& high) {
  using C = Components<Dim>;
  const auto of = [&](int c) { return in.primitive + c * in.cells + in.first; };
  const auto ends = [&](int c) { return detail::RowEnds{low.value[c] + to, high.value[c] + to}; };
  std::uint8_t smooth[row_room];
  const detail::SmoothCells cells =
      in.never_yields ? detail::find_smooth(in.never_yields + in.first, in.step, in.count, smooth)
                      : detail::SmoothCells{};
  const auto plain = [&](int c, double least) {
    detail::reconstruct_plain(of(c), in.step, in.count, least, cells, ends(c));
  };
  const bool gas = is_gas(eos.eos);
  plain(C::rho, gas ? detail::density_scale_of_gas : 1e-6 * eos.rho0 * eos.rho0);
  plain(C::ep, 1e-12);
  if (eos.porous)
    detail::reconstruct_crushed(eos.porous->alpha0, 1e-6 * eos.rho0 * eos.rho0, of(C::rho), of(C::crushed),
                                in.step, in.count, ends(C::rho), ends(C::crushed));
  else
    plain(C::temperature_rise, 1e-6);
  if (in.fails) plain(C::damage, 1e-12);
  if (eos.barotropic) plain(C::extra, 1e-2);

  detail::reconstruct_waves(in.stress + in.first, of(C::u + Axis), in.impedance + in.first, in.step, in.count,
                            gas ? detail::stress_scale_of_gas : detail::stress_scale, cells,
                            {low.stress + to, high.stress + to}, ends(C::u + Axis));
  for (int t = 0; t < Dim; ++t) {
    if (t == Axis) continue;
    const int u = C::u + t, tau = C::s + C::stress(Axis, t);
    if constexpr (Shear) {
      detail::reconstruct_shear_waves(of(tau), of(u), of(C::rho), in.shear + in.first, in.step, in.count,
                                      cells, ends(tau), ends(u));
    } else {
      plain(u, detail::velocity_scale);
    }
  }

  for (int c = C::s; c < C::ep; ++c) {
    bool sheared = false;
    for (int t = 0; t < Dim; ++t) sheared = sheared || (t != Axis && c == C::s + C::stress(Axis, t));
    const bool from_trace = Dim == 3 && Axis == 2 && c < C::s + 2;
    if (!(Shear && sheared) && !from_trace) plain(c, detail::stress_scale);
  }
  if constexpr (Dim == 3 && Axis == 2)
    detail::reconstruct_turned(of(C::s), of(C::s + 1), in.step, in.count, cells, ends(C::s), ends(C::s + 1));
  if (in.flattens) detail::flatten_where_needed<Dim, Axis>(in, eos.rho0, to, low, high);
  if (in.ahead) detail::move_half_step<Dim, Axis, Shear>(eos.barotropic, in, to, low, high);
  for (int c = C::ep; c < static_cast<int>(in.carried()); ++c)
    detail::keep_positive(of(c), in.count, ends(c));
}

namespace detail {

/// The states on one side of a row of faces, from place `from` of `values` on.
template <int Dim>
struct FaceSide {
  FaceValues<Dim>& values;
  int from = 0;
  const double* sound = nullptr;  // c_L [faces]

  const double* of(std::size_t c) const { return values.value[c] + from; }
  const double* stress() const { return values.stress + from; }
};

/// How much of the jump of stress across each face of a row drives its star velocity: half of it between two
/// cells beside a contact, else all of it. @param pulls out.
template <int Dim>
const double* find_pulls(const Row<Dim>& in, double* pulls) {
  const std::uint8_t *upper = in.beside_contact + in.first, *lower = upper - in.step;
  for (int i = 0; i < in.count; ++i) pulls[i] = (upper[i] & lower[i]) != 0 ? 0.5 : 1.0;
  return pulls;
}

/// Completes one side: p from the stress, and c_L into `sound`. States out of bounds are replaced by the
/// average of their cell. @param shift distance in memory from a face's upper cell to the one on this side.
/// @returns how many states of regular cells were replaced. Ghosts have no better value than their own: those
/// beyond the free surface of a gas have no pressure, and no speed of sound.
template <int Dim, int Axis>
int complete_side(const AnyEos& eos, const StateBounds& bounds, const Row<Dim>& in, std::ptrdiff_t shift,
                  FaceValues<Dim>& w, int from, double* sound) {
  using C = Components<Dim>;
  const double *own = in.primitive + C::rho * in.cells + in.first + shift, *rho = w.value[C::rho] + from,
               *stress = w.stress + from, *crushed = w.value[C::crushed] + from,
               *shear = in.shear + in.first + shift;
  double* p = w.value[C::p] + from;
#pragma omp simd
  for (int i = 0; i < in.count; ++i) p[i] = normal_deviator<Dim, Axis>(w.value, i + from) - stress[i];
  eos.wave_speeds_squared(rho, p, crushed, static_cast<std::size_t>(in.count), sound);
  int bad = find_longitudinal_speeds(bounds, rho, own, shear, in.count, sound);
  if (bad == 0) return 0;
  for (int i = 0; i < in.count; ++i) {
    double* value = &w.value[0][i + from];
    if (bounds.admit(value[0], own[i], eos.wave_speed_squared(value[0], p[i], crushed[i]))) continue;
    const std::ptrdiff_t k = in.first + i + shift;
    const bool with_voids = in.failed && in.failed[k] == with_void;  // left to solve_failed_faces()
    if (with_voids || (in.role && (in.role[k] & regular) == 0)) --bad;
    for (std::size_t c = 0; c < C::primitives; ++c)
      value[c * FaceValues<Dim>::room] = in.primitive[c * in.cells + k];
    w.stress[i + from] = in.stress[k];
    sound[i] =
        bounds.longitudinal_speed(value[0], eos.wave_speed_squared(value[0], p[i], crushed[i]), shear[i]);
  }
  return bad;
}

/// The waves along the axis: mass, normal momentum and energy, and the normal star velocity.
/// @param pull see solve_normal_waves(). @param inverse out: NormalWaves::inverse.
template <int Dim, int Axis>
void solve_along_axis(const AnyEos& eos, int count, const AtRest& rest, const FaceSide<Dim>& left,
                      const FaceSide<Dim>& right, const double* pull, const FaceFlux<Dim>& out,
                      double* inverse) {
  using C = Components<Dim>;
  constexpr std::size_t un = C::u + Axis;
  alignas(64) double rho_behind[longest_row], p_behind[longest_row], energy[longest_row],
      kinetic[longest_row], work[longest_row];
  const auto side = [](const FaceSide<Dim>& s) {
    return NormalSide{s.of(C::rho), s.of(un), s.stress(), s.of(C::p), s.sound};
  };
  double *mass = out.flux_of(C::rho), *power = out.flux_of(C::energy), *speed = out.velocity_along(Axis);
  solve_normal_waves(count, rest, side(left), side(right), pull,
                     {mass, out.flux_of(un), power, speed, rho_behind, p_behind, kinetic, work, inverse});
  alignas(64) double upwind[longest_row];
  const double* crushed = left.of(C::crushed);
  if (eos.porous) {
    take_upwind(count, crushed, right.of(C::crushed), speed, upwind);
    crushed = upwind;
  }
  eos.energies(rho_behind, p_behind, crushed, static_cast<std::size_t>(count), energy);
  add_scaled(count, 1, kinetic, energy);
  if (eos.barotropic) {
    take_upwind(count, left.of(C::extra), right.of(C::extra), speed, upwind);
    add_scaled(count, 1, upwind, energy);
  }
#pragma omp simd
  for (int i = 0; i < count; ++i) power[i] = mass[i] * (energy[i] - work[i]) - power[i];
}

}  // namespace detail

/// Fluxes through a row of faces across `Axis`, from the values on their left (from place `left_from` of its
/// row) and on their right: an HLLC solver whose wave speeds are elastic, with acoustic shear waves.
/// Unphysical values fall back to the cell's own state, for which `in` is read.
/// @returns how many values fell back.
template <int Dim, int Axis, bool Shear>
int solve_faces(const AnyEos& eos, const Row<Dim>& in, FaceValues<Dim>& left_values, int left_from,
                FaceValues<Dim>& right_values, int right_from, const FaceFlux<Dim>& out) {
  using C = Components<Dim>;
  const int count = in.count;
  const detail::StateBounds bounds(eos);
  alignas(64) double sound_left[longest_row], sound_right[longest_row], inverse[longest_row];
  const int fallen =
      detail::complete_side<Dim, Axis>(eos, bounds, in, -in.step, left_values, left_from, sound_left) +
      detail::complete_side<Dim, Axis>(eos, bounds, in, 0, right_values, right_from, sound_right);

  const detail::FaceSide<Dim> left{left_values, left_from, sound_left},
      right{right_values, right_from, sound_right};
  [[maybe_unused]] const double *modulus = in.shear + in.first, *below = modulus - in.step;
  alignas(64) double pulls[longest_row];
  const double* pull = in.beside_contact ? detail::find_pulls(in, pulls) : nullptr;
  const detail::AtRest rest(eos);
  detail::solve_along_axis<Dim, Axis>(eos, count, rest, left, right, pull, out, inverse);
  const detail::CarryingFlow flow{out.flux_of(C::rho), out.velocity_along(Axis), inverse};
  for (int t = 0; t < Dim; ++t) {
    if (t == Axis) continue;
    [[maybe_unused]] const std::size_t v = C::u + t, tau = C::s + C::stress(Axis, t);
    const detail::AlongFace along{out.flux_of(v), out.velocity_along(t), out.flux_of(C::energy)};
    if constexpr (Shear)
      detail::solve_shear_waves(count, rest, {left.of(C::rho), left.of(v), left.of(tau), below},
                                {right.of(C::rho), right.of(v), right.of(tau), modulus}, pull, flow, along);
    else
      detail::carry_velocity(count, left.of(v), right.of(v), flow, along);
  }
  for (std::size_t c = C::s; c < in.carried(); ++c)
    detail::carry(count, left.of(c), right.of(c), flow, out.flux_of(c));
  return fallen;
}

/// reconstruct() and solve_faces() for a row of faces that stands alone. @returns how many values fell back.
template <int Dim, int Axis, bool Shear>
int face_fluxes(const AnyEos& eos, const Row<Dim>& in, const FaceFlux<Dim>& out) {
  FaceValues<Dim> left, right, beyond;
  Row<Dim> cells = in;
  cells.first = in.first - in.step;
  reconstruct<Dim, Axis, Shear>(eos, cells, 0, beyond, left);
  cells.first = in.first;
  reconstruct<Dim, Axis, Shear>(eos, cells, 0, right, beyond);
  return solve_faces<Dim, Axis, Shear>(eos, in, left, 0, right, 0, out);
}

}  // namespace recoil
