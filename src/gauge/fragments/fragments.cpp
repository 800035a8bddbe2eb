#include "gauge/fragments/fragments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/exact_sum.hpp"
#include "gauge/fragments/fragment_cells.hpp"
#include "mesh/cell_sides.hpp"
#include "parallel/archive.hpp"

namespace recoil {

namespace {

using Cells = std::vector<std::vector<FragmentBlock>>;  // by body and slot
using Numbers = std::pair<std::int64_t, std::int64_t>;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A cell of one body.
struct Site {
  std::size_t slot = 0, cell = 0;
};

/// Whether two cells with matter that share a face are connected.
bool connected(const FragmentBlock& a, std::size_t i, const FragmentBlock& b, std::size_t j, Connected how) {
  if (!(a.phi[i] + b.phi[j] < 0)) return false;
  const Hold hold = a.hold[i];
  return how == Connected::by_level_set ||
         (hold == b.hold[j] && (hold == Hold::holds || hold == Hold::rubble));
}

/// Sets of own cells of one body, and what other processes' cells they are connected to.
template <int Dim>
class Labels {
 public:
  Labels(const Mesh<Dim>& mesh, std::vector<FragmentBlock>& blocks, Connected how)
      : mesh_(mesh),
        blocks_(blocks),
        how_(how),
        size_(static_cast<std::size_t>(mesh.grid().layout().size())),
        sets_(static_cast<std::size_t>(mesh.local()) * size_) {
    for (std::size_t slot = 0; slot < own(); ++slot)
      if (!blocks_[slot].hold.empty()) connect_block(slot);
    give_numbers();
  }
  /// Pairs of own and other cells, of which the latter are copies.
  const std::vector<std::pair<Site, Site>>& across() const { return across_; }

 private:
  std::size_t own() const { return static_cast<std::size_t>(mesh_.local()); }

  void connect_block(std::size_t slot) {
    const Box<Dim> cells = mesh_.block(static_cast<int>(slot)).cells, layout = mesh_.grid().layout();
    for_each(cells, [&](const Index<Dim>& i) {
      const Site here{slot, static_cast<std::size_t>(layout.at(i - cells.lo))};
      if (blocks_[slot].hold[here.cell] != Hold::none) connect_cell(here, i);
    });
  }

  void connect_cell(const Site& here, const Index<Dim>& i) {
    const FragmentBlock& b = blocks_[here.slot];
    bool any = false;
    Site fullest;
    std::pair best{b.fill[here.cell], -b.number[here.cell]};
    for_each_across(mesh_, static_cast<int>(here.slot), i, [&](int s, int k) {
      const Site there{static_cast<std::size_t>(s), static_cast<std::size_t>(k)};
      const FragmentBlock& o = blocks_[there.slot];
      if (o.hold.empty() || o.hold[there.cell] == Hold::none) return;
      if (connected(b, here.cell, o, there.cell, how_)) {
        any = true;
        join(here, there);
      }
      const std::pair candidate{o.fill[there.cell], -o.number[there.cell]};
      if (candidate > best) best = candidate, fullest = there;
    });
    if (!any && best.second != -b.number[here.cell]) join(here, fullest);
  }

  void join(const Site& a, const Site& b) {
    if (b.slot < own())
      sets_.join(a.slot * size_ + a.cell, b.slot * size_ + b.cell);
    else
      across_.emplace_back(a, b);
  }

  /// Every own cell gets the smallest number of its set.
  void give_numbers() {
    std::vector<std::int64_t> smallest(own() * size_, std::numeric_limits<std::int64_t>::max());
    const auto for_each_own = [&](auto&& f) {
      for (std::size_t slot = 0; slot < own(); ++slot)
        for (std::size_t k = 0; k < blocks_[slot].hold.size(); ++k)
          if (blocks_[slot].hold[k] != Hold::none)
            f(blocks_[slot].number[k], smallest[sets_.top(slot * size_ + k)]);
    };
    for_each_own([](const std::int64_t& number, std::int64_t& least) { least = std::min(least, number); });
    for_each_own([](std::int64_t& number, const std::int64_t& least) { number = least; });
  }

  const Mesh<Dim>& mesh_;
  std::vector<FragmentBlock>& blocks_;
  Connected how_;
  std::size_t size_;  // cells of a layout
  DisjointSets sets_;
  std::vector<std::pair<Site, Site>> across_;
};

/// Exact sums over a part of a fragment.
template <int Dim>
struct Part {
  std::int64_t first = 0, cells = 0;
  int body = 0;
  bool piece = false;
  ExactSum mass, failed, volume, kinetic;
  std::vector<ExactSum> momentum = std::vector<ExactSum>(Dim), place = momentum;
  Vec<Dim> lowest, highest;

