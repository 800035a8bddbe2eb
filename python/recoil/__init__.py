"""Reads runs of the hydrocode Recoil, and starts them.

    import recoil
    run = recoil.open("runs/flyer")               # reads nothing yet
    run.verdict                                   # 'valid', 'doubtful' or 'stopped'
    run.gauges["rear"]["velocity"].plot()         # pandas, over the time in us
    run.at("3 us")["pressure"]                    # numpy, GPa, one value for each cell
    run = recoil.run("flyer.toml", overrides={"body.flyer.velocity.x": "500 m/s"})

Units are those of the files: time in us, lengths in mm, velocities in m/s, stresses in GPa; each table and each
field tells its own. A number without a unit that stands for a time is in us.
"""

from .errors import (
    EnvironmentError,
    InputError,
    InternalError,
    MissingDependency,
    PhysicsError,
    RecoilError,
    RecoilWarning,
    UnfinishedRun,
    UnknownName,
)
from .fields import Fields, Grid, RigidBody
from .launch import program_file, run
from .material import Material
from .results import Run, open_run
from .sweeps import sweep
from .tables import read_table
from .version import version as _version

open = open_run
__version__ = _version()
# Not `open` and `EnvironmentError`: `from recoil import *` leaves those of Python alone.
__all__ = [
    "Fields",
    "Grid",
    "InputError",
    "InternalError",
    "Material",
    "MissingDependency",
    "PhysicsError",
    "RecoilError",
    "RecoilWarning",
    "RigidBody",
    "Run",
    "UnfinishedRun",
    "UnknownName",
    "open_run",
    "program_file",
    "read_table",
    "run",
    "sweep",
]
