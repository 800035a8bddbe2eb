#pragma once

#include <string>

#include "config/declare/entry.hpp"

namespace recoil::config {

struct Method {
  std::string scheme = "conservative";  // conservative, ghost-fluid, seed
  std::string stages = "three";         // one, three; conservative only
  double kappa = 0.5;                   // [dx] distance at which bodies meet; seed only

  static constexpr const char* doc = "The numerical method.";
  static Entries<Method> keys() {
    return {{.name = "scheme",
             .member = &Method::scheme,
             .doc = "how surfaces are treated; conservative: cut cells that keep mass, momentum and energy; "
                    "ghost-fluid: whole cells and ghost values; seed: the scheme of the contact-separation "
                    "paper, to compare with",
             .example = R"("conservative")",
             .choices = {"conservative", "ghost-fluid", "seed"}},
            {.name = "stages",
             .member = &Method::stages,
             .doc = "scheme = \"conservative\" only: stages of a step; one: values at faces and walls of the "
                    "middle of the step; three: SSP-RK3, whose steps take up to 1.7 times the time",
             .example = R"("three")",
             .choices = {"one", "three"},
             .when = [](const Method& m) { return m.scheme == "conservative"; }},
            {.name = "kappa",
             .member = &Method::kappa,
             .most = 1,
             .positive = true,
             .doc = "scheme = \"seed\" only: bodies meet when this many cells still lie between them",
             .example = "0.5",
             .when = [](const Method& m) { return m.scheme == "seed"; }}};
  }
  void check(const TableReading& reading) const;
};

}  // namespace recoil::config
