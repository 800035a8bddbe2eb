#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "material/eos/any_eos.hpp"

/// Loops over rows of cells and faces that know neither dimension nor axis: each is compiled once, for
/// several processors (core/multiversion.hpp). Arrays are adjacent in memory along the row, and `count` long;
/// outputs do not overlap inputs unless said.
namespace recoil::detail {

/// Smallest differences that count, squared: of stresses [Pa2] and velocities [m2/s2].
inline constexpr double stress_scale = 1e8, velocity_scale = 1e-2;

/// The values of a row of cells at their low and high faces.
struct RowEnds {
  double *low, *high;
};

/// Which cells of a row are reconstructed by MP5: those whose five cells never yield; the others
/// by WENO5-Z. A cell's values do not depend on which others are in its row.
struct SmoothCells {
  const std::uint8_t* smooth = nullptr;  // 1 where MP5 is; null: nowhere
};

/// Finds them. @param never_yields of the cells, 1 where matter never yields. @param smooth out, [count].
SmoothCells find_smooth(const std::uint8_t* never_yields, std::ptrdiff_t step, int count,
                        std::uint8_t* smooth);

/// WENO5-Z or MP5 of one array. @param step distance in memory to the next cell along the axis.
void reconstruct_plain(const double* q, std::ptrdiff_t step, int count, double least, SmoothCells cells,
                       RowEnds ends);

/// The same of the characteristic-like stress + Z u and stress - Z u with the cell's own impedance Z; then
/// back to stress and u.
void reconstruct_waves(const double* stress, const double* u, const double* impedance, std::ptrdiff_t step,
                       int count, double least, SmoothCells cells, RowEnds stress_ends, RowEnds u_ends);

/// The same for shear waves along the axis, with Z = sqrt(rho G); G [Pa] of each cell.
void reconstruct_shear_waves(const double* tau, const double* u, const double* rho,
                             const double* shear_modulus, std::ptrdiff_t step, int count, SmoothCells cells,
                             RowEnds tau_ends, RowEnds u_ends);

/// The same of the sum and the difference of two arrays; then back to the two.
void reconstruct_turned(const double* xx, const double* yy, std::ptrdiff_t step, int count, SmoothCells cells,
                        RowEnds xx_ends, RowEnds yy_ends);

/// What porous matter has lost of its distension, by the density of its solid, alpha rho, at the faces: where
/// pores are crushed the latter hardly changes, while alpha and rho do. Both values of a cell are drawn
/// towards its own, as by keep_positive(), until they are within bounds.
/// @param rho_ends of the density, which have been found before.
void reconstruct_crushed(double alpha0, double least, const double* rho, const double* crushed,
                         std::ptrdiff_t step, int count, RowEnds rho_ends, RowEnds ends);

/// Draws both face values of a cell towards its own, by the same part, until neither of a quantity that
/// cannot be negative is (Zhang & Shu, J. Comput. Phys. 229 (2010) 3091). Cells without a negative face value
/// keep their bits.
void keep_positive(const double* q, int count, RowEnds ends);

/// Which reconstructed states are used, and their longitudinal sound speed.
struct StateBounds {
  double least_rho, least_c2;  // kg/m3, m2/s2

  explicit StateBounds(const AnyEos& eos);

  /// @param own density of the average of the cell that the state belongs to.
  [[gnu::always_inline]] bool admit(double rho, double own, double c2) const {
    return (rho > 0.5 * own) & (rho < 2 * own) & (rho > least_rho) & (c2 >= least_c2);
  }
  [[gnu::always_inline]] double longitudinal_speed(double rho, double c2, double shear_modulus) const {
    return std::sqrt((c2 > least_c2 ? c2 : least_c2) + 4.0 / 3 * shear_modulus / rho);
  }
};

/// Turns the squared bulk sound speeds `sound` into longitudinal sound speeds. @param shear_modulus [Pa] of
/// each state. @returns how many states are not admitted.
int find_longitudinal_speeds(const StateBounds& bounds, const double* rho, const double* own,
                             const double* shear_modulus, int count, double* sound);

/// Between states that move slower and are under less stress than this a face lets nothing pass, so that
/// matter at rest stays at rest until a wave arrives (docs/decisions/0073). Far above rounding, which is
/// 2e-16 of the same speed and modulus, and far below all that matters.
struct AtRest {
  double speed, stress;  // m/s, Pa

