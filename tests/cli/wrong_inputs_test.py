#!/usr/bin/python3
"""Wrong inputs: each must get a message, its place and a cure, exit code 2, and leave no file behind.

Needs RECOIL_PROGRAM, the program, and RECOIL_DATA, the folder that holds cases/ and materials/.
"""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["RECOIL_PROGRAM"]
DATA = pathlib.Path(os.environ["RECOIL_DATA"])

FLYER = """\
format = 1
title = "Flyer"
[domain]
geometry = "1d"
x = ["-4 mm", "18 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "6 us"
[body.flyer]
material = "aluminium/6061-t6"
shape = { kind = "box", x = ["-2 mm", "0 mm"] }
velocity = { x = "450 m/s" }
[body.target]
material = "copper/ofhc-johnson-cook"
shape = { kind = "box", x = ["0 mm", "15 mm"] }
[gauge.rear]
kind = "surface-velocity"
body = "target"
at = { x = "15 mm" }
"""

PLANE = """\
format = 1
[domain]
geometry = "planar"
x = ["-5 mm", "20 mm"]
y = ["-10 mm", "10 mm"]
[mesh]
finest = "0.2 mm"
[time]
end = "1 us"
[body.ball]
material = "aluminium/6061-t6"
shape = { kind = "disc", radius = "2 mm", centre = { x = "-2.5 mm", y = "0 mm" } }
velocity = { x = "1 km/s" }
[body.target]
material = "copper/ofhc-johnson-cook"
shape = { kind = "box", x = ["0 mm", "10 mm"], y = ["-8 mm", "8 mm"] }
"""

MINE = '\n[material.mine]\nbase = "copper/ofhc-johnson-cook"\n[material.mine.%s]\n%s\n'
USES_MINE = ('"copper/ofhc-johnson-cook"', '"mine"')
END = ('end = "6 us"', 'end = "6 us"\n%s')


def after_end(text):
    return (END[0], END[1] % text)


