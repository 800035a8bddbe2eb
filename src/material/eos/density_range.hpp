#pragma once

namespace recoil {

/// Densities, as parts of that at rest, within which the scheme takes states of a material as they are;
/// beyond, they are averaged with their neighbours and counted. An equation of state with a range of its own
/// has a member `range`, or a function where it depends on the constants.
struct DensityRange {
  double least = 0.5, most = 2.5;
};

template <class Model>
constexpr DensityRange density_range(const Model& model) {
  if constexpr (requires { model.range(); })
    return model.range();
  else if constexpr (requires { model.range; })
    return model.range;
  else
    return {};
}

}  // namespace recoil
