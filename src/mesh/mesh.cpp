#include "mesh/mesh.hpp"

#include <p4est_bits.h>
#include <p4est_extended.h>
#include <p4est_ghost.h>
#include <p8est_bits.h>
#include <p8est_extended.h>
#include <p8est_ghost.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace recoil {

namespace {

/// p4est spells its two dimensions with two prefixes; this is the whole list that we use of each.
/// A 1-d mesh is a row of trees of the 2-d library.
template <int Dim>
struct Library {
  using Forest = p4est_t;
  using Connectivity = p4est_connectivity_t;
  using Ghost = p4est_ghost_t;
  using Quadrant = p4est_quadrant_t;
  static constexpr int children = P4EST_CHILDREN;
  static Connectivity* brick(const Index<Dim>& n, const std::array<int, 3>& periodic) {
    return p4est_connectivity_new_brick(n[0], Dim > 1 ? n[Dim - 1] : 1, periodic[0], periodic[1]);
  }
  static Forest* create(Connectivity* c, void* user) {
    return p4est_new_ext(sc_MPI_COMM_WORLD, c, 0, 0, 1, 0, nullptr, user);
  }
  static void partition(Forest* f, int (*weight)(Forest*, p4est_topidx_t, Quadrant*)) {
    p4est_partition(f, 0, weight);
  }
  static Ghost* ghost(Forest* f) { return p4est_ghost_new(f, P4EST_CONNECT_FULL); }
  static void destroy(Ghost* g) { p4est_ghost_destroy(g); }
  static void destroy(Forest* f) { p4est_destroy(f); }
  static void destroy(Connectivity* c) { p4est_connectivity_destroy(c); }
};

template <>
struct Library<3> {
  using Forest = p8est_t;
  using Connectivity = p8est_connectivity_t;
  using Ghost = p8est_ghost_t;
  using Quadrant = p8est_quadrant_t;
  static constexpr int children = P8EST_CHILDREN;
  static Connectivity* brick(const Index<3>& n, const std::array<int, 3>& periodic) {
    return p8est_connectivity_new_brick(n[0], n[1], n[2], periodic[0], periodic[1], periodic[2]);
  }
  static Forest* create(Connectivity* c, void* user) {
    return p8est_new_ext(sc_MPI_COMM_WORLD, c, 0, 0, 1, 0, nullptr, user);
  }
  static void partition(Forest* f, int (*weight)(Forest*, p4est_topidx_t, Quadrant*)) {
    p8est_partition(f, 0, weight);
  }
  static Ghost* ghost(Forest* f) { return p8est_ghost_new(f, P8EST_CONNECT_FULL); }
  static void destroy(Ghost* g) { p8est_ghost_destroy(g); }
  static void destroy(Forest* f) { p8est_destroy(f); }
  static void destroy(Connectivity* c) { p8est_connectivity_destroy(c); }
};

void quiet_library() {
  static const bool done = [] {
    sc_set_log_defaults(nullptr, nullptr, SC_LP_ERROR);
    p4est_init(nullptr, SC_LP_ERROR);
    return true;
  }();
  (void)done;
}

}  // namespace

template <int Dim>
struct Mesh<Dim>::Forest {
  using L = Library<Dim>;
  typename L::Connectivity* connectivity = nullptr;
  typename L::Forest* forest = nullptr;
  std::function<int(const Index<Dim>&)> weight;

  ~Forest() {
    if (forest) L::destroy(forest);
    if (connectivity) L::destroy(connectivity);
  }
  /// Trees are unit cubes on the lattice of blocks: a tree's first vertex is its place.
  static Index<Dim> place(const typename L::Connectivity* c, p4est_topidx_t tree) {
    const double* x = c->vertices + 3 * c->tree_to_vertex[L::children * tree];
    Index<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = static_cast<int>(x[d] + 0.5);
    return at;
  }
  static int weigh(typename L::Forest* f, p4est_topidx_t tree, typename L::Quadrant*) {
    return static_cast<Forest*>(f->user_pointer)->weight(place(f->connectivity, tree));
  }
};

