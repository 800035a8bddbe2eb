"""Dumps of fields: the only module that knows how their files are laid out.

A file is a VTKHDF UnstructuredGrid of boxes (docs/reference/results.md), which may have several sizes.
"""

import dataclasses
import itertools
import json
import pathlib
from collections.abc import Sequence
from functools import cached_property

import numpy

from .errors import InputError, UnfinishedRun, needed, unknown
from .units import convert

UNITS = {"_kg_per_m3": "kg/m3", "_m_per_s": "m/s", "_GPa": "GPa", "_mm": "mm", "_K": "K"}
SHAPES = {3: 1, 9: 2, 12: 3}  # VTK's line, quadrilateral, hexahedron: dimensions
# Parts of a stress in the order of the file, by axes; what lies beyond is zero.
STRESSES = {
    ("x",): ("xx", "yy", "zz"),
    ("x", "y"): ("xx", "yy", "zz", "xy"),
    ("r", "z"): ("rr", "zz", "tt", "rz"),
    ("x", "y", "z"): ("xx", "yy", "zz", "xy", "yz", "xz"),
}
OUTSIDE = {"body": -1, "contact": 0}  # of whole numbers, in places without a cell
DIGITS = 9  # of mm, in coordinates of a grid
LATE = 1e-3  # part of the last time by which a time may lie beyond it


def split_array(array):
    """`pressure_GPa` -> ('pressure', 'GPa', 1): name and unit in Python, and what the numbers are multiplied with."""
    if array.startswith("level_set_"):
        return array.removesuffix("_m"), "mm", 1e3
    for suffix, unit in UNITS.items():
        if array.endswith(suffix):
            return array.removesuffix(suffix), unit, 1
    return array, "1", 1


@dataclasses.dataclass(frozen=True)
class RigidBody:
    """Where a rigid body is at one time, and how it moves. A point of it that was at X is now at `now(X)`."""

    start: numpy.ndarray  # the point that it turns about, at the start, (dimensions,), mm
    centre: numpy.ndarray  # that point now, (dimensions,), mm
    rotation: numpy.ndarray  # since the start, (3, 3): columns are where the axes of the start point now
    velocity: numpy.ndarray  # of the centre, (dimensions,), m/s
    spin: numpy.ndarray  # (3,), rad/s; in the plane the third

    def now(self, points):
        """Where points of the start [mm], (..., dimensions), are now."""
        many = len(self.start)
        return self.centre + (numpy.asarray(points) - self.start) @ self.rotation[:many, :many].T


