#include "field/window.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "../mesh/grids.hpp"

namespace recoil::window_test {
namespace {

/// The rules of the edges in closed form, for one axis of n cells.
struct Seen {
  int cell = 0;
  bool mirrored = false, outside = false, open = false;
};

int modulo(int a, int n) { return (a % n + n) % n; }

Seen look(int g, int n, Edge low, Edge high) {
  if (low == Edge::periodic) return {modulo(g, n), false, false, false};
  if (g >= 0 && g < n) return {g, false, false, false};
  if (low == Edge::reflect && high == Edge::reflect) {
    const int m = modulo(g, 2 * n);
    return {m < n ? m : 2 * n - 1 - m, m >= n, true, false};
  }
  const bool at_low = g < 0;
  if ((at_low ? low : high) == Edge::outflow) return {at_low ? 0 : n - 1, false, true, true};
  const int mirrored = at_low ? -1 - g : 2 * n - 1 - g;  // of which the other, open end may be passed
  if (mirrored >= 0 && mirrored < n) return {mirrored, true, true, false};
  return {at_low ? n - 1 : 0, true, true, true};
}

template <int Dim>
struct Expected {
  Index<Dim> cell;
  unsigned flips = 0;
  bool outside = false, open = false;
};

template <int Dim>
Expected<Dim> look(const Grid<Dim>& grid, const Index<Dim>& i) {
  Expected<Dim> e;
  for (int d = 0; d < Dim; ++d) {
    const auto& edge = grid.edge[d];
    const Seen s = look(i[d], grid.cells[d], edge[0], edge[1]);
    e.cell[d] = s.cell;
    e.flips |= static_cast<unsigned>(s.mirrored) << d;
    e.outside = e.outside || s.outside;
    e.open = e.open || s.open;
  }
  return e;
}

double value_of(int cell) { return 1 + 0.5 * cell; }

/// Blocks with a value for every cell of theirs; block `absent` has none.
template <int Dim>
struct Data {
  const Mesh<Dim>& mesh;
  std::vector<std::vector<double>> blocks;
  int absent = -1;