  /// 1e-12 of the speed of sound and of the bulk modulus at rest.
  explicit AtRest(const AnyEos& eos);
  AtRest(double most_speed, double most_stress) : speed(most_speed), stress(most_stress) {}
};

/// Whether the absolute value of all is at most `most`; false for NaN.
bool all_within(const double* values, int count, double most);

/// One side of a row of faces: what the waves along the axis need.
struct NormalSide {
  const double *rho, *u, *stress, *p, *sound;  // u and stress along the axis, c_L
};

/// What the waves along the axis give: mass, normal momentum, S u of the energy, and the normal star
/// velocity; of the side that each face looks at its density, pressure, u^2/2 and work of the wave per mass;
/// and 1/m of that side, 0 where the whole fan goes one way; m is the mass per area and time that runs
/// through its outer wave.
struct NormalWaves {
  double *mass, *normal, *power, *speed;
  double *rho_behind, *p_behind, *kinetic, *work, *inverse;
};
/// @param pull of each face: how much of the jump of stress drives the star velocity; null: all of it. The
/// star stress takes all of the jump of velocity.
void solve_normal_waves(int count, const AtRest& rest, const NormalSide& left, const NormalSide& right,
                        const double* pull, const NormalWaves& out);

/// One side of a row of faces, and what shear waves need there.
struct ShearSide {
  const double *rho, *v, *tau, *modulus;  // modulus: shear modulus [Pa]
};

/// Mass flux, normal star velocity and `inverse` of a row of faces, as solve_normal_waves() leaves them.
struct CarryingFlow {
  const double *mass, *speed, *inverse;
};

/// Momentum and star velocity along the face; `power` gets what they add to the flux of energy.
struct AlongFace {
  double *momentum, *speed, *power;
};

/// The shear waves of a solid. @param pull see solve_normal_waves().
void solve_shear_waves(int count, const AtRest& rest, const ShearSide& left, const ShearSide& right,
                       const double* pull, const CarryingFlow& flow, const AlongFace& out);

/// A fluid carries its velocity along the face with it.
void carry_velocity(int count, const double* left, const double* right, const CarryingFlow& flow,
                    const AlongFace& out);

/// flux[i] = mass[i] times the value of the side that it comes from.
void carry(int count, const double* left, const double* right, const CarryingFlow& flow, double* flux);

/// to[i] = of the side that the face looks at.
void take_upwind(int count, const double* left, const double* right, const double* speed, double* to);

/// out[i] += low[i] below[i] - high[i] above[i]: what flows into a row of cells through two rows of faces.
void add_difference(int count, const double* low, const double* below, const double* high,
                    const double* above, double* out);

/// out[i] = 0 + (low[i] below[i] - high[i] above[i]): as if it had been 0, to the sign of a zero.
void set_difference(int count, const double* low, const double* below, const double* high,
                    const double* above, double* out);

/// out[i] += factor a[i].
void add_scaled(int count, double factor, const double* a, double* out);

/// out[i] = a[i] + b[i].
void add_rows(int count, const double* a, const double* b, double* out);

/// now[i] += weight (old[i] - now[i]).
void mix(int count, double weight, const double* old, double* now);

/// Turns squared bulk sound speeds, at least `least`, into impedances rho c_L of longitudinal waves.
/// @param shear_modulus [Pa] of each cell.
void find_impedances(int count, const double* rho, double least, const double* shear_modulus,
                     double* impedance);

}  // namespace recoil::detail
