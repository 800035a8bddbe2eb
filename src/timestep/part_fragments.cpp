#include "timestep/part_fragments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include "cutcell/leaving.hpp"
#include "dynamics/primitives.hpp"
#include "gauge/fragments/fragments.hpp"
#include "parallel/archive.hpp"
#include "state/places.hpp"
#include "timestep/phases.hpp"

namespace recoil {

namespace {

using enum Field;

constexpr long steps_between = 4;
constexpr int least_across = 4;         // cells; smaller fragments stay where they are
constexpr double near_cells = 8;        // [dx] between the boxes of two fragments
constexpr double surface_cells = 1.5;   // [dx] cells as near to a surface tell distances from it
constexpr double equally_near = 0.15;   // [dx] difference of two distances
constexpr double touching_cells = 2.5;  // [dx] from a fragment within which records of contact go with it
constexpr int halo = 8;                 // cells; phi is kept to 7.5

/// What a cell of the body that gives a fragment away holds, kept in Field::role between two steps.
enum Holds : std::uint8_t { nothing, what_stays, what_goes };

template <int Dim>
bool are_near(const Fragment<Dim>& a, const Fragment<Dim>& b, double dx) {
  for (int d = 0; d < Dim; ++d) {
    const double gap = std::max(a.lowest[d] - b.highest[d], b.lowest[d] - a.highest[d]);
    if (gap > near_cells * dx) return false;  // not where it is NaN, in periodic directions
  }
  return true;
}

/// Bodies that share the fragments of one: the body that breaks, then those that take up its fragments.
using FragmentBodies = std::vector<int>;

template <int Dim>
std::vector<FragmentBodies> fragment_bodies(const State<Dim>& state) {
  std::vector<FragmentBodies> all;
  for (int m = 0; m < state.count(); ++m) {
    FragmentBodies bodies;
    for_each_part(state, m, [&](int part) { bodies.push_back(part); });
    std::stable_partition(bodies.begin(), bodies.end(), [&](int part) { return part == m; });
    if (bodies.size() > 1) all.push_back(std::move(bodies));
  }
  return all;
}

/// Says to which of the bodies each of their fragments shall belong. @returns how many find none.
template <int Dim>
std::int64_t choose_bodies(const std::vector<Fragment<Dim>>& list, const FragmentBodies& bodies, double dx,
                           std::vector<int>& body_of) {
  std::int64_t without = 0;
  std::vector<std::size_t> pieces;
  for (std::size_t k = 0; k < list.size(); ++k)
    if (list[k].piece && list[k].cells >= power<Dim>(least_across) &&
        std::ranges::find(bodies, list[k].body) != bodies.end())
      pieces.push_back(k);
  std::ranges::stable_sort(pieces, [&](std::size_t a, std::size_t b) { return list[a].mass > list[b].mass; });
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Fragment<Dim>& f = list[pieces[p]];
    const auto taken = [&](int body) {
      for (std::size_t q = 0; q < p; ++q)
        if (body_of[pieces[q]] == body && are_near(list[pieces[q]], f, dx)) return true;
      return false;
    };
    if (!taken(f.body)) continue;
    const auto holds_any_near = [&](int body) {
      return std::ranges::any_of(
          pieces, [&](std::size_t q) { return body_of[q] == body && are_near(list[q], f, dx); });
    };
    auto other = std::ranges::find_if(bodies, [&](int body) { return !holds_any_near(body); });
    if (other == bodies.end()) other = std::ranges::find_if(bodies, [&](int body) { return !taken(body); });
    if (other != bodies.end())
      body_of[pieces[p]] = *other;
    else
      ++without;
  }
  return without;
}

/// Cells near a surface, by which distances from it are told.
template <int Dim>
struct SurfaceCells {
  struct Cell {
    Vec<Dim> x;
    double phi;
  };
  std::vector<Cell> cells;

  /// Distance [m] of a place outside: of the balls of radius -phi about cells, which lie within the body (or
  /// end at its surface, where phi is positive), the nearest.
  double from(const Vec<Dim>& x, double far) const {
    double least = far;
    for (const Cell& c : cells) {
      const Vec<Dim> way = x - c.x;
      const double reach = least - c.phi;
      if (reach > 0 && dot(way, way) < reach * reach) least = norm(way) + c.phi;
    }
    return least;
  }
};

/// What changes in one block where a fragment goes from one body to another.
template <int Dim>
struct Change {
  std::vector<double> phi_from, phi_to;  // m; empty: nothing changes here
  std::vector<std::uint8_t> touches;     // whether records of contact go with the fragment
};

/// Moves all fragments that go from one body to another.
template <int Dim>
class Parting {
 public:
  Parting(StepRun<Dim>& step, int from, int to)
      : step_(step), state_(step.state()), from_(from), to_(to), far_(far_cells * state_.grid().dx) {}

