#pragma once

#include <tuple>
#include <type_traits>

#include "material/damage/damage_drive.hpp"
#include "state/body.hpp"

namespace recoil {

/// What is known of one field. From it follow allocation, exchange between processes, the estimate of memory,
/// checkpoints, and what happens to it when cells are refined or coarsened.
template <int Dim, class Member>
struct FieldDeclaration {
  Field id;
  const char* name;
  Member BodyBlock<Dim>::*member;
  int components;  // per cell; of lists: 1
  Lifetime lifetime;
  Extent extent;
  bool of_rigid;  // rigid bodies have it as well
  Restriction coarser;
  Prolongation finer;
  bool in_field_files;  // pictures and field files are made from it
  /// The field whose memory it takes over while it lives (the other is empty then); Field::count: its own.
  Field storage = Field::count;
  bool on_demand = false;  // allocated by the one scheme that uses it

  /// What lives from step to step is what a run goes on from.
  constexpr bool in_checkpoint() const { return lifetime == Lifetime::run; }
  /// Whether every block that the body is in has an entry for each of its cells.
  constexpr bool allocated() const {
    return extent == Extent::cells && storage == Field::count && !on_demand;
  }
};

template <int Dim, class Member>
FieldDeclaration(Field, const char*, Member BodyBlock<Dim>::*, int, Lifetime, Extent, bool, Restriction,
                 Prolongation, bool) -> FieldDeclaration<Dim, Member>;

/// All fields of a body, in the order in which they are exchanged and kept.
template <int Dim>
constexpr auto field_declarations() {
  using C = Components<Dim>;
  using B = BodyBlock<Dim>;
  using enum Lifetime;
  using enum Extent;
  using R = Restriction;
  using P = Prolongation;
  using Doubles = FieldDeclaration<Dim, FieldArray<double>>;
  return std::tuple{
      // The state: Q [per Components::contents], V, phi [m] negative inside; phi's velocity in the last step
      // [m/s], how far it stayed behind V [m], far if not known; a bit for every body that was touched then.
      FieldDeclaration{Field::contents, "contents", &B::contents, C::contents, run, cells, false, R::sum,
                       P::conservative, true},
      FieldDeclaration{Field::volume, "volume", &B::volume, 1, run, cells, false, R::sum, P::conservative,
                       true},
      FieldDeclaration{Field::phi, "phi", &B::phi, 1, run, cells, true, R::mean, P::linear, true},
      FieldDeclaration{Field::extension_velocity, "extension_velocity", &B::extension_velocity, Dim, run,
                       cells, false, R::mean, P::copy, false},
      FieldDeclaration{Field::lag, "lag", &B::lag, 1, run, cells, false, R::mean, P::copy, false},
      FieldDeclaration{Field::contact, "contact", &B::contact, 1, run, cells, false, R::any, P::copy, true},
      // Kept for the Runge-Kutta mean; allocated where a step has several stages.
      Doubles{Field::contents_old, "contents_old", &B::contents_old, C::contents, step, cells, false,
              R::finest_only, P::finest_only, false, Field::count, true},
      Doubles{Field::volume_old, "volume_old", &B::volume_old, 1, step, cells, false, R::finest_only,
              P::finest_only, false, Field::count, true},
      // phi half a step on; then, in its memory, the phi that a phase finds for swap_phi().
      FieldDeclaration{Field::phi_midstep, "phi_midstep", &B::phi_midstep, 1, step, cells, true,
                       R::finest_only, P::finest_only, false},
      Doubles{Field::phi_next, "phi_next", &B::phi_next, 1, step, cells, false, R::finest_only,
              P::finest_only, false, Field::phi_midstep},
      // Primitives of the averages of donors; then, in their memory, what reconstructions read.
      FieldDeclaration{Field::average, "average", &B::average, C::primitives, stage, cells, false,
                       R::finest_only, P::finest_only, false},
      Doubles{Field::stencil, "stencil", &B::stencil, C::primitives, stage, cells, false, R::mean, P::linear,
              false, Field::average},
      FieldDeclaration{Field::role, "role", &B::role, 1, step, cells, false, R::finest_only, P::finest_only,
                       false},
      // Mid-step, with surfaces shared where bodies touch: for the stages; of the step's end: for moves.
      FieldDeclaration{Field::geometry, "geometry", &B::geometry, 1, step, cells, true, R::finest_only,
                       P::finest_only, true},
      FieldDeclaration{Field::end_geometry, "end_geometry", &B::end_geometry, 1, step, cells, true,
                       R::finest_only, P::finest_only, false},
      FieldDeclaration{Field::walls, "walls", &B::walls, 1, step, cuts, false, R::finest_only, P::finest_only,
                       true},
      FieldDeclaration{Field::donors, "donors", &B::donors, 1, step, cuts, false, R::finest_only,
                       P::finest_only, false},
      FieldDeclaration{Field::ghosts, "ghosts", &B::ghosts, 1, step, cuts, false, R::finest_only,
                       P::finest_only, false},
      FieldDeclaration{Field::updates, "updates", &B::updates, 1, stage, cuts, false, R::finest_only,
                       P::finest_only, false},
      // Sum over the stages of the classical Runge-Kutta rule; allocated by it.
      Doubles{Field::contents_sum, "contents_sum", &B::contents_sum, C::contents, step, cells, false,
              R::finest_only, P::finest_only, false, Field::count, true},
      // Fluxes through the sides beyond which cells are coarser, of the last stage.
      Doubles{Field::rims, "rims", &B::rims, 1, stage, rims, false, R::finest_only, P::finest_only, false,
              Field::count, true},
      // What damage grows by, to be averaged over cells around (DamageDrive); allocated by what averages it.
      Doubles{Field::damage_drive, "damage_drive", &B::damage_drive, DamageDrive::components, stage, cells,
              false, R::finest_only, P::finest_only, false, Field::count, true}};
}

/// Made by the compiler: a step goes through them some 50 times.
template <int Dim>
inline constexpr auto declared_fields = field_declarations<Dim>();

/// Calls f(declaration) for every field.
template <int Dim, class F>
constexpr void for_each_field(F&& f) {
  std::apply([&](const auto&... declaration) { (f(declaration), ...); }, declared_fields<Dim>);
}

/// Calls f(array) for the one array of a field, or for the several of a geometry and of donors.
template <class T, class F>
void for_each_array(FieldArray<T>& field, F&& f) {
  f(field);
}
template <class T, class F>
void for_each_array(const FieldArray<T>& field, F&& f) {
  f(field);
}
template <int Dim, class F>
void for_each_array(Geometry<Dim>& field, F&& f) {
  f(field.kind);
  f(field.index);
  f(field.cuts);
}
template <int Dim, class F>
void for_each_array(const Geometry<Dim>& field, F&& f) {
  f(field.kind);
  f(field.index);
  f(field.cuts);
}

template <int Dim, class F>
void for_each_array(Donors<Dim>& field, F&& f) {
  f(field.cells);
  f(field.parts);
}
template <int Dim, class F>
void for_each_array(const Donors<Dim>& field, F&& f) {
  f(field.cells);
  f(field.parts);
}

/// Whether a field holds far_cells dx, not zero, where nothing of a body is.
constexpr bool usually_far(Field field) {
  return field == Field::phi || field == Field::phi_midstep || field == Field::phi_next ||
         field == Field::lag;
}

/// The fields whose declaration satisfies a condition.
template <int Dim, class Condition>
constexpr FieldSet fields_where(Condition&& condition) {
  FieldSet set;
  for_each_field<Dim>([&](const auto& d) {
    if (condition(d)) set = set | d.id;
  });
  return set;
}

/// The fields that live from step to step.
template <int Dim>
constexpr FieldSet run_fields() {
  return fields_where<Dim>([](const auto& d) { return d.lifetime == Lifetime::run; });
}

/// Bytes that a deformable body takes in each cell of its blocks, without lists of cut cells.
/// @param on_demand the fields that are allocated besides those that always are.
template <int Dim>
double bytes_per_cell(FieldSet on_demand) {
  double sum = 0;
  for_each_field<Dim>([&](const auto& d) {
    if (!d.allocated() && !on_demand.has(d.id)) return;
    const BodyBlock<Dim> none;
    for_each_array(none.*d.member, [&](const auto& array) {
      using T = typename std::remove_cvref_t<decltype(array)>::value_type;
      if constexpr (!std::is_same_v<T, CutCell<Dim>>) sum += d.components * static_cast<double>(sizeof(T));
    });
  });
  return sum;
}

}  // namespace recoil