class Fields:
    """The fields of a run at one time, for each cell that holds matter or lies beside a surface.

    fields["pressure"]: an array of shape (cells,); a vector or a stress (cells, parts); `fields["velocity.x"]` is one
    part. NaN where a cell has too little matter. Names may have hyphens as on the command line: `plastic-strain`.
    """

    def __init__(self, path, time, axes, bodies=()):
        self.path = pathlib.Path(path)
        self.time = time  # us
        self.axes = tuple(axes)  # ("x",), ("x", "y"), ("r", "z") or ("x", "y", "z")
        self.bodies = tuple(bodies)  # names, in the order of the case
        self._arrays = {}

    def __repr__(self):
        return f"<fields at {self.time:.6g} us: {', '.join(self.names)}>"

    def _file(self):
        h5py = needed("h5py", "a dump of fields")
        if not self.path.is_file():
            raise InputError(f"the dump {self.path} is not there")
        file = h5py.File(self.path)
        kind = file["VTKHDF"].attrs["Type"]
        if kind != b"UnstructuredGrid":
            file.close()
            raise InputError(f"{self.path} is a VTKHDF {kind.decode()}; this package reads UnstructuredGrid")
        return file

    @cached_property
    def _known(self):
        """Name -> array in the file, unit, factor."""
        with self._file() as file:
            split = {array: split_array(array) for array in file["VTKHDF/CellData"]}
        return {name: (array, unit, factor) for array, (name, unit, factor) in split.items()}

    @property
    def names(self):
        """Names of the fields."""
        return list(self._known)

    @cached_property
    def units(self):
        """Unit of each field, by name; '1' for a number."""
        return {name: unit for name, (_, unit, _) in self._known.items()}

    def parts(self, name):
        """Names of the parts of a vector or a stress, in the order of the last axis of its array; else empty."""
        return {"velocity": self.axes, "stress": STRESSES[self.axes]}.get(name, ())

    def __contains__(self, name):
        return self._split(name)[0] in self._known

    def __getitem__(self, name):
        whole, part = self._split(name)
        if whole not in self._known or (part and part not in self.parts(whole)):
            parts = [f"{n}.{p}" for n in self.names for p in self.parts(n)]
            raise unknown("field", name, self.names + parts)
        if whole not in self._arrays:
            array, _, factor = self._known[whole]
            with self._file() as file:
                values = file["VTKHDF/CellData"][array][...]
            values = values[:, : len(self.parts(whole))] if self.parts(whole) else values
            self._arrays[whole] = values if factor == 1 else values * numpy.asarray(factor, values.dtype)
        values = self._arrays[whole]
        return values[:, self.parts(whole).index(part)] if part else values

    @staticmethod
    def _split(name):
        """Name and part; hyphens of the command line are underscores, but for names of bodies, which have none."""
        whole, _, part = str(name).partition(".")
        return whole.replace("-", "_"), part

    @cached_property
    def rigid(self):
        """Where the rigid bodies are, prescribed and free: {name: RigidBody}; empty in runs of older versions."""
        with self._file() as file:
            arrays = {name: data[...] for name, data in file["VTKHDF/FieldData"].items() if name.startswith("rigid_")}
        many = len(self.axes)
        return {
            self.bodies[number] if number < len(self.bodies) else str(number): RigidBody(
                start=arrays["rigid_start_centre_m"][row, :many] * 1e3,
                centre=arrays["rigid_centre_m"][row, :many] * 1e3,
                rotation=arrays["rigid_rotation"][row].reshape(3, 3),
                velocity=arrays["rigid_velocity_m_per_s"][row, :many],
                spin=arrays["rigid_spin_rad_per_s"][row],
            )
            for row, number in enumerate(arrays.get("rigid_body", ()))
        }

    @cached_property
    def _boxes(self):
        """Lower corners and sizes of the cells, (cells, dimensions), mm."""
        with self._file() as file:
            root = file["VTKHDF"]
            kinds = numpy.unique(root["Types"][...])
            if len(kinds) == 0:
                return numpy.zeros((0, len(self.axes))), numpy.zeros((0, len(self.axes)))
            if len(kinds) > 1 or SHAPES.get(int(kinds[0])) != len(self.axes):
                raise InputError(f"{self.path} holds other cells than boxes over {', '.join(self.axes)}")
            points = root["Points"][...][:, : len(self.axes)] * 1e3
            corners = points[root["Connectivity"][...].reshape(-1, 2 ** len(self.axes))]
        lower = corners.min(axis=1)
        return lower, corners.max(axis=1) - lower

    @property
    def centres(self):
        """Middles of the cells, (cells, dimensions), mm."""
        lower, sizes = self._boxes
        return lower + sizes / 2

    @property
    def sizes(self):
        """Edges of the cells, (cells,), mm."""
        return self._boxes[1][:, 0]

    @property
    def coordinates(self):
        """Middles of the cells by axis: {"r": (cells,), "z": (cells,)}, mm."""
        return dict(zip(self.axes, self.centres.T))

    def grid(self):
        """The same fields on a full grid of the smallest cells."""
        return Grid(self)

    def to_xarray(self, names=None):
        """Fields as an xarray Dataset over the axes [mm], with units in attrs. @raises MissingDependency.

        names: which ones; None: all. Vectors have a dimension `axis`, stresses `component`.
        """
        xarray = needed("xarray", "Fields.to_xarray")
        grid = self.grid()
        known = [self._split(name)[0] for name in (self.names if names is None else names)]
        data = {}
        for name in known:
            values = grid[name]
            last = {"velocity": ["axis"], "stress": ["component"]}.get(name, [])
            data[name] = ([*self.axes, *last], values, {"units": self.units[name]})
        coordinates = {a: (a, c, {"units": "mm"}) for a, c in grid.centres.items()}
        if "velocity" in data:
            coordinates["axis"] = list(self.axes)
        if "stress" in data:
            coordinates["component"] = list(self.parts("stress"))
        coordinates["time"] = ((), self.time, {"units": "us"})
        return xarray.Dataset(data, coordinates, {"file": self.path.name})


