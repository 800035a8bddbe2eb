#!/usr/bin/python3
"""Pages of `recoil report`: what the command says, and what a browser shows (page.mjs drives it).

Environment: see tests/cli/program.py; RECOIL_PAGE_FOLDER, the folder with the node_modules that the page was built with.
"""

import json
import math
import os
import pathlib
import re
import subprocess
import sys
import unittest

import h5py
import numpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cli"))
from program import COARSE, DATA, Program, recoil  # noqa: E402

STATE = {"pressure": ("pressure_GPa", 0), "density": ("density_kg_per_m3", 0), "temperature": ("temperature_K", 0)}


def numbers(run, frame):
    """The arrays of a dump, and the middles of its cells [mm]."""
    series = sorted((run / "fields").glob("*.hdf"))
    with h5py.File(series[frame]) as file:
        root = file["VTKHDF"]
        cells = root["Offsets"].shape[0] - 1
        corners = root["Points"][:][root["Connectivity"][:]].reshape(cells, -1, 3)
        arrays = {name: data[:].reshape(cells, -1) for name, data in root["CellData"].items()}
    return arrays, 1e3 * corners.mean(axis=1)


def in_plane(middles, across, cell):
    """Which cells a cut through 0 across an axis shows: a cell holds its lower face."""
    return numpy.abs(middles[:, across] - cell / 2) < cell / 4 if across is not None else numpy.ones(len(middles), bool)


