#pragma once

#include <array>
#include <cmath>

#include "material/eos/linear.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// p = K1 mu + K2 mu^2 + K3 mu^3 in compression, K1 mu in expansion, mu = rho/rho0 - 1, whatever the energy:
/// the form in which Johnson and Holmquist give their ceramics.
struct PolynomialEos {
  double rho0 = unset;    // kg/m3
  double k1 = unset;      // Pa
  double k2 = 0, k3 = 0;  // Pa

  static constexpr const char* kind = "polynomial";
  static constexpr const char* doc = "pressure a cubic of the compression, independent of energy: ceramics";
  static constexpr bool barotropic = true;

  static constexpr auto parameters() {
    using E = PolynomialEos;
    using P = Parameter<E>;
    return std::array{P{"density", "kg/m3", &E::rho0, 1, 3e4, "density at rest"},
                      P{"k1", "Pa", &E::k1, 1e5, 1e13, "bulk modulus"},
                      P{"k2", "Pa", &E::k2, -1e13, 1e14, "factor of the square of the compression"},
                      P{"k3", "Pa", &E::k3, -1e13, 1e14, "factor of its cube"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const {
    for (int i = 0; i <= 200; ++i)
      if (!(slope(0.01 * i) > 0)) return "k1, k2 and k3 give a pressure that falls with compression";
    return nullptr;
  }

  /// Pressure [Pa] at density rho [kg/m3]; the energy does not matter.
  constexpr double pressure(double rho, double /*e*/) const {
    const double mu = rho / rho0 - 1, squeezed = mu > 0 ? mu : 0.0;
    return k1 * mu + squeezed * squeezed * (k2 + k3 * squeezed);
  }

  /// The integral of p/rho^2 from rho0 [J/kg]; with L = ln x + 1/x - 1 of the linear law
  ///   rho0 e = K1 L + K2 (mu^2/x - 2 L) + K3 (3 L + mu^2 (x - 4)/(2 x)).
  constexpr double energy(double rho, double /*p*/) const {
    const double x = rho / rho0, mu = x > 1 ? x - 1 : 0.0;
    const double linear = LinearEos{rho0, 1}.energy(rho, 0), l = x > 1 ? linear : 0.0, square = mu * mu / x;
    return k1 * linear + k2 * (square / rho0 - 2 * l) + k3 * (3 * l + 0.5 * square * (x - 4) / rho0);
  }

  /// (dp/drho) [m2/s2].
  constexpr double sound_speed_squared(double rho, double /*p*/) const {
    const double mu = rho / rho0 - 1;
    return slope(mu > 0 ? mu : 0.0) / rho0;
  }

  constexpr bool admissible(double rho) const { return rho > 0.34 * rho0 && rho < largest_density(); }
  constexpr double largest_density() const { return 3 * rho0; }

 private:
  constexpr double slope(double mu) const { return k1 + mu * (2 * k2 + 3 * k3 * mu); }  // Pa
};

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const PolynomialEos& eos) { return std::sqrt(eos.k1 / eos.rho0); }

}  // namespace recoil
