#!/usr/bin/python3
"""The command line as its users and their scripts see it: messages, exit codes, files.

Needs RECOIL_PROGRAM, the program, and RECOIL_DATA, the folder that holds cases/ and materials/.
"""

import csv
import filecmp
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["RECOIL_PROGRAM"]
DATA = pathlib.Path(os.environ["RECOIL_DATA"])
FLYER = DATA / "cases" / "flyer_al_cu" / "case.toml"
COARSE = ["--set", "mesh.finest=0.2mm"]  # runs in a fraction of a second


def recoil(*words, **more):
    """Runs the program; the result has returncode, stdout and stderr."""
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=500, check=False, **more)


class Program(unittest.TestCase):
    """A test with a scratch folder."""

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def case(self, *changes):
        """A copy of the flyer case without its expectations, with texts replaced; its file."""
        text = FLYER.read_text()
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        file = self.folder / "case.toml"
        file.write_text(text)
        return file

    def expect(self, result, code, *texts):
        said = result.stdout + result.stderr
        self.assertEqual(result.returncode, code, said)
        for text in texts:
            self.assertIn(text, said)


class Usage(Program):
    def test_misspelt_words_get_a_cure(self):
        self.expect(recoil("chek", FLYER), 2, "no command 'chek'", "did you mean 'check'?")
        self.expect(recoil("run", FLYER, "--forse"), 2, "did you mean '--force'?")
        self.expect(recoil("material", "lits"), 2, "did you mean 'list'?")
        self.expect(recoil("check", "flyer_al_ku"), 2, "did you mean 'flyer_al_cu'?")
        self.expect(recoil("material", "show", "coper/seed"), 2, "did you mean 'copper/seed'?")
        self.expect(recoil("explain", "finst"), 2, "did you mean")

    def test_nothing_is_bad_usage_and_help_is_not(self):
        self.expect(recoil(), 2, "recoil --help")
        for words in (["--help"], ["run", "--help"], ["--version"]):
            self.expect(recoil(*words), 0)
        self.assertRegex(recoil("--version").stdout, r"^recoil \d+\.\d+")

    def test_materials(self):
        self.expect(recoil("material", "list"), 0, "copper/seed", "steel/hzb")
        self.expect(recoil("material", "show", "copper/seed"), 0, 'kind = "johnson-cook"', "cite")

    def test_a_shown_material_is_one_that_can_be_used(self):
        shown = recoil("material", "show", "copper/seed").stdout
        lines = [f"[material.mine.{line[1:]}" if line.startswith("[") else line for line in shown.splitlines()]
        text = self.case(('"copper/seed"', '"mine"')).read_text() + "\n[material.mine]\n" + "\n".join(lines)
        (self.folder / "mine.toml").write_text(text)
        self.expect(recoil("check", self.folder / "mine.toml"), 0, "5.084 GPa")

    def test_schema_and_explanations(self):
        schema = json.loads(recoil("schema").stdout)
        self.assertIn("finest", schema["properties"]["mesh"]["properties"])
        material = schema["properties"]["material"]["additionalProperties"]["properties"]
        self.assertIn("c0", material["eos"]["properties"])
        self.expect(recoil("schema", "--markdown"), 0, "| `finest` |")
        self.expect(recoil("explain", "mesh.finest"), 0, "length")
        self.expect(recoil("explain", "material.any.strength.melting-temperature"), 0, "[K]")

    def test_missing_library_is_an_error_of_the_environment(self):
        empty = dict(os.environ, RECOIL_DATA=str(self.folder))
        self.expect(recoil("material", "list", env=empty), 4, "RECOIL_DATA")


