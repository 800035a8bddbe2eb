#!/usr/bin/python3
"""The Python package: what it reads against the files themselves, the program and closed forms; what it refuses.

Environment: see tests/cli/program.py.
"""

import os
import pathlib
import re
import runpy
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
import warnings

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "cli"), str(ROOT / "python")]
import recoil  # noqa: E402
from program import DATA, FLYER  # noqa: E402

os.environ["MPLBACKEND"] = "Agg"
QUICK = {"mesh.finest": "0.2 mm", "output.report": False}
FAST = {"threads": 1, "force": True}


class Scratch(unittest.TestCase):
    """Tests with one scratch folder for all of them, in which they run."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(cls.folder)


class Results(Scratch):
    """A run of the flyer case with expectations of every kind, which the program computes itself."""

    EXPECTED = {
        "gauge.rear.velocity.peak": "m/s", "gauge.rear.velocity.last": "m/s", "gauge.rear.velocity@3.8us": "m/s",
        "gauge.rear.velocity.max@3us..3.5us": "m/s", "gauge.rear.velocity.min": "m/s",
        "gauge.rear.velocity.mean@3us..5us": "m/s", "gauge.rear.velocity.rms@3.1us..5us": "m/s",
        "gauge.rear.velocity.slope@3us..5us": "m/(s us)",
        "gauge.rear.position.slope@3us..5us": "mm/us", "gauge.rear.velocity.arrival@100m/s": "us",
        "gauge.rear.velocity.until@0.05km/s": "us", "gauge.rear.position.max": "mm", "gauge.flyer.velocity.last": "m/s",
        "gauge.impact.traction.mean@200ns..0.5us": "GPa", "contact.target-flyer.opens": "us",
        "contact.flyer-target.separates": "us", "contact.flyer-target.lasts": "us", "body.flyer.momentum.x": "kg/(m s)",
        "body.flyer.velocity.x": "m/s", "body.total.energy": "J/m2", "body.target.highest.x": "mm",
        "body.target.plastic-strain": "1", "budget.total.energy": "1", "floor.cleared-strains": "1", "run.steps": "1",
        "gauge.impact.traction.pullback": "GPa", "fragments.target.pieces": "1", "fragments.target.rubble-mass": "kg/m2",
        "fragments.flyer.1.mass": "kg/m2", "fragments.flyer.1.velocity": "m/s",
    }  # fmt: skip

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        lines = [f'"{name}" = {{ at-least = "-1e9 {unit}" }}' if unit != "1" else f'"{name}" = {{ at-least = -1e9 }}'
                 for name, unit in cls.EXPECTED.items()]  # fmt: skip
        flags = ['"event.opening" = true', '"event.failure" = false']
        case = cls.folder / "plates.toml"
        case.write_text(FLYER.read_text() + "\n[expect]\n" + "\n".join(lines + flags) + "\n")
        cls.run_ = recoil.run(case, "plates", QUICK, **FAST)

    def test_head(self):
        run = recoil.open("plates")
        self.assertEqual(run.title, "Aluminium flyer on copper target, 450 m/s")
        self.assertEqual((run.geometry, run.axes, run.bodies), ("1d", ("x",), ["flyer", "target"]))
        self.assertEqual((run.state, run.verdict, run.exit_code, run.reasons), ("finished", "valid", 0, []))
        self.assertEqual(run.case["mesh"]["finest"], "0.0002 m")
        self.assertEqual(run.materials["aluminium/6061-t6"]["eos"]["density"], "2700 kg/m3")
        self.assertIn("verdict: valid", run.log)
        self.assertEqual(repr(run), f"<run {run.title!r}, valid, plates>")

    def test_opening_reads_nothing(self):
        words = ("import sys, recoil; run = recoil.open('plates'); "
                 "print([m for m in ('pandas', 'h5py', 'xarray') if m in sys.modules], len(vars(run)))")  # fmt: skip
        environment = dict(os.environ, PYTHONPATH=str(ROOT / "python"))
        said = subprocess.run([sys.executable, "-B", "-c", words], env=environment, capture_output=True, text=True,
                              check=True).stdout  # fmt: skip
        self.assertEqual(said, "[] 3\n")  # the folder, gauges and fields, all without contents

    def test_quantities_are_those_of_the_program(self):
        summary = self.run_.summary["expect"]
        for name, unit in self.EXPECTED.items():
            with self.subTest(name):
                kind = recoil.quantities.KINDS[name.split(".")[0]]
                value, own = kind(self.run_, name)
                wanted, its = summary[name]["value"], summary[name].get("unit", "1")
                value = recoil.units.convert(f"{value!r} {own}", its) if own != "1" else value
                self.assertAlmostEqual(value, wanted, delta=1e-9 * abs(wanted))
        self.assertIs(self.run_.value("event.opening"), True)
        self.assertIs(self.run_.value("event.failure"), False)
        self.assertAlmostEqual(self.run_.value("gauge.rear.velocity.peak", "km/s"),
                               summary["gauge.rear.velocity.peak"]["value"] / 1000)  # fmt: skip
        self.assertTrue(numpy.isnan(self.run_.value("contact.flyer-target.recloses")))

    def test_pull_back(self):
        """A rise by less than a tenth of the fall does not end it, one by more does; without a rise there is none."""
        for record, wanted in (([0, 10, 4, 4.5, 3, 9, 1], 7), ([0, 10, 4, 4.7, 3, 9], 6), ([0, 10, 4], numpy.nan),
                               ([0, 10, 9.95, 10, 4, 9], 6)):
            numpy.testing.assert_equal(recoil.quantities.pull_back(numpy.array(record)), wanted)

    def test_tables(self):
        rear = self.run_.gauges["rear"]
        last = (self.run_.folder / "gauges" / "rear.csv").read_text().splitlines()[-1]
        self.assertEqual([rear.index[-1], *rear.iloc[-1]], [float(x) for x in last.split(",")])
        units = {"time": "us", "velocity": "m/s", "velocity.x": "m/s", "position.x": "mm"}
        self.assertEqual(rear.attrs["units"], units)
        self.assertEqual(list(self.run_.gauges), ["flyer", "impact", "rear", "target"])
        kinetic = self.run_.series("history.flyer.kinetic")
        self.assertEqual(kinetic.attrs["unit"], "J/m2")
        self.assertAlmostEqual(kinetic.iloc[0], 0.5 * 2700 * 2e-3 * 450**2, delta=1e-6)
        self.assertEqual(self.run_.series("gauge.rear").name, "velocity")
        events = self.run_.events
        self.assertEqual(list(events["event"]), ["contact", "opening", "ricochet", "separation"])
        self.assertEqual(events["detail"][0], "flyer 450 m/s, target 0 m/s")
        self.assertEqual(events["place.x"][0], 0)
        self.assertAlmostEqual(events["place.x"][1], self.run_.summary["events"][1]["place_mm"][0], delta=1e-5)
        self.assertEqual(events.attrs["units"]["place.x"], "mm")
        pieces = self.run_.fragments
        self.assertEqual(list(pieces["body"][-2:]), ["flyer", "target"])
        self.assertEqual(list(pieces["kind"].unique()), ["piece"])
        self.assertAlmostEqual(pieces["mass"].iloc[-2], 2700 * 2e-3, delta=1e-11)
        self.assertEqual(pieces.attrs["units"]["position.x"], "mm")
        self.assertEqual(self.run_.summary["fragments"]["target"], {"pieces": 1, "heaps_of_rubble": 0})
        pair = self.run_.contacts.loc["flyer-target"]
        self.assertEqual((pair["made"], pair["opens"]), (0, events["time"][1]))
        self.assertTrue(numpy.isnan(pair["recloses"]))
        self.assertLess(self.run_.budgets.loc["total", "energy"], 1e-11)
        self.assertEqual(self.run_.floors["averaged-states"], 0)
        self.assertTrue(self.run_.expectations["pass"].all())
        curve = recoil.read_table(DATA / "cases" / "flyer_al_cu" / "reference.csv")
        self.assertEqual((curve.index.name, curve.attrs["units"]["velocity"]), ("time", "m/s"))

    def test_names_that_do_not_exist(self):
        for call, wanted in (
            (lambda r: r.gauges["raer"], "did you mean 'rear'? there are: flyer, impact, rear, target"),
            (lambda r: r.series("gauge.rear.speed"), "velocity, velocity.x, position.x"),
            (lambda r: r.value("gauge.rear.velocity.top"), "peak"),
            (lambda r: r.value("contact.flyer-wall.opens"), "there are: flyer, target"),
            (lambda r: r.at(0)["presure"], "did you mean 'pressure'?"),
            (lambda r: r.at(0)["velocity.y"], "velocity.x"),
            (lambda r: r.value("floor.cuts"), "cuts-without-donor"),
        ):
            with self.subTest(wanted), self.assertRaises(recoil.UnknownName) as caught:
                call(self.run_)
            self.assertIn(wanted, str(caught.exception))

    def test_a_file_that_is_no_table(self):
        (self.folder / "note.txt").write_text("a, b\n1, 2\n1, 2, 3, 4\n")
        with self.assertRaisesRegex(recoil.InputError, "note.txt is not a table"):
            recoil.read_table("note.txt")

    def test_its_own_tables_are_no_references(self):
        self.assertNotIn("quantities.csv", self.run_.references)

    def test_folders_that_hold_no_run(self):
        for folder, wanted in (("nowhere", "there is no folder nowhere"), (".", "it has no case.resolved.toml")):
            with self.assertRaisesRegex(recoil.InputError, wanted):
                recoil.open(folder)

    def test_a_run_that_has_not_ended(self):
        shutil.copytree("plates", "half")
        (self.folder / "half" / "summary.json").unlink()
        status = (self.folder / "half" / "status.json").read_text()
        (self.folder / "half" / "status.json").write_text(status.replace('"finished"', '"running"'))
        rear = self.folder / "half" / "gauges" / "rear.csv"
        lines = rear.read_text().splitlines(keepends=True)
        rear.write_text("".join(lines[:50]) + lines[50][:-8])  # in the middle of a number
        run = recoil.open("half")
        self.assertEqual(len(run.gauges["rear"]), 49)
        self.assertEqual(run.state, "interrupted")
        wanted = "half is interrupted at 6 of 6 us .*`recoil resume half` goes on"
        with self.assertRaisesRegex(recoil.UnfinishedRun, wanted):
            _ = run.verdict
        writer = "import fcntl, time; f = open('half/.lock'); fcntl.flock(f, 2); print(flush=True); time.sleep(60)"
        with subprocess.Popen([sys.executable, "-c", writer], stdout=subprocess.PIPE) as process:
            process.stdout.readline()
            self.assertEqual(run.state, "running")
            process.kill()

    def test_a_package_that_is_missing(self):
        for module, call in (("pandas", lambda r: r.history), ("xarray", lambda r: r.at(0).to_xarray()),
                             ("h5py", lambda r: r.at(0)["pressure"])):  # fmt: skip
            with unittest.mock.patch.dict(sys.modules, {module: None}), self.subTest(module):
                with self.assertRaisesRegex(recoil.MissingDependency, f"apt-get install python3-{module}"):
                    call(recoil.open("plates"))


class Running(Scratch):
    def test_overrides(self):
        changes = {**QUICK, "domain.x": ["-5 mm", "18 mm"], "body.flyer.velocity.x": "500 m/s", "time.end": "0.4 us",
                   "output.fields": {"every": "0.1 us"}, "time.cfl": numpy.float64(0.5)}  # fmt: skip
        run = recoil.run("flyer_al_cu", None, changes, ranks=2, **FAST)
        self.assertEqual(run.folder, pathlib.Path("runs/flyer_al_cu"))
        self.assertEqual(run.case["domain"]["x"], ["-0.005 m", "0.018 m"])
        self.assertEqual(run.case["time"], {"end": "4e-07 s", "cfl": 0.5})
        self.assertEqual((len(run.times), run.exit_code), (5, 5))
        self.assertAlmostEqual(run.history["flyer.momentum.x"].iloc[0], 500 * 2700 * 2e-3, delta=1e-9)
        self.assertIn("1 thread", run.log)
        self.assertIn("2 processes", run.log)

    def test_errors_of_the_program(self):
        with self.assertRaisesRegex(recoil.InputError, "did you mean 'finest'") as caught:
            recoil.run("flyer_al_cu", "bad", {"mesh.finst": "1 mm"})
        self.assertEqual(caught.exception.exit_code, 2)
        with self.assertRaisesRegex(recoil.PhysicsError, "^error: flyer has a density beyond") as caught:
            recoil.run("flyer_al_cu", "fast", {**QUICK, "time.fixed-dt": "0.5 us"}, **FAST)
        self.assertEqual((caught.exception.exit_code, caught.exception.folder.name), (3, "fast"))
        self.assertEqual(recoil.open(caught.exception.folder).verdict, "stopped")
        with self.assertRaisesRegex(recoil.InputError, "holds a finished run(?s:.*)force=True replaces it, out="):
            recoil.run("flyer_al_cu", "fast", QUICK)
        (self.folder / "file").write_text("")
        with self.assertRaises(recoil.EnvironmentError) as caught:
            recoil.run("flyer_al_cu", "file/below", QUICK)
        self.assertEqual(caught.exception.exit_code, 4)

    def test_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            recoil.run("flyer_al_cu", "warned", {**QUICK, "time.end": "10 ns"}, **FAST)
        texts = [str(w.message) for w in caught if w.category is recoil.RecoilWarning]
        self.assertTrue(any(t.startswith("'flyer' is 10 cells thick") for t in texts), texts)
        self.assertTrue(any(t.startswith("material 'copper/seed' is in doubt") for t in texts), texts)

    def test_no_program(self):
        with unittest.mock.patch.dict(os.environ, {"RECOIL_PROGRAM": "/nowhere/recoil"}):
            with self.assertRaisesRegex(recoil.EnvironmentError, "/nowhere/recoil, which is no program"):
                recoil.run("flyer_al_cu")

    def interrupt(self, call, *folders):
        """Interrupts Python once runs have begun that would take minutes; states of the runs."""
        words = f"import recoil; mesh = {{'mesh.finest': '0.005 mm'}}; recoil.{call}"
        environment = dict(os.environ, PYTHONPATH=str(ROOT / "python"))
        with subprocess.Popen([sys.executable, "-B", "-c", words], env=environment, stderr=subprocess.PIPE,
                              text=True) as process:  # fmt: skip
            for _ in range(200):
                if all((self.folder / folder / "status.json").is_file() for folder in folders):
                    break
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            self.assertIn("KeyboardInterrupt", process.communicate(timeout=20)[1])
        for folder in folders:
            run = recoil.open(folder)
            self.assertEqual(run.state, "stopped")
            self.assertTrue(list((run.folder / "checkpoints").iterdir()))

    def test_an_interrupt_leaves_a_checkpoint(self):
        self.interrupt("run('flyer_al_cu', 'long', mesh, threads=1)", "long")
        self.interrupt("sweep('flyer_al_cu', {'time.cfl': [0.5, 0.6, 0.7]}, [], 'many', mesh, processes=2)",
                       "many/000", "many/001")  # fmt: skip
        self.assertFalse((self.folder / "many" / "002").exists())


class Sweep(Scratch):
    def test_all_combinations(self):
        table = recoil.sweep(
            "flyer_al_cu",
            {"body.flyer.velocity.x": ["300 m/s", "450 m/s"], "time.cfl": [0.5, 0.9]},
            {"momentum": "body.total.momentum.x", "first": lambda run: run.times[0]},
            "grid", {**QUICK, "time.end": "0.2 us"}, processes=2,
        )  # fmt: skip
        self.assertEqual(list(table["body.flyer.velocity.x"]), [300, 300, 450, 450])
        self.assertEqual(list(table["time.cfl"]), [0.5, 0.9] * 2)
        self.assertEqual(table.attrs["units"]["body.flyer.velocity.x"], "m/s")
        self.assertEqual(table.attrs["units"]["momentum"], "kg/(m s)")
        numpy.testing.assert_allclose(table["momentum"], table["body.flyer.velocity.x"] * 2700 * 2e-3, rtol=1e-12)
        cfl = [recoil.open(folder).case["time"]["cfl"] for folder in table["folder"]]
        self.assertEqual(cfl, [0.5, 0.9] * 2)

    def test_a_run_that_is_stopped_has_a_row(self):
        speeds = {"body.flyer.velocity.x": ["450 m/s", "35 km/s"]}
        table = recoil.sweep("flyer_al_cu", speeds, ["gauge.rear.velocity@3.9us"], "speeds",
                             {**QUICK, "time.end": "4 us"})  # fmt: skip
        self.assertEqual(table["verdict"][1], "stopped")
        self.assertNotEqual(table["verdict"][0], "stopped")
        self.assertEqual(list(numpy.isnan(table["gauge.rear.velocity@3.9us"])), [False, True])

    def test_a_mistake_ends_it(self):
        with self.assertRaisesRegex(recoil.InputError, "finst"):
            recoil.sweep("flyer_al_cu", {"mesh.finst": ["1 mm", "2 mm"]}, [], "bad")


class Examples(Scratch):
    def setUp(self):
        import matplotlib.pyplot

        matplotlib.pyplot.close("all")

    def example(self, name):
        return runpy.run_path(str(ROOT / "python" / "examples" / f"{name}.py"))

    def colours(self, file):
        """How many colours a picture has."""
        from matplotlib import image

        return len(numpy.unique(image.imread(file).reshape(-1, 4), axis=0))

    def test_flyer_figure(self):
        names = self.example("flyer_figure")
        self.assertTrue(names["run"].expectations["pass"].all())
        self.assertLess(names["run"].value("gauge.rear.velocity.error@3us..5us:reference.csv:velocity"), 1.1)
        lines = names["plt"].gca().get_lines()
        self.assertEqual([line.get_label() for line in lines], ["0.2 mm", "0.1 mm", "0.05 mm", "0.03 mm", "reference"])
        peaks = [line.get_ydata().max() for line in lines]
        self.assertEqual(peaks, sorted(peaks))  # towards the reference
        self.assertGreater(self.colours("flyer_figure.png"), 20)

    def test_sweep_of_velocities(self):
        table = self.example("sweep_of_velocities")["table"]
        self.assertTrue(table["peak"].is_monotonic_increasing and table["rebound"].is_monotonic_increasing)
        self.assertTrue(((table["ratio"] > 1.02) & (table["ratio"] < 1.2)).all())

    def test_fields_at_a_time(self):
        names = self.example("fields_at_a_time")
        self.assertTrue(4 < numpy.nanmax(names["pressure"]) < 5.5)  # 5.1 GPa where the plates touch, less strength
        self.assertGreater(self.colours("fields_at_a_time.png"), 100)


class Page(Scratch):
    """docs/how-to/python.md: its commands and its Python."""

    def setUp(self):
        self.environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | {"HOME": str(self.folder)}

    def install(self, page):
        """Runs the commands of the page in a copy of the sources."""
        source = self.folder / "source"
        nothing_built = shutil.ignore_patterns("build", "*.egg-info", "__pycache__")
        shutil.copytree(ROOT / "python", source / "python", ignore=nothing_built)
        shutil.copy(ROOT / "CMakeLists.txt", source)
        commands = re.findall(r"^    (python3 .*?)(?:  +# .*)?$", page, re.M)
        self.assertEqual(len(commands), 3)
        for command in commands:
            command = command.replace("python3", "/usr/bin/python3", 1)
            done = subprocess.run(command, shell=True, cwd=source, env=self.environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, command + "\n" + done.stdout + done.stderr)

    def test_page(self):
        page = (ROOT / "docs" / "how-to" / "python.md").read_text()
        self.install(page)
        words = [self.folder / "recoil-python" / "bin" / "python", "-c",
                 "import recoil; print(recoil.__file__, recoil.__version__)"]  # fmt: skip
        said = subprocess.run(words, env=self.environment, capture_output=True, text=True, check=True).stdout.split()
        self.assertTrue(said[0].startswith(str(self.folder / "recoil-python" / "lib")), said)
        self.assertIn(f"VERSION {said[1]} ", (ROOT / "CMakeLists.txt").read_text())
        names = {}
        blocks = re.findall(r"^```python\n(.*?)^```", page, re.S | re.M)
        self.assertGreater(len(blocks), 3)
        for block in blocks:
            exec(compile(block, "python.md", "exec"), names)
        self.assertEqual(names["run"].verdict, "valid")


if __name__ == "__main__":
    unittest.main(warnings="ignore")
