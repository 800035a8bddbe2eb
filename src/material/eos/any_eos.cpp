#include "material/eos/any_eos.hpp"

#include <cstddef>
#include <variant>

namespace recoil {

void AnyEos::energies(const double* rho, const double* p, const double* crushed, std::size_t count,
                      double* e) const {
  std::visit(
      [=](const auto& model) {
#pragma omp simd
        for (std::size_t i = 0; i < count; ++i) e[i] = frozen(model, crushed[i]).energy(rho[i], p[i]);
      },
      eos);
}

void AnyEos::sound_speeds_squared(const double* rho, const double* p, const double* crushed,
                                  std::size_t count, double* c2) const {
  std::visit(
      [=](const auto& model) {
#pragma omp simd
        for (std::size_t i = 0; i < count; ++i)
          c2[i] = frozen(model, crushed[i]).sound_speed_squared(rho[i], p[i]);
      },
      eos);
}

}  // namespace recoil
