"""Radius of the foot of the bar at the end of a run: python3 foot.py RUN_FOLDER

In every layer of cells, the area within the zero of the level set, turned into the radius of a circle, sqrt(4 A / pi) of a quarter;
the largest counts. Also the reach along x and along the diagonal in that layer. Needs numpy and h5py.
"""

import pathlib
import sys

import h5py
import numpy as np

FINE = 8  # points per cell and direction


def layer_of(centre, phi, z, dx):
    """Level set of one layer, shape (n, n), mirrored at x = 0 and y = 0; where no cell is stored: outside."""
    n = int(round(centre[:, :2].max() / dx + 0.5)) + 1
    layer = np.full((n, n), 2 * dx)
    here = abs(centre[:, 2] - z) < 0.1 * dx
    i, j = np.rint(centre[here, :2].T / dx - 0.5).astype(int)
    layer[i, j] = phi[here]
    return layer


def refine(layer):
    """Linear between the centres of cells along both axes; the first row and column mirrored."""
    n = len(layer)
    at = (np.arange(n * FINE) + 0.5) / FINE - 0.5
    mirrored = np.vstack([layer[:1], layer])
    rows = np.stack([np.interp(at, np.arange(-1, n), mirrored[:, k]) for k in range(n)], 1)
    mirrored = np.hstack([rows[:, :1], rows])
    return np.stack([np.interp(at, np.arange(-1, n), row) for row in mirrored])


def main(folder, number=-1):
    last = sorted((folder / "fields").glob("*.hdf"))[number]
    grid = h5py.File(last)["VTKHDF"]
    corners = grid["Connectivity"][:].reshape(grid["NumberOfCells"][0], -1)
    points = grid["Points"][:]
    dx = np.ptp(points[corners[0], 0])
    centre, phi = points[corners].mean(1), grid["CellData/level_set_bar_m"][:]
    best = (0,)
    for z in np.unique(np.round(centre[phi < 0, 2], 9)):
        fine = refine(layer_of(centre, phi, z, dx))
        area = (fine < 0).sum() * (dx / FINE) ** 2
        along = (fine[0] < 0).sum() * dx / FINE
        diagonal = (np.diag(fine) < 0).sum() * dx / FINE * 2**0.5
        best = max(best, ((4 * area / np.pi) ** 0.5, along, diagonal, z))
    print("{}: radius {:.3f} mm; along x {:.3f}, diagonal {:.3f} mm, layer z = {:.2f} mm".format(
        last.name, *(1e3 * v for v in best)))


main(pathlib.Path(sys.argv[1]), *map(int, sys.argv[2:]))
