#include "config/section/contact.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "config/read_case.hpp"

namespace recoil::config::read_contact_test {
namespace {

using enum ContactChoice::Mode;

const std::string bodies = R"(format = 1
[domain]
geometry = "planar"
x = ["0 mm", "80 mm"]
y = ["-8 mm", "22 mm"]
[mesh]
finest = "0.5 mm"
[time]
end = "10 us"
[body.block]
material = "steel/hzb"
shape = { kind = "disc", radius = "5 mm", centre = { x = "9 mm" } }
[body.floor]
rigid = true
shape = { kind = "disc", radius = "5 mm", centre = { x = "20 mm" } }
[body.ram]
rigid = true
mass = "2 kg/m"
inertia = "3 kg m"
centre-of-mass = { x = "40 mm", y = "1 mm" }
spin = "100 rad/s"
shape = { kind = "disc", radius = "5 mm", centre = { x = "40 mm" } }
)";

Case read(const std::string& more, Diagnostics& out) {
  const Document doc = parse_document(bodies + more, "case.toml", out);
  return read_case(doc, out);
}

TEST(ReadContact, WithoutATableNothingIsHeld) {
  Diagnostics out;
  const Case c = read("", out);
  ASSERT_FALSE(out.has_errors()) << out.text();
  EXPECT_EQ(c.contact.between("block", "floor").mode, separable);
}

TEST(ReadContact, PairsDifferFromTheDefaultInEitherOrder) {
  Diagnostics out;
  const Case c = read(
      "[contact]\ndefault = \"friction\"\nfriction = 0.2\n[contact.pairs]\n"
      "floor-block = { mode = \"bonded\" }\n",
      out);
  ASSERT_FALSE(out.has_errors()) << out.text();
  EXPECT_EQ(c.contact.between("block", "floor").mode, bonded);
  EXPECT_EQ(c.contact.between("floor", "block").mode, bonded);
  EXPECT_EQ(c.contact.between("block", "ram").mode, friction);
  EXPECT_EQ(c.contact.between("block", "ram").friction, 0.2);
}

/// What takes up fragments touches others as the body that breaks does, and its fragments by the default.
TEST(ReadContact, FragmentsFollowTheirSource) {
  Diagnostics out;
  const Case c = read(
      "[body.chip]\nfragments-of = \"block\"\n[body.dust]\nfragments-of = \"block\"\n"
      "[contact.pairs]\nblock-floor = { mode = \"bonded\" }\n"
      "floor-dust = { mode = \"friction\", friction = 0.1 }\n",
      out);
  ASSERT_FALSE(out.has_errors()) << out.text();
  EXPECT_EQ(c.contact.between("chip", "floor").mode, bonded);
  EXPECT_EQ(c.contact.between("dust", "floor").mode, friction);
  for (const auto& [a, b] : {std::pair("chip", "block"), {"chip", "dust"}, {"dust", "ram"}})
    EXPECT_EQ(c.contact.between(a, b).mode, separable) << a << b;
}

TEST(ReadContact, AFreeRigidBodyHasAMassAndTurnsAboutItsCentre) {
  Diagnostics out;
  const Case c = read("", out);
  ASSERT_FALSE(out.has_errors()) << out.text();
  EXPECT_EQ(c.bodies[2].mass, 2);
  EXPECT_EQ(c.bodies[2].inertia[2], 3);
  EXPECT_EQ(c.bodies[2].spin[2], 100);
  EXPECT_DOUBLE_EQ(c.bodies[2].spin_centre[0], 0.04);
  EXPECT_EQ(c.bodies[1].mass, 0);
}

struct Mistake {
  const char *text, *message, *help;
};
void PrintTo(const Mistake& m, std::ostream* out) { *out << m.text; }

class ContactMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(ContactMistakes, GetAMessageAndACure) {
  Diagnostics out;
  read(GetParam().text, out);
  ASSERT_EQ(out.error_count(), 1) << out.text();
  EXPECT_NE(out.list().front().message.find(GetParam().message), std::string::npos) << out.text();
  EXPECT_NE(out.text().find(GetParam().help), std::string::npos) << out.text();
}

INSTANTIATE_TEST_SUITE_P(
    All, ContactMistakes,
    testing::Values(
        Mistake{"[contact]\ndefault = \"frction\"\n", "frction", "friction"},
        Mistake{"[contact]\ndefault = \"friction\"\n", "friction needs a coefficient", "friction = 0.3"},
        Mistake{"[contact]\nfriction = 0.3\n", "'friction' does not apply", "default = \"friction\""},
        Mistake{"[contact.pairs]\nblock-flor = { mode = \"bonded\" }\n", "'block-flor' is not a pair",
                "block-floor"},
        Mistake{"[contact.pairs]\nblock-floor = \"bonded\"\n", "'block-floor' is not a table",
                "mode = \"friction\""},
        Mistake{
            "[contact.pairs]\nblock-floor = { mode = \"bonded\" }\nfloor-block = { mode = \"separable\" }\n",
            "is given twice", ""},
        Mistake{"[body.soft]\nmaterial = \"steel/hzb\"\nmass = \"1 kg/m\"\nshape = { kind = \"disc\", radius "
                "= \"1 "
                "mm\", centre = { x = \"60 mm\" } }\n",
                "'mass' is for rigid bodies", "add rigid = true"},
        Mistake{"[body.hard]\nrigid = true\nmass = \"1 kg/m\"\ninertia = \"1 kg m\"\nshape = { kind = "
                "\"disc\", radius = "
                "\"1 mm\", centre = { x = \"60 mm\" } }\n",
                "'inertia' needs 'centre-of-mass'", "centre-of-mass = {"},
        Mistake{"[body.hard]\nrigid = true\nmass = \"1 kg\"\nshape = { kind = \"disc\", radius = \"1 mm\", "
                "centre = { x "
                "= \"60 mm\" } }\n",
                "'1 kg' has dimension", "kg/m"}));

}  // namespace
}  // namespace recoil::config::read_contact_test
