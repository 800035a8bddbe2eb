#include "mesh/forest.hpp"

#include <p4est_bits.h>
#include <p4est_extended.h>
#include <p4est_ghost.h>
#include <p8est_bits.h>
#include <p8est_extended.h>
#include <p8est_ghost.h>

#include <cmath>
#include <cstddef>
#include <utility>

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
  using Tree = p4est_tree_t;
  static constexpr int children = P4EST_CHILDREN, deepest = P4EST_MAXLEVEL;
  static Connectivity* brick(const Index<Dim>& n, const std::array<int, 3>& periodic) {
    return p4est_connectivity_new_brick(n[0], Dim > 1 ? n[Dim - 1] : 1, periodic[0], periodic[1]);
  }
  static Forest* create(Connectivity* c) {
    return p4est_new_ext(sc_MPI_COMM_WORLD, c, 0, 0, 1, 0, nullptr, nullptr);
  }
  static Forest* copy(Forest* f) { return p4est_copy(f, 0); }
  static void refine(Forest* f, bool recursive, int (*fn)(Forest*, p4est_topidx_t, Quadrant*)) {
    p4est_refine(f, recursive ? 1 : 0, fn, nullptr);
  }
  static void coarsen(Forest* f, int (*fn)(Forest*, p4est_topidx_t, Quadrant*[])) {
    p4est_coarsen(f, 0, fn, nullptr);
  }
  static void balance(Forest* f) { p4est_balance(f, P4EST_CONNECT_FULL, nullptr); }
  static bool balanced(Forest* f) { return p4est_is_balanced(f, P4EST_CONNECT_FULL) != 0; }
  static void partition(Forest* f, int (*weight)(Forest*, p4est_topidx_t, Quadrant*)) {
    p4est_partition(f, 1, weight);
  }
  static Ghost* ghost(Forest* f) { return p4est_ghost_new(f, P4EST_CONNECT_FULL); }
  static Tree* tree(Forest* f, p4est_topidx_t t) { return p4est_tree_array_index(f->trees, t); }
  static Quadrant* quadrant(Tree* t, std::size_t k) { return p4est_quadrant_array_index(&t->quadrants, k); }
  static std::array<p4est_qcoord_t, 3> corner(const Quadrant& q) { return {q.x, q.y, 0}; }
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
  using Tree = p8est_tree_t;
  static constexpr int children = P8EST_CHILDREN, deepest = P8EST_MAXLEVEL;
  static Connectivity* brick(const Index<3>& n, const std::array<int, 3>& periodic) {
    return p8est_connectivity_new_brick(n[0], n[1], n[2], periodic[0], periodic[1], periodic[2]);
  }
  static Forest* create(Connectivity* c) {
    return p8est_new_ext(sc_MPI_COMM_WORLD, c, 0, 0, 1, 0, nullptr, nullptr);
  }
  static Forest* copy(Forest* f) { return p8est_copy(f, 0); }
  static void refine(Forest* f, bool recursive, int (*fn)(Forest*, p4est_topidx_t, Quadrant*)) {
    p8est_refine(f, recursive ? 1 : 0, fn, nullptr);
  }
  static void coarsen(Forest* f, int (*fn)(Forest*, p4est_topidx_t, Quadrant*[])) {
    p8est_coarsen(f, 0, fn, nullptr);
  }
  static void balance(Forest* f) { p8est_balance(f, P8EST_CONNECT_FULL, nullptr); }
  static bool balanced(Forest* f) { return p8est_is_balanced(f, P8EST_CONNECT_FULL) != 0; }
  static void partition(Forest* f, int (*weight)(Forest*, p4est_topidx_t, Quadrant*)) {
    p8est_partition(f, 1, weight);
  }
  static Ghost* ghost(Forest* f) { return p8est_ghost_new(f, P8EST_CONNECT_FULL); }
  static Tree* tree(Forest* f, p4est_topidx_t t) { return p8est_tree_array_index(f->trees, t); }
  static Quadrant* quadrant(Tree* t, std::size_t k) { return p8est_quadrant_array_index(&t->quadrants, k); }
  static std::array<p4est_qcoord_t, 3> corner(const Quadrant& q) { return {q.x, q.y, q.z}; }
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
struct Forest<Dim>::Parts {
  using L = Library<Dim>;
  using Quadrant = typename L::Quadrant;
  using Shape = typename L::Connectivity;
  std::shared_ptr<Shape> connectivity;
  typename L::Forest* forest = nullptr;
  int levels = 1;
  bool periodic = false;
  const Chooses* chooses = nullptr;  // during refine() and coarsen()
  const std::function<int(const Place<Dim>&)>* weight = nullptr;

