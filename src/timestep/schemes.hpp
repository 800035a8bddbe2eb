#pragma once

#include <string>

#include "timestep/step.hpp"

namespace recoil {

/// How a scheme starts, and its step.
template <int Dim>
struct Scheme {
  void (*prepare)(State<Dim>&, Engine&);
  double (*advance)(State<Dim>&, const Stepping&, double until, Engine&);
};

/// The scheme of a value of `method.scheme`: conservative, ghost-fluid or seed. Asked for once per run.
/// @throws InternalError for another name.
template <int Dim>
Scheme<Dim> scheme_of(const std::string& name);

}  // namespace recoil
