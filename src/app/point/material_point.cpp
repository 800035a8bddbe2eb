#include "app/point/material_point.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.hpp"
#include "dynamics/plastic_return.hpp"
#include "material/starting_state.hpp"

namespace recoil::app {

namespace {

using C = Components<3>;

constexpr int corrections = 4;  // of the work by the stress that it leads to: each gains some three digits

Tensor product(const Tensor& a, const Tensor& b) {
  Tensor c;
  for (std::size_t i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[static_cast<std::size_t>(k)][j];
  return c;
}

Tensor transposed(const Tensor& a) {
  Tensor b;
  for (int i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) b[j][i] = a[static_cast<std::size_t>(i)][static_cast<int>(j)];
  return b;
}

double trace(const Tensor& a) { return a[0][0] + a[1][1] + a[2][2]; }

/// exp(W dt) of the antisymmetric part of a gradient: Rodrigues' formula.
Tensor rotation(const Tensor& l, double dt) {
  const Vec<3> angle = 0.5 * dt * Vec<3>{{l[2][1] - l[1][2], l[0][2] - l[2][0], l[1][0] - l[0][1]}};
  const double size = norm(angle);
  Tensor turn{Vec<3>{{1, 0, 0}}, Vec<3>{{0, 1, 0}}, Vec<3>{{0, 0, 1}}};
  if (size == 0) return turn;
  const Tensor w{Vec<3>{{0, -angle[2], angle[1]}}, Vec<3>{{angle[2], 0, -angle[0]}},
                 Vec<3>{{-angle[1], angle[0], 0}}};
  const Tensor square = product(w, w);
  const double by_sine = std::sin(size) / size, half = std::sin(0.5 * size) / size;
  for (std::size_t i = 0; i < 3; ++i) turn[i] += by_sine * w[i] + 2 * half * half * square[i];
  return turn;
}

/// The deviator after dt of equation (4): half of the distortion, the rotation, the other half.
Tensor distorted(Tensor s, const Tensor& l, double dt, double shear_modulus) {
  const Tensor back = transposed(l);
  const auto distort = [&] {
    for (std::size_t i = 0; i < 3; ++i) {
      s[i] += 0.5 * shear_modulus * dt * (l[i] + back[i]);
      s[i][static_cast<int>(i)] -= shear_modulus * dt * trace(l) / 3;
    }
  };
  distort();
  const Tensor turn = rotation(l, dt);
  s = product(product(turn, s), transposed(turn));
  distort();
  return s;
}

Tensor deviator(const Contents<3>& contents) {
  Tensor s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int c = C::stress(i, j);
      const double sum = c < 0 ? -(contents[C::s] + contents[C::s + 1])
                               : contents[static_cast<std::size_t>(C::s) + static_cast<std::size_t>(c)];
      s[static_cast<std::size_t>(i)][j] = sum / contents[C::rho];
    }
  return s;
}

void set_deviator(Contents<3>& contents, const Tensor& s) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      if (const int c = C::stress(i, j); c >= 0)
        contents[static_cast<std::size_t>(C::s + c)] = contents[C::rho] * s[static_cast<std::size_t>(i)][j];
}

/// Shear modulus [Pa] of the state before an increment.
double modulus_of(const Material& m, const PointState<3>& p) {
  if (!modulus_follows(m.strength)) return shear_modulus(m);
  return shear_modulus(m.strength,
                       {.temperature = p.temperature, .pressure = p.pressure, .compression = p.compression});
}

/// sigma:D, which is sigma:L.
double power(const Tensor& stress, const Tensor& l) {
  return dot(stress[0], l[0]) + dot(stress[1], l[1]) + dot(stress[2], l[2]);
}

}  // namespace

MaterialPoint::MaterialPoint(const Material& material, std::optional<double> pressure,
                             std::optional<double> temperature) {
  Body<3> body;
  body.name = material.name;
  body.material = material;
  body.temperature = temperature_law(material);
  const StartingState start = state_at_start(material, pressure, temperature, material.name);
  body_ = std::make_shared<const Body<3>>(std::move(body));
  contents_[C::rho] = start.density;
  contents_[C::energy] = start.density * start.energy;
  contents_[C::temperature_rise] = start.density * start.heat;
}

void MaterialPoint::check_density() const {
  const Eos& eos = body_->material.eos;
  const DensityRange range = density_range(eos);
  const double rho = contents_[C::rho] / volume_;
  if (rho < largest_density(eos) && rho > range.least * density(eos)) return;
  throw PhysicsError(
      fmt::format("{}: the equation of state ends at {:.5g} kg/m3 and {:.5g} kg/m3, not at {:.5g} kg/m3",
                  body_->name, range.least * density(eos), largest_density(eos), rho));
}

void MaterialPoint::advance(const Tensor& l, double dt) {
  const Contents<3> before = contents_;
  const double volume = volume_, power_before = volume * power(stress(), l);
  const double modulus = modulus_of(body_->material, state());
  volume_ *= std::exp(trace(l) * dt);
  check_density();
  Contents<3> trial = before;
  set_deviator(trial, distorted(deviator(before), l, dt, modulus));
  double work = dt * power_before;
  for (int k = 0; k < corrections; ++k) {
    contents_ = trial;
    contents_[C::energy] = before[C::energy] + work;
    return_fragment(*body_, contents_, volume_, dt);
    work = 0.5 * dt * (power_before + volume_ * power(stress(), l));
  }
}

double MaterialPoint::internal_energy() const { return contents_[C::energy] / contents_[C::rho]; }

Tensor MaterialPoint::stress() const {
  const PointState<3> p = state();  // of failed matter in tension: none
  const auto& s = p.stress;         // xx, yy, xy, xz, yz, zz
  return {Vec<3>{{s[0], s[2], s[3]}}, Vec<3>{{s[2], s[1], s[4]}}, Vec<3>{{s[3], s[4], s[5]}}};
}

}  // namespace recoil::app
