"""What can go wrong. The first four have the names and the exit codes of the program's own errors."""

import difflib
import importlib


class RecoilError(Exception):
    """Any error of this package.

    exit_code: of the program; None where no program ran.
    folder: of the run, a path; None where there is none.
    """

    exit_code = None

    def __init__(self, message, folder=None):
        super().__init__(message)
        self.folder = folder

    def __str__(self):  # KeyError would show the message in quotes
        return self.args[0]


class InputError(RecoilError, ValueError):
    """The case, an option or a folder is wrong; the message says where, and what to do."""

    exit_code = 2


class PhysicsError(RecoilError):
    """The state left the range in which the equations hold, or passed a limit that stops; folder has what is known."""

    exit_code = 3


class EnvironmentError(RecoilError):
    """Disk, memory, MPI, or no program."""

    exit_code = 4


class InternalError(RecoilError):
    """A bug of Recoil."""

    exit_code = 1


class UnfinishedRun(RecoilError):
    """What was asked for exists at the end of a run only."""


class UnknownName(RecoilError, KeyError):
    """No gauge, column, field or quantity of this name; the message has the names that exist."""


class MissingDependency(RecoilError, ImportError):
    """A package that is not needed for everything is not installed."""


class RecoilWarning(UserWarning):
    """What the program warned of when it read a case."""


def unknown(what, name, known):
    """The error for a name that is not among the known ones."""
    known = [str(k) for k in known]
    near = difflib.get_close_matches(str(name), known, 1)
    guess = f"did you mean {near[0]!r}? " if near else ""
    return UnknownName(f"there is no {what} {name!r}; {guess}there are: {', '.join(known) or 'none'}")


def needed(module, purpose):
    """Imports a module late, as most of what a script does needs none. @raises MissingDependency."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise MissingDependency(
            f"{purpose} needs {module}: apt-get install python3-{module}, or pip install {module}"
        ) from error