  void run(const Fragments<Dim>& fragments, const std::vector<int>& body_of) {
    mark(fragments, body_of);
    step_.update_copies(phi | role, {.cells = halo});
    std::vector<Change<Dim>> changes(static_cast<std::size_t>(state_.mesh.local()));
    step_.for_each_own([&](int slot, Scratch& scratch) {
      if (source().present(slot)) changes[static_cast<std::size_t>(slot)] = find_change(slot, scratch);
    });
    step_.for_each_own([&](int slot, Scratch&) {
      if (!changes[static_cast<std::size_t>(slot)].phi_from.empty())
        apply(slot, changes[static_cast<std::size_t>(slot)]);
    });
    step_.has_changed(run_fields<Dim>());
  }

 private:
  Body<Dim>& source() { return state_.bodies[static_cast<std::size_t>(from_)]; }
  Body<Dim>& target() { return state_.bodies[static_cast<std::size_t>(to_)]; }

  void mark(const Fragments<Dim>& fragments, const std::vector<int>& body_of) {
    static constexpr FieldAccess access{"mark fragments", {}, contents, role};
    step_.for_each_slot(StepPhase::moves, access, [&](int slot, Scratch&) {
      if (!source().present(slot)) return;
      BodyBlock<Dim>& b = source().at(slot);
      for (std::size_t k = 0; k < b.volume.size(); ++k) {
        const int n = fragments.at(from_, slot, static_cast<int>(k));
        const bool goes = n >= 0 && body_of[static_cast<std::size_t>(n)] == to_;
        b.role[k] = b.contents[k] == 0 ? nothing : goes ? what_goes : what_stays;
      }
    });
  }

  Change<Dim> find_change(int slot, Scratch& scratch) {
    const BodyBlock<Dim>& b = source().at(slot);
    const Grid<Dim>& grid = state_.grid(slot);
    const Window<Dim> w(state_.mesh, slot, halo);
    const auto size = static_cast<std::size_t>(w.size());
    auto* holds = scratch.take<std::uint8_t>(size);
    auto* phi_around = scratch.take<double>(size);
    const auto in = [&](int s) { return !state_.mesh.is_stand_in(s) && source().present(s); };
    w.gather([&](int s) { return in(s) ? source().at(s).role.data() : nullptr; }, std::uint8_t{nothing},
             Beyond::extend, holds);
    w.gather([&](int s) { return in(s) ? source().at(s).phi.data() : nullptr; }, far_, Beyond::extend,
             phi_around);
    Change<Dim> change;
    if (std::find(holds, holds + size, what_goes) == holds + size) return change;
    SurfaceCells<Dim> goes, stays;
    for_each(w.box(), [&](const Index<Dim>& i) {
      const int k = w.at(i);
      if (holds[k] == nothing || std::abs(phi_around[k]) > surface_cells * grid.dx) return;
      (holds[k] == what_goes ? goes : stays).cells.push_back({grid.centre(i), phi_around[k]});
    });
    change.phi_from.resize(b.phi.size());
    change.phi_to.resize(b.phi.size());
    change.touches.resize(b.phi.size());
    for_each_place(state_, slot, [&](const Index<Dim>& i, std::size_t k) {
      const double phi_here = b.phi[k], from_goes = goes.from(grid.centre(i), far_),
                   from_stays = stays.from(grid.centre(i), far_), equal = equally_near * grid.dx;
      const Holds here{b.role[k]};
      const auto beyond = [&](double distance) { return std::max(distance, std::abs(phi_here)); };
      const bool keeps = here == what_stays || (here == nothing && from_stays < from_goes + equal);
      const bool gives = here == what_goes || (here == nothing && from_goes < from_stays + equal);
      change.phi_from[k] = keeps ? phi_here : beyond(from_stays);
      change.phi_to[k] = gives ? phi_here : beyond(from_goes);
      change.touches[k] = from_goes < touching_cells * grid.dx;
    });
    return change;
  }

  void apply(int slot, const Change<Dim>& change) {
    if (!target().present(slot)) enter_block(target(), slot, state_.grid());
    BodyBlock<Dim>&a = source().at(slot), &b = target().at(slot);
    const auto own = std::uint32_t{1} << static_cast<unsigned>(from_);
    const auto new_one = std::uint32_t{1} << static_cast<unsigned>(to_);
    for_each_place(state_, slot, [&](const Index<Dim>& i, std::size_t k) {
      const double before = b.phi[k];
      b.phi[k] = std::min(before, change.phi_to[k]);
      a.phi[k] = change.phi_from[k];
      if (change.phi_to[k] < before) copy_motion(a, b, k);
      if (change.touches[k] != 0) {
        b.contact[k] |= a.contact[k] & ~new_one;
        for (Body<Dim>& other : state_.bodies)
          if (&other != &source() && &other != &target() && other.present(slot) && !other.rigid &&
              (other.at(slot).contact[k] & own) != 0)
            other.at(slot).contact[k] |= new_one;
      }
      if (a.role[k] == what_goes) move_contents(slot, i, k);
    });
  }