class Grid:
    """Fields on a full grid of the smallest cells, from the first to the last cell of the dump along each axis.

    grid["pressure"]: array of shape (nr, nz), or as many axes as there are, and parts last. NaN where the dump has no
    cell (body -1, contact 0). A larger cell gives its value to all the places that it covers.
    """

    def __init__(self, fields):
        self.fields = fields
        lower, sizes = fields._boxes
        if len(lower) == 0:
            raise InputError(f"{fields.path} holds no cells")
        self.size = float(sizes.min())  # mm
        origin = lower.min(axis=0)
        first = numpy.rint((lower - origin) / self.size).astype(int)
        counts = numpy.rint(sizes[:, 0] / self.size).astype(int)
        self.shape = tuple(int(n) for n in (first + counts[:, None]).max(axis=0))
        # Rounded, so that all dumps of a run have the same ones to the bit.
        self.edges = {
            a: numpy.round(o + self.size * numpy.arange(n + 1), DIGITS)
            for a, o, n in zip(fields.axes, origin, self.shape)
        }
        self.centres = {a: numpy.round((e[1:] + e[:-1]) / 2, DIGITS) for a, e in self.edges.items()}
        # For each size of cells: which cells, and their first places.
        self._levels = [(int(n), numpy.flatnonzero(counts == n)) for n in numpy.unique(counts)]
        self._first = first

    def __getitem__(self, name):
        values = self.fields[name]
        gap = OUTSIDE[name] if name in OUTSIDE else numpy.nan
        full = numpy.full(self.shape + values.shape[1:], gap, values.dtype)
        for count, cells in self._levels:
            for step in itertools.product(range(count), repeat=len(self.shape)):
                full[tuple((self._first[cells] + step).T)] = values[cells]
        return full


class FieldSeries(Sequence):
    """All dumps of a run in the order of time: `series[3]`, `len(series)`; `series("3 us")` is the one nearest to 3 us.

    times: of the dumps, (dumps,), us.
    """

    def __init__(self, folder, axes, bodies):
        self._folder = pathlib.Path(folder)
        self._axes, self._bodies = axes, bodies  # functions: they read the case

    @cached_property
    def _entries(self):
        found = sorted(self._folder.glob("*.hdf.series"))
        if not found:
            return []
        return [(f["name"], f["time"] * 1e6) for f in json.loads(found[0].read_text())["files"]]

    @property
    def times(self):
        return numpy.array([time for _, time in self._entries])

    def __len__(self):
        return len(self._entries)

    def __getitem__(self, number):
        if isinstance(number, slice):
            return [self[k] for k in range(*number.indices(len(self)))]
        name, time = self._entries[number]
        return Fields(self._folder / name, time, self._axes(), self._bodies())

    def __call__(self, time):
        """The dump nearest to a time: a number in us, or a text with a unit. @raises InputError beyond the last one."""
        if not self._entries:
            raise UnfinishedRun(f"{self._folder} holds no dumps of fields", self._folder.parent)
        wanted, times = convert(time, "us"), self.times
        if not 0 <= wanted <= times[-1] * (1 + LATE):
            raise InputError(f"there are fields from 0 to {times[-1]:.6g} us, not at {wanted:.6g} us")
        return self[int(numpy.abs(times - wanted).argmin())]

    def __repr__(self):
        span = f", 0 to {self.times[-1]:.6g} us" if self._entries else ""
        return f"<{len(self)} dumps of fields{span}>"
