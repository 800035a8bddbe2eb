#include "state/exchange_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "../core/dimensions.hpp"
#include "../mesh/grids.hpp"
#include "parallel/post.hpp"

namespace recoil::exchange_fields_test {
namespace {

constexpr int least_cells = 40, block = 10, cut_every = 3;
constexpr FieldSet sent_fields = Field::phi | Field::phi_midstep | Field::contents | Field::volume |
                                 Field::geometry | Field::walls | Field::contact | Field::stencil;

/// A number for each cell of each block.
double number(long order, std::size_t k) {
  return static_cast<double>(1000 * order) + static_cast<double>(k);
}

/// A deformable and a rigid body in the even blocks, with numbers that tell block and cell; every fifth cell
/// has none.
template <int dim>
void fill(BodyBlock<dim>& b, long order, bool rigid) {
  for_each_field<dim>([&](const auto& d) {
    if (!d.allocated() || (rigid && !d.of_rigid)) return;
    for_each_array(b.*d.member, [&](auto& array) {
      if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(array)>::value_type, double>)
        for (std::size_t k = 0; k < array.size(); ++k)
          if (k % 5 != 0) array.raw()[k] = number(order, k) + 0.5 * static_cast<int>(d.id);
    });
  });
  b.near_surface = order % 4 == 0;
  for (std::size_t k = 0; k < b.phi.size(); k += cut_every) {
    b.geometry.index[k] = static_cast<int>(b.geometry.cuts.size());
    b.geometry.kind[k] = CellKind::cut;
    b.geometry.cuts.emplace_back().cell = static_cast<int>(k);
    b.geometry.cuts.back().volume = number(order, k);
    if (rigid) continue;
    b.contact[k] = static_cast<std::uint32_t>(order + 1);
    b.walls.emplace_back().traction = -number(order, k);
  }
}

template <int dim>
State<dim> make(Edge edge) {
  const Grid<dim> grid = make_test_grid<dim>(enough_cells<dim>(least_cells, block), block, edge, true);
  State<dim> state{make_test_mesh(grid), {}, {}, {}};
  for (const bool rigid : {false, true}) {
    Body<dim>& body = state.bodies.emplace_back();
    if (rigid) body.rigid.emplace();
    body.blocks.resize(static_cast<std::size_t>(state.mesh.slots()));
    for (int s = 0; s < state.mesh.local(); ++s) {
      const long order = state.mesh.block(s).order;
      if (order % 2 != 0) continue;
      enter_block(body, s, grid);
      fill<dim>(body.at(s), order, rigid);
    }
  }
  return state;
}

/// Cells between a cell and the nearest own block, along the axis where they are most.
template <int dim>
int distance_to_own(const Mesh<dim>& mesh, const Index<dim>& i) {
  const bool periodic = mesh.grid().periodic(0);
  const int cells = mesh.grid().cells[0];
  int nearest = std::numeric_limits<int>::max();
  for (int s = 0; s < mesh.local(); ++s) {
    int far = 0;
    for (int d = 0; d < dim; ++d) {
      int along = std::numeric_limits<int>::max();
      for (const int shift : {-cells, 0, cells}) {
        if (shift != 0 && !periodic) continue;
        const int at = i[d] + shift;
        along = std::min(along,
                         std::max({mesh.block(s).cells.lo[d] - at, at - mesh.block(s).cells.hi[d] + 1, 0}));
      }
      far = std::max(far, along);
    }
    nearest = std::min(nearest, far);
  }
  return nearest;
}

/// Whether a value is that of a cell that was not sent.
template <class T>
bool untouched(T value, T usual) {
#ifdef NDEBUG
  return value == usual;
#else
  if constexpr (std::is_same_v<T, double>) return std::isnan(value);
  return value == usual;
#endif
}

/// Run by mpirun with several processes.
template <class D>
struct MpiExchange : testing::Test {
  static constexpr int dim = D::value;
  void SetUp() override {
    if (!several_processes()) GTEST_SKIP() << "for mpirun";
    start_parallel();
  }

