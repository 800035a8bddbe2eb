#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/exact_sum.hpp"
#include "core/exact_vec.hpp"
#include "field/window.hpp"
#include "material/material.hpp"
#include "state/contact_list.hpp"
#include "state/cut_cell.hpp"
#include "state/detonation_front.hpp"
#include "state/rigid_motion.hpp"
#include "state/surface_load.hpp"

namespace recoil {

/// What a cell's fragment serves as; fixed for a step.
enum Role : std::uint8_t {
  donates = 1,           // V > 0.3 full: takes part in fits
  regular = 2,           // V >= 0.5 full: its average stands in stencils
  valued = 4,            // has a value for stencils
  has_bad_contents = 8,  // inadmissible
  opens = 16             // mostly void: the level set opens here
};

/// One body in one block; fields are empty where the body is not. What is known of each field stands in
/// state/fields.hpp.
template <int Dim>
struct BodyBlock {
  bool present = false;
  bool near_surface = false;  // some cell within the reach of the surface
  Box<Dim> reach{};   // cells with phi < 5.5 dx or with matter: where surfaces and moves may matter in a step
  Box<Dim> matter{};  // cells that the mid-step geometry or V gives to the body; may be empty

  FieldArray<double> contents{Field::contents};
  FieldArray<double> volume{Field::volume};
  FieldArray<double> phi{Field::phi};
  FieldArray<double> extension_velocity{Field::extension_velocity};
  FieldArray<double> lag{Field::lag};
  FieldArray<std::uint32_t> contact{Field::contact};
  FieldArray<double> contents_old{Field::contents_old};
  FieldArray<double> volume_old{Field::volume_old};
  FieldArray<double> phi_midstep{Field::phi_midstep};
  FieldArray<double> phi_next{Field::phi_next};
  FieldArray<double> average{Field::average};
  FieldArray<double> stencil{Field::stencil};
  FieldArray<std::uint8_t> role{Field::role};
  Geometry<Dim> geometry{Field::geometry};
  Geometry<Dim> end_geometry{Field::end_geometry};
  FieldArray<Wall<Dim>> walls{Field::walls};
  Donors<Dim> donors{Field::donors};
  FieldArray<GhostCell<Dim>> ghosts{Field::ghosts};
  FieldArray<Update<Dim>> updates{Field::updates};
  FieldArray<double> contents_sum{Field::contents_sum};
  FieldArray<double> rims{Field::rims};  // RimFluxes
  FieldArray<double> damage_drive{Field::damage_drive};
};

template <int Dim>
struct Body {
  std::string name;
  Material material;           // not used by rigid bodies
  TemperatureLaw temperature;  // of the material
  std::optional<RigidMotion<Dim>> rigid;
  std::optional<DetonationFront<Dim>> detonation;
  int fragments_of = -1;               // the body whose fragments it takes up; -1: it began with matter
  std::vector<BodyBlock<Dim>> blocks;  // by slot

  BodyBlock<Dim>& at(int slot) { return blocks[slot]; }
  const BodyBlock<Dim>& at(int slot) const { return blocks[slot]; }
  bool present(int slot) const { return at(slot).present; }
};

/// What is counted because it should not happen, or only in extreme cases. Reported in summary.json.
struct Counters {
  std::int64_t first_order_faces = 0, faces_without_value = 0, cuts_without_donor = 0,
               ghosts_without_wall = 0, averages_kept = 0, fragments_too_thin = 0,
               real_cells_without_contents = 0, uncovered_cells_without_value = 0, clamped_fit_densities = 0,
               clamped_ghost_densities = 0, averaged_states = 0, wide_neighbourhoods = 0,
               widest_neighbourhoods = 0, unmerged_fragments = 0, lone_fragments_moved = 0, capped_speeds = 0,
               volume_bounds = 0, volume_bounds_left = 0, floored_sound_speeds = 0, contacts_lost = 0,
               opened_cells = 0, restored_cells = 0, torn_states = 0, faces_of_dust = 0, cuts_of_dust = 0,
               cleared_strains = 0, clamped_damage = 0, clamped_distensions = 0, flat_refinements = 0,
               faces_at_open_edges = 0, pushed_contacts = 0, fragments_without_body = 0;

  Counters& operator+=(const Counters& b);
  /// Name and count of each, in a fixed order.
  std::vector<std::pair<const char*, std::int64_t*>> list();
};

/// What passed between two bodies, or through the edges of the domain, since the start.
template <int Dim>
struct Account {
  double mass = 0, energy = 0;
  Vec<Dim> momentum;
};

/// What has left through the edges of the domain, and from where.
template <int Dim>
struct EdgeAccount : Account<Dim> {
  Vec<Dim> place;  // kg m, sum of m x
};

/// The same while it is summed up, cell by cell or contact by contact.
template <int Dim>
struct ExactAccount {
  ExactSum mass, energy;
  ExactVec<Dim> momentum;

  bool is_zero() const { return mass.is_zero() && energy.is_zero() && momentum.is_zero(); }
  Account<Dim> value() const { return {mass.value(), energy.value(), momentum.value()}; }
  ExactAccount& operator+=(const ExactAccount& b) {
    mass += b.mass, energy += b.energy, momentum += b.momentum;
    return *this;
  }
};

template <int Dim>
struct ExactEdgeAccount : ExactAccount<Dim> {
  ExactVec<Dim> place;

