#pragma once

#include <array>
#include <cstddef>

#include "state/body.hpp"

namespace recoil {

/// What a fragment of matter is like, for people.
template <int Dim>
struct PointState {
  /// Stresses that are held, and the out-of-plane ones that follow from the trace (1d: yy and zz are the
  /// same).
  static constexpr std::size_t stresses = Dim == 1 ? 3 : Dim == 2 ? 4 : 6;

  double density = 0;                          // kg/m3
  Vec<Dim> velocity;                           // m/s
  double pressure = 0;                         // Pa
  std::array<double, stresses> stress{};       // Pa, positive in tension, in the order of RunUnits::stresses
  double von_mises = 0;                        // Pa
  double plastic_strain = 0, temperature = 0;  // 1, K
  double molten = 0;                           // part that is molten
  double damage = 0;                           // 1: failed
  bool has_void = false;                       // failed matter that bears no tension
  double void_fraction = 0;                    // part of the volume
  double compression = 1;                      // density over that without pressure
  double distension = 1;                       // of porous matter: density of its solid over its own
  double thermal_energy = 0;                   // J/kg, internal without that of elastic distortion
  double unmelted = 0, melts_at = 0;           // K, temperature without latent heat, melting temperature
};

/// Of the contents of a volume > 0 with a mass > 0.
template <int Dim>
PointState<Dim> point_state(const Body<Dim>& body, const Contents<Dim>& contents, double volume);

/// The largest principal stress [Pa], positive in tension.
template <int Dim>
double largest_principal(const PointState<Dim>& state);

/// Part of a whole cell from which on a fragment's state is shown.
inline constexpr double shown_fill = 0.3;

}  // namespace recoil