def places(run, frame, fields, across, cell):
    """Some cells full of matter: their places as the page calls them, and their values with tolerances."""
    arrays, middles = numbers(run, frame)
    axes = [d for d in range(3) if d != across][:2] if across is not None else [0, 1]
    seen = in_plane(middles, across, cell)
    full = numpy.flatnonzero(seen & (arrays["volume_fraction"][:, 0] > 0.99) & (arrays["body"][:, 0] >= 0))
    strong = full[numpy.argsort(numpy.abs(arrays["pressure_GPa"][full, 0]))]
    found = []
    for n in (strong[-1], strong[len(strong) // 2], full[len(full) // 3]):
        values = {}
        for name, (array, component) in fields.items():
            plane = arrays[array][seen, component]
            step = (numpy.nanmax(plane) - numpy.nanmin(plane)) / 4094
            values[name] = {"value": float(arrays[array][n, component]), "tolerance": 0.51 * step + 1e-9}
            values[name]["tolerance"] += 0.5 * 10 ** numpy.floor(numpy.log10(step) + 1e-9) if step > 0 else 0
        found.append({"x": middles[n, axes[0]], "y": middles[n, axes[1]], "values": values, "text": ""})
    return found


class Report(Program):
    def run_case(self, name, folder, *changes):
        words = [word for change in changes for word in ("--set", change)]
        out = self.folder / folder
        self.expect(recoil("run", DATA / "cases" / name, "-o", out, "-j", 1, "--plain", *words), self.code(name))
        return out

    @staticmethod
    def code(name):
        return {"flyer_al_cu": 5, "flyer_axisymmetric": 5, "sphere_on_plate": 5}[name]

    @staticmethod
    def frame_of_last_event(run, summary):
        """The frame nearest to it in time."""
        series = json.loads(next((run / "fields").glob("*.series")).read_text())["files"]
        last = summary["events"][-1]["time_us"]
        return min(range(len(series)), key=lambda k: abs(series[k]["time"] * 1e6 - last))

    def facts_of(self, run, frame, fields, across=None, cell=0.0, words=()):
        summary = json.loads((run / "summary.json").read_text())
        case = (run / "case.toml").read_text()
        title = next(line.split('"')[1] for line in case.splitlines() if line.startswith("title"))
        return {
            "page": str(run / "report.html"), "title": title, "verdict": summary["verdict"],
            "gauges": case.count("[gauge."), "events": len(summary["events"]), "frame": frame,
            "frames": len(list((run / "fields").glob("*.hdf"))), "words": list(words),
            "bodies": sorted(line.split(".")[1].rstrip("]") for line in case.splitlines() if re.fullmatch(r"\[body\.[-\w]+\]", line)),
            "lastEvent": self.frame_of_last_event(run, summary),
            "places": places(run, frame, fields, across, cell),
        }  # fmt: skip

    def test_pages(self):
        plane = self.run_case("flyer_axisymmetric", "axisymmetric", "mesh.finest=0.5mm", "time.end=1.5us",
                              "output.fields.every=0.1us")
        line = self.run_case("flyer_al_cu", "line", *COARSE[1:], "output.fields.every=0.2us")
        flight = self.folder / "flight"
        self.expect(recoil("run", DATA / "cases" / "free_flight_square", "-o", flight, "-j", 1, "--plain", "--end", "1us",
                           "--set", "output.fields.every=0.5us"), 5)
        stopped, longer = self.folder / "stopped", self.folder / "longer"
        self.expect(recoil("run", DATA / "cases" / "flyer_al_cu", "-o", stopped, "-j", 1, "--plain", *COARSE, "--set",
                           "time.fixed-dt=0.5 us"), 3)  # fmt: skip
        self.expect(recoil("run", DATA / "cases" / "free_flight_square", "-o", longer, "-j", 1, "--plain", "--end", "0.2us",
                           "--set", "output.checkpoint.every=0.1us"), 5)  # fmt: skip
        self.expect(recoil("resume", longer, "-j", 1, "--plain", "--to", "0.3us"), 5)
        other = self.run_case("flyer_al_cu", "other", "mesh.finest=0.25mm", "output.report=false")
        space = self.run_case("sphere_on_plate", "space", "mesh.finest=2mm", "time.end=4us",
                              "output.fields.every=1us")
        self.assertFalse((other / "report.html").exists())
        facts = {
            "axisymmetric": self.facts_of(plane, 5, STATE | {"velocity.z": ("velocity_m_per_s", 1),
                                                             "stress.tt": ("stress_GPa", 2)},
                                          words=["Lesuer", "flyer-target"]),
            "line": self.facts_of(line, 8, STATE | {"velocity": ("velocity_m_per_s", 0)}, words=["6061-t6"]),
            "space": self.facts_of(space, 3, STATE | {"velocity.z": ("velocity_m_per_s", 2)}, across=1, cell=2.0),
        }  # fmt: skip
        # A quarter of a ball of radius 5 mm, which is 2.5 cells, on one of a plate, 20 x 20 x 10 mm: from above and from the
        # side outlines of 80 mm, which are to be right to a twentieth of a cell in the mean.
        above, side = {"area": 400, "tolerance": 0.05 * 2 * 80}, {"area": 200 + math.pi * 25 / 2, "tolerance": 0.05 * 2 * 80}
        facts["space"]["areas"] = [{"turn": 0, "tilt": 90} | above, {"turn": -45, "tilt": -90} | above,
                                   {"turn": 0, "tilt": 0} | side, {"turn": 90, "tilt": 0} | side]  # fmt: skip
        both, small = self.folder / "both.html", self.folder / "small.html"
        self.expect(recoil("report", line, other, "-o", both), 0, "both.html")
        said = recoil("report", plane, "-o", small, "--max-mb", "0.2")
        self.expect(said, 0, "dumps of the fields shown")
        self.assertLess(small.stat().st_size, 0.25e6)
        facts["stopped"], facts["longer"] = {"page": str(stopped / "report.html")}, {"page": str(longer / "report.html")}
        facts["flight"] = {"page": str(flight / "report.html")}
        facts["both"] = {"page": str(both), "names": ["line", "other"]}
        facts["small"] = {"page": str(small), "omission": said.stdout.split(": ")[1].split(" shown")[0]}
        file = self.folder / "facts.json"
        file.write_text(json.dumps(facts))
        done = subprocess.run(["node", "--test-reporter=spec", HERE / "page.mjs", file], timeout=300, check=False)
        self.assertEqual(done.returncode, 0)

    def test_what_the_command_refuses(self):
        self.expect(recoil("report", self.folder), 2, "is not the folder of a run")
        self.expect(recoil("report", self.folder / "nowhere"), 2, "there is no folder")
        self.expect(recoil("report", self.folder, "--max-mb", "0"), 2, "--max-mb")
        self.expect(recoil("report", self.folder, "-o", self.folder / "page.pdf"), 2, "end its name in .html")

    def test_a_run_that_was_stopped_has_a_page(self):
        self.expect(self.run_coarse("--set", "time.fixed-dt=0.5 us"), 3, "what is known is in")
        page = (self.folder / "out" / "report.html").read_text()
        self.assertIn('"verdict":"stopped"', page)
        self.assertIn("last dt 500 ns", page)


if __name__ == "__main__":
    if "RECOIL_PAGE_FOLDER" not in os.environ:
        sys.exit("RECOIL_PAGE_FOLDER is not set")
    unittest.main()
