#!/usr/bin/python3
"""Many runs with one command: `recoil study` and `recoil verify`. Environment: see program.py."""

import csv
import json
import os
import signal
import subprocess
import time
import unittest

from program import DATA, FLYER, PROGRAM, Program, recoil


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

    def test_interrupted_it_goes_on_where_it_stopped(self):
        words = ["study", self.case(), "--mesh", "0.2mm,0.05mm,0.1mm", "--quantity", "gauge.rear.velocity.max"]
        out = self.folder / "study"
        with subprocess.Popen([PROGRAM, *map(str, words), "-o", out], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              start_new_session=True) as process:  # fmt: skip
            self.assertIn("mesh_0.2mm ... done", process.stdout.readline())
            while not (out / "mesh_0.05mm" / "gauges").exists():
                time.sleep(0.01)
            os.killpg(process.pid, signal.SIGINT)
            said = process.communicate()
        self.assertEqual(process.returncode, 75, said)
        self.assertIn(" stopped\n", said[0])
        self.assertIn("of 3 runs 1 are done, 1 stopped with a checkpoint, 1 were not begun", said[1])
        self.assertFalse((out / "study.md").exists())
        again = recoil(*words, "-o", out)
        self.expect(again, 0, "mesh_0.2mm ... finished before", "mesh_0.05mm ... done")
        self.assertIn("goes on from", (out / "mesh_0.05mm" / "run.log").read_text())
        self.expect(recoil(*words, "-o", self.folder / "whole"), 0)
        self.assertEqual((out / "study.csv").read_text(), (self.folder / "whole" / "study.csv").read_text())

    def test_without_a_reader_it_goes_on_to_its_table(self):
        with subprocess.Popen([PROGRAM, "study", self.case(), "--mesh", "0.4mm,0.2mm,0.1mm", "-o", self.folder / "study"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:  # fmt: skip
            self.assertIn("mesh_0.4mm", process.stdout.readline())
            process.stdout.close()
            self.assertEqual(process.stderr.read(), "")
        self.assertEqual(process.returncode, 0)
        self.assertTrue((self.folder / "study" / "study.md").exists())

    def test_draws_records_over_their_reference(self):
        (self.folder / "curve.csv").write_text("time [us],speed [m/s]\n0,0\n6,20\n")
        (self.folder / "case.toml").write_text(
            self.case().read_text() + '[expect]\n"gauge.rear.velocity.error@3us..5us:curve.csv:speed" = { at-most = "1 km/s" }\n')
        self.expect(recoil("study", self.folder / "case.toml", "--mesh", "0.4mm,0.2mm", "-o", self.folder / "study"), 0,
                    "rear_velocity.png")
        self.assertEqual((self.folder / "study" / "rear_velocity.png").read_bytes()[:4], b"\x89PNG")

    def test_any_quantity_without_expectations(self):
        words = ["study", self.case(), "--mesh", "0.8mm,0.4mm,0.2mm", "--set", "time.end=1us", "-o", self.folder / "study"]
        self.expect(recoil(*words, "--quantity", "body.flyer.velocity.x", "--quantity", "contact.flyer-target.opens"), 0,
                    "| body.flyer.velocity.x [m/s] | - |", "contact.flyer-target.opens [us]", "| extrapolated |")
        with open(self.folder / "study" / "study.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 6)
        opens = [float(row["value"]) for row in rows if row["unit"] == "us"]
        self.assertTrue(all(0.5 < t < 1 for t in opens), opens)
        self.expect(recoil(*words[:3], "0.4mm", *words[4:]), 0, "gauge.rear.velocity.peak [m/s]", "gauge.impact.traction.peak [GPa]")
        self.expect(recoil(*words, "--quantity", "gauge.raer.velocity.max"), 2, "did you mean 'rear'?", "--quantity:1:1")

    def test_nothing_to_tabulate(self):
        case = self.folder / "bare.toml"
        text = self.case().read_text()
        case.write_text("[gauge".join(text.split("[gauge")[:1]))
        self.expect(recoil("study", case, "--mesh", "0.4mm", "-o", self.folder / "study"), 2, "nothing to tabulate", "--quantity")
        self.assertFalse((self.folder / "study").exists())

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
                    "1 case, 2 checks, 1 against references, 0 failed")
        table = (self.folder / "table.md").read_text()
        self.assertIn("| -5.091 GPa | theory |", table)
        self.assertEqual(table, (out / "verify.md").read_text())
        with open(out / "verify.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["pass"] for row in rows], ["true", "true"])
        self.assertEqual(json.loads((out / "verify.json").read_text())["references"], 1)

    def test_folders_with_the_names_of_shipped_cases_are_not_meant(self):
        mine = self.folder / "flyer_al_cu"
        mine.mkdir()
        (mine / "case.toml").write_text("format = 1\n")
        self.expect(recoil("verify", "--list", cwd=self.folder), 0, " flyer_al_cu ", "attenuation_al_450")

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
        self.expect(recoil("verify", self.case(), "-o", self.folder / "out"), 2, "has no expectations", "expected.toml")
        self.expect(recoil("verify", "--quick", "flyer_al_cu"), 2, "--quick chooses")
        self.assertFalse((self.folder / "out").exists())

    def test_lists_the_cases(self):
        self.expect(recoil("verify", "--list"), 0, "quick", "flyer_al_cu", "taylor_copper")

    def test_lists_the_other_cases_where_one_cannot_be_read(self):
        (self.folder / "cases" / "broken").mkdir(parents=True)
        for name in ("case.toml", "expected.toml"):
            (self.folder / "cases" / "broken" / name).write_text("format = 1\n")
        (self.folder / "cases" / "flyer_al_cu").symlink_to(FLYER.parent)
        (self.folder / "materials").symlink_to(DATA / "materials")
        env = {**os.environ, "RECOIL_DATA": str(self.folder)}
        self.expect(recoil("verify", "--list", env=env), 2, "Aluminium", "broken", "cannot be read: error")


if __name__ == "__main__":
    unittest.main()