  void copy_motion(const BodyBlock<Dim>& a, BodyBlock<Dim>& b, std::size_t k) {
    const std::size_t n = a.volume.size();
    for (std::size_t d = 0; d < Dim; ++d) b.extension_velocity[d * n + k] = a.extension_velocity[d * n + k];
    b.lag[k] = far_;  // not known
  }

  void move_contents(int slot, const Index<Dim>& i, std::size_t k) {
    BodyBlock<Dim>&a = source().at(slot), &b = target().at(slot);
    const std::size_t n = a.volume.size();
    Contents<Dim> given = contents_of(a, static_cast<int>(k));
    auto& edges = state_.ledger[slot].edges;
    const Vec<Dim> x = state_.grid(slot).centre(i);
    book(given, x, edges[static_cast<std::size_t>(from_)]);
    for (std::size_t c = 0; c < given.size(); ++c) {
      b.contents[c * n + k] += given[c];
      a.contents[c * n + k] = 0;
      given[c] = -given[c];
    }
    book(given, x, edges[static_cast<std::size_t>(to_)]);
    b.volume[k] += a.volume[k];
    a.volume[k] = 0;
    a.lag[k] = far_;
    a.contact[k] = 0;
  }

  StepRun<Dim>& step_;
  State<Dim>& state_;
  int from_, to_;
  double far_;
};

/// What all ranks must know of the choice.
struct Choice {
  std::vector<int> body_of;               // by fragment
  std::vector<std::pair<int, int>> ways;  // from and to which bodies fragments go
  std::int64_t without = 0;               // fragments that find no body

  template <class Archive>
  void transfer(Archive& a) {
    a(body_of, ways, without);
  }
};

/// A fragment does not go where another one leaves in the same look: in cells that both cut, what it brings
/// would be taken for the other's. It goes at the next look.
template <int Dim>
void put_off(const std::vector<Fragment<Dim>>& list, Choice& choice) {
  std::set<std::pair<int, int>> ways;
  for (std::size_t k = 0; k < list.size(); ++k)
    if (list[k].body != choice.body_of[k]) ways.emplace(list[k].body, choice.body_of[k]);
  const auto is_left = [&](int body) {
    return std::ranges::any_of(ways, [&](const auto& way) { return way.first == body; });
  };
  for (const auto& way : ways)
    if (!is_left(way.second)) choice.ways.push_back(way);
  if (choice.ways.empty() && !ways.empty()) choice.ways.push_back(*ways.begin());  // they change places
  for (std::size_t k = 0; k < list.size(); ++k)
    if (std::ranges::find(choice.ways, std::pair(list[k].body, choice.body_of[k])) == choice.ways.end())
      choice.body_of[k] = list[k].body;
}

template <int Dim>
Choice choose(const std::vector<Fragment<Dim>>& list, const std::vector<FragmentBodies>& all, double dx) {
  Choice choice;
  for (const Fragment<Dim>& f : list) choice.body_of.push_back(f.body);
  for (const FragmentBodies& bodies : all) choice.without += choose_bodies(list, bodies, dx, choice.body_of);
  put_off(list, choice);
  return choice;
}

/// The choice of rank 0, on all. Collective.
template <int Dim>
Choice shared_choice(const parallel::World& world, const Fragments<Dim>& fragments,
                     const std::vector<FragmentBodies>& all, double dx) {
  parallel::Bytes bytes;
  if (world.rank() == 0) {
    parallel::ArchiveWriter archive(bytes);
    archive(choose(fragments.list, all, dx));
  }
  world.broadcast(bytes);
  parallel::Unpacker reader(bytes);
  parallel::ArchiveReader archive(reader);
  Choice choice;
  archive(choice);
  return choice;
}

}  // namespace

template <int Dim>
PartedFragments<Dim> part_fragments(State<Dim>& state, Engine& engine) {
  PartedFragments<Dim> moved;
  const bool any = std::ranges::any_of(state.bodies, [](const auto& body) { return body.fragments_of >= 0; });
  if (!any || state.step % steps_between != 0) return moved;
  const std::vector<FragmentBodies> all = fragment_bodies(state);
  const Fragments<Dim> fragments = find_fragments(state, engine.world, Connected::by_level_set);
  const Choice choice = shared_choice(engine.world, fragments, all, state.grid().dx);
  if (engine.world.rank() == 0 && !state.ledger.empty())
    state.ledger.front().counters.fragments_without_body += choice.without;
  if (choice.ways.empty()) return moved;
  StepRun<Dim> step(state, engine);
  for (const auto& [from, to] : choice.ways) Parting<Dim>(step, from, to).run(fragments, choice.body_of);
  update_bands(step);
  for (std::size_t k = 0; k < fragments.list.size(); ++k) {
    const Fragment<Dim>& f = fragments.list[k];
    if (f.body != choice.body_of[k]) moved.push_back({f.body, choice.body_of[k], f.mass, f.position});
  }
  return moved;
}

#define RECOIL_INSTANTIATE(Dim) template PartedFragments<Dim> part_fragments<Dim>(State<Dim>&, Engine&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
