#!/usr/bin/python3
"""Pictures of runs, as `recoil plot` draws them. Environment: see program.py."""

import unittest

from program import COARSE, DATA, FLYER, Program, recoil


class Plot(Program):
    def test_plots(self):
        self.expect(self.run_coarse(), 0)
        out, png = self.folder / "out", self.folder / "picture.png"
        reference = f"{FLYER.parent}/reference.csv:velocity"
        for words in (["gauge.rear", "--reference", reference], ["gauge.impact", "traction"], ["rear", png],
                      ["pressure"], ["velocity.x", "--at", "2 us"], ["stress.xx"]):
            target = [] if png in words else ["-o", png]
            self.expect(recoil("plot", out, *words, *target), 0, "picture.png")
            self.assertEqual(png.read_bytes()[:4], b"\x89PNG")
            png.unlink()
        self.expect(recoil("plot", out, "gauge.raer"), 2, "did you mean 'rear'?")
        self.expect(recoil("plot", out, "presure"), 2, "pressure")
        for other in (self.folder / "nowhere", self.folder):
            self.expect(recoil("plot", out, "gauge.rear", "--with", other), 2, "there is no", str(other))
        self.expect(recoil("plot", out, "gauge.rear", "speed"), 2, "velocity")
        self.expect(recoil("plot", out, "gauge.rear", "out.xyz"), 2, "'out.xyz' is neither a file that ends in .png", "velocity")
        self.expect(recoil("plot", out, "gauge.nosuch"), 2, "there is no gauge 'nosuch'", "it has", "impact, ", "rear")
        self.expect(recoil("plot", self.folder / "nowhere", "pressure"), 2, "no folder")
        self.expect(recoil("plot", out, "pressure", "--at", "60 us"), 2, "beyond the end of the run", "last fields")

    def test_a_field_that_was_not_written(self):
        self.expect(self.run_coarse("--end", "0.1us", "--set", "output.fields.every=0.02us", "--set",
                                    'output.fields.variables=["pressure", "velocity"]'), 0)  # fmt: skip
        for words in ([], ["--xt"]):
            self.expect(recoil("plot", self.folder / "out", "von-mises", *words), 2, "this run did not write the field 'von-mises'",
                        "it has pressure, velocity", "[output.fields]")  # fmt: skip

    def test_a_column_without_numbers_is_no_picture(self):
        self.expect(self.run_coarse("--end", "0.1us"), 0)
        (self.folder / "out" / "gauges" / "none.csv").write_text("time [us],depth [mm],width [mm]\n0,nan,1\n1,nan,1\n")
        file = self.folder / "picture.png"
        self.expect(recoil("plot", self.folder / "out", "gauge.none", "-o", file), 2, "there is no number in 'depth", "width")
        self.assertFalse(file.exists())
        self.expect(recoil("plot", self.folder / "out", "gauge.none", "width", "-o", file), 0)

    def test_round_off_does_not_look_like_physics(self):
        case = self.folder / "flight.toml"
        case.write_text("""
format = 1
domain = { geometry = "planar", x = ["-5 mm", "7 mm"], y = ["-5 mm", "7 mm"] }
mesh.finest = "0.5 mm"
time.end = "2 us"
output.history.every = "0.1 us"
[body.square]
material = "copper/ofhc-johnson-cook"
shape = { kind = "box", x = ["-4 mm", "4 mm"], y = ["-4 mm", "4 mm"], rotation = "20 deg" }
velocity = { x = "240 m/s", y = "180 m/s" }
[gauge.middle]
kind = "point"
body = "square"
at = { x = "0 mm", y = "0 mm" }
follows = true
[output.fields]
every = "1 us"
""")
        self.expect(recoil("run", case, "-o", self.folder / "out", "-j", "1"), 0)

        def text(*words):
            file = self.folder / "picture.svg"
            self.expect(recoil("plot", self.folder / "out", *words, "-o", file), 0)
            return file

        noted = [text("pressure").read_bytes(), text("stress.xx", "--along", "-3mm,0mm:3mm,0mm").read_bytes()]
        # Text is drawn as glyphs: the picture with the label that says so differs from the one with limits.
        self.assertNotEqual(noted[0], text("pressure", "--min", "-2e-8", "--max", "2e-8").read_bytes())
        self.assertGreater(len(noted[0]), len(text("pressure", "--min", "-1", "--max", "1").read_bytes()))
        self.assertNotEqual(noted[1], text("stress.xx", "--along", "-3mm,0mm:3mm,0mm", "--min", "-1", "--max", "1").read_bytes())

    def test_plots_in_three_formats(self):
        self.expect(self.run_coarse(), 0)
        out = self.folder / "out"
        for suffix, begin in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
            for words in (["gauge.rear"], ["pressure", "--xt"], ["history.flyer.kinetic"]):
                file, again = self.folder / f"a.{suffix}", self.folder / f"b.{suffix}"
                self.expect(recoil("plot", out, *words, "-o", file), 0, file.name)
                self.expect(recoil("plot", out, *words, again), 0, again.name)
                self.assertTrue(file.read_bytes().startswith(begin), words)
                self.assertEqual(file.read_bytes(), again.read_bytes())
        self.assertNotIn(b"CreationDate", again.read_bytes())
        for file in ("a.jpg", "a"):
            self.expect(recoil("plot", out, "gauge.rear", "-o", file), 2, ".png, .svg or .pdf")
        self.expect(recoil("plot", out, "pressure", "a.jpg"), 2, ".png, .svg or .pdf")
        self.expect(recoil("plot", out, "gauge.rear", "velocity", "a.jpg"), 2, ".png, .svg or .pdf")
        self.expect(recoil("check", self.case(), "--png", self.folder / "case.svg"), 0)
        self.assertIn(">", (self.folder / "case.svg").read_text())
        self.expect(recoil("check", self.case(), "--png", self.folder / "case.jpg"), 2, ".png, .svg or .pdf")

    def test_plots_as_they_are_asked_for(self):
        self.expect(self.run_coarse(), 0)
        out = self.folder / "out"

        def svg(*words):
            file = self.folder / "picture.svg"
            self.expect(recoil("plot", out, *words, "-o", file), 0, "picture.svg")
            return file.read_text()

        usual = svg("gauge.rear")
        self.assertIn('width="1200px" height="800px"', usual)
        self.assertIn('width="900px" height="500px"', svg("gauge.rear", "--width", "900", "--height", "500"))
        for words in (["--title", "Rear"], ["--max", "100"], ["--min", "-0.1km/s"], ["--log", "--min", "1 m/s"]):
            self.assertNotEqual(svg("gauge.rear", *words), usual, words)
        self.assertEqual(svg("gauge.rear", "--max", "100"), svg("gauge.rear", "--max", "0.1 km/s"))
        self.assertNotEqual(svg("pressure", "--xt"), svg("pressure", "--xt", "--max", "1", "--min", "-1"))
        self.expect(recoil("plot", out, "gauge.rear", "--min", "5", "--max", "2"), 2, "is not below --max 2")
        self.expect(recoil("plot", out, "gauge.rear", "--min", "5 GPa"), 2, "dimension [pressure]")
        self.expect(recoil("plot", out, "gauge.rear", "--log", "--min", "0"), 2, "positive limits")
        self.expect(recoil("plot", out, "gauge.rear", "--max", "-5"), 2, "below --max -5")
        self.expect(recoil("plot", out, "gauge.rear", "--width", "5"), 2, "--width")
        self.expect(recoil("plot", out, "history.flyer.kinetik"), 2, "flyer.kinetic")
        self.expect(recoil("plot", out, "pressure", "--along", "0mm,0mm:1mm,0mm"), 2, "need a field in the plane")
        self.expect(recoil("plot", out, "pressure", "--view", "x"), 2, "need a 3d run")
        self.expect(recoil("plot", out, "pressure", "--slice", "z=0mm"), 2, "--slice needs a 3d run")

    def picture(self, *words):
        """Draws; the size of the picture in bytes."""
        png = self.folder / "picture.png"
        self.expect(recoil("plot", *words, "-o", png), 0, "picture.png")
        return len(png.read_bytes())

    def test_plots_of_several_runs_and_over_time(self):
        self.expect(self.run_coarse(), 0)
        out, other = self.folder / "out", self.folder / "other"
        self.expect(recoil("run", self.case(), *COARSE, "--set", "mesh.offset=0.4", "-o", other), 0)
        self.assertNotEqual(self.picture(out, "gauge.rear"), self.picture(out, "gauge.rear", "--with", other))
        self.assertGreater(self.picture(out, "pressure", "--xt"), 5000)
        self.expect(recoil("plot", out, "pressure", "--window", "x=0mm..1mm"), 2, "need a field in the plane")

    def test_plots_of_parts_with_outlines(self):
        out, outline = self.folder / "out", self.folder / "outline.csv"
        self.expect(recoil("run", DATA / "cases" / "slip_aligned", "--end", "0.05 us", "-o", out),
                    5)
        outline.write_text("time [us],x [mm],y [mm]\n0,0,0\n0.05,-1,0.1\n0.05,1,0.5\n")
        whole, window = self.picture(out, "velocity.x"), ["--window", "x=-2.5mm..1mm,y=0mm..0.4mm"]
        part = self.picture(out, "velocity.x", *window)
        self.assertNotEqual(whole, part)
        self.assertNotEqual(part, self.picture(out, "velocity.x", *window, "--outline", outline))
        self.expect(recoil("plot", out, "velocity.x", "--window", "r=0mm..1mm"), 2, "--window x=0mm..9mm,y=0mm..12mm")
        self.expect(recoil("plot", out, "velocity.x", "--window", "x=50mm..60mm"), 2, "outside the field")
        self.expect(recoil("plot", out, "velocity.x", "--window", "x=1mm..0mm"), 2, "ends before it begins", "x=0mm..1mm")
        self.expect(recoil("plot", out, "velocity.x", "--at=-1us"), 2, "before the start of the run")
        self.expect(recoil("plot", out, "pressure", "--xt"), 2, "--xt needs a 1d run")
        self.assertNotEqual(whole, self.picture(out, "body"))
        self.expect(recoil("plot", out, "body", "--log"), 2, "a field of names")
        self.assertNotEqual(whole, self.picture(out, "velocity.x", "--along", "-1mm,-0.5mm:1mm,0.5mm"))
        for line, text in (("0mm,0mm", "is not a line"), ("0mm,0mm:0mm,0mm", "is a point"), ("0mm,0s:1mm,0mm", "time"),
                           ("50mm,50mm:60mm,50mm", "no matter along")):
            self.expect(recoil("plot", out, "velocity.x", "--along", line), 2, text)

    def test_views_of_space(self):
        out = self.folder / "out"
        recoil("run", DATA / "cases" / "sphere_on_plate", "--end", "1 us", "--set", "mesh.finest=1.5mm",
               "--set", "output.fields.every=1us", "--set", "output.report=false", "-o", out)  # misses expectations
        small = ["--width", "500", "--height", "400"]
        sizes = {}
        for words in (["--view=-50deg,25deg"], ["--view", "x"], ["--view", "-y", "--up", "x"], ["--mirror"],
                      ["--mirror", "--cut", "y=0mm"], ["--mirror", "--cut", "x+y=0mm"], ["--body", "sphere"],
                      ["--slice", "x=0mm"], ["--slice", "x-y=0mm"], ["--along", "0mm,0mm,-5mm:0mm,0mm,8mm"]):
            sizes[tuple(words)] = self.picture(out, "velocity.z", *words, *small)
        self.assertEqual(len(set(sizes.values())), len(sizes), sizes)
        self.expect(recoil("plot", out, "body", "--mirror", *small), 0, "body_1us_view.png")
        svg = self.folder / "view.svg"
        self.expect(recoil("plot", out, "velocity", "--view", "z", "--min", "1", "--log", *small, "-o", svg), 0)
        self.assertIn("<image", svg.read_text())
        self.expect(recoil("movie", out, "velocity.z", self.folder / "m.png", "--mirror", *small), 0, "2 pictures")
        for words, text in ((["--view", "q"], "no direction of view"), (["--view", "10deg,100deg"], "-90 deg to 90"),
                            (["--cut", "z"], "a plane is given as"), (["--cut", "z=1us"], "time"),
                            (["--view", "x", "--cut", "z=0mm"], "from its edge"), (["--body", "plat"], "sphere, plate"),
                            (["--view", "x", "--slice", "z=0mm"], "draw a plane"), (["--up", "w"], "--up is x, y or z"),
                            (["--view", "x", "--cut", "x=-9mm"], "nothing is left"),
                            (["--slice", "x+y=90mm"], "outside of all matter"),
                            (["--along", "0mm,0mm,1mm:1mm,1mm"], "is not a line")):
            self.expect(recoil("plot", out, "velocity.z", *words), 2, text)
        self.expect(recoil("plot", out, "velocity.z", "--along", "9cm,0mm,0mm:9cm,1mm,0mm"), 2, "no matter along")


if __name__ == "__main__":
    unittest.main()
