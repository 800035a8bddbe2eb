#!/usr/bin/python3
"""Many values of keys: `recoil sweep`. Environment: see program.py."""

import csv
import os
import signal
import subprocess
import time
import unittest

from program import PROGRAM, Program, recoil

# Half a microsecond on 0.4 mm: a run takes about a quarter of a second.
QUICK = [("end = \"6 us\"", "end = \"1.2 us\""), ('finest = "0.05 mm"', 'finest = "0.4 mm"')]
SPEED = "body.flyer.velocity.x="
SET = "set.body.flyer.velocity.x [m/s]"


def table(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


class Sweep(Program):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def sweep(self, *words):
        """Sweeps the quick case."""
        return recoil("sweep", self.quick, "-o", self.out, *words)

    @property
    def quick(self):
        return self.case(*QUICK)

    def test_every_combination_in_one_table_and_again_without_running(self):
        words = ["--set", SPEED + "200m/s,0.4km/s", "--set", "body.target.material=copper/seed,tungsten/steinberg",
                 "--quantity", "gauge.impact.traction.min", "--quantity", "event.separation", "-j", "2"]  # fmt: skip
        said = self.sweep(*words)
        self.expect(said, 0, "[4/4]", "| verdict | gauge.impact.traction.min [GPa] | event.separation |")
        rows = table(self.out / "sweep.csv")
        self.assertEqual([row[SET] for row in rows], ["200", "200", "400", "400"])
        tractions = [float(row["gauge.impact.traction.min [GPa]"]) for row in rows]
        self.assertLess(tractions[2], 1.8 * tractions[0])  # about twice the pressure
        self.assertLess(tractions[1], tractions[0])  # tungsten is stiffer than copper
        self.assertEqual({row["verdict"] for row in rows}, {"valid"})
        summary = self.out / rows[0]["run"] / "summary.json"
        before = summary.stat().st_mtime_ns
        self.expect(self.sweep(*words[:2], *words[2:4], "--quantity", "run.steps"), 0, "4 of them finished before", "run.steps")
        self.assertEqual(summary.stat().st_mtime_ns, before)
        (self.out / rows[1]["run"] / "quantities.csv").unlink()  # as of a run that was killed
        self.expect(self.sweep(*words), 0, "3 of them finished before")

    def test_interrupted_it_goes_on_where_it_stopped(self):
        words = ["sweep", self.case(), "--set", SPEED + "200m/s:500m/s:4", "--quantity", "gauge.rear.velocity.max", "-j", "1"]
        for number, (request, send) in enumerate([(signal.SIGINT, os.killpg), (signal.SIGTERM, os.kill)]):
            out = self.folder / f"out_{number}"
            with subprocess.Popen([PROGRAM, *map(str, words), "-o", out], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  text=True, start_new_session=True) as process:  # fmt: skip
                self.assertIn("[1/4]", process.stdout.readline())
                while len(list(out.glob("*/gauges"))) < 2:
                    time.sleep(0.01)
                send(process.pid, request)
                said = process.communicate()
            self.assertEqual(process.returncode, 75, said)
            self.assertIn("of 4 runs 1 are done, 1 stopped with a checkpoint, 2 were not begun", said[1])
            self.assertFalse((out / "sweep.csv").exists())
            self.expect(recoil(*words, "-o", out), 0, "1 of them finished before")
            self.assertEqual(len([log for log in out.glob("*/run.log") if "goes on from" in log.read_text()]), 1)
        self.assertEqual(*[(self.folder / f"out_{n}" / "sweep.csv").read_text() for n in (0, 1)])

    def test_without_a_reader_it_goes_on_to_its_table(self):
        with subprocess.Popen([PROGRAM, "sweep", self.quick, "-o", self.out, "--set", SPEED + "200m/s:400m/s:3", "-j", "1"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:  # fmt: skip
            self.assertIn("[1/3]", process.stdout.readline())
            process.stdout.close()
            self.assertEqual(process.stderr.read(), "")
        self.assertEqual(process.returncode, 0)
        self.assertEqual(len(table(self.out / "sweep.csv")), 3)

    def test_without_a_choice_all_that_a_run_has(self):
        self.expect(self.sweep("--set", SPEED + "200m/s:300m/s:2"), 0, "gauge.rear.velocity.peak")
        row = table(self.out / "sweep.csv")[1]
        self.assertGreater(len(row), 100)
        self.assertAlmostEqual(float(row["body.flyer.mass [kg/m2]"]), 5.4, 9)
        self.assertEqual(row["event.contact [1]"], "1")
        self.assertLess(float(row["contact.flyer-target.opens [us]"]), 1)
        self.assertLess(abs(float(row["budget.total.energy [1]"])), 1e-12)
        # The same numbers as the run's own files have.
        with open(self.out / row["run"] / "gauges" / "flyer.csv", newline="") as lines:
            last = list(csv.DictReader(lines))[-1]
        self.assertAlmostEqual(float(row["body.flyer.velocity.x [m/s]"]), float(last["velocity.x [m/s]"]), 9)
        self.assertEqual(float(row[SET]), 300)
        self.assertLess(float(row["body.flyer.velocity.x [m/s]"]), 0)
        self.assertEqual(float(row["gauge.flyer.velocity.x.last [m/s]"]), float(last["velocity.x [m/s]"]))

    def test_finds_a_threshold(self):
        self.expect(self.sweep("--set", SPEED + "100m/s:400m/s", "--find", "gauge.impact.traction.min < -2.4 GPa", "--within", "4 m/s"),
                    0, "holds above it")  # fmt: skip
        (found,) = table(self.out / "threshold.csv")
        speed, width = float(found["body.flyer.velocity.x [m/s]"]), float(found["half-width [m/s]"])
        self.assertLessEqual(width, 4)
        runs = table(self.out / "sweep.csv")
        below = [float(r["gauge.impact.traction.min [GPa]"]) for r in runs if float(r[SET]) < speed]
        above = [float(r["gauge.impact.traction.min [GPa]"]) for r in runs if float(r[SET]) > speed]
        self.assertGreater(min(below), -2.4)
        self.assertLess(max(above), -2.4)
        self.assertEqual(int(found["runs"]), len(runs))

    def test_no_threshold_is_exit_5(self):
        self.expect(self.sweep("--set", SPEED + "100m/s:200m/s", "--find", "event.reclosure"), 5, "no threshold there")
        self.assertEqual(table(self.out / "threshold.csv")[0]["holds"], "nowhere")

    def test_a_run_that_fails_is_in_the_table(self):
        said = self.sweep("--set", SPEED + "35km/s,450m/s", "--set", "time.end=6us", "--quantity", "run.steps")
        self.expect(said, 3, "failed", "error: ", ".log", "| - |")
        self.assertEqual([row["verdict"] for row in table(self.out / "sweep.csv")], ["failed", "valid"])

    def test_mistakes_come_before_the_first_run(self):
        speed = ["--set", SPEED + "200m/s:300m/s"]
        for words, texts in (
            (["--set", SPEED + "200m/s,,300m/s"], ["--set:1:", "a value is missing"]),
            (["--set", SPEED + "200m/s:3mm:4"], ["different dimensions"]),
            (["--set", SPEED + "200m/s:300m/s:x"], ["'x' is no number of values"]),
            (["--set", "body.flier.velocity.x=1m/s,2m/s"], ["did you mean 'flyer'?"]),
            (["--set", "mesh.finest=0.4mm,fine"], ["'fine' is not a quantity", "--set:1:13"]),
            (["--set", "mesh.finest=0.4mm,0.4mm"], ["twice"]),
            ([*speed, *speed], ["is set twice", "--set:2:1"]),
            ([*speed, "--quantity", "gauge.raer.velocity.max"], ["did you mean 'rear'?", "--quantity:1:1"]),
            ([*speed, "--find", "event.ricochet", "--within", "3 us"], ["give it in m/s"]),
            ([*speed, "--find", "contact.flyer-target.opens = 3us"], ["one of < <= > >="]),
            ([*speed, "--within", "3 m/s"], ["--within goes with --find"]),
            (["--set", SPEED + "200m/s,300m/s", "--find", "event.ricochet"], ["no --set has a range"]),
            ([*speed, "--quantity", "gauge.rear.speed.max"], ["has no column 'speed'", "velocity"]),
            ([*speed, "--find", "event.ricoche"], ["did you mean 'event.ricochet'?"]),
            ([*speed, "--find", "gauge.impact.traction.min < -3 us"], ["compare it with a value in GPa"]),
            ([*speed, "--find", "body.flyer.velocity.x > 5GPa"], ["compare it with a value in m/s"]),
            ([*speed, "--find", "body.flyer.velocity.x"], ["is a number"]),
            ([], ["--set"]),
        ):
            self.expect(self.sweep(*words), 2, *texts)
        self.assertFalse(self.out.exists())

    def test_a_quantity_without_a_value_is_told_after_the_first_run(self):
        speed = ["--set", SPEED + "200m/s:300m/s", "-j", "1"]
        self.expect(self.sweep(*speed, "--find", "gauge.rear.velocity@9us > 3 m/s"), 2, "a run has no value there", "goes on from it")
        self.expect(self.sweep(*speed, "--find", "gauge.impact.traction.min < -3 GPa", "--within", "30 m/s"),
                    0, "1 of them finished before")  # fmt: skip

    def test_a_case_without_a_title_has_the_name_of_its_file(self):
        case = self.folder / "untitled.toml"
        case.write_text("\n".join(line for line in self.quick.read_text().splitlines() if not line.startswith("title")))
        self.expect(recoil("sweep", case, "-o", self.out, "--set", SPEED + "200m/s,300m/s", "--quantity", "run.steps"), 0, "# untitled\n")

    def test_an_interrupted_run_goes_on(self):
        case = self.case(*QUICK, ("[gauge.rear]", '[output.checkpoint]\nevery = "0.3 us"\n\n[gauge.rear]'))
        words = ["sweep", case, "-o", self.out, "--set", SPEED + "200m/s,300m/s", "--quantity", "run.steps"]
        self.expect(recoil(*words), 0)
        run = self.out / "body.flyer.velocity.x=200m_s"
        steps = table(self.out / "sweep.csv")[0]["run.steps [1]"]
        for name in ("summary.json", "quantities.csv"):
            (run / name).unlink()
        self.expect(recoil(*words), 0, "1 of them finished before")
        self.assertIn("goes on from", (run / "run.log").read_text())
        self.assertEqual(table(self.out / "sweep.csv")[0]["run.steps [1]"], steps)

    def test_no_folder_for_results(self):
        if os.geteuid() == 0:
            blocked = self.folder / "file"
            blocked.write_text("")
            self.expect(recoil("sweep", self.quick, "--set", SPEED + "1m/s,2m/s", "-o", blocked / "x"), 4, "cannot be made")


if __name__ == "__main__":
    unittest.main()
