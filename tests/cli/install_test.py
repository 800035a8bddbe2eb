#!/usr/bin/python3
"""What `make install` and the Debian packages contain, put below a prefix of its own and used from another folder.

Environment: RECOIL_BUILD, the build folder, and RECOIL_CMAKE, the cmake that made it.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
OWN = ("RECOIL_DATA", "RECOIL_PROGRAM", "RECOIL_MATERIALS", "PYTHONPATH", "DESTDIR")
CLEAN = {name: value for name, value in os.environ.items() if name not in OWN}


def say(*words, code=0, **options):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=300, check=False, **options)
    if done.returncode != code:
        raise AssertionError(f"{words} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        image, cls.folder = pathlib.Path(cls.holder.name) / "image", pathlib.Path(cls.holder.name) / "elsewhere"
        cls.folder.mkdir()
        cls.said = say(os.environ["RECOIL_CMAKE"], "--install", os.environ["RECOIL_BUILD"], "--prefix", "/opt/recoil",
                       env=CLEAN | {"DESTDIR": str(image)})  # fmt: skip
        cls.prefix = image / "opt" / "recoil"

    def recoil(self, *words):
        return say(self.prefix / "bin" / "recoil", *words, cwd=self.folder, env=CLEAN)

    def test_nothing_is_put_elsewhere(self):
        self.assertEqual([p.name for p in self.prefix.parents[1].iterdir()], ["opt"])
        self.assertEqual(sorted(p.name for p in self.prefix.iterdir()), ["bin", "lib", "share"])
        self.assertNotIn("Warning", self.said)

    def test_the_program_finds_what_lies_beside_it(self):
        data = self.prefix / "share" / "recoil"
        said = self.recoil("doctor")
        self.assertRegex(said, rf"(?m)^ok +data +\d+ materials in {re.escape(str(data))}$")
        self.assertIn("copper/seed", self.recoil("material", "list"))
        self.recoil("new", "flyer", "fresh")
        self.assertIn("predicted", self.recoil("check", "fresh"))
        schema = (self.folder / "fresh" / "case.toml").read_text().split()[1]
        self.assertTrue((self.folder / "fresh" / schema).is_file(), schema)
        self.assertIn("predicted", self.recoil("check", "flyer_al_cu"))  # a shipped case by its name
        for case in sorted((data / "cases").rglob("case.toml")):
            self.assertTrue((case.parent / case.read_text().split()[1]).is_file(), case)

    def test_version_is_that_of_the_project(self):
        project = re.search(r"project\(recoil VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        version = self.recoil("--version").split()[1]
        self.assertRegex(version, rf"^{re.escape(project)}(\+([0-9]+\.)?g?[0-9a-f]+)?(\.dirty|\+dirty)?$")

    def test_version_without_git(self):
        tree = self.folder / "tarball"
        (tree / "cmake").mkdir(parents=True)
        for name in ("CMakeLists.txt", "cmake/recoil_version.cmake"):
            shutil.copy(SOURCE / name, tree / name)
        script = [os.environ["RECOIL_CMAKE"], "-P", tree / "cmake" / "recoil_version.cmake"]
        done = subprocess.run(script, capture_output=True, text=True, check=True, timeout=60)
        project = re.search(r"project\(recoil VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        self.assertEqual(done.stderr.strip(), project)
        if not shutil.which("git"):
            return
        git = ["git", "-C", tree, "-c", "user.name=a", "-c", "user.email=a@b"]
        for words in (["init", "-q"], ["add", "."], ["commit", "-qm", "one"], ["tag", "v7.1"], ["commit", "-qm", "two", "--allow-empty"]):
            say(*git, *words)
        done = subprocess.run(script, capture_output=True, text=True, check=True, timeout=60)
        self.assertRegex(done.stderr.strip(), r"^7\.1\+1\.g[0-9a-f]+$")
        say(*git, "checkout", "-q", "v7.1")
        done = subprocess.run(script, capture_output=True, text=True, check=True, timeout=60)
        self.assertEqual(done.stderr.strip(), "7.1")

    def test_manual_page_has_every_command(self):
        page = say("gzip", "-dc", self.prefix / "share" / "man" / "man1" / "recoil.1.gz")
        commands = [c.replace("-", r"\-") for c in re.findall(r"^## recoil (.*)$", self.recoil("commands"), re.M)]
        self.assertGreater(len(commands), 15)
        for command in commands:
            self.assertRegex(page, rf'(?m)^\.SS "recoil {re.escape(command)}[ "]')
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z"], input=page, capture_output=True, text=True, check=True)
            self.assertEqual(done.stderr, "")

    def test_completion(self):
        share = self.prefix / "share"
        bash = f'. {share}/bash-completion/completions/recoil; COMP_WORDS=(recoil dr ""); complete -p recoil'
        self.assertIn("_recoil", say("bash", "-ec", bash))
        self.assertIn("complete -c recoil", (share / "fish" / "vendor_completions.d" / "recoil.fish").read_text())
        (zsh,) = share.glob("zsh/*/_recoil")
        self.assertTrue(zsh.read_text().startswith("#compdef recoil\n"))
        self.assertNotIn(str(SOURCE), zsh.read_text())
        if shutil.which("zsh"):  # the file is the body of a function that zsh loads at the first Tab
            call = f"fpath=({zsh.parent} $fpath); autoload -Uz compinit _recoil; compinit -D -u; "
            call += "_arguments() { print -r -- ${(j: :)@} }; words=(recoil doc) CURRENT=2; _recoil; words=(recoil run x) CURRENT=3; _recoil"
            said = say("zsh", "-fc", call).splitlines()
            self.assertIn("doctor", said[0])
            self.assertIn("--threads", said[1])

    def test_python_package(self):
        (place,) = self.prefix.glob("lib/python3*/dist-packages")
        text = "import recoil; print(recoil.__version__, recoil.__file__); print(recoil.program_file())"
        environment = CLEAN | {"PYTHONPATH": str(place), "PATH": f"{self.prefix}/bin:{CLEAN['PATH']}"}
        said = say(sys.executable, "-B", "-c", text, cwd=self.folder, env=environment)
        self.assertRegex(said, rf"^\d+\.\d+\.\d+ {re.escape(str(place))}")
        self.assertIn(str(self.prefix / "bin" / "recoil"), said)

    def test_licences(self):
        text = (self.prefix / "share" / "doc" / "recoil" / "copyright").read_text()
        self.assertIn("GPL-2.0-or-later", text)
        self.assertTrue((self.prefix / "share" / "doc" / "recoil" / "changelog.gz").stat().st_size)


if __name__ == "__main__":
    unittest.main()
