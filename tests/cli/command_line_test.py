#!/usr/bin/python3
"""The command line as its users and their scripts see it: messages, exit codes, files. Environment: see program.py."""

import csv
import filecmp
import json
import os
import struct
import subprocess
import unittest

from program import COARSE, DATA, FLYER, PROGRAM, Program, recoil


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

    def test_shocks_of_a_material(self):
        done = recoil("material", "hugoniot", "aluminium/6061-t6", "-o", self.folder / "al.png")
        self.expect(done, 0, "elastic limit", "velocity")
        row = [line.split() for line in done.stdout.splitlines() if line.split()[:1] == ["3000"]][0]
        self.assertAlmostEqual(float(row[1]), 5386 + 1.339 * 3000, delta=15)  # no strength is left: U_s = c0 + s u
        self.assertEqual((self.folder / "al.png").read_bytes()[:4], b"\x89PNG")
        self.expect(recoil("material", "hugoniot", "explosive-products/tnt"), 0, "detonation: 69", "GPa")
        self.expect(recoil("material", "hugoniot", "copper/seed", "--to", "90 km/s"), 2, "reaches")
        self.expect(recoil("material", "hugoniot", "coper/seed"), 2, "did you mean 'copper/seed'?")

    def test_state_of_an_impact(self):
        svg = self.folder / "pu.svg"
        done = recoil("material", "match", "aluminium/6061-t6", "copper/seed", "--speed", "450 m/s", "-o", svg)
        self.expect(done, 0, "interface 133.69 m/s, 5.084 GPa", "part")
        self.assertIn("<svg", svg.read_text())
        self.expect(recoil("material", "match", "copper/seed", "copper/seed", "--speed", "3 kg"), 2, "--speed")

    def test_lint(self):
        self.expect(recoil("material", "lint"), 0, "nothing to remark")
        wrong = self.folder / "heavy.toml"
        wrong.write_text(recoil("material", "show", "copper/seed").stdout.replace('"8930 kg/m3"', '"8.93 kg/m3"'))
        env = dict(os.environ, RECOIL_MATERIALS=str(self.folder))
        self.expect(recoil("material", "lint", "heavy", env=env), 2, "eos.density", "8.93 g/cm3")

    def test_own_materials_are_found_by_name(self):
        text = recoil("material", "show", "copper/seed").stdout
        (self.folder / "materials").mkdir()
        (self.folder / "materials" / "mine.toml").write_text(text)
        self.case(('"copper/seed"', '"mine"'))
        self.expect(recoil("check", self.folder / "case.toml"), 0, "5.084 GPa")
        away = self.folder / "away"
        away.mkdir()
        (self.folder / "materials" / "mine.toml").rename(away / "mine.toml")
        self.expect(recoil("check", self.folder / "case.toml"), 2, "unknown material 'mine'")
        env = dict(os.environ, RECOIL_MATERIALS=f"{self.folder}/none:{away}")
        self.expect(recoil("check", self.folder / "case.toml", env=env), 0, "5.084 GPa")
        self.expect(recoil("material", "show", "mine", env=env), 0, "away/mine.toml")
        (away / "half.toml").write_text('title = "Half"\ncite = ["handbook2024"]\n')
        self.expect(recoil("material", "show", "half", env=env), 2, "'eos' is missing", "away/half.toml")

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


GAS = """format = 1
[domain]
geometry = "planar"
x = ["0 mm", "20 mm"]
y = ["0 mm", "10 mm"]
[mesh]
finest = "0.5 mm"
[time]
end = "1 us"
[body.gas]
material = "gas/air"
shape = { kind = "box", x = ["5 mm", "10 mm"], y = ["0 mm", "10 mm"] }
velocity = { x = "10 m/s" }
[body.left]
material = "copper/seed"
shape = { kind = "box", x = ["0 mm", "5 mm"], y = ["0 mm", "10 mm"] }
[body.right]
material = "RIGHT"
shape = { kind = "box", x = ["10 mm", "20 mm"], y = ["0 mm", "10 mm"] }
[material.dense]
base = "gas/air"
eos.pressure = "10 MPa"
eos.density = "118.8 kg/m3"
"""