  ~Parts() {
    if (forest) L::destroy(forest);
  }
  /// Trees are unit cubes on the lattice of the coarsest blocks: a tree's first vertex is its place.
  static Leaf leaf(const typename L::Forest* f, int levels, p4est_topidx_t tree, const Quadrant& q) {
    const Shape* c = f->connectivity;
    const double* x = c->vertices + 3 * c->tree_to_vertex[L::children * tree];
    const auto corner = L::corner(q);
    const auto below = [&](std::size_t d) { return static_cast<int>(corner[d] >> (L::deepest - q.level)); };
    Leaf to;
    to.place.level = levels - 1 - q.level;
    for (int d = 0; d < Dim; ++d)
      to.place.at[d] = (static_cast<int>(std::lround(x[d])) << q.level) + below(static_cast<std::size_t>(d));
    to.beside = Dim == 1 && below(1) != 0;
    return to;
  }
  static const Parts& of(const typename L::Forest* f) { return *static_cast<const Parts*>(f->user_pointer); }
  static int refines(typename L::Forest* f, p4est_topidx_t tree, Quadrant* q) {
    const Parts& p = of(f);
    const Leaf at = leaf(f, p.levels, tree, *q);
    return at.place.level > 0 && !at.beside && (*p.chooses)(at.place) ? 1 : 0;
  }
  static int coarsens(typename L::Forest* f, p4est_topidx_t tree, Quadrant* family[]) {
    const Parts& p = of(f);
    for (int k = 0; k < L::children; ++k) {
      const Leaf at = leaf(f, p.levels, tree, *family[k]);
      if (!at.beside && !(*p.chooses)(at.place)) return 0;
    }
    return 1;
  }
  static int weigh(typename L::Forest* f, p4est_topidx_t tree, Quadrant* q) {
    const Parts& p = of(f);
    const Leaf at = leaf(f, p.levels, tree, *q);
    return at.beside ? 0 : (*p.weight)(at.place);
  }
};

template <int Dim>
Forest<Dim>::Forest(const Index<Dim>& trees, const std::array<bool, Dim>& periodic, int levels)
    : parts_(std::make_unique<Parts>()) {
  using L = Library<Dim>;
  quiet_library();
  std::array<int, 3> wraps{};
  for (std::size_t d = 0; d < Dim; ++d) {
    wraps[d] = periodic[d] ? 1 : 0;
    parts_->periodic = parts_->periodic || periodic[d];
  }
  parts_->levels = levels;
  parts_->connectivity = std::shared_ptr<typename L::Connectivity>(
      L::brick(trees, wraps), [](typename L::Connectivity* c) { L::destroy(c); });
  parts_->forest = L::create(parts_->connectivity.get());
  parts_->forest->user_pointer = parts_.get();
}

template <int Dim>
Forest<Dim>::Forest(const Forest& other) : parts_(std::make_unique<Parts>()) {
  parts_->levels = other.parts_->levels;
  parts_->periodic = other.parts_->periodic;
  parts_->connectivity = other.parts_->connectivity;
  parts_->forest = Library<Dim>::copy(other.parts_->forest);
  parts_->forest->user_pointer = parts_.get();
}

template <int Dim>
Forest<Dim>::Forest(Forest&&) noexcept = default;
template <int Dim>
Forest<Dim>& Forest<Dim>::operator=(Forest&&) noexcept = default;
template <int Dim>
Forest<Dim>::~Forest() = default;

template <int Dim>
void Forest<Dim>::refine(const Chooses& wanted, bool recursive) {
  parts_->chooses = &wanted;
  Library<Dim>::refine(parts_->forest, recursive, &Parts::refines);
}

template <int Dim>
void Forest<Dim>::coarsen(const Chooses& wanted) {
  parts_->chooses = &wanted;
  Library<Dim>::coarsen(parts_->forest, &Parts::coarsens);
}

/// Across periodic edges one call may leave something to do.
template <int Dim>
void Forest<Dim>::balance() {
  Library<Dim>::balance(parts_->forest);
  while (parts_->periodic && !Library<Dim>::balanced(parts_->forest)) Library<Dim>::balance(parts_->forest);
}

template <int Dim>
void Forest<Dim>::partition(const std::function<int(const Place<Dim>&)>& weight) {
  parts_->weight = &weight;
  Library<Dim>::partition(parts_->forest, &Parts::weigh);
}

template <int Dim>
std::vector<typename Forest<Dim>::Leaf> Forest<Dim>::leaves() const {
  using L = Library<Dim>;
  std::vector<Leaf> all;
  auto* f = parts_->forest;
  for (p4est_topidx_t t = f->first_local_tree; t <= f->last_local_tree; ++t) {
    auto* tree = L::tree(f, t);
    for (std::size_t k = 0; k < tree->quadrants.elem_count; ++k)
      all.push_back(Parts::leaf(f, parts_->levels, t, *L::quadrant(tree, k)));
  }
  return all;
}

template <int Dim>
std::vector<typename Forest<Dim>::Shared> Forest<Dim>::shared() const {
  using L = Library<Dim>;
  using Quadrant = typename L::Quadrant;
  auto* f = parts_->forest;
  auto* ghost = L::ghost(f);
  std::vector<Shared> all;
  for (int r = 0; r < f->mpisize; ++r) {
    Shared peer{r, {}, {}};
    for (auto g = ghost->proc_offsets[r]; g < ghost->proc_offsets[r + 1]; ++g) {
      const auto* q = static_cast<Quadrant*>(sc_array_index(&ghost->ghosts, static_cast<std::size_t>(g)));
      peer.copies.push_back(Parts::leaf(f, parts_->levels, q->p.piggy3.which_tree, *q));
    }
    for (auto m = ghost->mirror_proc_offsets[r]; m < ghost->mirror_proc_offsets[r + 1]; ++m) {
      const auto which = static_cast<std::size_t>(ghost->mirror_proc_mirrors[m]);
      const auto* q = static_cast<Quadrant*>(sc_array_index(&ghost->mirrors, which));
      peer.own.push_back(static_cast<int>(q->p.piggy3.local_num));
    }
    if (!peer.own.empty() || !peer.copies.empty()) all.push_back(std::move(peer));
  }
  L::destroy(ghost);
  return all;
}

template class Forest<1>;
template class Forest<2>;
template class Forest<3>;

}  // namespace recoil
