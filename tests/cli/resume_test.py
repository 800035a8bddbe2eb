#!/usr/bin/python3
"""Runs that are stopped or killed, and go on: `recoil resume` must end with the bits of the run that was not.

Needs RECOIL_PROGRAM, the program, and RECOIL_DATA, the folder that holds cases/ and materials/. RECOIL_KILLS is the
number of random moments at which runs are killed (5; the nightly tests take 50).
"""

import importlib.machinery
import importlib.util
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["RECOIL_PROGRAM"]
KILLS = int(os.environ.get("RECOIL_KILLS", "5"))
TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"

loader = importlib.machinery.SourceFileLoader("fingerprint", str(TOOLS / "fingerprint"))
fingerprint = importlib.util.module_from_spec(importlib.util.spec_from_loader("fingerprint", loader))
loader.exec_module(fingerprint)

# A block falls askew on another one and is thrown back: contact, opening, lift-off, gauges of all kinds.
CASE = """
format = 1
title = "two blocks"
[domain]
geometry = "planar"
x = ["0 mm", "24 mm"]
y = ["0 mm", "24 mm"]
[mesh]
finest = "0.4 mm"
block = 12
[time]
end = "6 us"
[body.falling]
material = "copper/ofhc-johnson-cook"
shape = { kind = "box", x = ["6 mm", "14 mm"], y = ["11 mm", "17 mm"], rotation = "8 deg" }
velocity = { x = "60 m/s", y = "-350 m/s" }
[body.lying]
material = "aluminium/6061-t6"
shape = { kind = "box", x = ["3 mm", "21 mm"], y = ["3 mm", "9.6 mm"] }
[body.ram]
rigid = true
mass = "0.1 kg/m"
shape = { kind = "disc", radius = "2 mm", centre = { x = "12 mm", y = "21 mm" } }
velocity = { y = "-900 m/s" }
[gauge.rear]
kind = "surface-velocity"
body = "lying"
at = { x = "12 mm", y = "3 mm" }
[gauge.touch]
kind = "contact"
pair = "falling-lying"
at = { x = "11 mm", y = "9 mm" }
radius = "4 mm"
[gauge.whole]
kind = "body"
body = "falling"
every = "0.1 us"
[gauge.line]
kind = "peak-stress"
body = "lying"
at = { x = "12 mm", y = "9 mm" }
to = { x = "12 mm", y = "4 mm" }
stations = 12
[output.fields]
every = "2 us"
[output.checkpoint]
every = "0.25 us"
keep = 3
"""


def recoil(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=500, check=False)


def bits(run):
    """Hashes of all that a run has recorded: gauges, history, events, last fields; and its cell-steps."""
    steps = json.loads((run / "summary.json").read_text())["cell_steps"]
    return fingerprint.of_run(run) | {"events": (run / "events.csv").read_bytes(), "cell_steps": steps}