# Changes of FLYER (pairs of texts; a single text is added at the end), part of the message, line, column, part of the cure.
ERRORS = [
    ([after_end('[output.fields]\nvariables = ["presure"]')], "there is no field 'presure'", 11, 14, "did you mean 'pressure'?"),
    ([after_end('[output.fields]\nvariables = ["pressure", "zzz"]')], "there is no field 'zzz'", 11, 26, "plastic-strain"),
    ([USES_MINE, MINE % ("eos", 'density = "8.93 kg/m3"')], "density 8.93 kg/m3 is that of no solid", 25, 11, "8.93 g/cm3"),
    ([USES_MINE, MINE % ("strength", 'a = "90 GPa"')], "yield stress 90 GPa is implausible", 25, 5, "90 MPa"),
    ([('"450 m/s"', '"450 km/s"')], "beyond the range of the equation of state", 13, 12, "is the unit right?"),
    ([('velocity = { x = "450 m/s" }\n', "")], "nothing moves", 10, 7, 'velocity = { x = "450 m/s" }'),
    ([('"450 m/s"', '"0 m/s"')], "nothing moves", 10, 7, "[body.flyer]"),
    ([('at = { x = "15 mm" }', 'at = { x = "15 mm" }\nevery = "7 us"')], "'every' = 7 us lies beyond the end", 21, 9, '0.06 us'),
    ([after_end('[output]\nfields = { every = "1 ms" }')], "'every' = 1000 us lies beyond the end", 11, 20, "gives 100"),
    ([after_end('[output]\nhistory = { every = "1 ms" }')], "beyond the end", 11, 21, "gives 100"),
    ([('["-2 mm", "0 mm"]', '["-0.04 mm", "0 mm"]')], "'flyer' is thinner than a cell: 0.04 mm, 0.4 cells", 12, 9, 'finest = "0.01 mm"'),
    ([('["-2 mm", "0 mm"]', '["-9 mm", "-7 mm"]')], "nothing of 'flyer' lies in the domain", 12, 9, "domain"),
    ([('"0.1 mm"', '"0.01 nm"')], "this machine has", 7, 10, "would fit"),
    ([('"450 m/s"', '"450 mps"')], "unknown unit 'mps'", 13, 18, "did you mean 'm/s'?"),
    ([('"450 m/s"', '"1600 kph"')], "unknown unit 'kph'", 13, 18, "did you mean 'km/h'?"),
    ([('"450 m/s"', '"1600 KMH"')], "unknown unit 'KMH'", 13, 18, "did you mean 'km/h'?"),
    ([('"450 m/s"', '"nan m/s"')], "'x' must be finite", 13, 18, '"450 m/s"'),
    ([('"450 m/s"', '"-inf m/s"')], "'x' must be finite", 13, 18, '"450 m/s"'),
    ([('"450 m/s"', '"1e999 m/s"')], "'x' must be finite", 13, 18, '"450 m/s"'),
    ([('"450 m/s"', '"1e307 km/s"')], "beyond the range of numbers", 13, 18, '"450 m/s"'),
    ([('"6 us"', "nan")], "'end' must be finite", 9, 7, '"10 us"'),
    ([('"6 us"', "inf")], "'end' must be finite", 9, 7, '"10 us"'),
    ([USES_MINE, MINE % ("eos", "s = nan")], "'s' must be finite", 25, 5, "write"),
    ([USES_MINE, MINE % ("strength", 'a = "90 Gpa"')], "unknown unit 'Gpa'", 25, 5, "did you mean 'GPa'?"),
    ([after_end('end = "7 us"')], "'end' is given twice", 10, 7, 'the first stands in line 9: end = "6 us"'),
    ([after_end('[mesh]\nfinest = "1 mm"')], "'mesh' is given twice", 10, 1, "the first stands in line 6: [mesh]"),
    ([("velocity = { x = ", 'velocity = { x = "1 m/s", x = ')], "'x' is given twice", 13, 31, "in the same line"),
    ([('title = "Flyer"', 'title = "Flyer')], "this quote is never closed", 2, 9, "behind the text"),
    ([('"6 us"', "'6 us")], "this quote is never closed", 9, 7, "behind the text"),
    ([('"6 us"', '6 us"')], "closes what was never opened", 9, 11, "before the text"),
    ([('["-4 mm", "18 mm"]', '["-4 mm, "18 mm"]')], "this quote is never closed", 5, 6, "behind the text"),
    ([('title = "Flyer"', 'title = """Flyer')], "this quote is never closed", 2, 9, "behind the text"),
    ([('"Flyer"', '"Fl\udce4yer"')], "the byte 0xE4 is no UTF-8", 2, 12, "save the file as UTF-8"),
    ([('"Flyer"', '"\u00e4\udcff"')], "the byte 0xFF is no UTF-8", 2, 11, "save the file as UTF-8"),
    ([("[gauge.rear]", 'detonation = { points = [{ x = "1 mm" }] }\n[gauge.rear]')],
     "'target' is lit, but 'copper/ofhc-johnson-cook' is no explosive", 17, 14, 'of kind "jwl"'),
    ([("[gauge.rear]", 'detonation = { points = [] }\n[gauge.rear]')], "'points' needs a list of positions", 17, 25, "e.g."),
    ([('velocity = { x = "450 m/s" }', 'velocity-history = [["0 us", { x = "1 m/s" }], ["1 us", { x = "2 m/s" }]]')],
     "'velocity-history' is for rigid bodies", 13, 1, "a rigid body can push it"),
    ([('velocity = { x = "450 m/s" }', 'velocity = { x = "450 m/s" }\npressure = "-900 GPa"')],
     "'flyer' cannot start at -900 GPa and 298 K", 14, 12, "change its pressure"),
    ([('material = "aluminium/6061-t6"', "rigid = true"),
      ('velocity = { x = "450 m/s" }', 'velocity-history = [["1 us", { x = "1 m/s" }], ["1 us", { x = "2 m/s" }]]')],
     "the times of 'velocity-history' do not grow", 13, 48, "nanosecond"),
    ([after_end('[output]\ncheckpoint = { every = "10 us" }')], "'every' = 10 us lies beyond the end", 11, 24, "gives 100"),
    ([after_end('[output]\ncheckpoint = { keep = 0 }')], "'keep' must be at least 1", 11, 23, "newest"),
    ([('"0.1 mm"', '"0.1 mm"\nblock = 4')], "blocks of 4 cells are too small", 8, 9, "block = 16"),
    ([('"0.1 mm"', '"0.1 mm"\nlevels = 2.5')], "'levels' needs a whole number", 8, 10, "levels = 4"),
    ([('"0.1 mm"', '"0.1 mm"\nlevels = 3\n[refine.far]\nx = ["30 mm", "40 mm"]')], "nothing of [refine.far] lies in the domain",
     9, 9, "into the domain"),
    ([('"0.1 mm"', '"0.1 mm"\nlevels = 3\n[refine]\nx = ["0 mm", "1 mm"]')], "'x' must be a refine", 10, 1, "[refine.NAME]"),
    ([('["-4 mm", "18 mm"]', '["-4 mm", "18.1 mm"]\nboundary = { x = "symmetry" }'), ('"0.1 mm"', '"0.1 mm"\nlevels = 3')],
     "221 of the finest cells along x, but its closed ends need whole cells of all 3 levels", 9, 10, "such as 224"),
    ([USES_MINE, '\n[material.mine]\nbase = "mine"\n'], "material 'mine' is its own base", 23, 8, "recoil material list"),
    ([USES_MINE, MINE % ("damage", 'kind = "tensil"')], "'tensil' is not a valid 'kind'", 25, 8, "did you mean 'tensile'?"),
    ([USES_MINE, MINE % ("thermal", 'heat-capacity = "383 J/kg"')], "unknown key 'heat-capacity'", 25, 1, "specific-heat"),
    ([('"aluminium/6061-t6"', '""')], "the material has no name", 11, 12, "material list"),
    (['[expect]\n"gauge.rear.velocity.max" = { value = "1 us", within = "1 %" }'],
     "'gauge.rear.velocity.max' is of [velocity], but the expected value is of [time]", 22, 1, "give it in m/s"),
    (['[expect]\n"contact.flyer-target.opens" = { value = "0.7 um", within = "1 %" }'],
     "'contact.flyer-target.opens' is of [time], but the expected value is of [length]", 22, 1, "give it in us"),
    (['[expect]\n"event.ricochets" = true'], "no run of this case has such a result", 22, 1, "did you mean 'event.ricochet'?"),
    (['[expect]\n"foo" = true'], "there is no quantity 'foo'", 22, 1, "quantities begin with body., budget., contact."),
    (['[expect]\n"gaugee.rear.velocity.max" = { at-least = "1 m/s" }'], "there is no quantity 'gaugee.rear.velocity.max'", 22, 1,
     "did you mean 'gauge'?"),
    (['[expect]\n"gauge.rear.velosity.max" = { at-least = "1 m/s" }'], "gauge 'rear' has no column 'velosity'", 22, 1,
     "did you mean 'velocity'?"),
    (['[expect]\n"gauge.rear.velocity" = { at-least = "1 m/s" }'], "does not say which value of the record", 22, 1, ".max"),
    (['[expect]\n"gauge.rear.velocity.max" = { value = nan, within = "1 %" }'], "needs a number or a quantity", 22, 39, "0.695 us"),
    (['[expect]\n"gauge.rear.velocity.error@0us..1us:no.csv:velocity" = { at-most = "1 m/s" }'], "cannot read the table", 22, 1,
     "CSV file"),
    ([('"0.1 mm"', '"-0.1 mm"')], "'finest' must be more than 0 mm", 7, 10, 'finest = "0.05 mm"'),
    ([('"450 m/s"', '["450 m/s"]')], "'x' needs a quantity of [velocity], but is a list", 13, 18, 'e.g. "450 m/s"'),
    ([("[mesh]", "[mesh")], "this is no TOML", 6, 6, "[table] or key = value"),
    ([('["-4 mm", "18 mm"]', '["-4 mm", "18 mm"]\nboundary = { x = ["outflow", "outflow", "outflow"] }')],
     "'x' needs one kind of boundary or two", 6, 18, '["symmetry", "outflow"]'),
    (['[contact.pairs]\nflyer-target = { mode = "bonded" }\ntarget-flyer = { mode = "separable" }'],
     "the pair 'target-flyer' is given twice", 23, 1, "leave one of them out"),
    ([('material = "aluminium/6061-t6"', "rigid = true"), ('material = "copper/ofhc-johnson-cook"', "rigid = true"),
      ('[gauge.rear]\nkind = "surface-velocity"\nbody = "target"\nat = { x = "15 mm" }\n', "")],
     "all bodies are rigid", 10, 7, "give one of them a material"),
    ([('["-4 mm", "18 mm"]', '["-4 mm", "18 mm"]\nboundary = { x = ["symmetry", "outflow"] }'),
      '[body.free]\nrigid = true\nmass = "1 kg/m2"\nshape = { kind = "box", x = ["-4 mm", "-3 mm"] }\n'],
     "the free rigid body 'free' is cut by the plane of symmetry x = -4 mm", 25, 9, "model it whole"),
    # A material of two bodies: its mistake once.
    ([USES_MINE, ('"aluminium/6061-t6"', '"mine"'), MINE % ("strength", 'a = "90 Gpa"')], "unknown unit 'Gpa'", 25, 5,
     "did you mean 'GPa'?"),
]

