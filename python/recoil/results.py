"""A run: the folder that `recoil run` leaves, read piece by piece as it is asked for."""

import fcntl
import json
import math
import pathlib
import tomllib
from functools import cached_property

from . import quantities
from .errors import InputError, UnfinishedRun, needed
from .fields import FieldSeries
from .tables import Tables, read_table, series
from .units import convert

AXES = {"1d": ("x",), "spherical": ("r",), "planar": ("x", "y"), "axisymmetric": ("r", "z"), "3d": ("x", "y", "z")}


class Run:
    """A run, finished or not. Nothing is read before it is asked for; what was read stays.

    What a run that has not ended cannot know (summary, verdict, ...) raises UnfinishedRun.
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise InputError(f"there is no folder {self.folder}", self.folder)
        if not (self.folder / "case.resolved.toml").is_file():
            raise InputError(f"{self.folder} is not the folder of a run: it has no case.resolved.toml", self.folder)
        self.gauges = Tables("gauge", {p.stem: p for p in sorted(self.folder.glob("gauges/*.csv"))})
        self.fields = FieldSeries(self.folder / "fields", lambda: self.axes, lambda: self.bodies)

    def __repr__(self):
        word = self.verdict if self.finished else self.state
        return f"<run {self.title!r}, {word}, {self.folder}>"

    # What was computed.

    @cached_property
    def case(self):
        """The case with every default, values in SI, materials included: a dict like the TOML file."""
        return tomllib.loads((self.folder / "case.resolved.toml").read_text())

    @property
    def title(self):
        return self.case.get("title", "")

    @property
    def geometry(self):
        """'1d', 'spherical', 'planar', 'axisymmetric' or '3d'."""
        return self.case["domain"]["geometry"]

    @property
    def axes(self):
        """Names of the axes: ("x",), ("x", "y"), ("r", "z") or ("x", "y", "z")."""
        return AXES[self.geometry]

    @property
    def bodies(self):
        """Names of the bodies; the field `body` counts them from 0."""
        return list(self.case["body"])

    @property
    def materials(self):
        """Materials of the case by name, values in SI: a dict like the TOML file."""
        return self.case.get("material", {})

    # How it went.

    @property
    def status(self):
        """status.json: `state`, `time_us`, `end_us`, `step`, `dt_ns`, `wall_s`, ...; {} before it is there."""
        file = self.folder / "status.json"
        return json.loads(file.read_text()) if file.is_file() else {}

    @property
    def state(self):
        """'running', 'interrupted' (killed), 'stopped' (can go on), 'failed' or 'finished'."""
        state = self.status.get("state", "running")
        return "interrupted" if state == "running" and not self._is_locked() else state

    def _is_locked(self):
        """Whether a program is writing to the folder."""
        try:
            with open(self.folder / ".lock", "rb") as file:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            return False
        return False

    @property
    def finished(self):
        """Whether the run has come to an end, be it that of a failure: then it has a summary."""
        return (self.folder / "summary.json").is_file()

    @cached_property
    def summary(self):
        """summary.json: a dict. @raises UnfinishedRun."""
        if self.finished:
            return json.loads((self.folder / "summary.json").read_text())
        status, state = self.status, self.state
        where = f" at {status['time_us']:.6g} of {status['end_us']:.6g} us" if status else ""
        cure = "wait for its end" if state == "running" else f"`recoil resume {self.folder}` goes on from a checkpoint"
        raise UnfinishedRun(f"the run {self.folder} is {state}{where} and has no summary yet; {cure}", self.folder)

    @property
    def verdict(self):
        """'valid', 'doubtful' or 'stopped'."""
        return self.summary["verdict"]

    @property
    def reasons(self):
        """Why the verdict is not `valid`: sentences."""
        return [reason["text"] for reason in self.summary["reasons"]]

    @property
    def exit_code(self):
        return self.summary["exit"]

    @property
    def log(self):
        """What the program said: the text of run.log."""
        return (self.folder / "run.log").read_text()

    # What it measured.

    @cached_property
    def history(self):
        """history.csv: DataFrame over the time [us], columns NAME.QUANTITY."""
        return read_table(self.folder / "history.csv")

    @cached_property
    def events(self):
        """events.csv: DataFrame with `time` [us], `event`, `bodies`, `place.AXIS` [mm] for each axis, and `detail`."""
        frame = read_table(self.folder / "events.csv")
        if "place" not in frame:
            return frame
        # Runs of older versions have all coordinates in one column.
        places = [str(place).split() for place in frame["place"]]
        at, units = frame.columns.get_loc("place"), frame.attrs["units"]
        frame = frame.drop(columns="place")
        for k, axis in enumerate(self.axes):
            values = [float(place[k]) if k < len(place) else math.nan for place in places]
            frame.insert(at + k, f"place.{axis}", values)
            units[f"place.{axis}"] = units["place"]
        frame.attrs["units"] = {column: units[column] for column in frame.columns}
        return frame

    @cached_property
    def fragments(self):
        """fragments.csv: DataFrame with a row for each fragment at each time of a dump, the `time` [us] a column."""
        return read_table(self.folder / "fragments.csv")

    @cached_property
    def contacts(self):
        """DataFrame of the pairs that have touched: times [us] of what happened first, `lasts` [us]; NaN: it did not.

        Columns: `made`, `opens`, `separates`, `recloses`, `first-lift-off`, `last-lift-off`, `lasts`.
        """
        pandas = needed("pandas", "a table")
        frame = pandas.DataFrame.from_dict(quantities.contacts(self), orient="index", columns=quantities.CONTACT)
        frame.index.name = "pair"
        frame.attrs["units"] = dict.fromkeys(frame.columns, "us")
        return frame

    @property
    def budgets(self):
        """DataFrame of the largest relative drifts of `mass`, `momentum`, `energy`, by body and `total`."""
        return needed("pandas", "a table").DataFrame(self.summary["budgets"]).T.astype(float)

    @property
    def floors(self):
        """Series: how often anything was limited or clipped, by name."""
        return needed("pandas", "a table").Series(self.summary["floors"], dtype="int64", name="floors")

    @property
    def expectations(self):
        """DataFrame of [expect], by quantity: `value`, `reference`, `tolerance`, `unit`, `pass` and so on."""
        return needed("pandas", "a table").DataFrame.from_dict(self.summary["expect"], orient="index")

    @cached_property
    def references(self):
        """Curves that the run was compared with, by name of file: DataFrames."""
        own = {"history.csv", "events.csv", "fragments.csv", "quantities.csv"}
        return Tables("reference", {p.name: p for p in sorted(self.folder.glob("*.csv")) if p.name not in own})

    def series(self, name):
        """A column as `recoil plot` names it, `gauge.rear.velocity` or `history.flyer.kinetic`.

        A pandas Series over the time [us], or the distance [mm], with `attrs["unit"]`. A gauge without a column means
        its main one, the first. @raises UnknownName.
        """
        kind, _, rest = name.partition(".")
        if kind == "history":
            return series(self.history, rest)
        if kind != "gauge":
            raise InputError(f"{name!r} is no series: gauge.NAME.COLUMN or history.NAME.QUANTITY")
        gauge, _, column = rest.partition(".")
        frame = self.gauges[gauge]
        return series(frame, column or frame.columns[0])

    def value(self, quantity, unit=None):
        """A number, or True or False, as [expect] names it: `gauge.rear.velocity.peak`, `contact.flyer-target.opens`.

        unit: in which to give it; without one that of its column, us for times. @raises UnknownName, InputError.
        """
        value, own = quantities.measure(self, quantity)
        if unit is None or isinstance(value, bool):
            return value
        return value if math.isnan(value) else convert(f"{value!r} {own}", unit)

    # Fields.

    @property
    def times(self):
        """Times of the dumps of fields, (dumps,), us."""
        return self.fields.times

    def at(self, time):
        """The fields nearest to a time: `run.at("3 us")`, or a number in us."""
        return self.fields(time)


def open_run(folder):
    """Opens the folder of a run, finished or not. @raises InputError where it is none."""
    return Run(folder)
