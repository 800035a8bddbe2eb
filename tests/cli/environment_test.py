#!/usr/bin/python3
"""What the machine refuses: full disks, folders that cannot be written, too little memory, too many threads.

The program must say so in its own words, exit with 4, and leave what it has written readable and resumable.
"""

import os
import pathlib
import resource
import shutil
import subprocess
import unittest

from program import COARSE, FLYER, PROGRAM, Program, recoil


def limited(kind, size):
    """Sets a limit of the process that is about to start."""
    return lambda: resource.setrlimit(kind, (size, size))


class Environment(Program):
    def disk(self, options):
        """A file system of our own; the test is skipped without the right to mount one."""
        disk = self.folder / "disk"
        disk.mkdir()
        mount = ["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(disk)]
        if not shutil.which("mount") or subprocess.run(mount, capture_output=True, check=False).returncode:
            self.skipTest("no right to mount a file system")
        self.addCleanup(subprocess.run, ["umount", str(disk)], check=True)
        return disk

    def test_a_full_disk(self):
        disk = self.disk("size=2m")
        case = self.case(('fields = { every = "0.5 us" }',
                          'fields = { every = "0.02 us" }\ncheckpoint = { every = "0.5 us", keep = 1 }'))
        words = ["-o", disk / "run", *COARSE, "--plain", "-j", "1"]
        full = recoil("run", case, *words)
        self.expect(full, 4, "No space left on device")
        self.expect(recoil("status", disk / "run"), 0, "interrupted", "resume")
        written = sorted((disk / "run" / "fields").glob("*.hdf"))
        self.assertGreater(len(written), 2)
        self.expect(recoil("plot", disk / "run", "pressure", "-o", self.folder / "last.png"), 0)
        # With room again it goes on.
        for file in written[:-1]:
            file.unlink()
        subprocess.run(["mount", "-o", "remount,size=40m", str(disk)], check=True)
        self.expect(recoil("resume", disk / "run", "-j", "1"), 0, "finished at 6 us")

    def test_a_full_disk_for_several_processes(self):
        disk = self.disk("size=300k")
        case = self.case(('fields = { every = "0.5 us" }', 'checkpoint = { every = "0.5 us", keep = 9 }'))
        full = recoil("run", case, "-o", disk / "run", *COARSE, "--plain", "-n", "2", "-j", "1", "--set", "output.report=false")
        self.expect(full, 4, "No space left on device")
        self.assertNotIn("HDF5", full.stdout + full.stderr)
        self.assertNotIn("signal", full.stdout + full.stderr)
        saved = sorted((disk / "run" / "checkpoints").glob("*.h5"))
        self.assertGreater(len(saved), 0)
        subprocess.run(["mount", "-o", "remount,size=40m", str(disk)], check=True)
        self.expect(recoil("resume", disk / "run", "-n", "2", "-j", "1"), 0, "finished at 6 us")

    def test_a_disk_with_no_room_at_all(self):
        disk = self.disk("size=64k")
        result = recoil("run", self.case(), "-o", disk / "run", "-j", "1")
        self.expect(result, 4, "error: cannot")
        self.assertNotIn("signal", result.stdout + result.stderr)

    def test_folders_that_cannot_be_made(self):
        file = self.folder / "a_file"
        file.write_text("")
        for folder in (file / "out", pathlib.Path("/proc/recoil/out")):
            self.expect(recoil("run", self.case(), "-o", folder, *COARSE), 4, str(folder.parent))

    def test_a_folder_that_may_only_be_read(self):
        closed = self.folder / "closed"
        closed.mkdir()
        if os.geteuid() == 0:  # who may write everywhere
            closed = self.disk("ro")
        else:
            closed.chmod(0o500)
        self.expect(recoil("run", self.case(), "-o", closed / "out", *COARSE), 4, str(closed))
        picture = closed / "start.png"
        self.expect(recoil("check", self.case(), "--png", picture), 4, f"cannot write '{picture}'")

    def test_a_process_on_its_own_needs_no_folder_of_open_mpi(self):
        # Two that start at the same moment would make the same one, and one of them would end.
        command = [PROGRAM, "run", self.case(), "-o", self.folder / "run", *COARSE, "-q", "-j", "1"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "TMPDIR": "/proc"})
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_output_that_cannot_be_written(self):
        for words in (["schema"], ["check", str(FLYER)], ["material", "list"]):
            with self.subTest(words), open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, *words], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(done.returncode, 4, done.stderr)
                self.assertIn("No space left on device", done.stderr)

    def test_errors_that_cannot_be_written_either(self):
        with open("/dev/full", "w") as full:
            for words in (["run", "nowhere.toml"], ["run", str(self.case(('"450 m/s"', '"45 km/s"'))), "-o", str(self.folder / "out")]):
                done = subprocess.run([PROGRAM, *words], stdout=full, stderr=full, check=False)
                self.assertIn(done.returncode, (2, 4), "no signal")

    def test_less_memory_than_the_case_needs(self):
        case = self.case(('finest = "0.05 mm"', 'finest = "0.001 um"'))
        for words in (("check", case), ("run", case, "-o", self.folder / "out")):
            result = recoil(*words, preexec_fn=limited(resource.RLIMIT_AS, 4 << 30))
            self.expect(result, 4, "GB of memory", "finest")
        self.assertFalse((self.folder / "out").exists())

    def test_numbers_of_threads_and_processes(self):
        for words in (("-j", "0"), ("-j", "-3"), ("-n", "0")):
            self.expect(recoil("run", self.case(), "-o", self.folder / "out", *COARSE, *words), 2)
            self.assertFalse((self.folder / "out").exists())
        many = recoil("run", self.case(), "-o", self.folder / "out", *COARSE, "-j", "1000")
        self.expect(many, 0, "finished at 6 us")


if __name__ == "__main__":
    unittest.main()
