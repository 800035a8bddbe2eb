#!/usr/bin/python3
"""Files and folders in each other's place, of others, damaged, misnamed. Environment: see program.py."""

import json
import unittest

from program import FLYER, Program, recoil

CURVE = '[expect]\n"gauge.rear.velocity.error@0us..1us:%s:v" = { at-most = "1 m/s" }\n'


class WrongFiles(Program):
    def case_with(self, text):
        case = self.case()
        case.write_text(case.read_text() + text)
        return case

    def test_folders_of_others_are_left_as_they_are(self):
        thesis = self.folder / "texts" / "thesis.txt"
        thesis.parent.mkdir()
        thesis.write_text("mine")
        for out in (thesis.parent, thesis):
            self.expect(recoil("run", self.case(), "-o", out, "--force"), 2, "choose another one with -o")
        self.assertEqual([(p.name, p.read_text()) for p in thesis.parent.iterdir()], [("thesis.txt", "mine")])

    def test_a_case_that_is_refused_leaves_the_finished_run_as_it_is(self):
        out, case = self.folder / "out", self.case()
        self.expect(self.run_coarse("--end", "0.2us", case=case), 0)

        def held():
            return {file: file.read_bytes() for file in out.rglob("*") if file.is_file()}

        before = held()
        for change in ('expect={"event.ricochets"=true}', 'expect={"run.steps"={at-most="1 us"}}', "time.end=0us"):
            self.expect(self.run_coarse("--force", "--set", change, case=case), 2, "= help:")
            self.assertEqual(held(), before, change)

    def test_a_missing_case_leaves_the_others_in_the_report(self):
        missing = self.folder / "nowhere.toml"
        self.expect(recoil("check", missing, FLYER), 2, "there is no case file", "133.7 m/s")
        said = recoil("check", "--json", FLYER, missing)
        self.assertEqual(said.returncode, 2)
        good, bad = json.loads(said.stdout)
        self.assertTrue(good["good"])
        self.assertFalse(bad["good"])
        self.assertIn("there is no case file", bad["found"][0]["message"])
        self.assertEqual(bad["found"][0]["file"], str(missing))

    def test_folders_in_place_of_files(self):
        (self.folder / "materials" / "mine.toml").mkdir(parents=True)
        self.expect(recoil("check", self.case(('"copper/seed"', '"mine"'))), 2, "mine.toml': it is a folder", "= help:")
        self.expect(recoil("check", self.case_with(CURVE % "materials")), 2, "it is a folder, give a file")

    def test_messages_hold_no_control_characters(self):
        (self.folder / "curve.csv").write_bytes(b"time [us],v\n0,\x1b[31m\x07\xff\n")
        said = recoil("run", self.case_with(CURVE % "curve.csv"), "-o", self.folder / "out", "--end", "1us")
        self.expect(said, 2, "is not a number", "= help:")
        self.assertNotRegex(said.stderr, r"[\x00-\x08\x0b-\x1f]")
        self.assertFalse((self.folder / "out").exists())

    def test_names_of_cases_and_runs(self):
        case = self.case()
        self.expect(recoil("check", self.folder / "case"), 2, "did you mean", "case.toml'?")
        self.expect(recoil("check", self.folder / "cose.toml"), 2, "did you mean 'case.toml'?")
        case.rename(self.folder / "flyer.toml")
        self.expect(recoil("check", self.folder), 2, "there are: flyer.toml")
        (self.folder / "out").mkdir()
        for command in (["report"], ["resume"], ["plot", "pressure"]):
            self.expect(recoil(command[0], self.folder / "aut", *command[1:]), 2, "there is no folder", "did you mean 'out'?")

    def test_a_report_does_without_a_field_file_that_is_cut_off(self):
        out = self.folder / "out"
        self.assertIn(recoil("run", self.case(), "-o", out, "--end", "1us", "--set", 'output.fields={every="0.25us"}').returncode,
                      (0, 5, 6))
        last = sorted((out / "fields").glob("*.hdf"))[-1]
        last.write_bytes(last.read_bytes()[:2000])
        self.expect(recoil("report", out), 0, f"warning: the field file '{last}' is damaged", "= help:")
        self.assertIn("4 of 5 dumps of the fields", (out / "report.html").read_text(encoding="utf-8"))
        self.expect(recoil("plot", out, "pressure"), 2, "damaged or cut off")


if __name__ == "__main__":
    unittest.main()
