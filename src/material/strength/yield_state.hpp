#pragma once

namespace recoil {

/// What a yield stress may depend on.
struct YieldState {
  double ep = 0;           // 1, equivalent plastic strain, >= 0
  double rate = 0;         // 1/s, its rate
  double temperature = 0;  // K; only of models that are temperature_dependent
  double pressure = 0;     // Pa, positive in compression; only of models that are pressure_dependent
  double compression = 1;  // density over that at rest; likewise
  double damage = 0;       // 0 to 1; only of models that are damage_dependent
};

}  // namespace recoil