# The same of warnings, which leave the case fit to run. A place of None: not checked.
WARNINGS = [
    (FLYER, [('"450 m/s"', '"-450 m/s"')], "'flyer' and 'target' fly apart", 13, "turn the velocity round"),
    (PLANE, [('"1 km/s"', '"-1 km/s"'), ('y = ["-10 mm", "10 mm"]', 'y = ["0 mm", "10 mm"]\nboundary = { y = ["symmetry", "outflow"] }')],
     "'ball' and 'target' fly apart", 14, "turn the velocity round"),
    (FLYER, [('"15 mm"] }', '"20 mm"] }'), ('at = { x = "15 mm" }', 'at = { x = "0 mm" }')],
     "'target' is cut off at the high end of x, an outflow edge: 2 mm", 16, "20 mm"),
    (FLYER, [('["-4 mm", "18 mm"]', '["-2.2 mm", "18 mm"]\nboundary = { x = ["symmetry", "outflow"] }'), ('"450 m/s"', '"-450 m/s"')],
     "'flyer' meets its mirror image in the plane of symmetry x = -2.2 mm at 0.4444 us", 14, "a rigid half-space"),
    (FLYER, [USES_MINE, MINE % ("strength", 'a = "6 GPa"')], "yield stress 6 GPa is implausible", 25, "no metal exceeds about 5 GPa"),
    (FLYER, [USES_MINE, MINE % ("eos", 'density = "29000 kg/m3"')], "that of no solid", 25, "23000"),
    (FLYER, [('"copper/ofhc-johnson-cook"', '"copper/seed"')], "material 'copper/seed' is in doubt", 15, "slip of copying"),
    (FLYER, [('title = "Flyer"', 'cite = ["jonson1983"]')], "the source 'jonson1983' is not in", 2, "did you mean 'johnson1983'?"),
    (FLYER, [('"0.1 mm"', '"0.1 mm"\nbend = 0.2')], "'mesh.bend' has no effect", 8, "levels = 3"),
    (FLYER, [('[time]', '[refine.near]\nx = ["-1 mm", "1 mm"]\n[time]')], "'refine.near' has no effect", 8, "levels = 3"),
    (FLYER, [MINE % ("strength", 'a = "90 MPa"')], "no body is of the material 'mine'", 22, 'material = "mine"'),
    (PLANE, [('{ x = "-2.5 mm", y = "0 mm" }', '{ x = "-2.5 mm", y = "9 mm" }'), ('"8 mm"] }', '"9.9 mm"] }')],
     "'ball' is cut off at the high end of y", 12, "reach"),
    (PLANE, [('{ kind = "disc", radius = "2 mm", centre = { x = "-2.5 mm", y = "0 mm" } }',
              '{ kind = "polygon", vertices = [["-3 mm", "0 mm"], ["-0.1 mm", "0 mm"], ["-0.1 mm", "0.5 mm"], ["-3 mm", "0.5 mm"]] }')],
     "'ball' is 2.5 cells thick; about 4 are needed", 12, "finest ="),
    (PLANE, [('{ kind = "disc", radius = "2 mm", centre = { x = "-2.5 mm", y = "0 mm" } }',
              '{ kind = "union", parts = [{ kind = "disc", radius = "2 mm", centre = { x = "-2.5 mm", y = "0 mm" } },'
              ' { kind = "box", x = ["-3 mm", "-2 mm"], y = ["1.5 mm", "2.1 mm"] }] }')],
     "'ball' is 3 cells thick", 12, "finest ="),
    (FLYER, [('"copper/ofhc-johnson-cook"', '"explosive-products/tnt"')], "'target' is an explosive that nothing lights", 14, "detonation ="),
    (FLYER, [('"copper/ofhc-johnson-cook"', '"explosive-products/tnt"'),
             ("[gauge.rear]", 'detonation = { points = [{ x = "17 mm" }] }\n[gauge.rear]')],
     "'target' is lit at a point 2 mm outside of it", 17, "move the point"),
    (FLYER, [('"copper/ofhc-johnson-cook"', '"explosive-products/tnt"'),
             ("[gauge.rear]", 'detonation = { points = [{ x = "1 mm" }], time = "7 us" }\n[gauge.rear]')],
     "'target' is lit at 7 us, but the run ends at 6 us", 17, "light it earlier"),
    (FLYER, [after_end('fixed-dt = "1 us"')], "a step of 1000 ns is unstable", 10, "at most 'fixed-dt' = "),
    (FLYER, [('"6 us"', '"1 year"')], "the run would take", 9, "is the unit right?"),
    (FLYER, ['[body.one]\nrigid = true\nshape = { kind = "box", x = ["15.5 mm", "16 mm"] }\nvelocity = { x = "1 km/s" }\n',
             '[body.two]\nrigid = true\nshape = { kind = "box", x = ["16.5 mm", "17 mm"] }\n'],
     "the rigid bodies 'one' and 'two' meet at 0.5 us", 24, "only bodies with a material push others"),
]

