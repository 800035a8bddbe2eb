"""Meshes of several levels: the same bits for all processes and threads, resume, pictures, wrong inputs."""

import filecmp
import json
import unittest

import h5py
from program import DATA, Program, recoil

FILES = ("gauges/rear.csv", "gauges/flyer.csv", "gauges/impact.csv", "history.csv", "events.csv")
LEVELS = ["--set", "mesh.finest=0.05mm", "--set", "mesh.levels=4", "--set", "output.report=false"]


class Levels(Program):
    def run_flyer(self, name, *words, code=0):
        out = self.folder / name
        self.expect(recoil("run", self.case(), "-o", out, *LEVELS, "--end", "2us", *words), code)
        return out

    def expect_same(self, one, other):
        for file in FILES:
            self.assertTrue(filecmp.cmp(one / file, other / file, shallow=False), f"{other.name} {file}")

    def test_processes_and_threads_give_the_same_bits(self):
        one = self.run_flyer("one")
        for name, words in {"two": ["-n", "2"], "three": ["-n", "3"], "threads": ["-j", "2"]}.items():
            self.expect_same(one, self.run_flyer(name, *words))

    def test_a_run_goes_on_across_a_change_of_the_mesh_with_other_processes(self):
        whole = self.run_flyer("whole")
        parts = self.run_flyer("parts", "--wall", "30ms", code=75)
        self.expect(recoil("resume", parts, "-n", "2"), 0)
        self.expect_same(whole, parts)

    def test_fewer_cells_give_what_the_finest_give(self):
        fine, few = self.run_flyer("fine", "--set", "mesh.levels=1"), self.run_flyer("few")
        self.assertEqual(json.loads((few / "summary.json").read_text())["verdict"], "valid")
        self.assertLess(self.cells_of(few), 0.7 * self.cells_of(fine))
        for gauge in ("rear", "flyer", "impact"):
            ends = [(out / "gauges" / f"{gauge}.csv").read_text().splitlines()[-1].split(",") for out in (fine, few)]
            for exact, found in zip(*ends):
                if exact and abs(float(exact)) > 1e-6:
                    self.assertAlmostEqual(float(found) / float(exact), 1, delta=5e-3)

    def cells_of(self, out):
        with h5py.File(min((out / "fields").glob("*.hdf"))) as dump:
            return int(dump["VTKHDF"]["NumberOfCells"][0])

    def test_bad_states_in_coarser_cells_are_averaged(self):
        """Copper that cannot fail, stretched beyond its equation of state where nothing asks for the finest cells;
        soon after the end of this run so much is averaged that it would stop."""
        words = ["mesh.bend=1e6", "body.flyer.velocity.x=3km/s", 'body.flyer.material="copper/seed"']
        words += ['domain.x=["-4mm","40mm"]', "output.report=false", "time.end=3.85us"]
        runs = []
        for processes in ("1", "3"):
            out = self.folder / f"averaged_{processes}"
            case = DATA / "cases" / "flyer_levels" / "case.toml"
            result = recoil("run", case, "-o", out, "-n", processes, *[w for v in words for w in ("--set", v)])
            self.assertEqual(result.returncode, 5, result.stderr)  # what it expects is of another impact
            summary = json.loads((out / "summary.json").read_text())
            self.assertGreater(summary["floors"]["averaged-states"], 10)
            self.assertLess(max(summary["budgets"]["total"].values()), 1e-13)
            runs.append(out)
        self.expect_same(*runs)

    def test_the_level_is_a_field(self):
        out = self.run_flyer("field")
        self.expect(recoil("plot", out, "level", self.folder / "level.png"), 0)
        self.assertGreater((self.folder / "level.png").stat().st_size, 1000)

    def test_wrong_inputs(self):
        flyer = DATA / "cases" / "flyer_al_cu" / "case.toml"
        for words, text in (
            (["mesh.levels=0"], "levels"),
            (["mesh.levels=3", "method.scheme=\"ghost-fluid\""], "conservative"),
            (["mesh.bend=0"], "bend"),
            (["mesh.levels=3", "mesh.every=0"], "every"),
            (["mesh.levels=3", "mesh.block=11"], "even"),
            (["mesh.levels=4", "mesh.finest=0.05mm", "domain.boundary.x=\"symmetry\""], "multiple of 8 cells"),
        ):
            sets = [word for w in words for word in ("--set", w)]
            self.expect(recoil("check", flyer, *sets), 2, text)


if __name__ == "__main__":
    unittest.main()
