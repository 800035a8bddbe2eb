"""Runs the program."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import warnings

from . import errors
from .results import Run

ENDED = {0, 5, 6, 75}  # finished; expectation failed; doubtful; stopped with a checkpoint
FAILED = {1: errors.InternalError, 2: errors.InputError, 3: errors.PhysicsError, 4: errors.EnvironmentError}
_running = set()  # processes of this Python


def program_file():
    """The program: RECOIL_PROGRAM, else `recoil` on the PATH, else what `make` built here. @raises EnvironmentError."""
    named = os.environ.get("RECOIL_PROGRAM")
    if named and not os.access(named, os.X_OK):
        raise errors.EnvironmentError(f"RECOIL_PROGRAM names {named}, which is no program")
    built = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "recoil"
    found = named or shutil.which("recoil") or (str(built) if os.access(built, os.X_OK) else None)
    if not found:
        raise errors.EnvironmentError("there is no program `recoil` on the PATH; RECOIL_PROGRAM may name one")
    return found


def toml_value(value):
    """A value of Python as `--set` takes it: `true`, `0.5`, `["-8 mm", "22 mm"]`; a text as it is."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {_inside(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_inside, value)) + "]"
    number = getattr(value, "item", lambda: value)()  # of numpy
    return str(number).lower() if isinstance(number, bool) else repr(number)


def _inside(value):
    return f'"{value}"' if isinstance(value, str) else toml_value(value)


def default_folder(case):
    """Where the program puts the results of a case: runs/NAME."""
    path = pathlib.Path(case)
    if path.is_dir() or path.name == "case.toml":
        return pathlib.Path("runs") / (path if path.is_dir() else path.absolute().parent).resolve().name
    return pathlib.Path("runs") / path.stem


def _call(words):
    """Runs the program: its exit code, and its standard error. An interrupt of Python stops it with a checkpoint."""
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          start_new_session=True) as process:  # fmt: skip
        _running.add(process)
        try:
            said = process.communicate()[1]
        except KeyboardInterrupt:
            stop_all()
            try:
                process.communicate()
            finally:  # of a second interrupt
                process.kill()
            raise
        finally:
            _running.discard(process)
    return process.returncode, said


def stop_all():
    """Asks all runs of this Python to stop with a checkpoint, in the way that mpirun passes on."""
    for process in list(_running):
        process.send_signal(signal.SIGUSR1)


def _split(said):
    """What the program wrote to the standard error: texts of its warnings, and its errors as one text."""
    messages = [m.strip() for m in re.split(r"^(?=error: |warning: )", said, flags=re.MULTILINE) if m.strip()]
    told = [m.removeprefix("warning: ") for m in messages if m.startswith("warning: ")]
    failed = [m for m in messages if m.startswith("error: ")]
    return told, "\n\n".join(failed) or said.strip()


def _as_arguments(text):
    """Options of the program that a message advises, as arguments of `run`."""
    for option, argument in (("--force replaces", "force=True replaces"), ("-o chooses", "out=... chooses")):
        text = text.replace(option, argument)
    return text


def run(case, out=None, overrides=None, *, ranks=None, threads=None, force=False):
    """Runs a case and opens its results.

    case: a case file, its folder, or the name of a shipped case.
    out: folder of the results; None: runs/NAME. A finished run in it is replaced only with force.
    overrides: values of the case to change, {"body.flyer.velocity.x": "500 m/s", "mesh.finest": "0.1 mm"}.
    ranks, threads: processes under mpirun, threads of each.

    A run whose expectations fail, that is doubtful or was stopped on request is returned like any other: look at
    `verdict`, `expectations`, `state`. @raises InputError, PhysicsError, EnvironmentError, InternalError with what
    the program says, its `exit_code`, and the `folder`.
    """
    folder = pathlib.Path(out) if out is not None else default_folder(case)
    words = [program_file(), "run", str(case), "-o", str(folder), "--plain"]
    for key, value in (overrides or {}).items():
        words += ["--set", f"{key}={toml_value(value)}"]
    words += ["-n", str(ranks)] if ranks is not None else []
    words += ["-j", str(threads)] if threads is not None else []
    words += ["--force"] if force else []
    code, said = _call(words)
    told, error = _split(said)
    if code in ENDED:
        for text in told:
            warnings.warn(text, errors.RecoilWarning, stacklevel=2)
        return Run(folder)
    if code < 0:
        raise errors.EnvironmentError(f"signal {signal.Signals(-code).name} ended the program. {error}", folder)
    failed = FAILED.get(code, errors.InternalError)(_as_arguments(error), folder)
    failed.exit_code = code
    raise failed
