#!/usr/bin/python3
"""Every command that the documentation shows is run, or at least read as the program would read it.

Blocks of the pages in docs/ and of README.md are run in a folder that has what the page takes for granted (PREPARED), unless a page
marks them as parsed only (shell_blocks.py). Those, the commands in the cases' README and those in sentences are held against the commands
and options that the program declares; targets of make, scripts, cases and keys of --set must exist. Environment: RECOIL_PROGRAM,
RECOIL_DATA.
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from shell_blocks import ROOT, Declared, blocks_of, inline_commands, pages, pieces, recoil_words

PROGRAM = os.environ["RECOIL_PROGRAM"]


def recoil(*words, **options):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=300, check=False, **options)


def write_case(file, template, *changes):
    """A template with changes: coarse and short, so that the commands of a page take no time."""
    text = (ROOT / template).read_text()
    for old, new in changes:
        if len(re.findall(old, text)) != 1:
            raise AssertionError(f"{template} has no {old}")
        text = re.sub(old, new, text)
    file.write_text(text)


def plates(file, end="0.4 us", frames="0.1 us"):
    write_case(file, "templates/flyer.toml", (r'finest = "0.05 mm"', 'finest = "0.2 mm"'), (r'end = "4 us"', f'end = "{end}"'),
               (r'fields = { every = "0.05 us" }', f'fields = {{ every = "{frames}" }}'))  # fmt: skip


def prepare_readme(folder):
    page = (ROOT / "README.md").read_text()
    (case,) = re.findall(r"^    format = 1\n(?:    .*\n|\n(?=    ))+", page, re.M)
    (folder / "flyer.toml").write_text(re.sub(r"^    ", "", case, flags=re.M))


def prepare_run_a_case(folder):
    plates(folder / "my.toml", "3.2 us", "1 us")
    (folder / "measured.csv").write_text("time [us],velocity [m/s]\n0,0\n1,10\n")
    (folder / "outline.csv").write_text("time [us],r [mm],z [mm]\n0,1,0\n0,2,1\n")
    for name, case, size in (("disc", "flyer_axisymmetric", "1 mm"), ("sphere", "sphere_on_plate", "2.5 mm")):
        write_case(folder / f"{name}.toml", f"cases/{case}/case.toml", (r'finest += "[^"]*"', f'finest = "{size}"'),
                   (r'(?m)^end += "[^"]*"', 'end = "1 us"'))  # fmt: skip
    for case in ("disc", "sphere"):
        settings = ("--set", "output.report=false", "--set", "output.fields.every=1us")
        done = recoil("run", f"{case}.toml", "-q", "-j", 1, *settings, cwd=folder)
        assert done.returncode in (0, 5, 6), done.stdout + done.stderr


def prepare_reports(folder):
    plates(folder / "flyer.toml")
    for name in ("coarse", "fine"):
        recoil("run", "flyer.toml", "-q", "-o", f"runs/{name}", cwd=folder)


def prepare_resume(folder):
    plates(folder / "my.toml", "1 us")
    (folder / "my.toml").write_text((folder / "my.toml").read_text() + '\n[output.checkpoint]\nevery = "0.5 us"\n')


def prepare_study(folder):
    plates(folder / "my.toml", "0.2 us")


def prepare_sweep(folder):
    plates(folder / "flyer.toml", "0.2 us")


def prepare_cluster(folder):
    shutil.copy(ROOT / "templates" / "penetration.toml", folder / "rod.toml")


PREPARED = {
    "README.md": prepare_readme,
    "docs/how-to/run-a-case.md": prepare_run_a_case,
    "docs/how-to/read-a-report.md": prepare_reports,
    "docs/how-to/stop-and-resume.md": prepare_resume,
    "docs/how-to/mesh-study.md": prepare_study,
    "docs/how-to/sweep.md": prepare_sweep,
    "docs/how-to/cluster.md": prepare_cluster,
}


class Sandbox(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        programs = self.folder / "programs"
        programs.mkdir()
        (programs / "recoil").symlink_to(PROGRAM)
        self.environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}"}

    def shell(self, text):
        return subprocess.run(["bash", "-ec", text], cwd=self.folder, env=self.environment, timeout=300,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)  # fmt: skip


class Run(Sandbox):
    """The commands that are run, page by page, in the order of the page."""

    def run_page(self, name):
        page = ROOT / name
        PREPARED.get(name, lambda folder: None)(self.folder)
        said = None
        for block in blocks_of(page):
            if block.kind == "text":
                self.assertIsNotNone(said, f"{block.place()}: output without a command that is run before it")
                for line in filter(str.strip, block.text.splitlines()):
                    self.assertIn(line.rstrip(), said.splitlines(), f"{block.place()}: the commands before do not print this line")
            elif block.runs and not block.text.startswith("#!"):
                self.append_tables(page, block)
                done = self.shell("\n".join(f"{command} || (($? == 6))" for command in block.commands()))
                self.assertEqual(done.returncode, 0, f"{block.place()}: {block.text}\n{done.stdout}")
                said = done.stdout
        self.assertIsNotNone(said, f"{name} has no command that is run")

    def append_tables(self, page, block):
        """The tutorial adds a table to its case before the block."""
        before = "".join(page.read_text().splitlines(keepends=True)[: block.line - 1])
        if added := re.search(r"Append to `([^`]+)`:\n\n```toml\n(.*?)^```\s*\Z", before, re.M | re.S):
            with (self.folder / added[1]).open("a") as case:
                case.write("\n" + added[2])


def name_of_test(page):
    return "test_" + re.sub(r"\W", "_", page.relative_to(ROOT).with_suffix("").as_posix())


for found in pages():
    if any(b.runs for b in blocks_of(found)):
        setattr(Run, name_of_test(found), lambda self, name=found.relative_to(ROOT).as_posix(): self.run_page(name))


class Cluster(Sandbox):
    def test_the_job_stops_is_requeued_and_goes_on(self):
        page = (ROOT / "docs" / "how-to" / "cluster.md").read_text()
        (script,) = re.findall(r"^```bash\n(#!/bin/bash\n.*?)^```", page, re.M | re.S)
        self.assertEqual(script.count("--wall 230min"), 2)
        plates(self.folder / "rod.toml", "4 us")
        (self.folder / "programs" / "scontrol").write_text('#!/bin/sh\necho "$@" >> requeued\n')
        (self.folder / "programs" / "scontrol").chmod(0o755)
        slurm = {"SLURM_NTASKS": "2", "SLURM_CPUS_PER_TASK": "1", "SLURM_JOB_ID": "17", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
        first = subprocess.run(["bash", "-c", script.replace("230min", "0.1s")], cwd=self.folder, env=self.environment | slurm,
                               capture_output=True, text=True, timeout=300, check=False)  # fmt: skip
        self.assertEqual(first.returncode, 75, first.stdout + first.stderr)
        self.assertEqual((self.folder / "requeued").read_text(), "requeue 17\n")
        second = subprocess.run(["bash", "-c", script], cwd=self.folder, env=self.environment | slurm,
                                capture_output=True, text=True, timeout=300, check=False)  # fmt: skip
        self.assertEqual(second.returncode, 0, second.stdout + second.stderr)
        self.assertIn("finished at 4 us", second.stdout)
        self.assertEqual((self.folder / "requeued").read_text(), "requeue 17\n")


class Parsed(unittest.TestCase):
    """All commands of all pages, also those that are not run."""

    @classmethod
    def setUpClass(cls):
        cls.declared = Declared(recoil("commands").stdout)
        cls.targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.M))
        cls.blocks = [b for page in pages() for b in blocks_of(page) if b.kind == "sh"]

    def commands(self):
        for block in self.blocks:
            for line in block.commands():
                for words in pieces(line):
                    yield block.place(), line, words

    def test_recoil_knows_commands_and_options(self):
        count = 0
        for place, line, words in self.commands():
            if (behind := recoil_words(words)) is not None:
                count += 1
                self.assertIsNone(self.declared.mistake(behind), f"{place}: {line}")
        self.assertGreater(count, 150)
        for page in pages():
            for line, text in inline_commands(page):
                words = [w for w in pieces(text)[0][1:] if w != "..."]
                self.assertIsNone(self.declared.mistake(words, whole=False), f"{page}:{line}: {text}")

    def test_mistakes_are_found(self):
        for words in (["rnu", "a"], ["run"], ["run", "a", "b"], ["run", "a", "--thread", "2"], ["material", "lits", "a"],
                      ["plot", "a"], ["run", "a", "-o"], ["doctor", "--set", "a=1"]):  # fmt: skip
            self.assertIsNotNone(self.declared.mistake(words), words)

    def test_what_is_named_is_there(self):
        for place, line, words in self.commands():
            for word in words:
                if re.match(r"(cases|tools|templates|\.ci|python)/[\w./]+$", word):
                    self.assertTrue((ROOT / word).exists(), f"{place}: {word}\n{line}")
            if words[0] == "make" or words[:2] == ["sudo", "make"]:
                for word in words[1:]:
                    known = "=" in word or word in self.targets or word.startswith("-") or word == "make"
                    self.assertTrue(known, f"{place}: the Makefile has no {word}")

    def test_keys_of_set_exist(self):
        keys = {}
        for place, _, words in self.commands():
            for flag, value in zip(words, words[1:]):
                if flag == "--set" and recoil_words(words) is not None:
                    keys.setdefault(value.split("=")[0], place)
        self.assertGreater(len(keys), 8)
        for key, place in keys.items():
            table = key.rpartition(".")[0]  # a component, velocity.x, stands with its vector
            known = recoil("explain", key).returncode == 0 or recoil("explain", table).returncode == 0
            self.assertTrue(known, f"{place}: {key}")

    def test_what_is_run(self):
        run = [b for b in self.blocks if b.runs]
        print(f"shell blocks: {len(run)} run, {len(self.blocks) - len(run)} parsed only")
        self.assertGreater(len(run), 15)


if __name__ == "__main__":
    unittest.main()
