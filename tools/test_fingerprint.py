#!/usr/bin/env python3
"""Tests of fingerprint: small made-up run folders."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy

PROGRAM = Path(__file__).resolve().parent / "fingerprint"
HISTORY = "# remark\ntime [us],energy\n0,1\n1,-4\n2,nan\n"


def make_run(folder, history=HISTORY, gauge="time [us],velocity [m/s]\n0,0\n", pressure=(1.0, 2.0)):
    (folder / "gauges").mkdir(parents=True)
    (folder / "fields").mkdir()
    (folder / "summary.json").write_text("{}", encoding="utf-8")
    (folder / "history.csv").write_text(history, encoding="utf-8")
    (folder / "gauges" / "rear.csv").write_text(gauge, encoding="utf-8")
    for name, values in (("0000.hdf", (0.0, 0.0)), ("0001.hdf", pressure)):
        with h5py.File(folder / "fields" / name, "w") as file:
            file["cells/pressure"] = numpy.array(values)


class Fingerprint(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)
        make_run(self.root / "old" / "flyer")
        hashes = self.call("old")
        self.assertEqual(hashes.returncode, 0)
        self.hashes = json.loads(hashes.stdout)
        (self.root / "before.json").write_text(hashes.stdout, encoding="utf-8")

    def call(self, *arguments):
        command = [sys.executable, "-B", str(PROGRAM), *arguments]
        return subprocess.run(command, cwd=self.root, capture_output=True, text=True)

    def compare(self, **changes):
        """Exit code and lines of the comparison with a run that has these changes."""
        make_run(self.root / "new" / "flyer", **changes)
        done = self.call("new", "--against", "before.json", "--old", "old")
        return done.returncode, done.stdout.splitlines()

    def test_one_hash_for_each_array_and_table(self):
        self.assertEqual(
            {run: sorted(items) for run, items in self.hashes.items()},
            {"flyer": ["fields cells/pressure", "gauges/rear.csv", "history.csv"]},
        )

    def test_the_same_run_is_the_same(self):
        self.assertEqual(self.compare(), (0, ["3 the same, 0 different or missing"]))

    def test_remarks_do_not_count(self):
        self.assertEqual(self.compare(history=HISTORY.replace("remark", "other"))[0], 0)

    def test_a_number_of_a_table_and_how_far_it_is_off(self):
        status, lines = self.compare(history=HISTORY.replace("1,-4", "1,-3"))
        self.assertEqual(status, 1)
        wanted = ["flyer: history.csv differs", "    energy: 0.25", "2 the same, 1 different or missing"]
        self.assertEqual(lines, wanted)

    def test_the_last_bit_of_a_field(self):
        status, lines = self.compare(pressure=(1.0, numpy.nextafter(2.0, 3.0)))
        self.assertEqual((status, lines[0]), (1, "flyer: fields cells/pressure differs"))

    def test_other_rows_and_columns(self):
        status, lines = self.compare(history="time [us],work\n0,1\n1,-4\n")
        self.assertEqual(status, 1)
        self.assertEqual(lines[1:3], ["    time [us]: gone, or other rows", "    energy: gone, or other rows"])

    def test_an_empty_table(self):
        self.assertEqual(self.compare(history="")[0], 1)

    def test_what_is_missing_and_what_is_new(self):
        make_run(self.root / "new" / "bar")
        done = self.call("new", "--against", "before.json")
        self.assertEqual(done.returncode, 1)
        lines = done.stdout.splitlines()
        self.assertIn("flyer: gauges/rear.csv is missing", lines)
        self.assertIn("bar: new", lines)
        self.assertEqual(lines[-1], "0 the same, 3 different or missing")

    def test_a_folder_without_runs_is_an_error(self):
        (self.root / "empty").mkdir()
        done = self.call("empty")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no runs", done.stderr)


if __name__ == "__main__":
    unittest.main()
