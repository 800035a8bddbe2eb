#pragma once

#include "samples.hpp"

namespace recoil::samples {

/// Alumina of Cronin et al. (2003).
inline Material alumina() {
  Material m;
  m.name = "alumina";
  m.eos = PolynomialEos{3700, 130.95e9};
  m.strength = of(JohnsonHolmquist{})[0];
  m.damage = of(JohnsonHolmquistDamage{})[0];
  m.thermal.specific_heat = 880;
  return m;
}

}  // namespace recoil::samples
