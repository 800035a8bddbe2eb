#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../parallel/session.hpp"
#include "config/document.hpp"
#include "config/read_case.hpp"
#include "material/material.hpp"
#include "problem/start.hpp"

namespace recoil {

/// A solid that stays elastic, rho 1000 kg/m3, c_L 5000 m/s.
inline Material hard_matter() {
  Material m;
  m.name = "hard";
  m.eos = LinearEos{1000, 15e9};
  m.strength = Elastic{7.5e9};
  m.thermal.specific_heat = 500;
  return m;
}

/// A case from its text. Materials are hard_matter() whatever the text says.
inline config::Case case_from(const std::string& text) {
  config::Diagnostics out;
  const config::Document document = config::parse_document(text, "small/case.toml", out);
  config::Case c = config::read_case(document, out);
  EXPECT_NO_THROW(out.throw_if_errors());
  return c;
}

template <int Dim>
State<Dim> state_of(const config::Case& c) {
  start_parallel();
  return make_state<Dim>(c, std::vector<Material>(c.bodies.size(), hard_matter()), parallel::World{});
}

}  // namespace recoil
