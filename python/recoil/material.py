"""Materials of the library at single points: their constants, what a path of strain does to them, their Hugoniot.

Needs the module `_material`, which CMake builds (docs/how-to/python.md); reading runs does not.
"""

import importlib.machinery
import importlib.util
import os
import pathlib

import numpy

from .errors import EnvironmentError, MissingDependency, needed, unknown
from .launch import program_file
from .units import convert

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PARTS = ("xx", "yy", "zz", "xy", "yz", "xz")  # of a stress
# What each column is multiplied with, from SI, and its unit then.
PATH = {
    "time": (1e6, "us"),
    "strain": (1, "1"),
    "side_strain": (1, "1"),
    "stress": (1e-9, "GPa"),
    "pressure": (1e-9, "GPa"),
    "von_mises": (1e-9, "GPa"),
    "density": (1, "kg/m3"),
    "energy": (1, "J/kg"),
    "temperature": (1, "K"),
    "molten": (1, "1"),
    "plastic_strain": (1, "1"),
    "damage": (1, "1"),
    "void_fraction": (1, "1"),
}
SHOCK = {
    "velocity": (1, "m/s"),
    "stress": (1e-9, "GPa"),
    "pressure": (1e-9, "GPa"),
    "density": (1, "kg/m3"),
    "energy": (1, "J/kg"),
    "temperature": (1, "K"),
    "molten": (1, "1"),
    "plastic_strain": (1, "1"),
    "yield_stress": (1e-9, "GPa"),
    "shock_speed": (1, "m/s"),
    "release_speed": (1, "m/s"),
    "bulk_speed": (1, "m/s"),
    "precursor_speed": (1, "m/s"),
    "precursor_velocity": (1, "m/s"),
    "precursor_stress": (1e-9, "GPa"),
}


def _program_folders():
    """Where the program lies, if there is one."""
    try:
        return [pathlib.Path(program_file()).resolve().parent]
    except EnvironmentError:
        return []


def _load_module():
    """The compiled module: installed with the package, beside the program, or in a build folder of the source tree."""
    folders = [folder / "python" for folder in _program_folders()] + sorted(SOURCE.glob("build/*/python"))
    for folder in [pathlib.Path(__file__).resolve().parent, *folders]:
        for file in (folder / f"_material{suffix}" for suffix in importlib.machinery.EXTENSION_SUFFIXES):
            if file.exists():
                spec = importlib.util.spec_from_file_location("recoil._material", file)
                module = importlib.util.module_from_spec(spec)
                spec.loader.exec_module(module)
                return module
    raise MissingDependency(
        "materials need the compiled module recoil._material: in the source tree, with python3-dev and pybind11-dev, "
        "`tools/configure build/release -DRECOIL_PYTHON=ON && cmake --build build/release --target recoil_python_module`"
    )


_module = None


def _native():
    global _module
    _module = _module or _load_module()
    return _module


def material_folders(own=None):
    """Where materials are looked for, as the program does: a folder of one's own, RECOIL_MATERIALS, the library."""
    folders = [str(own)] if own else []
    folders += [folder for folder in os.environ.get("RECOIL_MATERIALS", "").split(":") if folder]
    installed = [folder.parent / "share" / "recoil" for folder in _program_folders()]
    data = os.environ.get("RECOIL_DATA") or next((f for f in installed if (f / "materials").is_dir()), SOURCE)
    return [*folders, str(pathlib.Path(data) / "materials")]


class Columns:
    """Numpy arrays by name, `path["pressure"]`, over the points of a path or of a Hugoniot, with their units."""

    def __init__(self, arrays, units):
        self._arrays, self.units = arrays, units

    def __repr__(self):
        return f"<{len(next(iter(self._arrays.values())))} points: {', '.join(self.names)}>"

    @property
    def names(self):
        return list(self._arrays)

    def __getitem__(self, name):
        """(points,); a stress along a path (points, 6), or one part of it: `path["stress.xx"]`. @raises UnknownName."""
        whole, _, part = str(name).replace("-", "_").partition(".")
        if whole not in self._arrays or (part and (part not in PARTS or self._arrays[whole].ndim == 1)):
            raise unknown("column", name, self.names)
        return self._arrays[whole][:, PARTS.index(part)] if part else self._arrays[whole]

    def to_pandas(self):
        """A DataFrame with the units in `attrs`; a stress along a path has a column for each part."""
        columns, units = {}, {}
        for name in self.names:
            parts = [f"{name}.{p}" for p in PARTS] if self[name].ndim == 2 else [name]
            columns.update({part: self[part] for part in parts})
            units.update({part: self.units[name] for part in parts})
        frame = needed("pandas", "Columns.to_pandas").DataFrame(columns)
        frame.attrs["units"] = units
        return frame