  static void check_lists(const State<dim>& state, int s, bool rigid) {
    const BodyBlock<dim>& b = state.bodies[rigid ? 1 : 0].at(s);
    const long order = state.mesh.block(s).order;
    const Box<dim> layout = state.grid().layout();
    const Index<dim> lo = state.mesh.block(s).cells.lo;
    std::size_t cut = 0;
    for (int k = 0; k < layout.size(); ++k) {
      const auto place = static_cast<std::size_t>(k);
      const bool near = distance_to_own(state.mesh, lo + layout.index(k)) <= reach_of(Field::geometry);
      const bool is_cut = near && k % cut_every == 0;
      ASSERT_EQ(b.geometry.index[place], is_cut ? static_cast<int>(cut) : -1);
      EXPECT_EQ(b.geometry.kind[place], is_cut ? CellKind::cut : CellKind::empty);
      if (!is_cut) continue;
      ASSERT_LT(cut, b.geometry.cuts.size());
      EXPECT_EQ(b.geometry.cuts[cut].cell, k);
      EXPECT_EQ(b.geometry.cuts[cut].volume, number(order, place));
      if (!rigid) {
        ASSERT_LT(cut, b.walls.size());
        EXPECT_EQ(b.walls[cut].traction, -number(order, place));
      }
      ++cut;
    }
    EXPECT_EQ(b.geometry.cuts.size(), cut) << "no others";
    EXPECT_EQ(b.walls.size(), rigid ? 0 : cut);
  }

  static void check_cells(const State<dim>& state, int s, bool rigid, int reach) {
    const BodyBlock<dim>& b = state.bodies[rigid ? 1 : 0].at(s);
    const long order = state.mesh.block(s).order;
    const Box<dim> layout = state.grid().layout();
    const Index<dim> lo = state.mesh.block(s).cells.lo;
    Body<dim> of_owner;
    if (rigid) of_owner.rigid.emplace();
    of_owner.blocks.resize(2);
    enter_block(of_owner, 0, state.grid());
    enter_block(of_owner, 1, state.grid());
    fill<dim>(of_owner.at(0), order, rigid);
    for_each_field<dim>([&](const auto& d) {
      if (!sent_fields.has(d.id) || (rigid && !d.of_rigid)) return;
      if constexpr (requires { (b.*d.member).raw()[0] == (b.*d.member).raw()[0]; }) {
        if (d.extent != Extent::cells) return;
        const auto& got = (b.*d.member).raw();
        const auto& sent = (of_owner.at(0).*d.member).raw();
        if (sent.empty() || got.empty()) return;  // shares the memory of another field
        for (std::size_t k = 0; k < got.size(); ++k) {
          const Index<dim> i = lo + layout.index(static_cast<int>(k) % layout.size());
          if (distance_to_own(state.mesh, i) <= std::min(reach, reach_of(d.id)))
            ASSERT_EQ(got[k], sent[k]) << d.name << ' ' << k;
          else
            ASSERT_TRUE(untouched(got[k], (of_owner.at(1).*d.member).raw()[k])) << d.name << ' ' << k;
        }
      }
    });
  }