  explicit Data(const Mesh<Dim>& m) : mesh(m) {
    const Box<Dim> layout = mesh.grid().layout(), domain = mesh.grid().domain();
    for (int s = 0; s < mesh.slots(); ++s) {
      blocks.emplace_back(static_cast<std::size_t>(layout.size()), -1e9);
      for_each(mesh.block(s).cells, [&](const Index<Dim>& i) {
        blocks.back()[layout.at(i - mesh.block(s).cells.lo)] = value_of(domain.at(i));
      });
    }
  }
  const double* operator()(int slot) const { return slot == absent ? nullptr : blocks[slot].data(); }
  double seen(const Expected<Dim>& e, Beyond beyond, unsigned odd, double missing) const {
    const Grid<Dim>& grid = mesh.grid();
    Index<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = e.cell[d] / grid.block[d];
    const bool hidden = (beyond == Beyond::nothing && e.outside) || (beyond == Beyond::mirror && e.open);
    if (hidden || mesh.find(Place<Dim>{0, at}) == absent) return missing;
    const double v = value_of(grid.domain().at(e.cell));
    return __builtin_popcount(e.flips & odd) % 2 == 1 ? -v : v;
  }
};

/// Compares every window of the mesh with the closed form.
template <int Dim>
void compare_windows(const Grid<Dim>& grid, int halo) {
  const auto mesh = make_test_mesh(grid);
  Data<Dim> data(mesh);
  std::vector<double> out;
  for (int s = 0; s < mesh.local(); ++s) {
    const Window<Dim> w(mesh, s, halo);
    ASSERT_EQ(w.box(), mesh.block(s).cells.grown(halo));
    out.resize(static_cast<std::size_t>(w.size()));
    data.absent = (s + 1) % mesh.slots() == s ? -1 : (s + 1) % mesh.slots();
    for (const Beyond beyond : {Beyond::extend, Beyond::mirror, Beyond::nothing}) {
      const unsigned odd = beyond == Beyond::extend ? 1U | 1U << (Dim - 1) : 1U;
      w.gather(data, -7.0, beyond, out.data(), odd);
      int wrong = 0;
      for_each(w.box(), [&](const Index<Dim>& i) {
        wrong += out[w.at(i)] != data.seen(look(grid, i), beyond, odd, -7.0);
      });
      ASSERT_EQ(wrong, 0) << "block " << s << " beyond " << static_cast<int>(beyond);
    }
    int wrong = 0;
    for_each(w.box(), [&](const Index<Dim>& i) {
      const auto e = look(grid, i);
      const auto from = w.source(i), inside = w.source_inside(i);
      const Index<Dim> cell = mesh.block(from.slot).cells.lo + grid.layout().index(from.cell);
      wrong += !(cell == e.cell) || from.flips != e.flips || (inside.slot < 0) != e.outside;
    });
    ASSERT_EQ(wrong, 0) << "sources of block " << s;
  }
}

template <class D>
struct Windows : testing::Test {
  static constexpr int dim = D::value;
  static Grid<dim> grid(int cells, int block, Edge low, Edge high, bool even = false) {
    auto g = make_test_grid<dim>(cells, block, low, even);
    for (auto& e : g.edge) e[1] = high;
    return g;
  }
};
TYPED_TEST_SUITE(Windows, Dimensions);

TYPED_TEST(Windows, OpenEdges) {
  compare_windows(TestFixture::grid(25, 10, Edge::outflow, Edge::outflow), 9);
}
TYPED_TEST(Windows, MirrorsAndTheLastBlockCutShort) {
  compare_windows(TestFixture::grid(25, 10, Edge::reflect, Edge::reflect), 9);
  compare_windows(TestFixture::grid(25, 10, Edge::reflect, Edge::outflow), 9);
  compare_windows(TestFixture::grid(21, 10, Edge::outflow, Edge::reflect), 3);
}
TYPED_TEST(Windows, PeriodicEdges) {
  compare_windows(TestFixture::grid(30, 10, Edge::periodic, Edge::periodic, true), 9);
  compare_windows(TestFixture::grid(20, 10, Edge::periodic, Edge::periodic, true), 4);
}
TYPED_TEST(Windows, OneBlockAlone) {
  compare_windows(TestFixture::grid(12, 12, Edge::periodic, Edge::periodic, true), 9);
  compare_windows(TestFixture::grid(4, 4, Edge::periodic, Edge::periodic, true), 9);  // wraps twice
  compare_windows(TestFixture::grid(4, 4, Edge::reflect, Edge::reflect, true), 9);    // mirrors mirrors
  compare_windows(TestFixture::grid(4, 6, Edge::reflect, Edge::outflow, true), 9);
}
TYPED_TEST(Windows, MixedAxes) {
  auto grid = TestFixture::grid(20, 10, Edge::periodic, Edge::periodic, true);
  grid.edge[TestFixture::dim - 1] = {Edge::reflect, Edge::outflow};
  compare_windows(grid, 9);
}

TYPED_TEST(Windows, OtherTypesAreGatheredWithoutSigns) {
  constexpr int dim = TestFixture::dim;
  const auto mesh = make_test_mesh(TestFixture::grid(12, 12, Edge::reflect, Edge::reflect, true));
  std::vector<int> cells(static_cast<std::size_t>(mesh.grid().layout().size()));
  for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = static_cast<int>(k);
  const Window<dim> w(mesh, 0, 2);
  std::vector<int> out(static_cast<std::size_t>(w.size()));
  w.gather([&](int) { return cells.data(); }, -1, Beyond::extend, out.data(), ~0U);
  for_each(w.box(), [&](const Index<dim>& i) {
    EXPECT_EQ(out[w.at(i)], mesh.grid().domain().at(look(mesh.grid(), i).cell));
  });
}

/// A window around a part of a block shows the same cells as one around the whole block.
/// Components that lie one layout apart come as they would one by one.
TYPED_TEST(Windows, SeveralComponents) {
  constexpr int dim = TestFixture::dim;
  using Component = typename Window<dim>::template Component<double>;
  const auto mesh = make_test_mesh(TestFixture::grid(25, 10, Edge::reflect, Edge::outflow));
  const auto n = static_cast<std::size_t>(mesh.grid().layout().size());
  std::vector<std::vector<double>> blocks(static_cast<std::size_t>(mesh.slots()), std::vector<double>(2 * n));
  for (std::size_t s = 0; s < blocks.size(); ++s)
    for (std::size_t k = 0; k < 2 * n; ++k) blocks[s][k] = static_cast<double>(1 + s * 2 * n + k);
  const auto of = [&](std::size_t first) {
    return [&blocks, first](int s) { return s == 1 ? nullptr : blocks[s].data() + first; };
  };
  for (int s = 0; s < mesh.local(); ++s) {
    const Window<dim> w(mesh, s, 3);
    const auto size = static_cast<std::size_t>(w.size());
    std::vector<double> both(2 * size), one(size), other(size);
    w.gather(of(0), std::array{Component{-1.0, 1U}, Component{-2.0, 0U}}, Beyond::nothing, both.data());
    w.gather(of(0), -1.0, Beyond::nothing, one.data(), 1U);
    w.gather(of(n), -2.0, Beyond::nothing, other.data());
    one.insert(one.end(), other.begin(), other.end());
    ASSERT_EQ(both, one) << "block " << s;
  }
}

TYPED_TEST(Windows, PartOfABlock) {
  constexpr int dim = TestFixture::dim;
  const auto mesh = make_test_mesh(TestFixture::grid(25, 10, Edge::reflect, Edge::outflow));
  const Data<dim> data(mesh);
  for (int s = 0; s < mesh.local(); ++s) {
    Box<dim> part = mesh.block(s).cells;
    for (int d = 0; d < dim; ++d) {
      part.lo[d] = std::min(part.lo[d] + 1, part.hi[d] - 1);
      part.hi[d] = std::min(part.hi[d], part.lo[d] + 4);
    }
    const Window<dim> w(mesh, s, 3, part), whole(mesh, s, 3);
    ASSERT_EQ(w.inner(), part);
    ASSERT_EQ(w.box(), part.grown(3));
    std::vector<double> out(static_cast<std::size_t>(w.size())), all(static_cast<std::size_t>(whole.size()));
    w.gather(data, -7.0, Beyond::mirror, out.data(), 1U);
    whole.gather(data, -7.0, Beyond::mirror, all.data(), 1U);
    for_each(w.box(), [&](const Index<dim>& i) { ASSERT_EQ(out[w.at(i)], all[whole.at(i)]); });
    for_each(w.inner(), [&](const Index<dim>& i) {
      ASSERT_EQ(w.cell(i), mesh.grid().layout().at(i - mesh.block(s).cells.lo));
      ASSERT_EQ(w.index_of(w.cell(i)), i);
    });
  }
}

TYPED_TEST(Windows, PointsAppearMirroredOrMovedLikeTheirCells) {
  constexpr int dim = TestFixture::dim;
  auto grid = TestFixture::grid(20, 10, Edge::reflect, Edge::reflect, true);
  if (dim > 1) grid.edge[dim - 1] = {Edge::periodic, Edge::periodic};
  const auto mesh = make_test_mesh(grid);
  for (int s = 0; s < mesh.local(); ++s) {
    const Window<dim> w(mesh, s, 9);
    for_each(w.box(), [&](const Index<dim>& i) {
      const auto from = w.source(i);
      const auto e = look(grid, i);
      Vec<dim> off, mirrored;
      for (int d = 0; d < dim; ++d) {
        off[d] = (0.1 + 0.1 * d) * grid.dx;
        mirrored[d] = (e.flips >> d & 1U) != 0 ? -off[d] : off[d];
      }
      const Vec<dim> miss = w.appear(i, from, grid.centre(e.cell) + off) - (grid.centre(i) + mirrored);
      ASSERT_LT(norm(miss), 1e-13);
    });
  }
}

}  // namespace
}  // namespace recoil::window_test