class Check(Program):
    def test_predicts_the_answer(self):
        self.expect(recoil("check", FLYER), 0, "133.7 m/s, 5.084 GPa", "precursor", "opens about", "steps")

    def test_json(self):
        report = json.loads(recoil("check", FLYER, "--json").stdout)[0]
        self.assertTrue(report["good"])
        predicted = report["predicted"][0]
        self.assertAlmostEqual(predicted["interface_stress"] * 1e-9, 5.0838, 3)
        self.assertEqual(predicted["opens_by"], "flyer-release")
        self.assertGreater(report["cost"]["steps"], 100)

    def test_all_mistakes_in_one_pass_with_place_and_cure(self):
        file = self.case(("velocity =", "velocty ="), ('finest = "0.05 mm"', 'finest = "2 us"'))
        result = recoil("check", file)
        self.expect(result, 2, "unknown key 'velocty' in [body.flyer]", "did you mean 'velocity'?",
                    "'2 us' has dimension [time]", f"--> {file}:19:1")
        report = json.loads(recoil("check", file, "--json").stdout)[0]
        self.assertFalse(report["good"])
        self.assertEqual([d["line"] for d in report["found"]], [11, 19])

    def test_logic(self):
        self.expect(recoil("check", FLYER, "--set", 'body.flyer.shape.x=["-2 mm", "0.5 mm"]'), 2, "overlap")
        self.expect(recoil("check", FLYER, "--set", "gauge.rear.at.x=14mm"), 2, "not on the surface")
        self.expect(recoil("check", FLYER, "--set", "mesh.finest=0.5mm"), 0, "4 cells thick", "0.1 mm")

    def test_several_cases_and_a_bad_one(self):
        bad = self.case(("[mesh]", "[mush]"))
        self.expect(recoil("check", FLYER, bad), 2, "133.7 m/s", "not fit to run")

    def test_other_schemes_say_what_they_do_not_keep(self):
        self.expect(recoil("check", FLYER, "--set", "method.scheme=seed"), 0, "not kept at surfaces", "0.025 mm are left")
        self.expect(recoil("check", FLYER, "--set", "method.kappa=0.3"), 2, "no meaning for scheme", "scheme = \"seed\"")

    def test_picture(self):
        png = self.folder / "case.png"
        self.expect(recoil("check", FLYER, "--png", png), 0)
        self.assert_png(png)

    def assert_png(self, file):
        data = file.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", data[16:24])
        self.assertGreater(min(width, height), 200)


