#include "state/beside_contact.hpp"

#include <gtest/gtest.h>

#include "../interface/prepared.hpp"

namespace recoil::beside_contact_test {
namespace {

/// Half a plane of a material, one cell of whose surface has touched another body, far above it.
struct Pressed {
  Grid<2> grid = make_test_grid<2>(32, 16, Edge::outflow);
  Prepared<2> prepared;
  Index<2> touched{};

  explicit Pressed(const Material& material, ContactLaw::Mode mode = ContactLaw::Mode::separable)
      : prepared{grid,
                 {half_space<2>(middle_of(grid), {{0.3, 1}}), half_space<2>({{0, -1}}, {{0, -1}})},
                 {moving<2>(material, {}), moving<2>(material, {})},
                 material} {
    prepared.state.contact.assign(1, {mode, 0.3});
    prepared.for_each_wall(0, [&](const Wall<2>&, const CutCell<2>&, const Index<2>& i) {
      if (i[0] == 15) touched = i;
    });
    prepared.for_each_body([&](Body<2>& body, int s, Scratch&) {
      if (&body != prepared.state.bodies.data()) return;
      const Box<2>& cells = prepared.state.mesh.block(s).cells;
      if (cells.contains(touched)) body.at(s).contact[grid.layout().at(touched - cells.lo)] = 2;
    });
    prepared.for_each_body([&](Body<2>& body, int s, Scratch& scratch) {
      mark_beside_contact(prepared.state, body, s, scratch);
    });
  }

  /// Calls f(whether a cell is marked, the square of its distance from the touched one in cells).
  template <class F>
  void for_each_cell(F&& f) {
    prepared.for_each_body([&](Body<2>& body, int s, Scratch&) {
      if (&body != prepared.state.bodies.data()) return;
      const BodyBlock<2>& b = body.at(s);
      const Box<2>& cells = prepared.state.mesh.block(s).cells;
      for_each(cells, [&](const Index<2>& i) {
        const int x = i[0] - touched[0], y = i[1] - touched[1];
        f((b.role[grid.layout().at(i - cells.lo)] & beside_contact) != 0, x * x + y * y, b.reach.contains(i));
      });
    });
  }
};

TEST(BesideContact, MarksTheCellsAroundATouch) {
  Material hard = samples::copper();
  hard.strength = Elastic{43e9};
  int marked = 0;
  Pressed(hard).for_each_cell([&](bool mark, int square, bool in_reach) {
    ASSERT_EQ(mark, in_reach && square <= contact_reach * contact_reach);
    marked += mark ? 1 : 0;
  });
  EXPECT_GT(marked, 40);
}

TEST(BesideContact, MarksNothingInMatterThatYields) {
  Pressed(samples::copper()).for_each_cell([](bool mark, int, bool) { ASSERT_FALSE(mark); });
}

// Glued elastic bodies gained energy by it (docs/decisions/0076).
TEST(BesideContact, MarksNothingBesideContactsWithShear) {
  Material hard = samples::copper();
  hard.strength = Elastic{43e9};
  for (const auto mode : {ContactLaw::Mode::bonded, ContactLaw::Mode::friction})
    Pressed(hard, mode).for_each_cell([](bool mark, int, bool) { ASSERT_FALSE(mark); });
}

}  // namespace
}  // namespace recoil::beside_contact_test
