#!/usr/bin/python3
"""Commands around a case: new, cite, doctor, completion; what is missing in them. Environment: see program.py."""

import os
import pathlib
import shutil
import subprocess
import unittest

from program import DATA, FLYER, Program, recoil

TEMPLATES = sorted(p.stem for p in (DATA / "templates").glob("*.toml"))
# Coarse and short: that they run, not what they find.
QUICK = {
    "flyer": ["--set", "mesh.finest=0.2mm"],
    "driven-plate": ["--set", "mesh.finest=0.2mm"],
    "layered": ["--set", "mesh.finest=0.05mm"],
    "spall": ["--set", "mesh.finest=0.04mm"],
    "cylinder": ["--set", "mesh.finest=1.3mm", "--end", "1.5us"],
    "whipple": ["--set", "mesh.finest=0.4mm", "--end", "0.8us"],
    "taylor": ["--set", "mesh.finest=0.5mm", "--end", "2us"],
    "penetration": ["--set", "mesh.finest=0.8mm", "--end", "1us"],
    "hypervelocity": ["--set", "mesh.finest=0.2mm", "--end", "0.1us"],
    "ogive": ["--set", "mesh.finest=1.5mm", "--end", "4us"],
    "fragment": ["--set", "mesh.finest=1mm", "--end", "1.5us"],
}  # fmt: skip


class Start(Program):
    def test_what_is_missing_is_named_as_the_help_names_it(self):
        for words, missing, cure in (
            ([], "a command is missing", "the commands are: new, run, resume"),
            (["material"], "a command is missing", "list, show"),
            (["run"], "CASE is missing (case file, or its folder)", "`recoil run --help`"),
            (["plot"], "DIR is missing (folder of the run)", "`recoil plot --help`"),
            (["material", "show"], "MATERIAL is missing", "`recoil material show --help`"),
            (["study", FLYER], "--mesh is missing (cell sizes", "`recoil study --help`"),
            (["material", "list", "copper"], "copper", "`recoil material list --help`"),
        ):
            with self.subTest(words):
                self.expect(recoil(*words), 2, missing, cure)

    def test_a_run_that_cannot_go_on_says_why(self):
        self.expect(recoil("resume", self.folder / "nowhere"), 2, "there is no folder")
        self.expect(recoil("resume", self.folder), 2, "holds no run")
        self.expect(self.run_coarse("--end", "0.1us"), 0)
        self.expect(recoil("resume", self.folder / "out"), 2, "has ended, and has left no checkpoint")

    def test_every_template_passes_the_check(self):
        self.assertGreater(len(TEMPLATES), 5)
        listed = recoil("new", "--list").stdout
        for name in TEMPLATES:
            folder = self.folder / name
            self.expect(recoil("new", name, folder), 0, "recoil check")
            self.assertRegex(listed, rf"(?m)^{name} +\w")
            said = recoil("check", folder)
            self.expect(said, 0, "cost")
            warnings = [line for line in said.stderr.splitlines() if line.startswith("warning")]
            for line in warnings:  # what a coarse first mesh costs; nothing else
                self.assertRegex(line, r"is [\d.]+ cells thick; about 20 are needed")
            schema = (folder / "case.toml").read_text().splitlines()[0].split()[1]
            self.assertIn('"$schema"', (folder / schema).read_text())

    def test_quick_templates_run(self):
        for name, words in QUICK.items():
            out = self.folder / name
            result = recoil("run", DATA / "templates" / f"{name}.toml", "-o", out, "-q", *words)
            self.assertIn(result.returncode, (0, 6), result.stdout + result.stderr)
            self.assertTrue((out / "events.csv").read_text().count("contact"), name)

    def test_new_refuses(self):
        self.expect(recoil("new", "flier"), 2, "did you mean 'flyer'?")
        self.expect(recoil("new"), 2, "--list")
        self.expect(recoil("new", "flyer", self.folder / "a"), 0)
        self.expect(recoil("new", "flyer", self.folder / "a"), 2, "exists")
        nowhere = os.environ | {"RECOIL_DATA": str(self.folder)}
        self.expect(recoil("new", "flyer", self.folder / "b", env=nowhere), 4, "RECOIL_DATA")

    def test_cites_the_code_and_the_sources(self):
        said = recoil("cite", DATA / "templates" / "flyer.toml")
        self.expect(said, 0, "@misc{recoil,", "@inproceedings{johnson1983,", "@techreport{lesuer2001,")
        self.assertEqual(said.stdout.count("{"), said.stdout.count("}"))
        self.expect(self.run_coarse(), 0)
        self.expect(recoil("cite", self.folder / "out"), 0, "@unpublished{seed,")
        case = self.case(('"lesuer2001"', '"mine2030"'))
        self.expect(recoil("cite", case), 0, "'mine2030' is cited, but in no references.bib")
        (self.folder / "references.bib").write_text("@book{mine2030, title = {Mine}, year = {2030}}\n")
        self.expect(recoil("cite", case), 0, "@book{mine2030, title = {Mine}")

    def test_doctor_names_what_is_wrong_and_a_cure(self):
        good = recoil("doctor", cwd=self.folder)
        self.expect(good, 0, "processors", "memory", "HDF5", "a field file was written and read")
        self.assertNotIn("FAIL", good.stdout)
        bare = os.environ | {"PATH": "/nowhere", "LC_ALL": "C"}
        self.expect(recoil("doctor", env=bare), 0, "no mpirun", "openmpi-bin", "LC_ALL=C.UTF-8", "no img2webp")
        lost = os.environ | {"RECOIL_DATA": str(self.folder)}
        self.expect(recoil("doctor", env=lost), 4, "FAIL  data", "set RECOIL_DATA")