class Run(Program):
    def run_coarse(self, *words, case=None):
        return recoil("run", case or self.case(), "-o", self.folder / "out", *COARSE, *words)

    def test_leaves_what_is_promised(self):
        self.expect(self.run_coarse(), 0, "opening flyer-target", "budget of total", "finished at 6 us")
        out = self.folder / "out"
        for name in ("case.toml", "case.resolved.toml", "run.log", "status.json", "summary.json", "history.csv",
                     "events.csv", "gauges/rear.csv", "gauges/impact.csv", "fields"):
            self.assertTrue((out / name).exists(), name)
        self.assertEqual((out / "case.toml").read_text(), FLYER.read_text())
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["exit"], 0)
        for drift in summary["budgets"]["total"].values():
            self.assertLess(abs(drift), 1e-11)
        with open(out / "gauges" / "rear.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0][:2], ["time [us]", "velocity [m/s]"])
        self.assertGreater(max(float(row[1]) for row in rows[1:]), 160)
        with open(out / "events.csv", newline="") as file:
            kinds = [row["event"] for row in csv.DictReader(file)]
        self.assertEqual(kinds[:2], ["contact", "opening"])

    def test_the_resolved_case_gives_the_same_run(self):
        self.expect(self.run_coarse("--end", "1us"), 0)
        resolved = self.folder / "out" / "case.resolved.toml"
        self.assertIn('end = "1e-06 s"  # --set', resolved.read_text())
        self.expect(recoil("run", resolved, "-o", self.folder / "again"), 0)
        for name in ("gauges/rear.csv", "gauges/impact.csv", "history.csv", "events.csv"):
            self.assertTrue(filecmp.cmp(self.folder / "out" / name, self.folder / "again" / name, shallow=False), name)

    def test_a_finished_run_is_not_overwritten(self):
        self.expect(self.run_coarse("--end", "0.1us"), 0)
        before = (self.folder / "out" / "summary.json").stat().st_mtime_ns
        self.expect(self.run_coarse("--end", "0.1us"), 2, "finished run", "--force")
        self.assertEqual((self.folder / "out" / "summary.json").stat().st_mtime_ns, before)
        self.expect(self.run_coarse("--end", "0.1us", "--force"), 0)

    def test_foreign_files_are_left_alone(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / "thesis.tex").write_text("years of work")
        self.expect(self.run_coarse("--force"), 2, "no run")
        self.assertEqual((self.folder / "out" / "thesis.tex").read_text(), "years of work")

    def test_a_failed_expectation_is_exit_5(self):
        text = self.case().read_text() + '\n[expect]\n"gauge.rear.velocity.peak" = { at-most = "100 m/s" }\n'
        (self.folder / "case.toml").write_text(text)
        result = self.run_coarse("-q", case=self.folder / "case.toml")
        self.expect(result, 5, "FAIL gauge.rear.velocity.peak")
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual(summary["exit"], 5)
        self.assertFalse(summary["expect"]["gauge.rear.velocity.peak"]["pass"])

    def test_a_numerical_failure_is_exit_3_and_leaves_what_is_known(self):
        result = self.run_coarse("--set", "time.fixed-dt=0.5 us")  # 20 times the stable step
        self.expect(result, 3, "what is known is in")
        self.assertIn("last dt 500 ns", (self.folder / "out" / "crash" / "process_0.txt").read_text())
        self.assertEqual(json.loads((self.folder / "out" / "status.json").read_text())["state"], "failed")
        self.assertFalse((self.folder / "out" / "summary.json").exists())

    def test_bad_input_leaves_no_folder(self):
        self.expect(self.run_coarse("--set", "body.flyer.material=coper/seed"), 2, "copper/seed")
        self.assertFalse((self.folder / "out").exists())

    def test_quiet_is_quiet(self):
        result = self.run_coarse("--end", "0.1us", "-q")
        self.expect(result, 0)
        self.assertEqual(result.stdout, "")

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
        self.expect(recoil("plot", out, "gauge.rear", "speed"), 2, "velocity")
        self.expect(recoil("plot", self.folder / "nowhere", "pressure"), 2, "no folder")
        self.expect(recoil("plot", out, "pressure", "--at", "60 us"), 2, "beyond the end of the run", "last fields")

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
        self.expect(recoil("plot", out, "gauge.rear", "--log", "--min", "0"), 2, "positive ends")
        self.expect(recoil("plot", out, "gauge.rear", "--max", "-5"), 2, "below --max -5")
        self.expect(recoil("plot", out, "gauge.rear", "--width", "5"), 2, "--width")
        self.expect(recoil("plot", out, "history.flyer.kinetik"), 2, "flyer.kinetic")
        self.expect(recoil("plot", out, "pressure", "--along", "0mm,0mm:1mm,0mm"), 2, "need a field in the plane")

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
        self.expect(recoil("plot", out, "velocity.x", "--window", "x=50mm..60mm"), 2, "beside the field")
        self.expect(recoil("plot", out, "pressure", "--xt"), 2, "--xt needs a 1d run")
        self.assertNotEqual(whole, self.picture(out, "body"))
        self.expect(recoil("plot", out, "body", "--log"), 2, "a field of names")
        self.assertNotEqual(whole, self.picture(out, "velocity.x", "--along", "-1mm,-0.5mm:1mm,0.5mm"))
        for line, text in (("0mm,0mm", "is no line"), ("0mm,0mm:0mm,0mm", "is a point"), ("0mm,0s:1mm,0mm", "time"),
                           ("50mm,50mm:60mm,50mm", "no matter along")):
            self.expect(recoil("plot", out, "velocity.x", "--along", line), 2, text)


class Ranks(Program):
    def test_processes_and_threads_give_the_same_bits(self):
        runs = {"one": [], "two": ["-n", "2"], "threads": ["-j", "2"]}
        for name, words in runs.items():
            self.expect(recoil("run", self.case(), "-o", self.folder / name, *COARSE, "--end", "2us", *words), 0)
        for name in ("two", "threads"):
            for file in ("gauges/rear.csv", "gauges/impact.csv", "gauges/flyer.csv", "history.csv", "events.csv"):
                self.assertTrue(filecmp.cmp(self.folder / "one" / file, self.folder / name / file, shallow=False),
                                f"{name} {file}")

    def test_exit_codes_come_through_mpirun(self):
        self.expect(recoil("run", self.case(), "-n", "2", "--set", "mesh.finest=1us"), 2, "dimension [time]")
        text = self.case().read_text() + '\n[expect]\n"gauge.rear.velocity.peak" = { at-least = "1 km/s" }\n'
        (self.folder / "case.toml").write_text(text)
        self.expect(recoil("run", self.folder / "case.toml", "-n", "2", "-o", self.folder / "out", *COARSE), 5, "FAIL")


class Study(Program):
    def test_tabulates_expectations_over_meshes(self):
        expected = """
[expect]
"gauge.impact.traction.mean@0.2us..0.5us" = { value = "-5.091 GPa", within = "1 %" }
"gauge.flyer.velocity.x.last" = { value = "-160.9 m/s", within = "1 %" }
"""
        (self.folder / "case.toml").write_text(self.case().read_text() + expected)
        self.expect(recoil("study", self.folder / "case.toml", "--mesh", "0.4mm,0.2mm,0.1mm", "--offset", "0,0.37",
                           "-o", self.folder / "study"), 0, "gauge.flyer.velocity.x.last")
        with open(self.folder / "study" / "study.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 12)
        errors = [abs(float(row["error"])) for row in rows
                  if row["quantity"] == "gauge.flyer.velocity.x.last" and float(row["offset [1]"]) == 0]
        self.assertGreater(errors[0], errors[1])
        self.assertGreater(errors[1], errors[2])
        self.assertIn("| order |", (self.folder / "study" / "study.md").read_text())
        self.assertEqual((self.folder / "study" / "error.png").read_bytes()[:4], b"\x89PNG")
        self.assertFalse((self.folder / "study" / "rear_velocity.png").exists(), "no curve is expected")

    def test_draws_records_over_their_reference(self):
        (self.folder / "curve.csv").write_text("time [us],speed [m/s]\n0,0\n6,20\n")
        (self.folder / "case.toml").write_text(
            self.case().read_text() + '[expect]\n"gauge.rear.velocity.error@3us..5us:curve.csv:speed" = { at-most = "1 km/s" }\n')
        self.expect(recoil("study", self.folder / "case.toml", "--mesh", "0.4mm,0.2mm", "-o", self.folder / "study"), 0,
                    "rear_velocity.png")
        self.assertEqual((self.folder / "study" / "rear_velocity.png").read_bytes()[:4], b"\x89PNG")

    def test_mistakes_come_before_the_first_run(self):
        self.expect(recoil("study", self.case(), "--mesh", "0.2mm,fine", "-o", self.folder / "study"), 2, "fine")
        self.assertFalse((self.folder / "study").exists())


class Verify(Program):
    def expecting(self, value):
        folder = self.folder / "mine"
        folder.mkdir(exist_ok=True)
        text = FLYER.read_text().replace('"0.05 mm"', '"0.2 mm"')
        (folder / "case.toml").write_text(text)
        (folder / "expected.toml").write_text(
            '[expect]\n"gauge.impact.traction.mean@0.2us..0.5us" = { value = "%s", within = "1 %%", source = "theory" }\n'
            '"contact.flyer-target.recloses" = false\n' % value)
        return folder

    def test_one_table_in_three_forms(self):
        out = self.folder / "out"
        self.expect(recoil("verify", self.expecting("-5.091 GPa"), "-o", out, "--write", self.folder / "table.md"), 0,
                    "1 cases, 2 checks, 1 against references, 0 failed")
        table = (self.folder / "table.md").read_text()
        self.assertIn("| -5.091 GPa | theory |", table)
        self.assertEqual(table, (out / "verify.md").read_text())
        with open(out / "verify.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["pass"] for row in rows], ["true", "true"])
        self.assertEqual(json.loads((out / "verify.json").read_text())["references"], 1)

    def test_a_failure_is_exit_5_and_runs_are_used_again(self):
        out = self.folder / "out"
        case = self.expecting("-6 GPa")
        self.expect(recoil("verify", case, "-o", out), 5, "**FAIL**", "1 of 2 FAILED")
        summary = out / "mine" / "summary.json"
        before = summary.stat().st_mtime_ns
        self.expect(recoil("verify", case, "-o", out, "--reuse"), 5, "1 of 2 FAILED")
        self.assertEqual(summary.stat().st_mtime_ns, before)
        self.expect(recoil("verify", self.expecting("-5.091 GPa"), "-o", out, "--reuse"), 0)
        self.assertNotEqual(summary.stat().st_mtime_ns, before)

    def test_values_set_in_every_case(self):
        out = self.folder / "out"
        self.expect(recoil("verify", self.expecting("-5.091 GPa"), "-o", out, "--set", "method.scheme=seed"), 0,
                    "--set method.scheme=seed")
        self.assertIn('scheme = "seed"', (out / "mine" / "case.resolved.toml").read_text())
        self.expect(recoil("verify", self.case(), "--set", "method.scheme=sead"), 2, "seed")

    def test_mistakes_come_before_the_first_run(self):
        self.expect(recoil("verify", "flyer_al_cuu", "-o", self.folder / "out"), 2, "did you mean 'flyer_al_cu'")
        self.expect(recoil("verify", self.case(), "-o", self.folder / "out"), 2, "expects nothing", "expected.toml")
        self.expect(recoil("verify", "--quick", "flyer_al_cu"), 2, "--quick chooses")
        self.assertFalse((self.folder / "out").exists())

    def test_lists_the_cases(self):
        self.expect(recoil("verify", "--list"), 0, "quick", "flyer_al_cu", "taylor_copper")


if __name__ == "__main__":
    unittest.main()