class Gases(Program):
    def check(self, text, code, *words):
        (self.folder / "gas.toml").write_text(text)
        done = recoil("check", self.folder / "gas.toml")
        self.expect(done, code, *words)
        return done.stdout + done.stderr

    def test_free_surfaces_of_a_gas_are_said(self):
        self.assertNotIn("free surface", self.check(GAS.replace("RIGHT", "gas/argon"), 0))
        self.check(GAS.replace("RIGHT", "copper/seed").replace('"10 mm", "20 mm"', '"12 mm", "20 mm"'), 0, "the gas 'gas' has a free surface", "101.3 kPa")

    def test_gases_rest_at_one_pressure(self):
        self.check(GAS.replace("RIGHT", "dense"), 2, "101325 Pa and at 1e+07 Pa")

    def test_a_gas_has_no_strength(self):
        own = '[material.jelly]\nbase = "gas/air"\nstrength = { kind = "elastic", shear-modulus = "1 kPa" }\n'
        self.check(GAS.replace("RIGHT", "jelly") + own, 2, "a gas has no strength")


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

    def test_what_it_predicts_is_what_runs_find(self):
        """The opening within 3 %, the peak of the rear face within 5 % (docs/testing.md has more of them)."""
        case = self.case(('"copper/seed"', '"copper/ofhc-johnson-cook"'), ('x = ["0 mm", "15 mm"]', 'x = ["0 mm", "5 mm"]'),
                         ('at   = { x = "15 mm" }', 'at   = { x = "5 mm" }'), ('end = "6 us"', 'end = "2 us"'))
        for speed in ("300 m/s", "500 m/s"):
            words = ["--set", f"body.flyer.velocity.x={speed}"]
            predicted = json.loads(recoil("check", case, "--json", *words).stdout)[0]["predicted"][0]
            self.assertFalse(predicted["rear"]["plateau_is_bound"])
            self.expect(recoil("run", case, "-o", self.folder / speed, "-q", *words, "--set", "output.report=false"), 6)
            with (self.folder / speed / "quantities.csv").open() as file:
                found = {row["quantity"]: row["value"] for row in csv.DictReader(file)}
            with (self.folder / speed / "gauges" / "rear.csv").open() as file:
                peak = max(float(row["velocity [m/s]"] or 0) for row in csv.DictReader(file))
            self.assertAlmostEqual(1e6 * predicted["opens"] / float(found["contact.flyer-target.opens"]), 1, delta=0.03)
            self.assertAlmostEqual(predicted["rear"]["plateau_velocity"] / peak, 1, delta=0.05)

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
        done = recoil("run", FLYER, "-o", self.folder / "none", "--set", 'body.flyer.shape.x=["-2 mm", "0.5 mm"]',
                      "--set", 'body.flyer.material="copper/seed"')
        self.expect(done, 2, "overlap")
        self.assertTrue(done.stderr.startswith("warning: material 'copper/seed' is in doubt"), done.stderr)
        self.expect(recoil("check", FLYER, "--set", "gauge.rear.at.x=14mm"), 2, "not on the surface")
        self.expect(recoil("check", FLYER, "--set", "mesh.finest=0.5mm"), 0, "4 cells thick", "0.1 mm")

    def test_several_cases_and_a_bad_one(self):
        bad = self.case(("[mesh]", "[mush]"))
        self.expect(recoil("check", FLYER, bad), 2, "133.7 m/s", "it cannot be run")

    def test_other_schemes_say_what_they_do_not_keep(self):
        self.expect(recoil("check", FLYER, "--set", "method.scheme=seed"), 0, "not conserved at surfaces", "0.025 mm")
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
            rows = list(csv.DictReader(file))
        kinds = [row["event"] for row in rows]
        self.assertEqual(list(rows[0]), ["time [us]", "event", "bodies", "place.x [mm]", "detail"])
        self.assertAlmostEqual(float(rows[0]["place.x [mm]"]), 0, delta=0.05)
        self.assertEqual(kinds[:2], ["contact", "opening"])

    def flyer_at(self, velocity):
        """An aluminium plate on aluminium, 20 cells thick; the result of its run and its summary."""
        case = self.case(('"copper/seed"', '"aluminium/6061-t6"'), ("450 m/s", velocity), ('end = "6 us"', 'end = "2.6 us"'))
        result = recoil("run", case, "-o", self.folder / "out", "--set", "mesh.finest=0.1mm")
        return result, json.loads((self.folder / "out" / "summary.json").read_text())

    def test_verdict_of_a_good_run(self):
        result, summary = self.flyer_at("450 m/s")
        self.expect(result, 0, "verdict: valid")
        self.assertEqual((summary["verdict"], summary["reasons"], summary["exit"]), ("valid", [], 0))

    def test_verdict_of_a_doubtful_run(self):
        result, summary = self.flyer_at("5 km/s")
        self.expect(result, 6, "doubtful: ", "%")
        self.assertEqual((summary["verdict"], summary["exit"]), ("doubtful", 6))
        self.assertGreater(summary["reasons"][0]["value"], summary["reasons"][0]["limit"])

    def test_a_run_beyond_its_equations_stops_and_says_why(self):
        result, summary = self.flyer_at("30 km/s")
        self.expect(result, 3, "stopped")
        self.assertEqual((summary["verdict"], summary["exit"]), ("stopped", 3))
        crash = (self.folder / "out" / "crash" / "process_0.txt").read_text()
        self.assertIn("case.resolved.toml", crash)
        self.assertIn("\nplace (", crash)
        self.assertIn("states of flyer around", crash)
        self.assertEqual((self.folder / "out" / "crash" / "process_0.png").read_bytes()[1:4], b"PNG")
        status = json.loads((self.folder / "out" / "status.json").read_text())
        self.assertEqual(status["state"], "failed")

    def test_the_last_steps_before_a_failure_can_be_repeated(self):
        case = self.case(('"copper/seed"', '"aluminium/6061-t6"'), ("450 m/s", "30 km/s"), ('end = "6 us"', 'end = "2.6 us"'))
        words = ["--set", "mesh.finest=0.1mm", "--set", "output.checkpoint.every=1ns", "-q"]
        failed = recoil("run", case, "-o", self.folder / "out", *words)
        crash = (self.folder / "out" / "crash" / "process_0.txt").read_text()
        command = [line.split() for line in crash.splitlines() if line.startswith("  recoil resume")][0]
        again = recoil(*command[1:])
        self.expect(again, 3, failed.stderr.splitlines()[0])

    def test_a_failed_expectation_comes_before_doubts(self):
        case = self.case()
        tight = ["--set", "limits.thickness=30", "--end", "0.1us"]  # the flyer has 10 cells
        self.expect(self.run_coarse(*tight, case=case), 6, "doubtful: flyer is 10 cells thick")
        case.write_text(case.read_text() + '[expect]\n"run.steps" = { at-most = 1 }\n')
        self.expect(self.run_coarse(*tight, "--force", case=case), 5, "FAIL run.steps", "doubtful: flyer")

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
        self.expect(result, 3, "what is known is in", "verdict: stopped", "  stopped: ")
        self.assertIn("last dt 500 ns", (self.folder / "out" / "crash" / "process_0.txt").read_text())
        self.assertEqual(json.loads((self.folder / "out" / "status.json").read_text())["state"], "failed")
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual((summary["verdict"], summary["reasons"][0]["what"]), ("stopped", "error"))

    def test_a_fixed_step_that_is_unstable_stops_the_run(self):
        result = self.run_coarse("--set", "time.fixed-dt=45 ns", "--set", "time.end=20 us")  # 1.8 times the stable step
        self.expect(result, 3, "a step of 45 ns is unstable")
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual(summary["verdict"], "stopped")
        self.assertLess(summary["time_us"], 20)
        self.assertIn("unstable-steps-stop", [reason["what"] for reason in summary["reasons"]])

    def test_bad_input_leaves_no_folder(self):
        self.expect(self.run_coarse("--set", "body.flyer.material=coper/seed"), 2, "copper/seed")
        self.assertFalse((self.folder / "out").exists())

    def test_quiet_is_quiet(self):
        result = self.run_coarse("--end", "0.1us", "-q")
        self.expect(result, 0)
        self.assertEqual(result.stdout, "verdict: valid\n")