  static void check(Edge edge, int reach) {
    State<dim> state = make<dim>(edge);
    const parallel::World world;
    exchange_fields(state, world, sent_fields, {reach});
    EXPECT_GT(state.mesh.slots(), state.mesh.local()) << "there are copies";
    std::vector<std::int64_t> held{0};
    for (int s = state.mesh.local(); s < state.mesh.slots(); ++s)
      for (const bool rigid : {false, true}) {
        const long order = state.mesh.block(s).order;
        const BodyBlock<dim>& b = state.bodies[rigid ? 1 : 0].at(s);
        ASSERT_EQ(b.present, order % 2 == 0) << order;
        if (!b.present) continue;
        ++held[0];
        EXPECT_EQ(b.near_surface, order % 4 == 0);
        EXPECT_EQ(b.contents.empty(), rigid);
        check_lists(state, s, rigid);
        check_cells(state, s, rigid, reach);
      }
    world.sum(held);
    EXPECT_GT(held[0], 0);
  }
};
TYPED_TEST_SUITE(MpiExchange, Dimensions);

/// Exactly the cells that are near enough to own blocks arrive, and of the lists of cut cells theirs.
TYPED_TEST(MpiExchange, CopiesHoldTheRimsThatAreRead) { TestFixture::check(Edge::outflow, widest_halo); }
TYPED_TEST(MpiExchange, NarrowRims) { TestFixture::check(Edge::outflow, 2); }
TYPED_TEST(MpiExchange, RimsAcrossPeriodicEdges) { TestFixture::check(Edge::periodic, 4); }

/// Only what is asked for goes over; a body that has left its block leaves the copies as well.
TYPED_TEST(MpiExchange, FieldsAndPresence) {
  constexpr int dim = TestFixture::dim;
  State<dim> state = make<dim>(Edge::outflow);
  const parallel::World world;
  exchange_fields(state, world, Field::phi);
  for (int s = state.mesh.local(); s < state.mesh.slots(); ++s) {
    const BodyBlock<dim>& b = state.bodies[0].at(s);
    if (!b.present) continue;
    EXPECT_EQ(b.contents.raw(), std::vector<double>(b.contents.size(), 0.0)) << "not asked for";
    EXPECT_TRUE(b.geometry.cuts.empty());
  }
  for (int s = 0; s < state.mesh.local(); ++s) leave_block(state.bodies[0], s);
  exchange_fields(state, world, Field::contents | Field::volume);
  for (int s = state.mesh.local(); s < state.mesh.slots(); ++s) {
    EXPECT_FALSE(state.bodies[0].present(s));
    EXPECT_EQ(state.bodies[1].present(s), state.mesh.block(s).order % 2 == 0);
  }
}

/// The numbers of a cell in a copy, and whether they were sent.
enum class Sent { all, none };
template <int dim>
void expect_contents(const State<dim>& state, int s, std::size_t k, Sent sent) {
  const auto& got = state.bodies[0].at(s).contents.raw();
  const std::size_t n = state.bodies[0].at(s).volume.raw().size();
  Body<dim> body;
  body.blocks.resize(1);
  enter_block(body, 0, state.grid());
  fill<dim>(body.at(0), state.mesh.block(s).order, false);
  for (std::size_t c = 0; c < Components<dim>::contents; ++c) {
    const double value = body.at(0).contents.raw()[c * n + k];
    if (sent == Sent::all)
      ASSERT_EQ(got[c * n + k], value) << k;
    else
      ASSERT_TRUE(untouched(got[c * n + k], 0.0)) << k;
  }
}

/// Contents of cut cells go over, others do not.
TYPED_TEST(MpiExchange, ContentsOfCutCellsAlone) {
  constexpr int dim = TestFixture::dim, reach = 2;
  State<dim> state = make<dim>(Edge::outflow);
  const parallel::World world;
  for (int s = 0; s < state.mesh.local(); ++s)
    if (BodyBlock<dim>& b = state.bodies[0].at(s); b.present)
      b.end_geometry.cuts.raw() = b.geometry.cuts.raw();
  exchange_fields(state, world, Field::contents | Field::volume,
                  {.cells = reach, .contents = ContentsSent::of_cut_cells});
  const Box<dim> layout = state.grid().layout();
  int sent = 0, kept = 0;
  for (int s = state.mesh.local(); s < state.mesh.slots(); ++s) {
    if (!state.bodies[0].present(s)) continue;
    for (int k = 0; k < layout.size(); ++k) {
      if (distance_to_own(state.mesh, state.mesh.block(s).cells.lo + layout.index(k)) > reach) continue;
      const bool cut = k % cut_every == 0;
      (cut ? sent : kept) += 1;
      expect_contents(state, s, static_cast<std::size_t>(k), cut ? Sent::all : Sent::none);
    }
  }
  std::vector<std::int64_t> all{sent, kept};
  world.sum(all);
  EXPECT_GT(all[0], 0);
  EXPECT_GT(all[1], 0);
}

/// Of walls that were asked for all goes over, of others how matter and wall move.
TYPED_TEST(MpiExchange, WallsThatWereAskedFor) {
  constexpr int dim = TestFixture::dim;
  State<dim> state = make<dim>(Edge::outflow);
  const parallel::World world;
  const auto& peers = state.mesh.peers();
  exchange_fields(state, world, FieldSet(Field::geometry));
  // Each own block follows the first wall of each block around.
  for (int s = 0; s < state.mesh.local(); ++s) {
    BodyBlock<dim>& b = state.bodies[0].at(s);
    for (Wall<dim>& wall : b.walls.raw()) wall.donors = 4, wall.mean_velocity[0] = 3, wall.value[0] = 2;
    if (!b.present) continue;
    for (const int other : state.mesh.block(s).neighbour) {
      if (other < state.mesh.local() || !state.bodies[0].present(other)) continue;
      if (state.bodies[0].at(other).geometry.cuts.raw().empty()) continue;
      b.ghosts.raw().emplace_back().slot = other;
    }
  }
  std::vector<AskedCells> asked;
  for (const auto& peer : peers) parallel::post(peer.rank, ask_for_cells(state, peer));
  for (const auto& peer : peers)
    asked.push_back(take_asked_cells(state, peer, parallel::wait_for_posted(peer.rank)));
  for (std::size_t p = 0; p < peers.size(); ++p)
    parallel::post(peers[p].rank, pack_fields(state, peers[p], Field::walls,
                                              {.walls = WallsSent::asked, .asked = &asked[p]}));
  for (const auto& peer : peers)
    unpack_fields(state, peer, world.rank(), Field::walls, {.walls = WallsSent::asked},
                  parallel::wait_for_posted(peer.rank));
  std::vector<std::int64_t> seen{0, 0};
  for (int s = 0; s < state.mesh.local(); ++s)
    for (const GhostCell<dim>& ghost : state.bodies[0].at(s).ghosts.raw()) {
      const BodyBlock<dim>& b = state.bodies[0].at(ghost.slot);
      const auto cell = static_cast<std::size_t>(b.geometry.cuts.raw()[0].cell);
      ASSERT_EQ(b.walls.raw().size(), b.geometry.cuts.raw().size());
      EXPECT_EQ(b.walls.raw()[0].traction, -number(state.mesh.block(ghost.slot).order, cell)) << "all of it";
      ++seen[0];
      for (std::size_t k = 1; k < b.walls.raw().size(); ++k, ++seen[1]) {
        const Wall<dim>& wall = b.walls.raw()[k];
        EXPECT_EQ(wall.traction, 0) << "not asked for";
        EXPECT_EQ(wall.donors, 4);
        EXPECT_EQ(wall.mean_velocity[0], 3);
        EXPECT_EQ(wall.value[0], 2);
      }
    }
  world.sum(seen);
  EXPECT_EQ(seen[0] > 0, dim > 1) << "in a line no two blocks with the body touch";
  EXPECT_EQ(seen[1] > 0, dim > 1);
}

/// The same numbers go over again where they have changed back to nothing.
TYPED_TEST(MpiExchange, CellsThatHaveBecomeEmptyAreEmptyInCopies) {
  constexpr int dim = TestFixture::dim;
  State<dim> state = make<dim>(Edge::outflow);
  const parallel::World world;
  exchange_fields(state, world, Field::volume);
  for (int s = 0; s < state.mesh.local(); ++s)
    for (double& v : state.bodies[0].at(s).volume.raw()) v = 0;
  exchange_fields(state, world, Field::volume);
  for (int s = state.mesh.local(); s < state.mesh.slots(); ++s)
    for (const double v : state.bodies[0].at(s).volume.raw()) EXPECT_TRUE(v == 0 || std::isnan(v));
}

}  // namespace
}  // namespace recoil::exchange_fields_test
