#include "gauge/point_state.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <variant>

#include "dynamics/failed_matter.hpp"
#include "dynamics/plastic_return.hpp"
#include "dynamics/primitives.hpp"
#include "dynamics/stress_invariants.hpp"

namespace recoil {

template <int Dim>
PointState<Dim> point_state(const Body<Dim>& body, const Contents<Dim>& contents, double volume) {
  using C = Components<Dim>;
  PointState<Dim> p;
  const Primitives<Dim> w = std::visit(
      [&](const auto& eos) {
        Primitives<Dim> w = to_primitives<Dim>(eos, contents, volume);
        p.has_void = relieve<Dim>(eos, w);
        return w;
      },
      body.material.eos);
  p.density = w[C::rho];
  for (int d = 0; d < Dim; ++d) p.velocity[d] = w[C::u + d];
  p.pressure = w[C::p];
  double trace = 0;  // of the held part of the deviator
  for (std::size_t c = 0; c < C::stresses; ++c) {
    const bool on_diagonal = c < (Dim == 1 ? 1U : 2U);
    p.stress[c] = w[C::s + c] - (on_diagonal ? p.pressure : 0);
    if (on_diagonal) trace += w[C::s + c];
  }
  for (std::size_t c = C::stresses; c < p.stress.size(); ++c)
    p.stress[c] = -trace / (Dim == 1 ? 2 : 1) - p.pressure;
  const double mises2 = equivalent_stress_squared<Dim>(w.data() + C::s, 1);
  p.von_mises = std::sqrt(mises2);
  p.plastic_strain = w[C::ep];
  p.damage = w[C::damage];
  p.compression = p.density / rest_density(body.material.eos, w[C::crushed]);
  if (const auto* porous = std::get_if<Porous>(&body.material.eos))
    p.distension = porous->distension(w[C::crushed]);
  p.thermal_energy = contents[C::energy] / contents[C::rho] - 0.5 * dot(p.velocity, p.velocity) -
                     distortion_energy(mises2, shear_modulus(body.material), p.density);
  const double solid =
      p.has_void ? solid_fraction(body.material.eos, p.density, p.thermal_energy, w[C::crushed]) : 1.0;
  p.void_fraction = 1 - solid;
  const Melt melt = body.temperature.melt(p.density / solid, p.thermal_energy, w[C::temperature_rise]);
  p.temperature = melt.temperature, p.molten = melt.molten;
  p.unmelted = melt.unmelted, p.melts_at = melt.at;
  return p;
}

template <int Dim>
double largest_principal(const PointState<Dim>& state) {
  std::array<double, Components<Dim>::stresses> deviator;
  for (std::size_t c = 0; c < deviator.size(); ++c)
    deviator[c] = state.stress[c] + (c < (Dim == 1 ? 1U : 2U) ? state.pressure : 0);
  return largest_principal_deviator<Dim>(deviator.data(), 1) - state.pressure;
}

template double largest_principal<1>(const PointState<1>&);
template double largest_principal<2>(const PointState<2>&);
template double largest_principal<3>(const PointState<3>&);
template PointState<1> point_state<1>(const Body<1>&, const Contents<1>&, double);
template PointState<2> point_state<2>(const Body<2>&, const Contents<2>&, double);
template PointState<3> point_state<3>(const Body<3>&, const Contents<3>&, double);

}  // namespace recoil
