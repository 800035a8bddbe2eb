#!/usr/bin/python3
"""What is met on the first day: pictures of cases, numbers of runs, materials of one's own. Environment: see program.py."""

import unittest

from program import Program, recoil

CARDS = """*KEYWORD
*MAT_JOHNSON_COOK_TITLE
tantalum rod
$#     mid        ro         g         e        pr       dtf        vp    rateop
         7    16.690     0.690     1.860     0.350       0.0       1.0       0.0
  8.000E-3  5.500E-3     0.400     0.057     0.440    3293.0     298.0    1.0E-6
  1.400E-6    -9.000       3.0       0.0       0.0       0.0       0.0       0.0
       0.0       0.0         0     1E-06       0.0
*EOS_GRUNEISEN
         7    0.3410     1.200       0.0       0.0      1.67      0.42       0.0
*END
"""


class FirstSteps(Program):
    def test_check_draws_from_where_all_bodies_are_seen(self):
        case = self.folder / "below.toml"
        text = """format = 1
[domain]
geometry = "3d"
x = ["-7 mm", "9 mm"]
y = ["-7 mm", "7 mm"]
z = ["-6 mm", "8 mm"]
[mesh]
finest = "0.5 mm"
[time]
end = "1 us"
[body.plate]
material = "aluminium/6061-t6"
shape = { kind = "box", x = ["-7 mm", "9 mm"], y = ["-7 mm", "7 mm"], z = ["0 mm", "4 mm"] }
[body.sphere]
material = "steel/4340"
shape = { kind = "sphere", radius = "2 mm", centre = { z = "%s mm" } }
velocity = { z = "%s m/s" }
"""
        for place, speed, said in ((-2.1, 700, "--view=-55deg,-24deg shows more"), (6.1, -700, f"picture {self.folder}/case.png\n")):
            case.write_text(text % (place, speed))
            self.expect(recoil("check", case, "--png", self.folder / "case.png"), 0, said)
            self.assertEqual((self.folder / "case.png").read_bytes()[:4], b"\x89PNG")
        asked = recoil("check", case, "--png", self.folder / "case.png", "--view=x")
        self.expect(asked, 0)
        self.assertNotIn("--view", asked.stdout)

    def test_prints_results_by_their_names(self):
        self.expect(self.run_coarse("--end", "1us"), 0)
        out = self.folder / "out"
        said = recoil("value", out, "contact.flyer-target.opens", "event.contact", "contact.flyer-target.recloses", "gauge.rear.velocity.max")
        self.expect(said, 0)
        words = [line.split(maxsplit=1) for line in said.stdout.splitlines()]
        self.assertEqual(words[1], ["event.contact", "yes"])
        self.assertEqual(words[2], ["contact.flyer-target.recloses", "did not happen"])
        self.assertRegex(words[0][1], r"^0\.7\d* us$")
        self.assertRegex(words[3][1], r"^\S+ m/s$")
        self.expect(recoil("value", out, "gauge.rear.velocity@9us"), 0, "the record, from 0 to 1 us, has no value there")
        everything = recoil("value", out)
        self.expect(everything, 0, "gauge.rear.velocity.peak", "body.flyer.mass")
        self.assertIn("5.4 kg/m2", everything.stdout)  # 2 mm of 2700 kg/m3
        self.expect(recoil("value", out, "body.flier.mass"), 2, "did you mean 'body.flyer.mass'?")
        self.expect(recoil("value", self.folder / "aut"), 2, "there is no folder", "did you mean 'out'?")

    def test_pairs_of_bodies_with_hyphens_are_named_once(self):
        case = self.case(("[body.flyer]", "[body.fly-er]"), ("[body.target]", "[body.tar-get]"),
                         ("flyer-target", "fly-er-tar-get"), ('body = "flyer"', 'body = "fly-er"'), ('body = "target"', 'body = "tar-get"'))
        self.expect(self.run_coarse("--end", "1us", case=case), 0)
        out = self.folder / "out"
        both = recoil("value", out, "contact.fly-er-tar-get.opens", "contact.tar-get-fly-er.opens")
        self.expect(both, 0)
        first, second = (line.split(maxsplit=1)[1] for line in both.stdout.splitlines())
        self.assertEqual(first, second)
        self.assertRegex(first, r"^0\.7\d* us$")
        listed = recoil("value", out).stdout
        self.assertIn("contact.fly-er-tar-get.opens", listed)
        self.assertNotIn("contact.tar-get-fly-er", listed)

    def test_imports_a_material_into_the_folder_of_a_case(self):
        cards = self.folder / "ta.k"
        cards.write_text(CARDS)
        mine = self.folder / "materials" / "tantalum" / "mine.toml"
        words = ["material", "import", cards, "--units", "g-cm-us", "-o", mine]
        self.expect(recoil(*words), 0, str(mine), "not taken over: the pressure cutoff PC")
        text = mine.read_text()
        for line in ('title = "tantalum rod, imported from ta.k"', 'c0 = "3410 m/s"', 'specific-heat = "140 J/(kg K)"'):
            self.assertIn(line, text)
        self.expect(recoil(*words), 2, "exists", "remove it first")
        # Commands find it from that folder, as the case does.
        self.expect(recoil("material", "lint", "tantalum/mine", cwd=self.folder), 0, "nothing to remark")
        self.expect(recoil("material", "lint", "tantalum/mine"), 2, "there is no material 'tantalum/mine'")
        self.expect(recoil("check", self.case(('"copper/seed"', '"tantalum/mine"'))), 0, "predicted")

    def test_wrong_cards_are_named_by_line_and_columns(self):
        cards = self.folder / "ta.k"
        cards.write_text(CARDS.replace("     298.0    1.0E-6", "      298.0     1.0E-6"))
        self.expect(recoil("material", "import", cards, "--units", "SI"), 2, f"--> {cards}:6\n", "columns 71 to 80", "ten characters")
        self.expect(recoil("material", "import", self.folder, "--units", "SI"), 2, "there is no file", "= help:")


if __name__ == "__main__":
    unittest.main()
