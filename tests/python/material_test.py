#!/usr/bin/python3
"""Material points in Python against closed forms: paths of strain, yield stress, Hugoniot, failure; what is refused.

Environment: see tests/cli/program.py; the compiled module lies beside the program.
"""

import math
import os
import pathlib
import re
import runpy
import sys
import tempfile
import unittest
import unittest.mock

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python")]
import recoil  # noqa: E402
import recoil.material  # noqa: E402

os.environ["MPLBACKEND"] = "Agg"
RHO, BULK, SHEAR, YIELD, HEAT = 8000.0, 120e9, 60e9, 0.6e9, 450.0  # SI
HARD = f"""
title = "Linear, perfectly plastic"
[eos]
kind = "linear"
density = "{RHO} kg/m3"
bulk-modulus = "{BULK} Pa"
[strength]
kind = "perfectly-plastic"
shear-modulus = "{SHEAR} Pa"
yield = "{YIELD} Pa"
[thermal]
specific-heat = "{HEAT} J/(kg K)"
"""
FLUID = """
title = "Copper's Hugoniot without strength"
[eos]
kind = "mie-gruneisen"
density = "8930 kg/m3"
c0 = "3940 m/s"
s = 1.489
gamma0 = 2.02
[strength]
kind = "none"
[thermal]
specific-heat = "383 J/(kg K)"
"""
BRITTLE = HARD + '[damage]\nkind = "minimum-pressure"\ntension = "0.5 GPa"\n'
COPPER = {"a": 0.090, "b": 0.292, "n": 0.31, "c": 0.025, "m": 1.09, "melting": 1356, "room": 298}  # GPa, K


def johnson_cook(strain, rate, temperature, a, b, n, c, m, melting, room):
    """Flow stress [GPa] (Johnson & Cook 1983)."""
    hot = numpy.clip((temperature - room) / (melting - room), 0, 1)
    return (a + b * strain**n) * (1 + c * numpy.log(numpy.maximum(rate, 1))) * (1 - hot**m)


