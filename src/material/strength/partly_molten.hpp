#pragma once

#include <variant>

#include "material/strength/strength.hpp"

namespace recoil {

/// The strength of matter that melts: a model times the part that is solid. A model that has a melting
/// temperature without a curve takes that of the state. One with a curve has no strength from where melting
/// begins, by the solid part: while latent heat is taken up the temperature is that of melting, so that by
/// the temperature rounding would decide.
template <class Model>
struct PartlyMolten : Model {
  double solid = 1;            // 0 to 1
  double melts_at = infinite;  // K

  static constexpr bool temperature_dependent = true;

  PartlyMolten(const Model& model, double solid_part, double melting_temperature)
      : Model(model), solid(solid_part), melts_at(melting_temperature) {
    if constexpr (
        requires(Model & m) { m.melting_temperature; } && !requires(const Model& m) { m.melting_at(1.0); })
      if (melts_at < infinite) this->melting_temperature = melts_at;
  }

  double yield(const YieldState& s) const {
    if (!(solid > 0)) return 0;
    if constexpr (requires(const Model& m) { m.yield_of_solid(s); })
      if (melts_at < infinite) return solid < 1 ? 0.0 : Model::yield_of_solid(s);
    return solid * Model::yield(s);
  }

  /// Model::expand(), whatever it takes.
  template <class... Where>
  auto expand(const Where&... where) const requires requires(const Model& m) {
    m.expand(where...);
  }
  {
    auto all = Model::expand(where...);
    all.yield *= solid, all.by_ep *= solid, all.by_log_rate *= solid;
    return all;
  }
};

/// Yield stress [Pa] of whichever model the material has.
inline double yield(const Strength& strength, const YieldState& state, double solid, double melts_at) {
  return std::visit(
      [&]<class Model>(const Model& model) {
        return PartlyMolten<Model>(model, solid, melts_at).yield(state);
      },
      strength);
}

/// The model that PartlyMolten has below it; any other itself.
template <class Model>
struct ModelBelow {
  using type = Model;
  static constexpr bool melts = false;
};
template <class Model>
struct ModelBelow<PartlyMolten<Model>> {
  using type = Model;
  static constexpr bool melts = true;
};

/// Growth of the yield stress with plastic strain [Pa], of models in which it is constant; of others 0.
template <class Model>
constexpr double constant_hardening(const Model& s) {
  if constexpr (ModelBelow<Model>::melts)
    return s.solid * constant_hardening<typename ModelBelow<Model>::type>(s);
  else if constexpr (requires { s.hardening + 0.0; })
    return s.hardening;
  else
    return 0;
}

}  // namespace recoil
