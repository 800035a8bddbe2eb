#include "mesh/mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "../core/dimensions.hpp"
#include "field/exchange.hpp"
#include "grids.hpp"

namespace recoil::mesh_test {
namespace {

template <int Dim>
Box<Dim> around() {
  Box<Dim> b;
  for (int d = 0; d < Dim; ++d) b.lo[d] = -1, b.hi[d] = 2;
  return b;
}

/// The place at an offset from a block, or nothing beyond an edge that is not periodic.
template <int Dim>
bool neighbour_place(const Grid<Dim>& grid, const Index<Dim>& at, const Index<Dim>& offset,
                     Index<Dim>& place) {
  place = at + offset;
  for (int d = 0; d < Dim; ++d) {
    const int n = grid.blocks()[d];
    if (grid.periodic(d)) place[d] = (place[d] + n) % n;
    if (place[d] < 0 || place[d] >= n) return false;
  }
  return true;
}

template <class D>
struct Meshes : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(Meshes, Dimensions);

TYPED_TEST(Meshes, BlocksTileTheDomain) {
  constexpr int dim = TestFixture::dim;
  if (several_processes()) GTEST_SKIP();
  const auto mesh =
      make_test_mesh(make_test_grid<dim>(23, 5, Edge::outflow));  // the last blocks are cut short
  const Box<dim> domain = mesh.grid().domain();
  std::vector<int> covered(static_cast<std::size_t>(domain.size()));
  EXPECT_EQ(mesh.local(), mesh.slots());
  for (int s = 0; s < mesh.local(); ++s) {
    const auto& block = mesh.block(s);
    EXPECT_EQ(block.order, s);
    EXPECT_EQ(mesh.find(block.place()), s);
    for_each(block.cells, [&](const Index<dim>& i) { ++covered[domain.at(i)]; });
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), domain.size());
  Index<dim> beyond;
  beyond[0] = -1;
  EXPECT_EQ(mesh.find(Place<dim>{0, beyond}), -1);
}

TYPED_TEST(Meshes, NeighboursAreRight) {
  constexpr int dim = TestFixture::dim;
  if (several_processes()) GTEST_SKIP();
  for (const Edge edge : {Edge::outflow, Edge::reflect, Edge::periodic}) {
    // Three and two blocks along an axis, and one, whose neighbour is itself where periodic.
    for (const int cells : {30, 20, 10}) {
      const auto mesh = make_test_mesh(make_test_grid<dim>(cells, 10, edge, true));
      for (int s = 0; s < mesh.slots(); ++s)
        for_each(around<dim>(), [&](const Index<dim>& o) {
          Index<dim> place;
          const bool exists = neighbour_place(mesh.grid(), mesh.block(s).at, o, place);
          const int n = mesh.block(s).neighbour[around<dim>().at(o)];
          ASSERT_EQ(n >= 0, exists);
          if (!exists) return;
          ASSERT_EQ(mesh.block(n).at, place);
        });
    }
  }
}

TYPED_TEST(Meshes, MixedEdgesWrapOnlyThePeriodicAxis) {
  constexpr int dim = TestFixture::dim;
  if (dim == 1 || several_processes()) GTEST_SKIP();
  auto grid = make_test_grid<dim>(30, 10, Edge::reflect, true);
  grid.edge[dim - 1] = {Edge::periodic, Edge::periodic};
  const auto mesh = make_test_mesh(grid);
  Index<dim> low, high, left;
  high[dim - 1] = 2;
  low[dim - 1] = -1;
  left[0] = -1;
  const auto& corner = mesh.block(mesh.find(Place<dim>{}));
  EXPECT_EQ(corner.neighbour[around<dim>().at(low)], mesh.find(Place<dim>{0, high}));
  EXPECT_EQ(corner.neighbour[around<dim>().at(left)], -1);
}

/// Run by mpirun with several processes.
template <class D>
struct MpiMesh : testing::Test {
  static constexpr int dim = D::value;
  void SetUp() override {
    if (!several_processes()) GTEST_SKIP() << "for mpirun";
    start_parallel();
  }
  static Mesh<dim> mesh(Edge edge, const std::function<int(const Box<dim>&)>& weight) {
    return Mesh<dim>(make_test_grid<dim>(enough_cells<dim>(40, 10), 10, edge, true), parallel::World{},
                     weight);
  }
  static Mesh<dim> mesh(Edge edge) {
    return mesh(edge, [](const Box<dim>& b) { return b.size(); });
  }
};
TYPED_TEST_SUITE(MpiMesh, Dimensions);

TYPED_TEST(MpiMesh, EveryBlockHasOneOwnerAndCopiesAllAround) {
  constexpr int dim = TestFixture::dim;
  const parallel::World world;
  for (const Edge edge : {Edge::outflow, Edge::periodic}) {
    const auto mesh = TestFixture::mesh(edge);
    std::vector<std::int64_t> owners(static_cast<std::size_t>(power<dim>(mesh.grid().blocks()[0])));
    for (int s = 0; s < mesh.local(); ++s) {
      ++owners[mesh.block(s).order];
      for_each(around<dim>(), [&](const Index<dim>& o) {
        Index<dim> place;
        const bool exists = neighbour_place(mesh.grid(), mesh.block(s).at, o, place);
        const int n = mesh.block(s).neighbour[around<dim>().at(o)];
        ASSERT_EQ(n >= 0, exists);
        if (!exists) return;
        ASSERT_EQ(mesh.block(n).at, place);
      });
    }
    world.sum(owners);
    for (const auto n : owners) EXPECT_EQ(n, 1);
    EXPECT_GT(mesh.slots(), mesh.local());
  }
}

TYPED_TEST(MpiMesh, WorkIsShared) {
  constexpr int dim = TestFixture::dim;
  const auto weight = [](const Box<dim>& b) { return b.lo[0] == 0 ? 90 : 1; };
  const auto mesh = TestFixture::mesh(Edge::outflow, weight);
  std::int64_t work[2] = {0, 0};
  for (int s = 0; s < mesh.local(); ++s) work[0] += weight(mesh.block(s).cells);
  work[1] = work[0];
  const parallel::World world;
  world.sum({work, 1});
  const double even = static_cast<double>(work[0]) / world.size();
  EXPECT_LE(static_cast<double>(work[1]), even + 91);
}

TYPED_TEST(MpiMesh, ExchangeBringsTheNeighboursData) {
  const parallel::World world;
  for (const Edge edge : {Edge::outflow, Edge::periodic}) {
    const auto mesh = TestFixture::mesh(edge);
    std::vector<std::vector<double>> data(static_cast<std::size_t>(mesh.slots()));
    const auto of = [&](int s) {  // blocks send different amounts
      return std::vector<double>(static_cast<std::size_t>(mesh.block(s).order % 3),
                                 7.5 + static_cast<double>(mesh.block(s).order));
    };
    for (int s = 0; s < mesh.local(); ++s) data[s] = of(s);
    std::set<int> filled;
    exchange(
        mesh, world,
        [&](int s, int rank, parallel::Bytes& bytes) {
          EXPECT_NE(rank, world.rank());
          EXPECT_LT(s, mesh.local());
          const auto& v = data[s];
          parallel::pack(bytes, static_cast<std::int64_t>(v.size()));
          parallel::pack(bytes, v.data(), v.size());
        },
        [&](int s, parallel::Unpacker& from) {
          EXPECT_GE(s, mesh.local());
          auto& v = data[s];
          v.resize(static_cast<std::size_t>(from.read<std::int64_t>()));
          from.read(v.data(), v.size());
          filled.insert(s);
        });
    EXPECT_EQ(static_cast<int>(filled.size()), mesh.slots() - mesh.local());
    for (int s = 0; s < mesh.slots(); ++s) EXPECT_EQ(data[s], of(s)) << "slot " << s;
  }
}

}  // namespace
}  // namespace recoil::mesh_test