class Completion(Program):
    def setUp(self):
        super().setUp()
        self.scripts = {shell: recoil("completion", shell).stdout for shell in ("bash", "zsh", "fish")}

    def completed(self, *words):
        """What bash offers for the last word."""
        call = f'COMP_WORDS=({" ".join(repr(w) for w in words)}); COMP_CWORD={len(words) - 1}; _recoil; '
        text = self.scripts["bash"] + call + 'printf "%s\\n" "${COMPREPLY[@]}"'
        done = subprocess.run(["bash", "-c", text], capture_output=True, text=True, check=True, cwd=self.folder)
        self.assertEqual(done.stderr, "")
        return sorted(done.stdout.split())

    def test_bash_completes_what_the_program_declares(self):
        self.assertEqual(self.completed("recoil", "re"), ["report", "resume"])
        self.assertEqual(self.completed("recoil", "material", ""), ["hugoniot", "import", "lint", "list", "match", "show", "table"])
        self.assertIn("copper/seed", self.completed("recoil", "material", "show", "cop"))
        self.assertEqual(self.completed("recoil", "run", "--thr"), ["--threads"])
        self.assertEqual(self.completed("recoil", "new", "ta"), ["taylor"])
        self.assertEqual(self.completed("recoil", "run", "-j", ""), [])
        (self.folder / "mine.toml").touch()
        self.assertEqual(self.completed("recoil", "run", "mi"), ["mine.toml"])
        self.assertEqual(self.completed("recoil", "check", "--png", "mi"), ["mine.toml"])
        self.expect(recoil("completion", "csh"), 2, "bash")

    def test_every_command_is_in_every_script(self):
        commands = [w for w in self.completed("recoil", "") if not w.startswith("-")]
        self.assertIn("verify", commands)
        for shell, script in self.scripts.items():
            for command in commands:
                self.assertIn(command, script, shell)

    def test_scripts_are_read_by_their_shells(self):
        for shell in ("bash", "zsh", "fish"):
            if not shutil.which(shell):
                self.skipTest(f"there is no {shell}")
            file = self.folder / shell
            file.write_text(self.scripts[shell])
            done = subprocess.run([shell, "-n", pathlib.Path(file)], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), shell)


if __name__ == "__main__":
    unittest.main()