template <int Dim>
Mesh<Dim>::Mesh(const Grid<Dim>& grid, const parallel::World& world,
                const std::function<int(const Box<Dim>&)>& weight)
    : grid_(grid), forest_(std::make_unique<Forest>()) {
  using L = Library<Dim>;
  quiet_library();
  std::array<int, 3> periodic{};
  for (int d = 0; d < Dim; ++d) periodic[d] = grid.periodic(d);
  const Index<Dim> lattice = grid.blocks();
  const auto cells_at = [&](const Index<Dim>& at) {
    Box<Dim> b;
    for (int d = 0; d < Dim; ++d) {
      b.lo[d] = at[d] * grid.block[d];
      b.hi[d] = std::min(b.lo[d] + grid.block[d], grid.cells[d]);
    }
    return b;
  };
  forest_->weight = [&](const Index<Dim>& at) { return std::max(1, weight(cells_at(at))); };
  forest_->connectivity = L::brick(lattice, periodic);
  forest_->forest = L::create(forest_->connectivity, forest_.get());
  L::partition(forest_->forest, &Forest::weigh);

  auto* forest = forest_->forest;
  const int rank = world.rank();
  const long first = static_cast<long>(forest->global_first_quadrant[rank]);
  local_ = static_cast<int>(forest->local_num_quadrants);
  for (p4est_topidx_t tree = forest->first_local_tree; tree <= forest->last_local_tree; ++tree) {
    const Index<Dim> at = Forest::place(forest_->connectivity, tree);
    blocks_.push_back({at, cells_at(at), first + static_cast<long>(blocks_.size()), {}});
  }
  require(static_cast<int>(blocks_.size()) == local_, "one block for each tree of the forest");

  auto* ghost = L::ghost(forest);
  for (int r = 0; r < world.size(); ++r) {
    Peer peer{r, {}, {}};
    for (auto g = ghost->proc_offsets[r]; g < ghost->proc_offsets[r + 1]; ++g) {
      const auto* q =
          static_cast<typename L::Quadrant*>(sc_array_index(&ghost->ghosts, static_cast<std::size_t>(g)));
      const Index<Dim> at = Forest::place(forest_->connectivity, q->p.piggy3.which_tree);
      peer.receive.push_back(static_cast<int>(blocks_.size()));
      blocks_.push_back({at,
                         cells_at(at),
                         static_cast<long>(forest->global_first_quadrant[r]) + q->p.piggy3.local_num,
                         {}});
    }
    for (auto m = ghost->mirror_proc_offsets[r]; m < ghost->mirror_proc_offsets[r + 1]; ++m) {
      const auto which = static_cast<std::size_t>(ghost->mirror_proc_mirrors[m]);
      const auto* q = static_cast<typename L::Quadrant*>(sc_array_index(&ghost->mirrors, which));
      peer.send.push_back(static_cast<int>(q->p.piggy3.local_num));
    }
    if (!peer.send.empty() || !peer.receive.empty()) peers_.push_back(std::move(peer));
  }
  L::destroy(ghost);
  number_neighbours();
}

template <int Dim>
Mesh<Dim>::~Mesh() = default;
template <int Dim>
Mesh<Dim>::Mesh(Mesh&&) noexcept = default;

template <int Dim>
int Mesh<Dim>::find(const Index<Dim>& at) const {
  const Box<Dim> box{{}, grid_.blocks()};
  return box.contains(at) ? lattice_[box.at(at)] : -1;
}

template <int Dim>
void Mesh<Dim>::number_neighbours() {
  const Box<Dim> box{{}, grid_.blocks()};
  lattice_.assign(static_cast<std::size_t>(box.size()), -1);
  for (int s = 0; s < slots(); ++s) lattice_[box.at(block(s).at)] = s;
  Box<Dim> around;
  for (int d = 0; d < Dim; ++d) around.lo[d] = -1, around.hi[d] = 2;
  for (auto& b : blocks_)
    for_each(around, [&](const Index<Dim>& o) {
      Index<Dim> at = b.at + o;
      for (int d = 0; d < Dim; ++d)
        if (grid_.periodic(d)) at[d] = (at[d] + box.hi[d]) % box.hi[d];
      b.neighbour[around.at(o)] = find(at);
    });
}

template <int Dim>
Index<Dim> choose_block(const Index<Dim>& cells, const std::array<std::array<Edge, 2>, Dim>& edge,
                        int wanted) {
  const int usual = wanted > 0 ? wanted : Dim == 1 ? 64 : Dim == 2 ? 32 : 16;
  Index<Dim> block;
  for (int d = 0; d < Dim; ++d) {
    block[d] = cells[d] <= usual ? cells[d] : usual;
    if (edge[d][0] != Edge::periodic || cells[d] % block[d] == 0) continue;
    int best = 0;
    for (int n = widest_halo + 1; n <= 2 * usual + widest_halo && n <= cells[d]; ++n)
      if (cells[d] % n == 0 && (best == 0 || std::abs(n - usual) < std::abs(best - usual))) best = n;
    if (best == 0)
      throw InputError(
          "error: the periodic axis " + std::to_string(d) + " has " + std::to_string(cells[d]) +
          " cells, which whole blocks cannot fill\n   = help: change the domain so that the number of "
          "cells along it is a multiple of " +
          std::to_string(usual));
    block[d] = best;
  }
  return block;
}

template class Mesh<1>;
template class Mesh<2>;
template class Mesh<3>;
template Index<1> choose_block<1>(const Index<1>&, const std::array<std::array<Edge, 2>, 1>&, int);
template Index<2> choose_block<2>(const Index<2>&, const std::array<std::array<Edge, 2>, 2>&, int);
template Index<3> choose_block<3>(const Index<3>&, const std::array<std::array<Edge, 2>, 3>&, int);

}  // namespace recoil
