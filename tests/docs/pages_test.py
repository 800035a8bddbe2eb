#!/usr/bin/python3
"""Pages of docs/ against the sources and the program.

Every block of C++ of a how-to page docs/how-to/NAME.md stands word for word in tests/unit/howto/NAME_test.cpp (with _
for -), which is compiled and run with the unit tests. With RECOIL_PROGRAM also: docs/reference/ is what the program
writes. Every case names a schema that is there, and passes the check.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import textwrap
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```cpp\n(.*?)^```", re.S | re.M)
PAGES = ("add-a-gauge", "add-a-shape", "add-an-equation-of-state", "add-a-strength-model")


def lines(text):
    """The lines without indentation and empty ones."""
    return [line.strip() for line in text.splitlines() if line.strip()]


def stands_in(part, whole):
    """Whether the lines `part` follow each other somewhere in `whole`."""
    return any(whole[k : k + len(part)] == part for k in range(len(whole) - len(part) + 1))


class HowTo(unittest.TestCase):
    def test_every_block_is_compiled(self):
        for name in PAGES:
            source = ROOT / "tests" / "unit" / "howto" / (name.replace("-", "_") + "_test.cpp")
            blocks = BLOCK.findall((ROOT / "docs" / "how-to" / (name + ".md")).read_text())
            self.assertTrue(blocks, f"{name}.md shows no C++")
            for block in blocks:
                self.assertTrue(
                    stands_in(lines(block), lines(source.read_text())),
                    f"this block of {name}.md does not stand in {source.relative_to(ROOT)}; change both:\n{block}",
                )


class Material(unittest.TestCase):
    """docs/how-to/add-a-material.md: its file is found, has nothing to remark, and does what the page says."""

    def test_the_file_of_the_page_works(self):
        page = (ROOT / "docs" / "how-to" / "add-a-material.md").read_text()
        text, tabulated = re.findall(r"^```toml\n(.*?)^```", page, re.S | re.M)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "bronze" / "cast.toml"
            file.parent.mkdir()
            file.write_text(text)
            environment = dict(os.environ, RECOIL_MATERIALS=folder)
            commands = re.findall(r"^    recoil (material (?!import).*?)(?: *#.*)?$", page, re.M)
            self.assertEqual(len(commands), 5)
            for command in commands:
                done = subprocess.run([os.environ["RECOIL_PROGRAM"], *shlex.split(command)], cwd=folder, env=environment,
                                      capture_output=True, text=True, timeout=60)  # fmt: skip
                self.assertEqual(done.returncode, 0, command + "\n" + done.stdout + done.stderr)
                self.assertIn("1 material, nothing to remark" if " lint " in command else "bronze/cast", done.stdout)
                if " -o " in command:
                    picture = pathlib.Path(folder) / command.split(" -o ")[1]
                    self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
            rest = 'title = "Copper by a table"\ncite = ["handbook2024"]\nstrength = { kind = "none" }\n'
            (file.parent / "tabulated.toml").write_text(rest + tabulated)
            (table,) = re.findall(r"`recoil (material table .*?)`", page)
            for command in (table, "material hugoniot bronze/tabulated"):
                done = subprocess.run([os.environ["RECOIL_PROGRAM"], *shlex.split(command)], cwd=file.parent,
                                      env=environment, capture_output=True, text=True, timeout=60)  # fmt: skip
                self.assertEqual(done.returncode, 0, command + "\n" + done.stdout + done.stderr)


class Shapes(unittest.TestCase):
    """docs/how-to/describe-a-body.md: every shape that it shows whole is read, in 3d."""

    def test_shapes_of_the_page_are_read(self):
        page = (ROOT / "docs" / "how-to" / "describe-a-body.md").read_text()
        blocks = [b for b in re.findall(r"(?:^    .*\n)+", page, re.M) if not any(part in b for part in ("...", "[body.", "[load."))]
        self.assertGreaterEqual(len(blocks), 6)
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(ROOT / "templates" / "fragment.stl", folder)
            case = pathlib.Path(folder) / "case.toml"
            for block in blocks:
                sides = "".join(f'{axis} = ["-50 mm", "50 mm"]\n' for axis in "xyz")
                moves = "" if "velocity" in block else 'velocity = { x = "1 m/s" }\n'
                case.write_text(f'[domain]\ngeometry = "3d"\n{sides}[mesh]\nfinest = "2 mm"\n[time]\nend = "1 us"\n'
                                f'[body.a]\nrigid = true\n{textwrap.dedent(block)}{moves}'
                                '[body.matter]\nmaterial = "copper/seed"\n'
                                'shape = { kind = "sphere", centre = { x = "-46 mm", y = "-46 mm", z = "-46 mm" }, radius = "3 mm" }\n')  # fmt: skip
                done = subprocess.run([os.environ["RECOIL_PROGRAM"], "check", case], capture_output=True, text=True, timeout=60)
                self.assertNotIn("error", done.stderr, block)
                self.assertIn("cost", done.stdout, block + done.stdout + done.stderr)


    def test_loads_of_the_page_are_read(self):
        page = (ROOT / "docs" / "how-to" / "describe-a-body.md").read_text()
        (block,) = [b for b in re.findall(r"(?:^    .*\n)+", page, re.M) if "[load." in b]
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "case.toml"
            case.write_text('[domain]\ngeometry = "axisymmetric"\nr = ["0 mm", "10 mm"]\nz = ["-5 mm", "5 mm"]\n[mesh]\nfinest = "0.1 mm"\n[time]\nend = "1 us"\n'
                            '[body.plate]\nmaterial = "copper/seed"\nshape = { kind = "box", r = ["0 mm", "8 mm"], z = ["0 mm", "2 mm"] }\n'
                            + textwrap.dedent(block))  # fmt: skip
            done = subprocess.run([os.environ["RECOIL_PROGRAM"], "check", case], capture_output=True, text=True, timeout=60)
            self.assertNotIn("error", done.stderr, block)
            self.assertNotIn("zero", done.stderr, block)


class Reference(unittest.TestCase):
    def check_file(self, name, *words):
        program = os.environ["RECOIL_PROGRAM"]
        written = subprocess.run([program, *words], capture_output=True, text=True, check=True, timeout=60).stdout
        self.assertEqual(
            (ROOT / "docs" / "reference" / name).read_text(), written,
            f"docs/reference/{name} is not what the program writes: renew it with `make docs`",
        )  # fmt: skip

    def test_reference_page(self):
        self.check_file("case.md", "schema", "--markdown")

    def test_page_of_commands(self):
        self.check_file("commands.md", "commands")

    def test_schema(self):
        self.check_file("recoil-case-1.schema.json", "schema")


class Cases(unittest.TestCase):
    cases = sorted(c for c in (ROOT / "cases").rglob("*.toml") if c.name != "expected.toml")

    def test_every_case_passes_the_check(self):
        for case in self.cases:
            said = subprocess.run([os.environ["RECOIL_PROGRAM"], "check", case], capture_output=True, text=True, check=False)
            self.assertEqual(said.returncode, 0, f"{case}\n{said.stdout}{said.stderr}")

    def test_every_case_names_its_schema(self):
        self.assertTrue(self.cases)
        for case in self.cases:
            first = case.read_text().splitlines()[0]
            self.assertRegex(first, r"^#:schema \S+$", case)
            schema = (case.parent / first.split()[1]).resolve()
            self.assertTrue(schema.is_file(), f"{case}: there is no {schema}")


if __name__ == "__main__":
    unittest.main()