  Part() {
    for (int d = 0; d < Dim; ++d) lowest[d] = infinite, highest[d] = -infinite;
  }
  void add(const Part& b) {
    first = std::min(first, b.first);
    cells += b.cells;
    piece = piece || b.piece;
    mass += b.mass, failed += b.failed, volume += b.volume, kinetic += b.kinetic;
    for (std::size_t d = 0; d < Dim; ++d) momentum[d] += b.momentum[d], place[d] += b.place[d];
    for (int d = 0; d < Dim; ++d) {
      lowest[d] = std::min(lowest[d], b.lowest[d]);
      highest[d] = std::max(highest[d], b.highest[d]);
    }
  }
  template <class Archive>
  void transfer(Archive& a) {
    a(first, cells, body, piece, mass, failed, volume, kinetic, momentum, place, lowest, highest);
  }
};

/// What one cell adds to its fragment.
template <int Dim>
void add_cell(const Grid<Dim>& grid, const BodyBlock<Dim>& b, const FragmentBlock& f, const Index<Dim>& i,
              std::size_t k, Part<Dim>& to) {
  using C = Components<Dim>;
  const std::size_t n = b.volume.size();
  const double mass = b.contents[k], damage = b.contents[C::damage * n + k];
  const Vec<Dim> x = grid.centre(i);
  double square = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    const double momentum = b.contents[(C::u + d) * n + k];
    square += momentum * momentum;
    to.momentum[d] += momentum;
    to.place[d] += mass * x[static_cast<int>(d)];
  }
  ++to.cells;
  to.piece = to.piece || f.hold[k] == Hold::holds;
  to.mass += mass;
  if (damage > 0 && damage >= failed_damage * mass) to.failed += mass;
  to.volume += b.volume[k] * f.solid[k];
  if (mass > 0) to.kinetic += 0.5 * square / mass;
  // A ball of radius |phi| about a place inside lies within the body; outside, the surface is so far inward.
  const double reach = std::clamp(-f.phi[k], -0.5 * grid.dx, 0.5 * grid.dx);
  for (int d = 0; d < Dim; ++d) {
    to.lowest[d] = std::min(to.lowest[d], x[d] - reach);
    to.highest[d] = std::max(to.highest[d], x[d] + reach);
  }
}

/// This rank's part of each fragment, by its first number here.
template <int Dim>
std::map<std::int64_t, Part<Dim>> own_parts(const State<Dim>& state, const Cells& cells) {
  std::map<std::int64_t, Part<Dim>> parts;
  const Box<Dim> layout = state.grid().layout();
  for (std::size_t m = 0; m < cells.size(); ++m)
    for (int slot = 0; slot < state.mesh.local(); ++slot) {
      const FragmentBlock& f = cells[m][static_cast<std::size_t>(slot)];
      if (f.hold.empty()) continue;
      const Box<Dim> box = state.mesh.block(slot).cells;
      Part<Dim>* part = nullptr;
      for_each(box, [&](const Index<Dim>& i) {
        const auto k = static_cast<std::size_t>(layout.at(i - box.lo));
        if (f.hold[k] == Hold::none) return;
        if (part == nullptr || part->first != f.number[k]) part = &parts[f.number[k]];
        part->first = f.number[k];
        part->body = static_cast<int>(m);
        add_cell(state.grid(slot), state.bodies[m].at(slot), f, i, k, *part);
      });
    }
  return parts;
}

template <int Dim>
double diameter_of(double volume, const Grid<Dim>& grid) {
  if (Dim == 1) return volume;
  if (Dim == 3 || grid.has_radius())
    return std::cbrt(6 / std::numbers::pi * (grid.has_radius() ? 2 * std::numbers::pi : 1) * volume);
  return 2 * std::sqrt(volume / std::numbers::pi);
}

/// The thickness of a spherical shell [m].
template <int Dim>
double thickness_of(const Part<Dim>& p) {
  if (p.highest[0] > p.lowest[0]) return p.highest[0] - p.lowest[0];
  const double radius = p.place[0].value() / p.mass.value();
  return p.volume.value() / (radius * radius);
}

template <int Dim>
Fragment<Dim> finished(const Part<Dim>& p, const Grid<Dim>& grid) {
  Fragment<Dim> f;
  f.body = p.body, f.piece = p.piece, f.first = p.first, f.cells = p.cells;
  f.mass = p.mass.value(), f.failed = p.failed.value();
  f.volume = p.volume.value(), f.kinetic = p.kinetic.value();
  f.diameter = grid.radial_power == 2 ? thickness_of(p) : diameter_of(std::max(f.volume, 0.0), grid);
  for (int d = 0; d < Dim; ++d) {
    const auto e = static_cast<std::size_t>(d);
    f.velocity[d] = p.momentum[e].value() / f.mass;
    if (grid.periodic(d)) {  // where a piece may lie on both ends of the domain
      f.position[d] = f.lowest[d] = f.highest[d] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    f.position[d] = p.place[e].value() / f.mass;
    f.lowest[d] = p.lowest[d], f.highest[d] = p.highest[d];
    if (f.highest[d] > f.lowest[d]) continue;  // what is less than half a cell everywhere has no such ball
    f.lowest[d] = f.position[d] - 0.5 * f.diameter;
    f.highest[d] = f.position[d] + 0.5 * f.diameter;
  }
  return f;
}

/// On rank 0: all parts joined. @returns to which fragment each part of a rank belongs, by its number there.
template <int Dim>
std::vector<std::pair<std::int64_t, int>> join_parts(const std::vector<parallel::Bytes>& from,
                                                     const Grid<Dim>& grid,
                                                     std::vector<Fragment<Dim>>& list) {
  std::map<std::int64_t, Part<Dim>> parts;
  std::vector<Numbers> edges;
  for (const parallel::Bytes& bytes : from) {
    parallel::Unpacker reader(bytes);
    parallel::ArchiveReader archive(reader);
    std::vector<std::pair<std::int64_t, Part<Dim>>> some;
    std::vector<Numbers> more;
    archive(some, more);
    parts.insert(some.begin(), some.end());
    edges.insert(edges.end(), more.begin(), more.end());
  }
  std::map<std::int64_t, std::size_t> place;
  std::vector<std::int64_t> numbers;
  for (const auto& entry : parts) place[entry.first] = numbers.size(), numbers.push_back(entry.first);
  DisjointSets sets(numbers.size());
  for (const auto& [a, b] : edges) sets.join(place.at(a), place.at(b));
  std::map<std::size_t, Part<Dim>> whole;  // by the set's top
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto [at, fresh] = whole.try_emplace(sets.top(k), parts.at(numbers[k]));
    if (!fresh) at->second.add(parts.at(numbers[k]));
  }
  std::vector<std::pair<Fragment<Dim>, std::size_t>> sorted;
  for (const auto& [top, part] : whole) sorted.emplace_back(finished(part, grid), top);
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    const auto key = [](const Fragment<Dim>& f) { return std::tuple(f.body, !f.piece, -f.mass, f.first); };
    return key(a.first) < key(b.first);
  });
  std::map<std::size_t, int> rank_of;
  for (const auto& [fragment, top] : sorted) {
    rank_of[top] = static_cast<int>(list.size());
    list.push_back(fragment);
  }
  std::vector<std::pair<std::int64_t, int>> found;
  for (std::size_t k = 0; k < numbers.size(); ++k) found.emplace_back(numbers[k], rank_of.at(sets.top(k)));
  return found;
}

