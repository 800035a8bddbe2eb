#pragma once

namespace recoil {

/// Whether matter of this kind has pores, and its state one number more.
template <class Model>
constexpr bool has_pores() {
  return requires(const Model& m) { m.frozen(0.0); };
}

/// The equation of state of matter that has lost this much of its distension (Components::crushed): as it is
/// while nothing goes on crushing. Of matter without pores the model itself, whatever the number.
template <class Model>
constexpr decltype(auto) frozen(const Model& model, [[maybe_unused]] double crushed) {
  if constexpr (has_pores<Model>())
    return model.frozen(crushed);
  else
    return (model);
}

}  // namespace recoil
