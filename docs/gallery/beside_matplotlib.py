"""Ten pictures of the gallery, each by `recoil plot` and by matplotlib from the same run, side by side: pairs_1.png, pairs_2.png.

    python3 docs/gallery/beside_matplotlib.py FOLDER

Environment: as for the Python package (docs/how-to/python.md). Meshes are coarser than those of the gallery: some minutes.
"""

import pathlib
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import recoil  # noqa: E402

RUNS = {
    "flyer_al_cu": {"output.fields.every": "0.05 us"},
    "flyer_convergence": {"mesh.finest": "0.05 mm"},
    "attenuation_al_1250": {},
    "flyer_axisymmetric": {},
    "taylor_copper": {"time.end": "40 us"},
    "spall_aluminium": {"output.fields.every": "0.02 us"},
    "sphere_on_plate": {"mesh.finest": "1.5 mm", "domain.x": ["0 mm", "21 mm"], "domain.y": ["0 mm", "21 mm"],
                        "domain.z": ["-16.5 mm", "12 mm"], "time.end": "30 us"},
}  # fmt: skip


def gauge(name, reference=None):
    """A column over time, with a reference curve of the run where there is one."""

    def draw(axes, run):
        series = run.series(name)
        axes.plot(series)
        if reference:
            axes.plot(run.references[reference[0]][reference[1]], "--")
        axes.set(xlabel=series.index.name, ylabel=f"{name} [{series.attrs['unit']}]")

    return draw


def plane(field, time):
    """A field on the cells of a plane."""

    def draw(axes, run):
        grid = run.at(time).grid()
        x, y = run.axes
        picture = axes.pcolormesh(grid.edges[x], grid.edges[y], grid[field].T)
        axes.set(xlabel=f"{x} [mm]", ylabel=f"{y} [mm]", aspect="equal")
        plt.colorbar(picture, ax=axes, label=field)

    return draw


def slice_of_space(field, time):
    """The cells beside y = 0."""

    def draw(axes, run):
        grid = run.at(time).grid()
        row = numpy.abs(grid.centres["y"] - grid.size / 2).argmin()
        picture = axes.pcolormesh(grid.edges["x"], grid.edges["z"], grid[field][:, row].T)
        axes.set(xlabel="x [mm]", ylabel="z [mm]", aspect="equal")
        plt.colorbar(picture, ax=axes, label=field)

    return draw


def along(field, time):
    def draw(axes, run):
        grid = run.at(time).grid()
        axes.plot(grid.centres["x"], grid[field])
        axes.set(xlabel="x [mm]", ylabel=field)

    return draw


def over_time(field):
    """Place, time and value."""

    def draw(axes, run):
        grids = [fields.grid() for fields in run.fields]
        size, low = grids[0].size, min(g.edges["x"][0] for g in grids)
        wide = max(round((g.edges["x"][-1] - low) / size) for g in grids)
        values = numpy.full((len(grids), wide), numpy.nan)
        for row, g in zip(values, grids):
            first = round((g.edges["x"][0] - low) / size)
            row[first : first + g.shape[0]] = g[field]
        picture = axes.pcolormesh(low + size * (numpy.arange(wide) + 0.5), run.times, values, shading="nearest")
        axes.set(xlabel="x [mm]", ylabel="time [us]")
        plt.colorbar(picture, ax=axes, label=field)

    return draw


PICTURES = [
    ("flyer_al_cu", ["gauge.rear"], gauge("gauge.rear.velocity")),
    ("flyer_al_cu", ["pressure", "--xt"], over_time("pressure")),
    ("flyer_al_cu", ["pressure", "--at", "2us"], along("pressure", "2us")),
    ("flyer_convergence", ["gauge.rear", "--reference", "REFERENCE:velocity"],
     gauge("gauge.rear.velocity", ("reference.csv", "velocity"))),
    ("attenuation_al_1250", ["gauge.wave"], gauge("gauge.wave")),
    ("flyer_axisymmetric", ["pressure", "--at", "2us"], plane("pressure", "2us")),
    ("taylor_copper", ["plastic-strain", "--at", "40us"], plane("plastic_strain", "40us")),
    ("spall_aluminium", ["gauge.rear"], gauge("gauge.rear.velocity")),
    ("spall_aluminium", ["pressure", "--xt"], over_time("pressure")),
    ("sphere_on_plate", ["plastic-strain", "--slice", "y=0mm", "--at", "30us"], slice_of_space("plastic_strain", "30us")),
]  # fmt: skip


def main(folder):
    cases = pathlib.Path(__file__).resolve().parents[2] / "cases"
    runs = {name: recoil.run(name, folder / name, {**changes, "output.report": False}, force=True) for name, changes in RUNS.items()}
    for part in (0, 1):
        figure, axes = plt.subplots(5, 2, figsize=(16, 28), layout="constrained")
        for (own, other), (name, words, draw) in zip(axes, PICTURES[5 * part : 5 * part + 5]):
            file = folder / "own.png"
            words = [word.replace("REFERENCE", str(cases / name / "reference.csv")) for word in words]
            subprocess.run([recoil.program_file(), "plot", runs[name].folder, *words, file], check=True, stdout=subprocess.DEVNULL)
            own.imshow(plt.imread(file))
            own.axis("off")
            draw(other, runs[name])
        figure.savefig(folder / f"pairs_{part + 1}.png", dpi=60)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
