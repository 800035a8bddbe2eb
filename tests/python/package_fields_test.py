#!/usr/bin/python3
"""Fields that the Python package reads: against the files, the history of the run, and a file with cells of two sizes.

Environment: see tests/cli/program.py.
"""

import pathlib
import shutil
import sys
import tempfile
import unittest

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python")]
import recoil  # noqa: E402

CASES = {
    "1d": ("flyer_al_cu", {"mesh.finest": "0.2 mm", "time.end": "1 us", "output.fields": {"every": "0.5 us"}}),
    "planar": ("free_flight_square", {"time.end": "0.1 us"}),
    "axisymmetric": ("flyer_axisymmetric", {"mesh.finest": "0.5 mm", "time.end": "0.3 us"}),
    "3d": ("sphere_on_plate", {"mesh.finest": "2 mm", "time.end": "1 us"}),
}
STRESS = {"1d": "xx yy zz", "planar": "xx yy zz xy", "axisymmetric": "rr zz tt rz", "3d": "xx yy zz xy yz xz"}


class RunFields(unittest.TestCase):
    """One short run of each geometry."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.runs = {
            geometry: recoil.run(case, cls.folder / geometry, {**changes, "output.report": False}, threads=1)
            for geometry, (case, changes) in CASES.items()
        }

    def test_arrays_are_those_of_the_files(self):
        for geometry, run in self.runs.items():
            fields = run.fields[-1]
            self.assertEqual((run.geometry, fields.axes), (geometry, run.axes))
            with self.subTest(geometry), h5py.File(fields.path) as file:
                root = file["VTKHDF"]
                self.assertAlmostEqual(fields.time, root["FieldData/TimeValue"][0] * 1e6)
                raw = {name: data[...] for name, data in root["CellData"].items()}
                corners = root["Points"][...][root["Connectivity"][...]].reshape(len(raw["body"]), -1, 3)
                numpy.testing.assert_array_equal(fields["pressure"], raw["pressure_GPa"])
                numpy.testing.assert_array_equal(fields["plastic-strain"], raw["plastic_strain"])
                body = run.bodies[-1]
                level_set = raw[f"level_set_{body}_m"]
                numpy.testing.assert_allclose(fields[f"level_set_{body}"], level_set * 1000, rtol=1e-6)
                dims = len(run.axes)
                numpy.testing.assert_array_equal(fields["velocity"], raw["velocity_m_per_s"][:, :dims])
                self.assertEqual(" ".join(fields.parts("stress")), STRESS[geometry])
                for k, part in enumerate(fields.parts("stress")):
                    numpy.testing.assert_array_equal(fields[f"stress.{part}"], raw["stress_GPa"][:, k])
                middles = corners.mean(axis=1)[:, :dims] * 1000
                numpy.testing.assert_allclose(fields.centres, middles, atol=1e-9)
                for k, axis in enumerate(run.axes):
                    numpy.testing.assert_allclose(fields.coordinates[axis], middles[:, k], atol=1e-9)
                self.assertTrue(numpy.isnan(fields["pressure"][fields["body"] < 0]).all())

    def test_volume_of_the_cells_is_that_of_the_history(self):
        for geometry, run in self.runs.items():
            fields = run.fields[0]
            volume = (fields.sizes / 1000) ** len(run.axes) * fields["volume_fraction"]
            volume = volume * 2 * numpy.pi * fields.coordinates["r"] / 1000 if geometry == "axisymmetric" else volume
            wanted = sum(run.history[f"{body}.volume"].iloc[0] for body in run.bodies)
            with self.subTest(geometry):
                self.assertAlmostEqual(numpy.sum(volume), wanted, delta=1e-6 * wanted)

    def test_bodies_are_counted_as_in_the_case(self):
        for geometry, run in self.runs.items():
            fields = run.fields[0]
            for number, body in enumerate(run.bodies):
                inside = (fields["body"] == number) & ~numpy.isnan(fields["density"])
                rest = float(run.materials[run.case["body"][body]["material"]]["eos"]["density"].split()[0])
                with self.subTest(f"{geometry} {body}"):
                    numpy.testing.assert_allclose(fields["density"][inside], rest)
                    self.assertTrue((fields[f"level_set_{body}"][inside] < fields.sizes[inside]).all())
                    self.assertLess(fields[f"level_set_{body}"][inside].min(), 0)

    def test_rigid_bodies(self):
        """The ram of rigid_free, which slows down, is where its gauge says, as fast; other runs have no rigid body."""
        self.assertEqual(self.runs["3d"].fields[0].rigid, {})
        changes = {"mesh.finest": "0.5 mm", "time.end": "2 us", "output.fields": {"every": "1 us"}, "output.report": False}
        run = recoil.run("rigid_free", self.folder / "ram", changes, threads=1)
        gauge = run.gauges["ram"]
        for fields in run.fields:
            ram = fields.rigid["ram"]
            record = gauge.iloc[numpy.abs(gauge.index - fields.time).argmin()]
            self.assertAlmostEqual(ram.velocity[0], record["velocity.x"], delta=1e-5)
            self.assertAlmostEqual(ram.centre[0] - ram.start[0], record["position.x"] - gauge["position.x"].iloc[0], delta=1e-6)
            self.assertAlmostEqual(ram.now([-2])[0], ram.centre[0] - 2 - ram.start[0], delta=1e-12)
            numpy.testing.assert_array_equal(ram.rotation, numpy.eye(3))
        self.assertLess(ram.velocity[0], 19)

    def test_points_of_a_rigid_body(self):
        """Exact: 90 degrees about z take x to y."""
        turn = numpy.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        body = recoil.RigidBody(numpy.array([1, 0]), numpy.array([5, 5]), turn, numpy.zeros(2), numpy.zeros(3))
        numpy.testing.assert_array_equal(body.now([[2, 0], [1, 3]]), [[5, 6], [2, 5]])

    def test_units(self):
        fields = self.runs["3d"].fields[0]
        wanted = {"pressure": "GPa", "velocity": "m/s", "density": "kg/m3", "temperature": "K", "plastic_strain": "1",
                  "von_mises": "GPa", "gap": "mm", "contact_traction": "GPa", "level_set_plate": "mm",
                  "body": "1"}  # fmt: skip
        self.assertEqual({name: fields.units[name] for name in wanted}, wanted)
        self.assertEqual(set(fields.units), set(fields.names))

    def test_grids(self):
        for geometry, run in self.runs.items():
            fields = run.fields[-1]
            grid, centres = fields.grid(), fields.centres
            with self.subTest(geometry):
                places = [numpy.abs(grid.centres[a][:, None] - c).argmin(axis=0) for a, c in zip(run.axes, centres.T)]
                for a, k, c in zip(run.axes, places, centres.T):
                    numpy.testing.assert_allclose(grid.centres[a][k], c, atol=1e-9)
                    self.assertEqual(len(grid.edges[a]), len(grid.centres[a]) + 1)
                for name in ("density", "stress", "body"):
                    numpy.testing.assert_array_equal(grid[name][tuple(places)], fields[name])
                self.assertEqual(numpy.sum(grid["volume_fraction"] >= 0), len(fields.sizes))
                self.assertEqual(numpy.sum(grid["body"] >= 0), numpy.sum(fields["body"] >= 0))

    def test_xarray(self):
        run = self.runs["axisymmetric"]
        data = run.fields[-1].to_xarray(["von-mises", "velocity", "stress"])
        self.assertEqual(data["velocity"].dims, ("r", "z", "axis"))
        self.assertEqual((data["von_mises"].attrs["units"], data["r"].attrs["units"]), ("GPa", "mm"))
        grid = run.fields[-1].grid()
        numpy.testing.assert_array_equal(data["velocity"].sel(axis="z"), grid["velocity.z"])
        numpy.testing.assert_array_equal(data["stress"].sel(component="tt"), grid["stress.tt"])
        middle = data["von_mises"].sel(r=10, z=1, method="nearest")
        self.assertLess(abs(float(middle["r"]) - 10) + abs(float(middle["z"]) - 1), 0.51)
        self.assertEqual(len(run.fields[0].to_xarray().data_vars), len(run.fields[0].names))

    def test_coordinates_of_all_times_agree_to_the_bit(self):
        for run in self.runs.values():
            for axis in run.axes:
                first, last = (run.fields[k].grid().centres[axis] for k in (0, -1))
                both = numpy.concatenate([first, last])
                self.assertEqual(len(numpy.unique(both)), len(numpy.unique(both.round(6))))

    def test_times(self):
        run = self.runs["1d"]
        self.assertEqual(len(run.fields), 3)
        numpy.testing.assert_allclose(run.times, [0, 0.5, 1], atol=0.02)
        for time, number in (("0 us", 0), (0.2, 0), (0.3, 1), ("600 ns", 1), ("1e-6 s", 2), (run.times[1], 1)):
            self.assertEqual(run.at(time).path, run.fields[number].path)
        self.assertEqual([f.time for f in run.fields], list(run.times))
        self.assertEqual([f.time for f in run.fields[1:]], list(run.times[1:]))
        for time, wanted in (("2 us", "fields from 0 to 1 us, not at 2 us"), (-1, "not at -1"),
                             ("3 mm", "not a quantity in us"), ("1 fortnight", "unknown unit"),
                             ("soon", "not a number with a unit")):  # fmt: skip
            with self.assertRaisesRegex(recoil.InputError, wanted):
                run.at(time)

    def test_a_run_without_dumps(self):
        shutil.copytree(self.folder / "1d", self.folder / "bare", ignore=shutil.ignore_patterns("fields"))
        run = recoil.open(self.folder / "bare")
        self.assertEqual((len(run.fields), len(run.times)), (0, 0))
        with self.assertRaisesRegex(recoil.UnfinishedRun, "holds no dumps of fields"):
            run.at(0)


class Files(unittest.TestCase):
    """Files that the program does not write, or not yet."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.file = pathlib.Path(scratch.name) / "a.hdf"

    def write(self, boxes, kind=b"UnstructuredGrid", cell=9):
        """Boxes (x, y, edge) in m, with their number as pressure and as body."""
        corners = [[(x, y, 0), (x + e, y, 0), (x + e, y + e, 0), (x, y + e, 0)] for x, y, e in boxes]
        with h5py.File(self.file, "w") as file:
            root = file.create_group("VTKHDF")
            root.attrs["Type"] = numpy.bytes_(kind)
            root["Points"] = numpy.array(corners, float).reshape(-1, 3)
            root["Connectivity"] = numpy.arange(4 * len(boxes))
            root["Types"] = numpy.full(len(boxes), cell, numpy.uint8)
            root["CellData/pressure_GPa"] = numpy.arange(len(boxes), dtype=numpy.float32)
            root["CellData/body"] = numpy.arange(len(boxes), dtype=numpy.int32)
        return recoil.Fields(self.file, 0, ("x", "y"))

    def test_cells_of_two_sizes(self):
        """A cell of 2 mm at the origin, two of 1 mm beside it, and nothing above the second."""
        fields = self.write([(0, 0, 2e-3), (2e-3, 0, 1e-3), (2e-3, 1e-3, 1e-3), (3e-3, 0, 1e-3)])
        numpy.testing.assert_allclose(fields.sizes, [2, 1, 1, 1])
        grid = fields.grid()
        numpy.testing.assert_array_equal(grid["pressure"], [[0, 0], [0, 0], [1, 2], [3, numpy.nan]])
        numpy.testing.assert_array_equal(grid["body"], [[0, 0], [0, 0], [1, 2], [3, -1]])
        numpy.testing.assert_array_equal(grid.edges["x"], [0, 1, 2, 3, 4])
        numpy.testing.assert_array_equal(grid.centres["y"], [0.5, 1.5])

    def test_coordinates_do_not_depend_on_the_first_cell(self):
        """0.1, 0.2, ... mm, which sums of round numbers miss by a bit."""
        several = [self.write([(1e-4 * k, 0, 1e-4) for k in range(first, 40)]).grid() for first in (0, 3, 7)]
        for grid in several:
            self.assertLessEqual(set(grid.edges["x"]), {round(0.1 * k, 9) for k in range(41)})
            self.assertLessEqual(set(grid.centres["x"]), {round(0.1 * k + 0.05, 9) for k in range(40)})

    def test_what_is_refused(self):
        with self.assertRaisesRegex(recoil.InputError, "OverlappingAMR; this package reads UnstructuredGrid"):
            _ = self.write([(0, 0, 1)], b"OverlappingAMR")["pressure"]
        with self.assertRaisesRegex(recoil.InputError, "other cells than boxes over x, y"):
            _ = self.write([(0, 0, 1)], cell=10).centres
        with self.assertRaisesRegex(recoil.InputError, "holds no cells"):
            self.write([]).grid()
        self.file.unlink()
        with self.assertRaisesRegex(recoil.InputError, "is not there"):
            _ = recoil.Fields(self.file, 0, ("x", "y")).names