# Words behind `run CASE`, and what is said of them.
USAGE = [
    (["-j", "0"], "'0' is no whole number of 1 or more"),
    (["-j", "-3"], "'-3' is no whole number"),
    (["-j", "2.5"], "'2.5' is no whole number"),
    (["-n", "0"], "'0' is no whole number of 1 or more"),
    (["-n", "99999"], "99999 processes are too many"),
]


def changed(text, changes):
    for change in changes:
        if isinstance(change, str):
            text += change
            continue
        old, new = change
        assert old in text, old
        text = text.replace(old, new)
    return text


class WrongInputs(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)
        self.file = self.folder / "case.toml"

    def recoil(self, *words):
        result = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, errors="replace", timeout=300,
                                check=False, cwd=self.folder)
        return result.returncode, result.stdout + result.stderr

    def write(self, text, changes=()):
        self.file.write_bytes(changed(text, changes).encode("utf-8", "surrogateescape"))

    def assert_nothing_written(self):
        self.assertEqual([p.name for p in self.folder.iterdir()], ["case.toml"])

    def test_errors(self):
        for changes, message, line, column, cure in ERRORS:
            with self.subTest(message):
                self.write(FLYER, changes)
                code, said = self.recoil("check", self.file)
                too_large = "this machine has" in message
                self.assertEqual(code, 4 if too_large else 2, said)
                self.assertEqual(said.count("error:"), 1, said)
                block = said[said.index("error:"):]
                self.assertIn(message, block.splitlines()[0])
                self.assertIn(f"  --> {self.file}:{line}:{column}\n", block)
                self.assertRegex(block, r"\n   \| +\t*\^")
                self.assertIn(cure, block[block.index("= help:"):])
                code, again = self.recoil("run", self.file, "-o", self.folder / "out")
                self.assertEqual(code, 4 if too_large else 2, again)
                self.assertIn(message, again)
                self.assert_nothing_written()

    def test_warnings(self):
        for text, changes, message, line, cure in WARNINGS:
            with self.subTest(message):
                self.write(text, changes)
                code, said = self.recoil("check", self.file)
                self.assertEqual(code, 0, said)
                blocks = [b for b in re.split(r"(?=warning: )", said) if message in b.split("\n")[0]]
                self.assertEqual(len(blocks), 1, said)
                self.assertIn(f"  --> {self.file}:{line}:", blocks[0])
                self.assertIn(cure, blocks[0][blocks[0].index("= help:"):])

    def test_right_inputs_are_silent(self):
        for text in (FLYER, PLANE):
            self.write(text)
            code, said = self.recoil("check", self.file)
            self.assertEqual(code, 0, said)
            self.assertNotIn("error:", said)
            self.assertNotRegex(said, "apart|cut off|doubt|implausible")

    def test_shapes_that_are_none(self):
        disc = '{ kind = "disc", radius = "2 mm", centre = { x = "-2.5 mm", y = "0 mm" } }'
        for shape, message, cure in (
                ('{ kind = "polygon", vertices = [["-3 mm", "0 mm"], ["-1 mm", "2 mm"], ["-1 mm", "0 mm"], ["-3 mm", "2 mm"]] }',
                 "the edges from corner 1 and from corner 3 cross", "along the outline"),
                ('{ kind = "polygon", vertices = [["-3 mm", "0 mm"], ["-2 mm", "0 mm"], ["-1 mm", "0 mm"]] }',
                 "the corners lie on one line", "an area"),
                ('{ kind = "lattice", shape = %s, count = { y = 0 }, pitch = { y = "3 mm" } }' % disc, "0 is no number of copies",
                 "count = { x = 3 }"),
                ('{ kind = "union", parts = [] }', "'parts' needs a list of at least 1 shapes", 'kind = "box"')):
            self.write(PLANE, [(disc, shape)])
            code, said = self.recoil("check", self.file)
            self.assertEqual(code, 2, said)
            self.assertIn(message, said)
            self.assertIn(cure, said[said.index("= help:"):])
            self.assertRegex(said, r"--> \S+:12:\d+\n")

    def test_gauges_that_measure_matter_of_rigid_bodies(self):
        """One of kind "peak-stress" crashed; the others recorded nothing."""
        rigid = [('material = "copper/ofhc-johnson-cook"', "rigid = true")]
        for kind, more in (("surface-velocity", ""), ("point", ""), ("pullback", ""), ("peak-stress", 'to = { x = "1 mm" }\n')):
            self.write(FLYER, [*rigid, ('"surface-velocity"', f'"{kind}"'), more])
            code, said = self.recoil("run", self.file, "-o", self.folder / "out")
            self.assertEqual(code, 2, said)
            self.assertIn("gauge 'rear' measures matter, but 'target' is a rigid body", said)
            self.assertRegex(said, r"--> \S+:19:8\n")
            self.assert_nothing_written()

    def test_more_bodies_than_are_possible(self):
        self.write(FLYER, [f'[body.b{k}]\nrigid = true\nshape = {{ kind = "box", x = ["{15.1 + 0.05 * k:.3f} mm", "{15.13 + 0.05 * k:.3f} mm"] }}\n'
                           for k in range(31)])
        code, said = self.recoil("check", self.file)
        self.assertEqual(code, 2, said)
        self.assertIn("33 bodies, at most 32 are possible", said)

    def test_a_match_beyond_the_equations_of_state(self):
        code, said = self.recoil("material", "match", "copper/seed", "copper/seed", "--speed", "300km/s")
        self.assertEqual(code, 2, said)
        self.assertIn("= help:", said)

    def test_empty_files(self):
        for text in ("", "\n  \n"):
            self.write(text)
            for words in (["check", self.file], ["run", self.file, "-o", self.folder / "out"]):
                code, said = self.recoil(*words)
                self.assertEqual(code, 2, said)
                self.assertIn("the file is empty", said)
                self.assertIn("= help:", said)
            self.assert_nothing_written()

    def test_usage(self):
        self.write(FLYER)
        for words, message in USAGE:
            with self.subTest(words):
                code, said = self.recoil("run", self.file, "-o", self.folder / "out", *words)
                self.assertEqual(code, 2, said)
                self.assertIn(message, said)
                self.assert_nothing_written()

    def test_more_threads_than_processors_are_left_out(self):
        self.write(FLYER)
        code, said = self.recoil("run", self.file, "-o", self.folder / "out", "-j", "1000", "--end", "0.05 us")
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r"note: \d+ threads?, as there are processors, not 1000")

    def test_a_run_cut_short_may_have_longer_intervals(self):
        self.write(FLYER, [after_end('[output]\nfields = { every = "1 us" }')])
        code, said = self.recoil("check", self.file, "--set", "time.end=0.05us")
        self.assertEqual(code, 0, said)
        self.assertIn("lies beyond the end", said)

    def test_impacts_that_are_no_plates_are_predicted_at_first_touch(self):
        self.write(PLANE)
        code, said = self.recoil("check", self.file)
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r"'ball' touches 'target' at about 0\.5(0\d)? us, closing at 1000 m/s\n")

    def test_a_crater_is_looked_at_from_outside(self):
        crater = '[gauge.pit]\nkind = "crater"\nbody = "target"\nat = { x = "0 mm" }\ndirection = { x = %d }\nradius = "5 mm"\n'
        self.write(PLANE + crater % 1)
        code, said = self.recoil("check", self.file)
        self.assertEqual(code, 2, said)
        self.assertIn("the direction of gauge 'pit' leads into 'target'", said)
        self.assertRegex(said, r"--> \S+:21:13\n")
        self.assertIn("turn it round", said)
        self.write(PLANE + crater % -1)
        self.assertEqual(self.recoil("check", self.file)[0], 0)

    def test_a_bar_has_no_opening_time(self):
        code, said = self.recoil("check", DATA / "cases" / "taylor_copper")
        self.assertEqual(code, 0, said)
        self.assertNotIn("opens about", said)
        self.assertIn("releases from the sides come first", said)

    def test_a_release_that_overtakes_makes_a_bound(self):
        self.write(FLYER, [('"18 mm"', '"50 mm"'), ('"15 mm"', '"45 mm"')])
        code, said = self.recoil("check", self.file)
        self.assertEqual(code, 0, said)
        self.assertIn("to at most", said)

    def test_a_release_that_nearly_overtakes_makes_a_bound(self):
        self.write(FLYER, [('"450 m/s"', '"200 m/s"')])  # the run's peak is 30 % below the plateau
        code, said = self.recoil("check", self.file)
        self.assertEqual(code, 0, said)
        self.assertIn("to at most 118.4 m/s", said)

    def test_meshes_of_a_study_are_checked_before_the_first_run(self):
        for meshes, message in (("0.2mm,0mm", "must be"), ("0.2mm,0.2mm", "--mesh names 0.2mm twice"), ("0.2mm,5mm", "thinner than a cell")):
            self.write(FLYER)
            code, said = self.recoil("study", self.file, "--mesh", meshes, "-o", self.folder / "out")
            self.assertEqual(code, 2, said)
            self.assertIn(message, said)
            self.assert_nothing_written()

    def test_doubts_are_shown_with_the_material(self):
        code, said = self.recoil("material", "show", "copper/seed")
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r'doubt = ".*slip of copying')


if __name__ == "__main__":
    unittest.main()