def _in_units(columns, kinds):
    return Columns({n: columns[n] * factor for n, (factor, _) in kinds.items()}, {n: unit for n, (_, unit) in kinds.items()})


class Material:
    """A material by its name, `Material("copper/ofhc-johnson-cook")`. @raises InputError for an unknown name.

    folder: of materials of one's own, asked before the library.
    """

    def __init__(self, name, folder=None):
        self._own = _native().load(name, material_folders(folder))
        self.name = self._own.name
        self.title = self._own.title
        self.density = self._own.density  # kg/m3, at rest
        self.shear_modulus = self._own.shear_modulus * 1e-9  # GPa
        self.bulk_speed = self._own.bulk_speed  # m/s, of sound at rest
        self.longitudinal_speed = self._own.longitudinal_speed  # m/s, of longitudinal waves at rest

    def __repr__(self):
        return f"<material {self.name}, {self.density:.5g} kg/m3>"

    def to_toml(self):
        """All its constants, in SI, as a file of the library would have them."""
        return self._own.toml()

    def yield_stress(self, plastic_strain=0, rate=0, temperature=298, pressure=0):
        """GPa, at a rate [1/s] of plastic strain, a temperature [K] and a pressure [GPa], density and damage as at rest."""
        rate, temperature = convert(rate, "1/s"), convert(temperature, "K")
        return self._own.yield_stress(plastic_strain, rate, temperature, convert(pressure, "GPa") * 1e9) * 1e-9

    def uniaxial_strain(self, strain, rate, steps=200, pressure=None, temperature=None):
        """Strain along x alone, as in plate impact.

        strain: logarithmic, positive where stretched; one or several, reached in turn from 0: [-0.05, 0].
        rate: of it, 1/s. steps: to each strain. pressure [GPa], temperature [K]: at the start.
        Columns: those of PATH above; `stress` positive in tension, `pressure` in compression. @raises PhysicsError where
        the equation of state ends.
        """
        return self._follow("uniaxial-strain", strain, rate, steps, pressure, temperature)

    def uniaxial_stress(self, strain, rate, steps=200, pressure=None, temperature=None):
        """The same where the sides are free of stress, as in a thin bar; `side_strain` is theirs, logarithmic."""
        return self._follow("uniaxial-stress", strain, rate, steps, pressure, temperature)

    def simple_shear(self, strain, rate, steps=200, pressure=None, temperature=None):
        """The same where layers slide along x; the strain is the slope du_x/dy of what was a line along y."""
        return self._follow("simple-shear", strain, rate, steps, pressure, temperature)

    def _follow(self, kind, strain, rate, steps, pressure, temperature):
        strains = [float(s) for s in numpy.atleast_1d(strain)]
        pressure = None if pressure is None else convert(pressure, "GPa") * 1e9
        temperature = None if temperature is None else convert(temperature, "K")
        columns = self._own.follow(kind, strains, convert(rate, "1/s"), steps, pressure, temperature)
        return _in_units(columns, PATH)

    def hugoniot(self, velocities):
        """States behind shocks into matter at rest that push it to these velocities [m/s], in uniaxial strain.

        With strength an elastic front goes ahead, `precursor_*`: its stress is the Hugoniot elastic limit; 0 where there
        is none. `stress` is compressive, positive. @raises PhysicsError beyond largest_velocity().
        """
        states = [self._own.shock(convert(v, "m/s")) for v in numpy.atleast_1d(velocities).tolist()]
        return _in_units({name: numpy.array([s[name] for s in states]) for name in SHOCK}, SHOCK)

    def largest_velocity(self):
        """Up to which the Hugoniot reaches, m/s."""
        return self._own.largest_velocity()
