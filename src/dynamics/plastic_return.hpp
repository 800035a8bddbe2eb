#pragma once

#include <cstdint>

#include "dynamics/stress_invariants.hpp"
#include "state/body.hpp"

namespace recoil {

/// Radial return of the deviators of one body in one block after a substage of length dt: scales S to the
/// yield surface, raises ep, and books the plastic heating. The rate of Johnson-Cook is dep/dt of this
/// substage. Energy, momentum and mass do not change: S and ep carry no budget. Matter that can fail takes
/// damage by the way, up to `most_damage`, and what has failed bears no tension (dynamics/failed_matter.hpp).
template <int Dim>
void return_to_yield(const State<Dim>& state, Body<Dim>& body, int slot, double dt, BlockLedger<Dim>& ledger,
                     double most_damage = 1);

/// Sets what damage has grown beyond 1 in the stages of a step (Stage::most_damage) to 1.
template <int Dim>
void bound_damage(const State<Dim>& state, Body<Dim>& body, int slot);

/// Lets the matter of one body in one block fail whose damage model has no rate (fails_at_once()), by the
/// contents at the end of a step.
template <int Dim>
void fail_at_once(const State<Dim>& state, Body<Dim>& body, int slot, BlockLedger<Dim>& ledger);

/// At the end of a step, after moves and exchanges along surfaces: what came to a cell of failed matter has
/// failed as well, as long as it would be in tension there. Matter whose damage model has no rate fails by
/// its own state now, in cells that are half full: smaller fragments are merged with others in the next step.
template <int Dim>
void fail_what_moved(const State<Dim>& state, Body<Dim>& body, int slot, BlockLedger<Dim>& ledger);

/// What return_to_yield(), fail_at_once() and crush_pores() do to the contents of one fragment of a volume,
/// after dt [s].
template <int Dim>
void return_fragment(const Body<Dim>& body, Contents<Dim>& contents, double volume, double dt);

/// Crushes pores: the states of porous matter in one block that are beyond the crush curve come back to it,
/// at their density and energy (Porous::crush). Distensions out of bounds are set to them and counted
/// (clamped-distensions).
template <int Dim>
void crush_pores(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters);

/// Sets plastic strain and plastic heating below zero to zero. They carry no budget.
/// @returns in how many fragments the strain was below -1e-6 or the heating below -1e-3 K.
template <int Dim>
std::int64_t clear_negative_strain(const State<Dim>& state, Body<Dim>& body, int slot);

/// The convex combination of a Runge-Kutta stage (Shu & Osher 1988): Q, V = old_weight (Q, V)_old + (1 -
/// old_weight) (Q, V), in the cells of BodyBlock::reach; exact where nothing has changed, and nothing has
/// beyond.
template <int Dim>
void combine_with_old(const State<Dim>& state, Body<Dim>& body, int slot, double old_weight);

}  // namespace recoil