  /// Adds mass that leaves at a place [m].
  void leave(double lost, const Vec<Dim>& at) {
    this->mass += lost;
    place += lost * at;
  }
  ExactEdgeAccount& operator+=(const ExactEdgeAccount& b) {
    ExactAccount<Dim>::operator+=(b);
    place += b.place;
    return *this;
  }
};

/// What one block adds to the record of a pair of bodies in one step, and since the start.
template <int Dim>
struct PairRecord {
  ExactAccount<Dim> exchanged;                 // received by the lower-numbered body [per time-integrated]
  ExactSum area;                               // in contact, last stage [m^(Dim-1)]
  ExactVec<Dim> force;                         // on the lower-numbered body, last stage
  ExactSum traction, velocity, gap;            // area-weighted sums, last stage
  ExactVec<Dim> place;                         // area-weighted sum of x_I
  ExactVec<3> moment;                          // as exchanged.momentum, about the origin [N m s]
  double widest_gap = 0, deepest_overlap = 0;  // in dx, at touching cells, last stage
};

/// The first failure of one body in one block.
template <int Dim>
struct FailureRecord {
  double time = std::numeric_limits<double>::infinity();  // s, start of the step
  Index<Dim> cell{};                                      // of those that failed in it: see merge()

  void note(double now, const Index<Dim>& i) { merge({now, i}); }
  /// Keeps the earlier one; of the same time that of the cell which comes first along the last axis.
  void merge(const FailureRecord& b) {
    bool before = b.time < time;
    if (b.time == time && std::isfinite(time))
      before =
          std::lexicographical_compare(b.cell.c.rbegin(), b.cell.c.rend(), cell.c.rbegin(), cell.c.rend());
    if (before) *this = b;
  }
};

/// What the loads on a body's surface have given it in one block since the start.
template <int Dim>
struct LoadRecord {
  ExactAccount<Dim> received;
  ExactVec<3> moment;  // as received.momentum, about the origin [N m s]

  LoadRecord& operator+=(const LoadRecord& b) {
    received += b.received, moment += b.moment;
    return *this;
  }
};

/// What one block has seen, so that threads need not share it. Sums over blocks do not depend on how cells
/// are divided between them.
template <int Dim>
struct BlockLedger {
  std::vector<PairRecord<Dim>> pairs;        // by pair_number
  std::vector<ExactEdgeAccount<Dim>> edges;  // by body: what left through the edges of the domain
  std::vector<FailureRecord<Dim>> failures;  // by body
  std::vector<ExactSum> released;            // by body: energy of detonation [J]
  std::vector<LoadRecord<Dim>> loads;        // by body; empty in a state without loads
  Counters counters;
};

/// What holds where two bodies meet.
struct ContactLaw {
  enum class Mode : std::uint8_t {
    separable,  // pressed together or apart, never pulled; no shear
    bonded,     // glued once they have touched: neither parts nor slides
    friction    // separable, with Coulomb friction
  };
  Mode mode = Mode::separable;
  double coefficient = 0;  // of friction
};

/// Everything that a run advances.
template <int Dim>
struct State {
  Mesh<Dim> mesh;
  std::vector<Body<Dim>> bodies;
  std::vector<BlockLedger<Dim>> ledger;      // by local slot
  std::vector<ContactLaw> contact;           // by pair_number
  std::vector<ContactList<Dim>> contacts{};  // of the latest stage, by local slot
  double time = 0;                           // s
  long step = 0;
  double travel = 0;  // of surfaces since the last full redistancing [m]
  FieldSet stale{};   // fields that have changed since this process last got copies of others' blocks
  std::vector<SurfaceLoad<Dim>> loads{};

  /// The cells of the finest level, and of the level of a block.
  const Grid<Dim>& grid() const { return mesh.grid(); }
  const Grid<Dim>& grid(int slot) const { return mesh.grid(slot); }
  int count() const { return static_cast<int>(bodies.size()); }
};

/// f(number) for a body and those that take up its fragments.
template <int Dim, class F>
void for_each_part(const State<Dim>& state, int body, F&& f) {
  for (int m = 0; m < state.count(); ++m)
    if (m == body || state.bodies[m].fragments_of == body) f(m);
}

/// At most this many bodies: a cell's partners are bits of one word.
inline constexpr int most_bodies = 32;

/// Number of the pair a < b among all pairs of n bodies.
constexpr int pair_number(int a, int b, int n) { return a * (2 * n - a - 1) / 2 + b - a - 1; }

/// Makes room for a body in a block, with nothing of it there: no volume, phi = far.
template <int Dim>
void enter_block(Body<Dim>& body, int slot, const Grid<Dim>& grid);
template <int Dim>
void leave_block(Body<Dim>& body, int slot);

/// BodyBlock::reach holds the cells up to this far outside [cells].
inline constexpr double reach_cells = 5.5;
/// Beyond this distance phi is not kept: it is +far or -far there [cells]. A block without nearer cells need
/// not hold the body, so cells beyond must look the same whether their block holds it or not.
inline constexpr double far_cells = 7.5;

/// Grows a box to hold one more cell.
template <int Dim>
void extend(Box<Dim>& box, const Index<Dim>& i) {
  const bool empty = box.size() == 0;
  for (int d = 0; d < Dim; ++d) {
    if (empty || i[d] < box.lo[d]) box.lo[d] = i[d];
    if (empty || i[d] >= box.hi[d]) box.hi[d] = i[d] + 1;
  }
}

/// Puts a block's updates in place.
template <int Dim>
void apply_updates(BodyBlock<Dim>& block);

}  // namespace recoil
