"""How far a body in free flight is from its exact shape at the end of a run: python3 shape_error.py RUN_FOLDER

Prints the part of its area (3d: volume) that lies outside of the exact shape moved along (a spinning body: after whole turns), and
the largest pressure against rho0 c0^2. For a spinning body also the angle at which the exact shape fits best. Needs numpy and h5py.
"""

import pathlib
import sys
import tomllib

import h5py
import numpy as np


def number(text):
    """Value of an SI quantity of case.resolved.toml."""
    return float(str(text).split()[0])


def vector(table, axes):
    return np.array([number(table.get(a, 0)) for a in axes])


def turn(x, centre, angle):
    """Points x, shape (n, 2) or (n, 3), turned about the z axis through the centre."""
    y = x - centre
    first = y[..., 0] * np.cos(angle) - y[..., 1] * np.sin(angle)
    second = y[..., 0] * np.sin(angle) + y[..., 1] * np.cos(angle)
    return centre + np.stack([first, second, *np.moveaxis(y, -1, 0)[2:]], -1)


def inside(shape, x, axes):
    """Which of the points x, shape (n, dimension) in m, lie in the shape."""
    kind = shape["kind"]
    if kind in ("cylinder", "sphere"):
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
    if "rotation" in shape:
        x = turn(x, vector(shape["centre"], axes), -number(shape["rotation"]))
    return ((x > low) & (x < high)).all(-1)


def part_inside(shape, x, dx, axes):
    """Part of each cell that lies in the shape, from n^dimension points in it."""
    dim = len(axes)
    n = 20 if dim == 2 else 10
    ticks = ((np.arange(n) + 0.5) / n - 0.5) * dx
    offsets = np.stack(np.meshgrid(*[ticks] * dim), -1).reshape(-1, dim)
    return sum(inside(shape, x + offset, axes).astype(float) for offset in offsets) / n**dim


def main(folder):
    case = tomllib.loads((folder / "case.resolved.toml").read_text())
    (body,) = case["body"].values()
    axes = "xyz" if case["domain"]["geometry"] == "3d" else "xy"
    dx = number(case["mesh"]["finest"])
    last = sorted((folder / "fields").glob("*.hdf"))[-1]
    grid = h5py.File(last)["VTKHDF"]
    corners = grid["Connectivity"][:].reshape(grid["NumberOfCells"][0], -1)
    x = grid["Points"][:][corners].mean(1)[:, : len(axes)] - vector(body["velocity"], axes) * number(case["time"]["end"])
    fill = grid["CellData/volume_fraction"][:]

    def outside(points):
        return 100 * np.maximum(fill - part_inside(body["shape"], points, dx, axes), 0).sum() / fill.sum()

    print(f"outside of the exact shape: {outside(x):.2f} %")
    if number(body.get("spin", 0)) != 0 and body["shape"]["kind"] == "box":
        centre = vector(body["spin-centre"], axes)
        error, lag = min((outside(turn(x, centre, np.radians(a))), a) for a in np.arange(-10, 40, 0.5))
        print(f"outside of the same shape turned back by {lag} degrees: {error:.2f} %")
    eos = case["material"][body["material"]]["eos"]
    stiffness = number(eos["bulk-modulus"]) if "bulk-modulus" in eos else number(eos["density"]) * number(eos["c0"]) ** 2
    pressure = np.nanmax(abs(grid["CellData/pressure_GPa"][:])) * 1e9
    print(f"largest pressure: {pressure / stiffness:.1e} rho0 c0^2")


main(pathlib.Path(sys.argv[1]))
