"""Many runs of one case."""

import itertools
import pathlib
from concurrent.futures import ThreadPoolExecutor

from . import launch, quantities
from .errors import InputError, PhysicsError, needed
from .results import Run
from .units import split


def _numbers(values):
    """Values of a key and their unit: numbers where all are texts with one unit, else as they are."""
    try:
        numbers, units = zip(*(split(value) for value in values))
    except (TypeError, InputError):
        return list(values), ""
    return (list(numbers), units[0]) if len(set(units)) == 1 else (list(values), "")


def _named(wanted):
    """Column -> quantity, or function of a run."""
    return dict(wanted) if isinstance(wanted, dict) else {name: name for name in wanted}


def _one(case, folder, overrides, options):
    """One run, also one that the equations have stopped."""
    try:
        return launch.run(case, folder, overrides, **options)
    except PhysicsError as error:
        return Run(error.folder)


def sweep(case, values, measured, out=None, overrides=None, *, processes=1, threads=1, ranks=None, force=False):
    """Runs a case with all combinations of some values, and measures each run: a pandas DataFrame, a row for each run.

    values: {"body.flyer.velocity.x": ["300 m/s", "450 m/s"], ...}; keys as for overrides.
    measured: names of quantities as in [expect], ["gauge.rear.velocity.peak"], or {column: name or function of a run}.
    out: folder of the runs; None: runs/NAME-sweep. overrides: as in recoil.run, the same for all.
    processes: how many runs at a time; threads, ranks: of each.

    Columns: the keys (numbers, where all their values have one unit), the quantities, `verdict`, `folder`;
    `attrs["units"]` has units. A run that the equations stop has the verdict `stopped`; any other failure ends the
    sweep. @raises as recoil.run.
    """
    pandas = needed("pandas", "recoil.sweep")
    folder = pathlib.Path(out) if out is not None else launch.default_folder(case).with_name(
        launch.default_folder(case).name + "-sweep")  # fmt: skip
    points = list(itertools.product(*values.values()))
    options = {"threads": threads, "ranks": ranks, "force": force}
    with ThreadPoolExecutor(processes) as pool:
        jobs = [
            pool.submit(_one, case, folder / f"{n:03}", {**(overrides or {}), **dict(zip(values, point))}, options)
            for n, point in enumerate(points)
        ]
        try:
            runs = [job.result() for job in jobs]
        except BaseException as error:
            pool.shutdown(wait=False, cancel_futures=True)
            if isinstance(error, KeyboardInterrupt):
                launch.stop_all()
            raise
    columns, units = {}, {}
    for key, its in zip(values, zip(*points)):
        columns[key], units[key] = _numbers(its)
    for column, what in _named(measured).items():
        found = [(what(r), "") if callable(what) else quantities.measure(r, what) for r in runs]
        columns[column], units[column] = [value for value, _ in found], next((unit for _, unit in found), "")
    frame = pandas.DataFrame({**columns, "verdict": [r.verdict for r in runs], "folder": [str(r.folder) for r in runs]})
    frame.attrs["units"] = units
    return frame