class Own(unittest.TestCase):
    """Materials of one's own in a folder."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        for name, text in {"hard": HARD, "fluid": FLUID, "brittle": BRITTLE}.items():
            (pathlib.Path(scratch.name) / f"{name}.toml").write_text(text)
        cls.hard, cls.fluid, cls.brittle = (recoil.Material(n, scratch.name) for n in ("hard", "fluid", "brittle"))


class Paths(Own):
    def test_uniaxial_strain_is_exact(self):
        """Elastic to e = Y/(2G), the Hugoniot elastic limit; then -s_xx = K (exp(-e) - 1) + 2/3 Y; back likewise."""
        path = self.hard.uniaxial_strain([-0.02, 0], "1e5/s", steps=400)
        strain = path["strain"]
        shear = numpy.where(numpy.arange(801) <= 400, 4 / 3 * SHEAR * strain, 4 / 3 * SHEAR * (strain + 0.02) - 2 / 3 * YIELD)
        shear = numpy.clip(shear, -2 / 3 * YIELD, 2 / 3 * YIELD)
        pressure = BULK * (numpy.exp(-strain) - 1)
        numpy.testing.assert_allclose(path["pressure"] * 1e9, pressure, rtol=1e-11, atol=1)
        numpy.testing.assert_allclose(path["stress.xx"] * 1e9, shear - pressure, rtol=1e-11, atol=1)
        numpy.testing.assert_allclose(path["stress.yy"] * 1e9, -shear / 2 - pressure, rtol=1e-11, atol=1)
        plastic = 2 / 3 * 0.02 - YIELD / (3 * SHEAR)
        self.assertAlmostEqual(path["plastic_strain"][400], plastic, delta=1e-13)
        self.assertAlmostEqual(path["plastic_strain"][-1], 2 * plastic - YIELD / (3 * SHEAR), delta=1e-13)
        numpy.testing.assert_allclose(path["density"], RHO * numpy.exp(-strain), rtol=1e-12)
        numpy.testing.assert_allclose(path["time"][[0, 400, -1]], [0, 0.2, 0.4], rtol=1e-12)

    def test_slopes_are_those_of_waves(self):
        """At the start rho c_L^2, beyond the elastic limit rho c_b^2."""
        path = self.hard.uniaxial_strain(-0.02, 1e5, steps=20000)
        slope = numpy.gradient(path["stress.xx"] * 1e9, path["strain"])
        self.assertAlmostEqual(slope[0] / (RHO * self.hard.longitudinal_speed**2), 1, delta=2e-6)
        self.assertAlmostEqual(slope[10000] / (BULK * math.exp(0.01)), 1, delta=1e-6)
        self.assertAlmostEqual(self.hard.longitudinal_speed, math.sqrt((BULK + 4 / 3 * SHEAR) / RHO), delta=1e-9)
        self.assertAlmostEqual(self.hard.bulk_speed, math.sqrt(BULK / RHO), delta=1e-9)
        limit = BULK * (math.exp(YIELD / (2 * SHEAR)) - 1) + 2 / 3 * YIELD
        first = numpy.argmax(path["plastic_strain"] > 0)
        self.assertAlmostEqual(-path["stress.xx"][first] * 1e9, limit, delta=2e-4 * limit)
        self.assertAlmostEqual(self.hard.hugoniot(100)["precursor_stress"][0] * 1e9, limit, delta=1e-9 * limit)

    def test_uniaxial_stress(self):
        """Young's modulus and Poisson's ratio, then the yield stress, without stress on the sides."""
        young, poisson = 9 * BULK * SHEAR / (3 * BULK + SHEAR), (3 * BULK - 2 * SHEAR) / (2 * (3 * BULK + SHEAR))
        for sign in (-1, 1):
            path = self.hard.uniaxial_stress(sign * 0.02, 1e3, steps=2000)
            first = path["strain"][1]
            self.assertAlmostEqual(path["stress.xx"][1] * 1e9 / (young * first), 1, delta=2e-5)
            self.assertAlmostEqual(-path["side_strain"][1] / (poisson * first), 1, delta=2e-5)
            self.assertAlmostEqual(path["stress.xx"][-1] * 1e9, sign * YIELD, delta=10)
            self.assertLess(numpy.abs(path["stress"][:, 1:]).max(), 1e-9)
            # The volume is the elastic one, so what is plastic keeps it: 2 parts on the sides for one along x.
            pressure = BULK * math.expm1(-path["strain"][-1] - 2 * path["side_strain"][-1])
            self.assertAlmostEqual(pressure, -sign * YIELD / 3, delta=1e-5 * YIELD)

    def test_simple_shear_turns_the_stress(self):
        """The Jaumann rate, elastic: s_xy = G sin(g), s_xx = -s_yy = G (1 - cos(g)). Perfectly plastic: von Mises Y."""
        soft = 1e-9 * SHEAR
        elastic = self.hard.simple_shear(0.005, 1e3, steps=50)
        g = elastic["strain"]
        numpy.testing.assert_allclose(elastic["stress.xy"], soft * numpy.sin(g), rtol=2e-9, atol=1e-15)
        numpy.testing.assert_allclose(elastic["stress.xx"], soft * (1 - numpy.cos(g)), rtol=1e-7, atol=2e-9)
        numpy.testing.assert_allclose(elastic["stress.xx"], -elastic["stress.yy"], atol=1e-15)
        plastic = self.hard.simple_shear([0.3, -0.1], 1e3)
        self.assertAlmostEqual(plastic["von_mises"][200] * 1e9, YIELD, delta=1e-3)
        self.assertLess(plastic["stress.xy"][-1], 0)
        self.assertAlmostEqual(plastic["density"][-1], RHO, delta=1e-9)

    def test_work_becomes_energy(self):
        """Exact: e = K/rho0 (x + exp(-x) - 1) with x = ln(rho/rho0), and (2/3 Y/rho0)(1 - exp(-x)) of a plastic strain."""

        def error(steps):
            path = self.hard.uniaxial_strain(-0.1, 1e5, steps=steps)
            x, y = 0.1, YIELD / (2 * SHEAR)
            elastic = 4 / 3 * SHEAR / RHO * (1 - (1 + y) * math.exp(-y))
            shear = elastic + 2 / 3 * YIELD / RHO * (math.exp(-y) - math.exp(-x))
            exact = BULK / RHO * (x + math.exp(-x) - 1) + shear
            hot = 298 + (path["energy"][-1] - BULK / RHO * (x + math.exp(-x) - 1) - YIELD**2 / (6 * SHEAR * path["density"][-1])) / HEAT
            self.assertAlmostEqual(path["temperature"][-1], hot, delta=1e-3)
            return abs(path["energy"][-1] / exact - 1)

        coarse, fine = error(100), error(200)
        self.assertLess(fine, 1e-4)
        self.assertTrue(3.5 < coarse / fine < 4.5, f"second order: {coarse} {fine}")

    def test_a_start_under_pressure_and_heat(self):
        path = recoil.Material("copper/ofhc-johnson-cook").uniaxial_strain(-1e-6, 1, 1, pressure="2 GPa", temperature=600)
        self.assertAlmostEqual(path["pressure"][0], 2, delta=1e-9)
        self.assertAlmostEqual(path["temperature"][0], 600, delta=1e-6)
        numpy.testing.assert_allclose(path["stress"][0, :3], -2, rtol=1e-9)

    def test_matter_that_fails_bears_no_tension(self):
        """It fails at -0.5 GPa, K ln(rho) beyond it; squeezed together again it presses where it did before."""
        path = self.brittle.uniaxial_strain([0.01, -0.01], 1e5, steps=500)
        strain, failed = path["strain"], path["damage"] >= 1
        first = numpy.argmax(failed)
        self.assertAlmostEqual(strain[first], -math.log(1 - 0.5e9 / BULK), delta=0.01 / 500)
        self.assertTrue(failed[first:].all() and not failed[:first].any())
        numpy.testing.assert_array_equal(path["stress"][failed & (strain > 0)][1:], 0)
        self.assertAlmostEqual(path["void_fraction"][500], 1 - math.exp(-0.01), delta=1e-9)
        self.assertAlmostEqual(path["pressure"][-1] * 1e9, BULK * math.expm1(0.01), delta=1)


class Constants(Own):
    def test_yield_stress_of_johnson_and_cook(self):
        copper = recoil.Material("copper/ofhc-johnson-cook")
        for strain, rate, temperature in ((0.1, 1, 298), (0.3, 1e4, 298), (0.05, "2e6/s", 700), (0.2, 1e3, "1400 K")):
            wanted = johnson_cook(strain, recoil.units.convert(rate, "1/s"), recoil.units.convert(temperature, "K"), **COPPER)
            self.assertAlmostEqual(copper.yield_stress(strain, rate, temperature), wanted, delta=1e-12)

    def test_flow_stress_of_johnson_and_cook_on_a_path(self):
        """At the strain, the rate and the temperature that the path itself has; the heat is that of the plastic work.

        A step returns to yield at the temperature before its own plastic work: an error of the first order.
        """
        copper, errors = recoil.Material("copper/ofhc-johnson-cook"), []
        for steps in (2000, 4000):
            path = copper.simple_shear(1.0, "5e3/s", steps=steps)
            rate = numpy.diff(path["plastic_strain"]) / (numpy.diff(path["time"]) * 1e-6)
            wanted = johnson_cook(path["plastic_strain"][1:], rate, path["temperature"][1:], **COPPER)
            errors.append(abs(path["von_mises"][-1] / wanted[-1] - 1))
        self.assertLess(errors[1], 2e-5)
        self.assertAlmostEqual(errors[0] / errors[1], 2, delta=0.1)
        self.assertAlmostEqual(rate[-1], 5e3 / math.sqrt(3), delta=10)
        # e of the work of the shear stress, which is that on the deviator; elastic distortion is no heat.
        work = numpy.sum(0.5 * (path["stress.xy"][1:] + path["stress.xy"][:-1])) * 1e9 / 4000 / 8960
        elastic = (path["von_mises"][-1] * 1e9) ** 2 / (6 * 47.7e9 * 8960)
        self.assertAlmostEqual(path["energy"][-1], work, delta=1e-4 * work)
        self.assertAlmostEqual(path["temperature"][-1], 298 + (work - elastic) / 383, delta=0.02)

    def test_hugoniot_without_strength(self):
        """U = c0 + s u and the jump conditions."""
        u = numpy.array([100.0, 500, 1500])
        shocks, speed = self.fluid.hugoniot(u), 3940 + 1.489 * u
        numpy.testing.assert_allclose(shocks["shock_speed"], speed, rtol=1e-9)
        numpy.testing.assert_allclose(shocks["stress"] * 1e9, 8930 * speed * u, rtol=1e-9)
        numpy.testing.assert_allclose(shocks["density"], 8930 * speed / (speed - u), rtol=1e-9)
        numpy.testing.assert_allclose(shocks["energy"], u**2 / 2, rtol=1e-9)
        numpy.testing.assert_array_equal(shocks["precursor_stress"], 0)

    def test_tables_and_constants(self):
        frame = self.hard.uniaxial_strain(-0.01, 1, 3).to_pandas()
        self.assertEqual(frame.shape, (4, 18))
        self.assertEqual((frame.attrs["units"]["stress.xz"], frame.attrs["units"]["time"]), ("GPa", "us"))
        self.assertEqual((self.hard.density, self.hard.shear_modulus), (RHO, SHEAR * 1e-9))
        self.assertIn('kind = "perfectly-plastic"', self.hard.to_toml())


class Refused(Own):
    def test_mistakes(self):
        for wrong in (lambda: recoil.Material("coper/seed"), lambda: self.hard.uniaxial_strain(-0.1, 0),
                      lambda: self.hard.uniaxial_strain(-0.1, "3 us"), lambda: self.hard.uniaxial_strain(math.nan, 1),
                      lambda: self.hard.uniaxial_strain([], 1), lambda: self.hard.simple_shear(1, 1, steps=0)):  # fmt: skip
            self.assertRaises(recoil.InputError, wrong)
        self.assertRaisesRegex(recoil.InputError, "copper/seed", recoil.Material, "coper/seed")
        self.assertRaisesRegex(recoil.UnknownName, "pressure", self.hard.simple_shear(0.1, 1).__getitem__, "presure")
        self.assertRaises(recoil.UnknownName, self.hard.simple_shear(0.1, 1).__getitem__, "pressure.xx")

    def test_the_end_of_the_equation_of_state(self):
        self.assertRaisesRegex(recoil.PhysicsError, "equation of state ends", self.fluid.uniaxial_strain, -2, 1)
        self.assertRaises(recoil.PhysicsError, self.fluid.hugoniot, 2 * self.fluid.largest_velocity())

    def test_reading_runs_needs_no_module(self):
        with unittest.mock.patch.object(recoil.material, "_module", None), unittest.mock.patch.object(
            recoil.material.importlib.util, "spec_from_file_location", side_effect=ImportError
        ):
            self.assertRaises(ImportError, recoil.Material, "copper/seed")
        with unittest.mock.patch.object(recoil.material, "_module", None), unittest.mock.patch.object(
            recoil.material.importlib.machinery, "EXTENSION_SUFFIXES", [".of-another-python.so"]
        ):
            self.assertRaisesRegex(recoil.MissingDependency, "RECOIL_PYTHON", recoil.Material, "copper/seed")


class Shown(unittest.TestCase):
    """docs/how-to/material-points.md and the example, in a scratch folder."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(scratch.name)

    def test_example(self):
        names = runpy.run_path(str(ROOT / "python" / "examples" / "stress_and_strain.py"))
        self.assertTrue(pathlib.Path("stress_and_strain.png").is_file())
        faster = [path["von_mises"][-1] for path in names["paths"].values()]
        self.assertEqual(faster, sorted(faster))

    def test_page(self):
        page = (ROOT / "docs" / "how-to" / "material-points.md").read_text()
        blocks, names = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S), {}
        self.assertGreaterEqual(len(blocks), 3)
        for block in blocks:
            exec(compile(block, "material-points.md", "exec"), names)


if __name__ == "__main__":
    unittest.main()