class Units(unittest.TestCase):
    def test_conversions(self):
        for text, unit, wanted in (("3us", "us", 3), ("0.2 ms", "us", 200), ("2 \u00b5s", "us", 2),
                                   ("1.5 MPa", "GPa", 1.5e-3), ("1 km/s", "m/s", 1e3), ("2 g/cm3", "kg/m3", 2e3),
                                   ("1 kJ/(kg K)", "J/(kg K)", 1e3), ("-4", "mm", -4), ("90 deg", "rad", numpy.pi / 2),
                                   ("1 N s", "kg m/s", 1)):  # fmt: skip
            self.assertAlmostEqual(recoil.units.convert(text, unit), wanted, delta=1e-12 * abs(wanted))
        for text, unit in (("3 m", "us"), ("3 m/s2", "m/s"), ("3 ells", "m"), ("m", "m"), ("3 dx", "mm")):
            with self.assertRaises(recoil.InputError):
                recoil.units.convert(text, unit)

    def test_names_of_arrays(self):
        split = recoil.fields.split_array
        self.assertEqual(split("level_set_rod_m_m"), ("level_set_rod_m", "mm", 1e3))
        self.assertEqual(split("velocity_m_per_s"), ("velocity", "m/s", 1))
        self.assertEqual(split("contact_state"), ("contact_state", "1", 1))


if __name__ == "__main__":
    unittest.main(warnings="ignore")