class Ranks(Program):
    def test_processes_and_threads_give_the_same_bits(self):
        runs = {"one": [], "two": ["-n", "2"], "threads": ["-j", "2"]}
        for name, words in runs.items():
            self.expect(recoil("run", self.case(), "-o", self.folder / name, *COARSE, "--end", "2us", *words), 0)
        for name in ("two", "threads"):
            for file in ("gauges/rear.csv", "gauges/impact.csv", "gauges/flyer.csv", "history.csv", "events.csv"):
                self.assertTrue(filecmp.cmp(self.folder / "one" / file, self.folder / name / file, shallow=False),
                                f"{name} {file}")

    def test_the_verdict_does_not_depend_on_the_number_of_processes(self):
        case = self.folder / "discs.toml"  # without the expectations, which are of finer cells
        case.write_text((DATA / "cases" / "discs_2kms" / "case.toml").read_text())
        words = [case, "--set", "mesh.finest=0.4mm", "--end", "2us",
                 "--set", "limits.largest-tension=1e-3", "--set", "limits.volume-bounds=0"]
        told = {}
        for ranks in ("1", "2", "3"):
            out = self.folder / ranks
            self.expect(recoil("run", *words, "-n", ranks, "-o", out), 6, "doubtful: ")
            summary = json.loads((out / "summary.json").read_text())
            told[ranks] = {key: summary[key] for key in ("verdict", "reasons", "remarks", "not_judged", "floors")}
        self.assertGreater(len(told["1"]["reasons"]), 2)
        self.assertIn("tension", [reason["what"] for reason in told["1"]["reasons"]])
        self.assertEqual(told["1"], told["2"])
        self.assertEqual(told["1"], told["3"])

    def test_means_of_damage_are_the_same_on_any_number_of_processes(self):
        case = DATA / "cases" / "spall_rotated" / "case.toml"
        words = ["--set", "mesh.finest=0.1mm", "--set", "mesh.block=16", "--end", "0.8us", "-j", "1"]
        laws = {"tensile": 'kind="tensile", threshold="1 GPa", time="0.02 us"',
                "at-once": 'kind="minimum-pressure", tension="1.2 GPa"'}
        for name, law in laws.items():
            for ranks in ("1", "3"):
                result = recoil("run", case, *words, "--set", f'material.breaking.damage={{{law}, length="0.4 mm"}}',
                                "-n", ranks, "-o", self.folder / (name + ranks))
                self.assertIn(result.returncode, (0, 5, 6), result.stderr)  # cells are coarser than in the case
            for file in ("gauges/rear.csv", "history.csv", "events.csv"):
                self.assertTrue(filecmp.cmp(self.folder / (name + "1") / file, self.folder / (name + "3") / file,
                                            shallow=False), f"{name} {file}")
            self.assertIn("failure", (self.folder / (name + "1") / "events.csv").read_text())

    def test_rims_hold_all_that_is_read_in_three_dimensions(self):
        case = DATA / "cases" / "taylor_copper_3d" / "case.toml"
        words = ["--set", "mesh.finest=0.4mm", "--set", "mesh.block=10", "--end", "0.5us", "-j", "1"]
        for ranks in ("1", "2", "3"):
            done = recoil("run", case, "-n", ranks, "-o", self.folder / ranks, "--verbose", *words)
            self.expect(done, 5, *([] if ranks == "1" else [f"sent in a step by each of {ranks} processes"]))
        for ranks in ("2", "3"):
            for file in ("gauges/rear.csv", "gauges/bar.csv", "gauges/wall.csv", "history.csv"):
                self.assertTrue(filecmp.cmp(self.folder / "1" / file, self.folder / ranks / file, shallow=False),
                                f"{ranks} {file}")

    def test_one_process_looks_at_the_case_for_all(self):
        wrong = self.case(('x = ["0 mm", "15 mm"]', 'x = ["-1 mm", "15 mm"]'))
        rights = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(["mpirun", "--oversubscribe", "-q", "-n", "3", PROGRAM, "run", wrong,
                               "-o", self.folder / "out"], capture_output=True, text=True, timeout=100,
                              check=False, env={**os.environ, **rights})
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("overlap by 1 mm"), 1, done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_exit_codes_come_through_mpirun(self):
        self.expect(recoil("run", self.case(), "-n", "2", "--set", "mesh.finest=1us"), 2, "dimension [time]")
        text = self.case().read_text() + '\n[expect]\n"gauge.rear.velocity.peak" = { at-least = "1 km/s" }\n'
        (self.folder / "case.toml").write_text(text)
        self.expect(recoil("run", self.folder / "case.toml", "-n", "2", "-o", self.folder / "out", *COARSE), 5, "FAIL")


if __name__ == "__main__":
    unittest.main()
