"""Tables that Recoil writes and reads: CSV with names and units in one header line."""

import csv
import io
import pathlib
import re
from collections.abc import Mapping

from .errors import InputError, needed, unknown

HEADER = re.compile(r"(.*?)\s*\[([^\]]*)\]\s*$")


def split_name(heading):
    """`time [us]` -> ('time', 'us'); the unit is '' where there is none."""
    found = HEADER.match(heading)
    return (found[1], found[2]) if found else (heading.strip(), "")


def _lines(path):
    """The lines of a table without comments; not a last one that a running program has not written to its end."""
    try:
        text = pathlib.Path(path).read_text()
    except OSError as error:
        raise InputError(f"cannot read the table {path}: {error.strerror}") from error
    whole = text[: text.rfind("\n") + 1] or text
    lines = [line for line in whole.splitlines() if line.strip() and not line.startswith("#")]
    if not lines:
        raise InputError(f"{path} has no header line")
    return lines


def read_table(path):
    """A CSV file as a pandas DataFrame; `attrs["units"]` has the unit of each column, the index included.

    A table of numbers runs over its first column (time, distance), which becomes the index. Columns have their names
    without units. What could not be measured is NaN. @raises InputError, MissingDependency.
    """
    pandas = needed("pandas", "a table")
    lines = _lines(path)
    headings = next(csv.reader(lines[:1]))
    names, units = zip(*map(split_name, headings))
    try:
        frame = pandas.read_csv(
            io.StringIO("\n".join(lines[1:])),
            names=list(names),
            index_col=False,
            keep_default_na=False,
            na_values=["nan", "-nan"],
            float_precision="round_trip",
        )
    except ValueError as error:
        raise InputError(f"{path} is not a table of numbers below one line of names: {str(error).strip()}") from error
    if len(names) > 1 and all(pandas.api.types.is_numeric_dtype(kind) for kind in frame.dtypes):
        frame = frame.set_index(names[0])
    frame.attrs["units"] = dict(zip(names, units))
    return frame


def series(frame, column):
    """A column as a pandas Series over the index, with `attrs["unit"]`. @raises UnknownName.

    The part of a name before a dot will do where only one column has it: `velocity` for `velocity.x`.
    """
    parts = [name for name in frame.columns if name.startswith(column + ".")]
    if column not in frame.columns and len(parts) == 1:
        column = parts[0]
    if column not in frame.columns:
        raise unknown("column", column, frame.columns)
    picked = frame[column]
    picked.attrs = {"unit": frame.attrs["units"][column], "units": frame.attrs["units"]}
    return picked


class Tables(Mapping):
    """Tables of a folder by name, each read when it is asked for the first time: the gauges of a run."""

    def __init__(self, what, paths):
        self._what = what
        self._paths = paths
        self._read = {}

    def __getitem__(self, name):
        if name not in self._paths:
            raise unknown(self._what, name, self._paths)
        if name not in self._read:
            self._read[name] = read_table(self._paths[name])
        return self._read[name]

    def __iter__(self):
        return iter(self._paths)

    def __len__(self):
        return len(self._paths)

    def __repr__(self):
        return f"<{self._what}s: {', '.join(self._paths) or 'none'}>"
