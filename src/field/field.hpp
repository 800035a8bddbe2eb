#pragma once

#include <bit>
#include <cstdint>

namespace recoil {

/// The fields that a body has on its blocks. What each is, how long it lives and what follows from that:
/// state/fields.hpp.
enum class Field : std::uint8_t {
  contents,
  volume,
  phi,
  extension_velocity,
  lag,
  contact,
  contents_old,
  volume_old,
  phi_midstep,
  phi_next,
  average,
  stencil,
  role,
  geometry,
  end_geometry,
  walls,
  donors,
  ghosts,
  updates,
  contents_sum,
  rims,
  damage_drive,
  count
};

/// A set of fields.
class FieldSet {
 public:
  constexpr FieldSet() = default;
  constexpr FieldSet(Field field) : bits_(1U << static_cast<unsigned>(field)) {}  // NOLINT: one is a set
  static constexpr FieldSet all() { return FieldSet((1U << static_cast<unsigned>(Field::count)) - 1); }

  constexpr bool has(Field field) const { return (bits_ & FieldSet(field).bits_) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr int size() const { return std::popcount(bits_); }
  friend constexpr FieldSet operator|(FieldSet a, FieldSet b) { return FieldSet(a.bits_ | b.bits_); }
  friend constexpr FieldSet operator&(FieldSet a, FieldSet b) { return FieldSet(a.bits_ & b.bits_); }
  /// What is in a but not in b.
  friend constexpr FieldSet operator-(FieldSet a, FieldSet b) { return FieldSet(a.bits_ & ~b.bits_); }
  friend constexpr bool operator==(FieldSet a, FieldSet b) = default;

 private:
  constexpr explicit FieldSet(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;
};
constexpr FieldSet operator|(Field a, Field b) { return FieldSet(a) | FieldSet(b); }

/// How long the values of a field mean something.
enum class Lifetime : std::uint8_t {
  run,   // from one step to the next: it is part of the state
  step,  // within a step
  stage  // within a stage of the time integration
};

/// What a field has entries for.
enum class Extent : std::uint8_t {
  cells,  // every cell of every block that the body is in
  cuts,   // the cut cells of blocks near the surface, and what belongs to them
  rims    // the faces at the sides of blocks beyond which the cells are coarser
};

/// How a cell gets its value from the 2^Dim finer cells in its place.
enum class Restriction : std::uint8_t {
  sum,         // extensive: the sum
  mean,        // the mean
  any,         // bits: those that any has
  finest_only  // never: exists on the finest level only, or is found anew
};

/// How finer cells get their values from the one that they replace.
enum class Prolongation : std::uint8_t {
  conservative,  // limited parabolas along each axis, the parent's sum kept
  linear,        // limited parabolas
  copy,          // the parent's value
  finest_only    // never
};

/// What a phase of a step does to the fields. It may read what it lists in its own block, what is in `around`
/// in the blocks around as well, and writes only its own block's `writes`. Copies of other processes' blocks
/// are brought up to date for `around` before it runs.
struct FieldAccess {
  const char* phase = "";
  FieldSet around, reads, writes;

  constexpr FieldSet touched() const { return around | reads | writes; }
};

}  // namespace recoil
