"""How far a body in free flight is from its exact shape at the end of a run: python3 shape_error.py RUN_FOLDER

Prints the part of its area (3d: volume) that lies outside of the exact shape moved along, and the largest pressure against
rho0 c0^2 of copper/seed or steel/hzb. Needs numpy and h5py.
"""

import pathlib
import sys
import tomllib

import h5py
import numpy as np

STIFFNESS = {"copper/seed": 8930 * 3940.0**2, "steel/hzb": 7850 * 4570.0**2}  # Pa


def number(text):
    """SI value of a quantity in mm, us, m/s, deg or rad."""
    if not isinstance(text, str):
        return float(text)
    value, unit = text.split()
    return float(value) * {"mm": 1e-3, "us": 1e-6, "m/s": 1, "deg": np.pi / 180, "rad": 1, "GPa": 1e9}[unit]


def vector(table, axes):
    return np.array([number(table.get(a, "0 mm")) for a in axes])


def inside(shape, x, axes):
    """Which of the points x, shape (n, dimension) in m, lie in the shape."""
    kind = shape["kind"]
    if kind in ("disc", "sphere"):
        return ((x - vector(shape["centre"], axes)) ** 2).sum(-1) < number(shape["radius"]) ** 2
    if kind == "half-space":
        return (x - vector(shape["point"], axes)) @ vector(shape["normal"], axes) < 0
    if kind == "difference":
        first, *rest = shape["parts"]
        kept = inside(first, x, axes)
        for part in rest:
            kept &= ~inside(part, x, axes)
        return kept
    low, high = (np.array([number(shape[a][k]) for a in axes]) for k in (0, 1))
    angle = number(shape.get("rotation", 0))
    y = x - (low + high) / 2
    turned = np.stack([y[..., 0] * np.cos(angle) + y[..., 1] * np.sin(angle),
                       -y[..., 0] * np.sin(angle) + y[..., 1] * np.cos(angle)], -1)
    return (abs(turned) < (high - low) / 2).all(-1)


def main(folder):
    case = tomllib.loads((folder / "case.toml").read_text())
    (body,) = case["body"].values()
    axes = "xyz" if case["domain"]["geometry"] == "3d" else "xy"
    dim = len(axes)
    dx = number(case["mesh"]["finest"])
    last = sorted((folder / "fields").glob("*.hdf"))[-1]
    grid = h5py.File(last)["VTKHDF"]
    corners = grid["Connectivity"][:].reshape(grid["NumberOfCells"][0], -1)
    centre = grid["Points"][:][corners].mean(1)[:, :dim]
    fill = grid["CellData/volume_fraction"][:]
    back = vector(body["velocity"], axes) * number(case["time"]["end"])
    n = 20 if dim == 2 else 10
    ticks = ((np.arange(n) + 0.5) / n - 0.5) * dx
    exact = np.zeros(len(fill))
    for offset in np.stack(np.meshgrid(*[ticks] * dim), -1).reshape(-1, dim):
        exact += inside(body["shape"], centre + offset - back, axes) / n**dim
    pressure = np.nanmax(abs(grid["CellData/pressure_GPa"][:])) * 1e9
    print(f"outside of the exact shape: {100 * np.maximum(fill - exact, 0).sum() / fill.sum():.2f} %"
          f" (missing inside: {100 * np.maximum(exact - fill, 0).sum() / fill.sum():.2f} %)")
    own = case.get("material", {}).get(body["material"])  # of the case itself: with the linear law
    stiffness = number(own["eos"]["bulk-modulus"]) if own else STIFFNESS[body["material"]]
    print(f"largest pressure: {pressure / stiffness:.1e} rho0 c0^2")


main(pathlib.Path(sys.argv[1]))