/// The number in the list of each own cell.
template <int Dim>
void number_cells(const State<Dim>& state, const Cells& cells,
                  const std::vector<std::pair<std::int64_t, int>>& found, Fragments<Dim>& to) {
  const auto number_of = [&](std::int64_t first) {
    return std::lower_bound(found.begin(), found.end(), first,
                            [](const auto& entry, std::int64_t key) { return entry.first < key; })
        ->second;
  };
  to.number.resize(cells.size());
  for (std::size_t m = 0; m < cells.size(); ++m)
    for (std::size_t slot = 0; slot < static_cast<std::size_t>(state.mesh.local()); ++slot) {
      const FragmentBlock& f = cells[m][slot];
      std::vector<int>& number = to.number[m].emplace_back(f.hold.size(), -1);
      for (std::size_t k = 0; k < number.size(); ++k)
        if (f.hold[k] != Hold::none) number[k] = number_of(f.number[k]);
    }
}

}  // namespace

template <int Dim>
Fragments<Dim> find_fragments(const State<Dim>& state, const parallel::World& world, Connected how) {
  Cells cells = fragment_cells(state, world);
  std::vector<std::pair<std::size_t, std::vector<std::pair<Site, Site>>>> across;
  for (std::size_t m = 0; m < cells.size(); ++m)
    across.emplace_back(m, Labels<Dim>(state.mesh, cells[m], how).across());
  exchange_numbers(state, world, cells);
  std::vector<Numbers> edges;
  for (const auto& [m, sites] : across)
    for (const auto& [a, b] : sites)
      edges.emplace_back(cells[m][a.slot].number[a.cell], cells[m][b.slot].number[b.cell]);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  const auto parts = own_parts(state, cells);
  parallel::Bytes bytes;
  parallel::ArchiveWriter own(bytes);
  own(std::vector<std::pair<std::int64_t, Part<Dim>>>(parts.begin(), parts.end()), edges);
  const auto all = world.gather(bytes);
  Fragments<Dim> result;
  parallel::Bytes shared;
  if (world.rank() == 0) {
    const auto found = join_parts(all, state.grid(), result.list);
    std::vector<int> heaviest(cells.size(), -1);
    for (std::size_t k = result.list.size(); k-- > 0;)
      if (result.list[k].piece) heaviest[static_cast<std::size_t>(result.list[k].body)] = static_cast<int>(k);
    parallel::ArchiveWriter archive(shared);
    archive(found, heaviest);
  }
  world.broadcast(shared);
  parallel::Unpacker reader(shared);
  std::vector<std::pair<std::int64_t, int>> found;
  parallel::ArchiveReader archive(reader);
  archive(found, result.heaviest);
  number_cells(state, cells, found, result);
  return result;
}

template Fragments<1> find_fragments<1>(const State<1>&, const parallel::World&, Connected);
template Fragments<2> find_fragments<2>(const State<2>&, const parallel::World&, Connected);
template Fragments<3> find_fragments<3>(const State<3>&, const parallel::World&, Connected);

}  // namespace recoil
