"""Runs the program for the tests of its command line.

Needs RECOIL_PROGRAM, the program, and RECOIL_DATA, the folder that holds cases/ and materials/.
"""

import os
import pathlib
import subprocess
import tempfile
import unittest

os.environ.pop("RECOIL_MATERIALS", None)  # of the shell: the tests look at shipped materials and at their own

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

    def run_coarse(self, *words, case=None):
        """Runs the flyer case, or another, on a coarse mesh into the folder `out`."""
        return recoil("run", case or self.case(), "-o", self.folder / "out", *COARSE, *words)
