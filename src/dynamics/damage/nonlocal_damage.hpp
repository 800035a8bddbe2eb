#pragma once

#include "core/scratch.hpp"
#include "material/damage/damage_drive.hpp"
#include "state/body.hpp"

/// Growth of damage by the mean state of the cells around (DamageAverage), in two phases: what damage grows
/// by is noted in every cell (Field::damage_drive), then averaged. The mean is taken over cells of the same
/// body and the same level that hold matter, in an order that does not depend on blocks; failed matter
/// counts with the stress that it bears. Reflecting edges mirror what is before them, open ones end it.
namespace recoil {

/// Cells of size dx [m] on each side that the mean reaches; 0 where the damage of a body grows by the cell
/// alone. @throws InternalError where it is more than DamageAverage::most_cells.
template <int Dim>
int averaged_cells(const Body<Dim>& body, double dx);
/// The most of all bodies, on the finest level.
template <int Dim>
int averaged_cells(const State<Dim>& state);

/// Notes in every cell of one body in one block what damage would grow by now; for fail_at_once_by_mean().
template <int Dim>
void note_damage_drive(const State<Dim>& state, Body<Dim>& body, int slot);

/// Makes room for Field::damage_drive of one block, without matter anywhere.
template <int Dim>
void clear_damage_drive(BodyBlock<Dim>& block) {
  block.damage_drive.assign(block.volume.size() * DamageDrive::components, 0.0);
}

/// Lets the damage of one body in one block grow by the mean of what return_to_yield() has noted, over dt
/// [s], up to `most_damage`.
template <int Dim>
void grow_by_mean(const State<Dim>& state, Body<Dim>& body, int slot, double dt, double most_damage,
                  BlockLedger<Dim>& ledger, Scratch& scratch);

/// fail_at_once() by the mean of what note_damage_drive() has noted.
template <int Dim>
void fail_at_once_by_mean(const State<Dim>& state, Body<Dim>& body, int slot, BlockLedger<Dim>& ledger,
                          Scratch& scratch);

}  // namespace recoil
