#include "material/eos/any_eos.hpp"

#include <cstddef>
#include <variant>

#include "core/multiversion.hpp"

namespace recoil {

namespace {

template <class Model>
RECOIL_MULTIVERSION void fill_energies(const Model& model, const double* rho, const double* p,
                                       const double* crushed, std::size_t count, double* e) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) e[i] = frozen(model, crushed[i]).energy(rho[i], p[i]);
}

template <class Model>
RECOIL_MULTIVERSION void fill_wave_speeds(const Model& model, const double* rho, const double* p,
                                          const double* crushed, std::size_t count, double* c2) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) c2[i] = wave_speed_squared(frozen(model, crushed[i]), rho[i], p[i]);
}

}  // namespace

void AnyEos::energies(const double* rho, const double* p, const double* crushed, std::size_t count,
                      double* e) const {
  std::visit([=](const auto& model) { fill_energies(model, rho, p, crushed, count, e); }, eos);
}

double AnyEos::wave_speed_squared(double rho, double p, double crushed) const {
  return std::visit(
      [=](const auto& model) { return recoil::wave_speed_squared(frozen(model, crushed), rho, p); }, eos);
}

void AnyEos::wave_speeds_squared(const double* rho, const double* p, const double* crushed, std::size_t count,
                                 double* c2) const {
  std::visit([=](const auto& model) { fill_wave_speeds(model, rho, p, crushed, count, c2); }, eos);
}

}  // namespace recoil