class Resume(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.case = cls.folder / "blocks.toml"
        cls.case.write_text(CASE)
        began = time.time()
        done = recoil("run", cls.case, "-o", cls.folder / "whole", "--plain", "-j", "1")
        cls.duration = time.time() - began
        assert done.returncode in (0, 6), done.stdout + done.stderr
        cls.exit = done.returncode
        cls.bits = bits(cls.folder / "whole")

    def expect(self, result, code, *texts):
        said = result.stdout + result.stderr
        self.assertEqual(result.returncode, code, said)
        for text in texts:
            self.assertIn(text, said)

    def same(self, run):
        now = bits(run)
        self.assertEqual(sorted(now), sorted(self.bits))
        for name, value in self.bits.items():
            self.assertEqual(now[name], value, f"{name} of {run.name}")

    def finish(self, run, *words):
        result = recoil("resume", run, "--plain", *words)
        if result.returncode == 2 and "holds no " in result.stderr:  # killed before the first one
            result = recoil("run", self.case, "-o", run, "--plain", "--force", *words)
        self.expect(result, self.exit)

    def wait_for_step(self, run, step):
        """Until a checkpoint of that step (of 161) or a later one is there: the run is under way, its end far off."""
        deadline = time.time() + 100
        while time.time() < deadline:
            if any(int(file.stem) >= step for file in (run / "checkpoints").glob("[0-9]*.h5")):
                return
            time.sleep(0.005)
        self.fail(f"no checkpoint of step {step} in {run}")

    def wait_for_the_end(self, run):
        for _ in range(100):  # the processes of an mpirun that was killed follow it a little later
            said = recoil("status", run).stdout if run.exists() else ""
            if "running" not in said and "starting" not in said:
                break
            time.sleep(0.2)

    def kill_and_go_on(self, name, words, moment):
        run = self.folder / name
        process = subprocess.Popen([PROGRAM, "run", str(self.case), "-o", str(run), "--plain", *words],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        time.sleep(moment)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        self.wait_for_the_end(run)
        if not (run / "summary.json").exists():
            self.finish(run, *words)
        self.same(run)

    def test_killed_at_random_moments(self):
        chance = random.Random(20261122)
        for k in range(KILLS):
            self.kill_and_go_on(f"killed_{k}", ["-j", "1"], chance.uniform(0.05, 1) * self.duration)

    def test_killed_with_two_processes(self):
        chance = random.Random(7)
        for k in range(max(1, KILLS // 3)):
            self.kill_and_go_on(f"ranks_{k}", ["-n", "2", "-j", "1"], chance.uniform(0.4, 1.2) * self.duration)

    def kill_while_it_writes(self, name, *words):
        """A run killed as soon as it has begun to write a checkpoint, then finished."""
        run = self.folder / name
        self.expect(recoil("run", self.case, "-o", run, "--plain", "--wall", "0.3s", *words), 75)
        process = subprocess.Popen([PROGRAM, "resume", str(run), "--plain", *words],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        while process.poll() is None and not list((run / "checkpoints").glob(".*.tmp")):
            pass
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        self.wait_for_the_end(run)
        self.finish(run, *words)
        self.assertEqual(list((run / "checkpoints").glob(".*.tmp")), [])
        self.same(run)

    def test_killed_between_two_writes_of_one_checkpoint(self):
        self.kill_while_it_writes("cut", "-j", "1")
        self.kill_while_it_writes("cut_ranks", "-n", "2", "-j", "1")

    def test_other_ranks_and_threads_go_on_to_the_same_bits(self):
        run = self.folder / "other"
        self.expect(recoil("run", self.case, "-o", run, "--plain", "-n", "2", "--wall", "0.3s"), 75, "recoil resume")
        self.expect(recoil("status", run), 0, "stopped")
        self.finish(run, "-j", "2")
        self.same(run)

    def test_asked_to_stop(self):
        for request in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGHUP):
            run = self.folder / request.name
            process = subprocess.Popen([PROGRAM, "run", str(self.case), "-o", str(run), "--plain", "-j", "1"],
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.wait_for_step(run, 50)
            process.send_signal(request)
            said = process.communicate()[0]
            self.assertEqual(process.returncode, 75, said)
            self.assertIn("stopped at", said)
            self.expect(recoil("run", self.case, "-o", run), 2, "interrupted run", "recoil resume")
            self.finish(run)
            self.same(run)

    def test_asked_to_stop_before_the_first_step(self):
        """From the moment that it reads its case."""
        for n, request in enumerate((signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGHUP)):
            run = self.folder / f"early_{n}"
            process = subprocess.Popen([PROGRAM, "run", str(self.case), "-o", str(run), "--plain", "-j", "1"],
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            while not (run / "case.resolved.toml").exists() and process.poll() is None:
                time.sleep(0.001)
            process.send_signal(request)
            said = process.communicate()[0]
            self.assertEqual(process.returncode, 75, said)
            self.assertIn("stopped at", said)
            self.finish(run)
            self.same(run)

    def test_asked_to_stop_with_two_processes(self):
        """By a signal to the launcher alone, or as Ctrl-C at a terminal sends it, to its process group; at any moment."""
        ways = (
            (signal.SIGINT, os.kill, None),
            (signal.SIGINT, os.killpg, 70),
            (signal.SIGTERM, os.kill, 1),
            (signal.SIGTERM, os.killpg, 35),
        )
        for n, (request, send, step) in enumerate(ways):
            run = self.folder / f"two_{n}"
            process = subprocess.Popen([PROGRAM, "run", str(self.case), "-o", str(run), "--plain", "-n", "2", "-j", "1"],
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
            if step is None:
                time.sleep(0.1 * self.duration)  # as its processes start
            else:
                self.wait_for_step(run, step)
            send(process.pid, request)
            said = process.communicate()[0]
            self.assertEqual(process.returncode, 75, said)
            self.assertIn(f"`recoil resume {run}` goes on", said)
            self.assertTrue(list((run / "checkpoints").glob("*.h5")))
            self.finish(run, "-j", "2")
            self.same(run)

    def test_a_second_interrupt_ends_all_processes(self):
        run = self.folder / "twice"
        process = subprocess.Popen([PROGRAM, "run", str(self.case), "-o", str(run), "--plain", "-n", "2", "-j", "1"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        while not (run / "status.json").exists():
            time.sleep(0.01)
        status = pathlib.Path(f"/proc/{process.pid}/status")
        catches = lambda: int(status.read_text().split("SigCgt:")[1].split()[0], 16) >> (signal.SIGINT - 1) & 1
        self.assertTrue(catches())
        process.send_signal(signal.SIGINT)
        while catches():  # until it has taken note of the first
            pass
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), -signal.SIGINT)
        self.wait_for_the_end(run)
        self.finish(run)
        self.same(run)

    def test_a_pipe_without_a_reader_and_nohup(self):
        run = self.folder / "pipe"
        with subprocess.Popen([PROGRAM, "run", str(self.case), "-o", str(run), "-j", "1"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True) as process:
            self.assertIn("two blocks", process.stdout.readline())
            process.stdout.close()
        self.assertEqual(process.returncode, self.exit)
        self.same(run)
        self.assertIn("verdict", (run / "run.log").read_text())
        run = self.folder / "nohup"
        with subprocess.Popen(["nohup", PROGRAM, "run", str(self.case), "-o", str(run), "--plain", "-j", "1"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            self.wait_for_step(run, 50)
            process.send_signal(signal.SIGHUP)
        self.assertEqual(process.returncode, self.exit)
        self.same(run)

    def test_a_longer_run_and_what_may_not_change(self):
        run = self.folder / "longer"
        self.expect(recoil("run", self.case, "-o", run, "--plain", "--end", "1us", "-j", "1"), 0)
        text = (run / "case.toml").read_text()
        (run / "case.toml").write_text(text.replace('finest = "0.4 mm"', 'finest = "0.8 mm"'))
        self.expect(recoil("resume", run, "--to", "2us"), 2, "mesh.finest")
        (run / "case.toml").write_text(text)
        self.expect(recoil("resume", run, "--to", "2us", "--set", "body.falling.velocity.y=-300m/s"), 2,
                    "body.falling.velocity")
        self.expect(recoil("resume", run, "--to", "2us", "--set", "output.fields.every=1us"), 0, "goes on from")

    def test_damaged_checkpoints(self):
        run = self.folder / "damaged"
        self.expect(recoil("run", self.case, "-o", run, "--plain", "--end", "1.5us", "-j", "1"), 0)
        files = sorted((run / "checkpoints").glob("*.h5"))
        self.assertEqual(len(files), 3)
        newest = files[-1].read_bytes()
        for damage, text in ((newest[: len(newest) // 2], "cut off"), (b"", "cannot be used"),
                             (newest[:-4000] + b"x" * 500 + newest[-3500:], "cannot be used")):
            files[-1].write_bytes(damage)
            self.expect(recoil("resume", run, "--to", "2us"), 2, text, "--from")
        self.expect(recoil("resume", run, "--to", "2us", "--from", files[-2].name), 0)
        self.expect(recoil("resume", self.folder / "nowhere"), 2, "no folder")
        self.expect(recoil("resume", run, "--to", "1us"), 2, "the run would end at 1 us", "--to a later")

    def test_tables_that_lack_rows(self):
        """A series that ends before the checkpoint would go on with a hole."""
        run = self.folder / "short_tables"
        self.expect(recoil("run", self.case, "-o", run, "--plain", "--wall", "0.3s"), 75)
        for name in ("history.csv", "fragments.csv"):
            whole = (run / name).read_bytes()
            (run / name).write_bytes(whole[: whole.index(b"\n") + 200])
            self.expect(recoil("resume", run, "--plain"), 2, name, "rows are lost", "put the whole file back")
            (run / name).unlink()
            self.expect(recoil("resume", run, "--plain"), 2, name)
            (run / name).write_bytes(whole)
        self.finish(run)
        self.same(run)

    def test_a_folder_belongs_to_one_run(self):
        run = self.folder / "locked"
        first = subprocess.Popen([PROGRAM, "run", str(self.case), "-o", str(run), "--plain", "-j", "1"],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_for_step(run, 30)
        self.expect(recoil("run", self.case, "-o", run, "--force"), 2, "another run", "recoil status")
        self.expect(recoil("status", run), 0, "running")
        first.kill()
        first.wait()
        said = recoil("status", run)
        self.expect(said, 0, "interrupted (killed, or ended by an error", "recoil resume")
        # It knows within a tenth of the time how far the run was, and the checkpoint by its name and time.
        reached = re.search(r"beyond ([0-9.e+-]+) of 6 us, step (\d+)", said.stdout)
        self.assertGreater(int(reached[2]), 0, said.stdout)
        saved = sorted((run / "checkpoints").glob("*.h5"))[-1]
        at = float(re.search(saved.name + " at ([0-9.e+-]+) us", said.stdout)[1])
        self.assertGreater(at, 0.2)
        self.assertGreater(float(reached[1]), 0.7 * at)

    def test_status_of_a_run_without_a_checkpoint(self):
        run = self.folder / "no_checkpoint"
        case = self.folder / "no_checkpoint.toml"
        case.write_text(CASE.split("[output.checkpoint]", maxsplit=1)[0])
        words = [PROGRAM, "run", str(case), "-o", str(run), "--plain", "-j", "1", "--end", "1000us"]
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            for _ in range(1500):  # until it is known to have come further than its start, for 30 s at most
                time.sleep(0.02)
                if (run / "status.json").exists() and ", step 0" not in recoil("status", run).stdout:
                    break
            process.kill()
        self.expect(recoil("status", run), 0, "interrupted (killed, or ended by an error", "left no checkpoint")
        (run / "status.json").unlink()
        self.expect(recoil("status", run), 0, "interrupted before its first step")


if __name__ == "__main__":
    unittest.main()
