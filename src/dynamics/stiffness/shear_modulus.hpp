#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dynamics/stress_invariants.hpp"
#include "state/body.hpp"

namespace recoil {

/// Densities, of that at rest, below which matter has lost some of its shear modulus, and all of it; and
/// below which matter with voids, whose pieces are solid, has.
inline constexpr double least_solid = 0.8, most_fluid = 0.6, most_dust = 0.1;

/// What is left of a shear modulus [Pa] in matter that has expanded, to `compression` of its density at rest.
/// No solid is thinner than most_fluid: with the modulus of the solid the elastic waves of vapour would run
/// the faster the thinner it is (c^2 = 4 G/(3 rho)), and hold back what expands (docs/decisions/0071). A
/// stress that is still there keeps as much, or its wave would part the matter at any speed.
/// @param with_voids they make it thin. @param s deviatoric stresses, `stride` apart.
template <int Dim>
double expanded_modulus(double modulus, double compression, bool with_voids, const double* s,
                        std::size_t stride) {
  if (compression >= (with_voids ? most_dust : least_solid) || modulus == 0) return modulus;
  constexpr double least_part = 1e-6;  // waves along a surface divide by it
  const double part = std::max((compression - most_fluid) / (least_solid - most_fluid), least_part),
               stress = std::sqrt(equivalent_stress_squared<Dim>(s, stride));
  return std::min(std::max(part * modulus, stress), modulus);
}

/// The shear modulus at rest [Pa], or what is left of it in a state.
template <int Dim>
double modulus_at(const Material& material, const Primitives<Dim>& w) {
  using C = Components<Dim>;
  const bool with_voids = w[C::damage] >= failed_damage && w[C::p] == 0;
  return expanded_modulus<Dim>(shear_modulus(material), w[C::rho] / density(material), with_voids,
                               w.data() + C::s, 1);
}

/// Shear modulus [Pa] of a state, where it follows temperature and pressure (modulus_follows()). The energy
/// of distortion, which the temperature leaves out, is taken with the modulus at rest.
template <int Dim>
double shear_modulus_of(const Body<Dim>& body, const Primitives<Dim>& w) {
  using C = Components<Dim>;
  const Eos& eos = body.material.eos;
  double e = energy(eos, w[C::rho], w[C::p], w[C::crushed]);
  if (barotropic(eos)) e += w[C::extra];
  const double square = equivalent_stress_squared<Dim>(w.data() + C::s, 1);
  e -= distortion_energy(square, shear_modulus(body.material), w[C::rho]);
  return shear_modulus(body.material.strength,
                       {.ep = std::max(w[C::ep], 0.0),
                        .temperature = body.temperature(w[C::rho], e, w[C::temperature_rise]),
                        .pressure = w[C::p],
                        .compression = w[C::rho] / rest_density(eos, w[C::crushed])});
}

/// The shear modulus [Pa] of a cell: that of its state, if it follows that, less what it loses by expanding.
/// @param w its primitives, `stride` apart.
template <int Dim>
double modulus_of_cell(const Body<Dim>& body, bool with_voids, const double* w, std::size_t stride) {
  double modulus = shear_modulus(body.material);
  if (modulus_follows(body.material.strength)) {
    Primitives<Dim> value;
    for (std::size_t c = 0; c < value.size(); ++c) value[c] = w[c * stride];
    modulus = shear_modulus_of(body, value);
  }
  return expanded_modulus<Dim>(modulus, w[0] / density(body.material), with_voids,
                               w + Components<Dim>::s * stride, stride);
}

}  // namespace recoil
