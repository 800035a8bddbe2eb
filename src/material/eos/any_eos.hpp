#pragma once

#include <cstddef>
#include <variant>

#include "material/eos/eos.hpp"

namespace recoil {

/// Any equation of state as one type. Kernels written for it are compiled once instead of once for each kind
/// of equation of state; where they must be fast they ask for a row of states at a time.
struct AnyEos {
  const Eos& eos;
  double rho0 = density(eos);  // kg/m3
  bool barotropic = recoil::barotropic(eos);
  const Porous* porous = std::get_if<Porous>(&eos);  // null: there are no pores

  // Single states: each call finds out anew which equation of state it is.
  double energy(double rho, double p, double crushed) const { return recoil::energy(eos, rho, p, crushed); }
  double wave_speed_squared(double rho, double p, double crushed) const;

  // `count` states, adjacent in memory. Only where there are pores is `crushed` read.
  void energies(const double* rho, const double* p, const double* crushed, std::size_t count,
                double* e) const;
  void wave_speeds_squared(const double* rho, const double* p, const double* crushed, std::size_t count,
                           double* c2) const;
};

inline double bulk_sound_speed(const AnyEos& any) { return bulk_sound_speed(any.eos); }
inline double least_sound_squared(const AnyEos& any) { return least_sound_squared(any.eos); }
inline DensityRange density_range(const AnyEos& any) { return density_range(any.eos); }

}  // namespace recoil
