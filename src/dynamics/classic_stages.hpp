#pragma once

#include <array>

#include "state/body.hpp"

namespace recoil {

/// The classical fourth-order Runge-Kutta rule (Kutta 1901), stage by stage: each starts from the old state
/// again, Q_i = Q_old + length_i dt R(Q_i-1), and the step is Q_old + dt sum weight_i R_i. For cells whose
/// volume does not change.
struct ClassicStage {
  double length, weight;  // of the step
};
inline constexpr std::array<ClassicStage, 4> rk4{
    {{0.5, 1.0 / 6}, {0.5, 1.0 / 3}, {1, 1.0 / 3}, {1, 1.0 / 6}}};

/// Q = Q_old, before a stage.
template <int Dim>
void start_stage(BodyBlock<Dim>& block);

/// Adds what the stage has done, weight_i dt R_i, to BodyBlock::contents_sum, before its radial return.
template <int Dim>
void collect_stage(BodyBlock<Dim>& block, const ClassicStage& stage);

/// Q = Q_old + the sum, in place of the last stage; the sum is empty again.
template <int Dim>
void finish_stages(BodyBlock<Dim>& block);

}  // namespace recoil
