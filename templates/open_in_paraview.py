"""Opens the fields of this run in ParaView with a view to start from: bodies, a field, levels, all times.

    paraview --script=open_in_paraview.py                    the window of ParaView
    pvpython open_in_paraview.py --picture pressure.png      a picture without a window (pvbatch does as well)

Options: --field plastic_strain, --body NAME (all where there is none), --time 3e-6 (in s; the last where there is none).
In the pipeline: `bodies` (their surfaces), `matter` (cells that hold some), in space `section` (across the middle) and
`levels` (the cells, by their level; not shown where there is one level), in space `rigid NAME` (rigid bodies, grey).
"""

import argparse
import glob
import os
import sys

from paraview import simple as pv

FIELD = "pressure_GPa"
LEVEL_SET = "level_set_"
INK = [0.1, 0.1, 0.12]
GREY = [0.72, 0.74, 0.77]

# Moves the surface that a rigid body had at the start, inputs[1], to where the dump has the body.
MOVE = """
import numpy
fields = inputs[0].FieldData
row = [int(number) for number in fields["rigid_body"]].index({number})
turn = numpy.asarray(fields["rigid_rotation"])[row].reshape(3, 3)
start, centre = (numpy.asarray(fields[name])[row] for name in ("rigid_start_centre_m", "rigid_centre_m"))
output.ShallowCopy(inputs[1].VTKObject)
output.Points = centre + (inputs[1].Points - start) @ turn.T
"""


def folder_of_run():
    """Where this file lies; ParaView's window may not say so: then where it was started."""
    return os.path.dirname(os.path.abspath(globals().get("__file__", "open_in_paraview.py")))


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--field", help=f"array to colour by (default: {FIELD})")
    parser.add_argument("--body", action="append", help="body to show; may be repeated")
    parser.add_argument("--time", type=float, help="time in s")
    parser.add_argument("--picture", help="PNG file to write")
    parser.add_argument("--state", help="state file of ParaView (.pvsm) to write")
    return parser.parse_args([] if os.path.basename(sys.argv[0]).startswith("paraview") else None)


def open_run(folder):
    """The series of dumps, as ParaView reads it."""
    series = glob.glob(os.path.join(folder, "fields", "*.hdf.series"))
    if len(series) != 1:
        sys.exit(f"{folder} holds {len(series)} runs with fields; this file belongs into the folder of one")
    reader = pv.OpenDataFile(series[0])
    pv.RenameSource("fields", reader)
    reader.UpdatePipeline()
    return reader


def rigid_surfaces(folder):
    """Number and STL file of the rigid bodies in space, by name, which is the head of the file."""
    found = {}
    for file in sorted(glob.glob(os.path.join(folder, "fields", "rigid_*.stl"))):
        with open(file, "rb") as stl:
            found[stl.read(80).decode().strip()] = (int(os.path.basename(file)[len("rigid_") : -len(".stl")]), file)
    return found


def shown_bodies(reader, wanted, rigid):
    """Names of the level sets of the deformable bodies to show, and the rigid ones."""
    names = [a.Name for a in reader.CellData if a.Name.startswith(LEVEL_SET)]
    of_body = {n[len(LEVEL_SET) : -len("_m")]: n for n in names}
    for body in wanted or ():
        if body not in of_body:
            sys.exit(f"there is no body {body!r}: there are {', '.join(of_body)}")
    level_sets = [of_body[b] for b in wanted or of_body if b not in rigid]
    if not level_sets:
        sys.exit("--body names rigid bodies only, which have no field; add a deformable one")
    return level_sets, [b for b in wanted or rigid if b in rigid]


def threshold(source, array, low, high):
    cells = pv.Threshold(Input=source, Scalars=["CELLS", array])
    cells.LowerThreshold, cells.UpperThreshold = low, high
    cells.ThresholdMethod = "Between"
    return cells


def insides(reader, level_sets):
    """Where a level set is below zero. The state is that of the nearest cell that has one: slivers have none."""
    points = pv.CellDatatoPointData(Input=reader, ProcessAllArrays=0, CellDataArraytoprocess=level_sets)
    each = [pv.IsoVolume(Input=points, InputScalars=["POINTS", name], ThresholdRange=[-1e9, 0]) for name in level_sets]
    bodies = pv.AppendDatasets(Input=each)
    middles = pv.CellCenters(Input=threshold(reader, "volume_fraction", 0.3, 1e9), VertexCells=1)
    bodies = pv.PointDatasetInterpolator(Input=middles, Source=bodies, Kernel="VoronoiKernel", Locator="Static Point Locator")
    pv.RenameSource("bodies", bodies)
    return bodies


def outlines(reader, level_sets):
    """Where the level sets are zero."""
    points = pv.CellDatatoPointData(Input=reader, ProcessAllArrays=0, CellDataArraytoprocess=level_sets)
    each = [pv.Contour(Input=points, ContourBy=["POINTS", name], Isosurfaces=[0.0]) for name in level_sets]
    bodies = pv.AppendDatasets(Input=each)
    pv.RenameSource("bodies", bodies)
    return bodies


def colour(display, association, array, view):
    """By the array; cells with too little matter for a value are not shown."""
    pv.ColorBy(display, (association, array))
    table = pv.GetColorTransferFunction(array)
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.NanOpacity = 0
    display.SetScalarBarVisibility(view, True)
    bar = pv.GetScalarBar(table, view)
    bar.TitleColor = bar.LabelColor = INK


def show_plane(reader, matter, bodies, field, view):
    shown = pv.Show(matter, view)
    colour(shown, "CELLS", field, view)
    outline = pv.Show(bodies, view)
    outline.AmbientColor = outline.DiffuseColor = INK
    outline.ColorArrayName = [None, ""]
    outline.LineWidth = 2
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    return shown


def show_space(reader, matter, bodies, field, view):
    shown = pv.Show(bodies, view)
    colour(shown, "POINTS", field, view)
    low, high = reader.GetDataInformation().GetBounds()[0::2], reader.GetDataInformation().GetBounds()[1::2]
    section = pv.Slice(Input=matter, SliceType="Plane")
    section.SliceType.Origin = [(a + b) / 2 for a, b in zip(low, high)]
    section.SliceType.Normal = [0, 1, 0]
    pv.RenameSource("section", section)
    hidden = pv.Show(section, view)
    pv.ColorBy(hidden, ("CELLS", field))
    pv.Hide(section, view)
    # From a corner of three faces, as `recoil plot --view`: azimuth -55 and elevation 24 degrees, z up.
    view.CameraFocalPoint = section.SliceType.Origin
    view.CameraPosition = [m + d for m, d in zip(section.SliceType.Origin, (0.524, -0.748, 0.407))]
    view.CameraViewUp = [0, 0, 1]
    return shown


def add_levels(matter, view):
    """The cells in the colours of their levels, to switch on."""
    levels = pv.Threshold(Input=matter, Scalars=["CELLS", "level"], LowerThreshold=0, UpperThreshold=99)
    pv.RenameSource("levels", levels)
    display = pv.Show(levels, view)
    display.SetRepresentationType("Surface With Edges")
    pv.ColorBy(display, ("CELLS", "level"))
    pv.Hide(levels, view)


def show_rigid(reader, name, number, file, view):
    """A rigid body, grey, where it is at the time that is shown."""
    surface = pv.STLReader(FileNames=[file])
    body = pv.ProgrammableFilter(Input=[reader, surface], OutputDataSetType="vtkPolyData", Script=MOVE.format(number=number))
    pv.RenameSource(f"rigid {name}", body)
    shown = pv.Show(body, view)
    shown.ColorArrayName = [None, ""]
    shown.AmbientColor = shown.DiffuseColor = GREY


def show_times(reader, view, time):
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = reader.TimestepValues[-1] if time is None else time
    label = pv.AnnotateTimeFilter(Input=reader, Format="{time:.4g} us", Scale=1e6)
    pv.RenameSource("time", label)
    pv.Show(label, view).Color = INK


def main():
    said = options()
    reader = open_run(folder_of_run())
    rigid = rigid_surfaces(folder_of_run())
    arrays = [a.Name for a in reader.CellData]
    field = said.field or (FIELD if FIELD in arrays else arrays[0])  # a case may write few variables
    if field not in arrays:
        sys.exit(f"there is no field {field!r}: there are {', '.join(arrays)}")
    view = pv.GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1200, 900]
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesLabelColor = INK
    matter = threshold(reader, "body", -0.5, 1e9)
    pv.RenameSource("matter", matter)
    bounds = reader.GetDataInformation().GetBounds()
    make, show = (insides, show_space) if bounds[5] > bounds[4] else (outlines, show_plane)
    level_sets, shown_rigid = shown_bodies(reader, said.body, rigid)
    bodies = make(reader, level_sets)
    shown = show(reader, matter, bodies, field, view)
    for name in shown_rigid:
        show_rigid(reader, name, *rigid[name], view)
    if "level" in arrays:
        add_levels(matter, view)
    show_times(reader, view, said.time)
    pv.SetActiveSource(bodies)
    pv.ResetCamera(view)
    shown.RescaleTransferFunctionToDataRange(False, True)  # of the time that is shown
    pv.Render(view)
    if said.state:
        pv.SaveState(said.state)
    if said.picture:
        pv.SaveScreenshot(said.picture, view, ImageResolution=[1200, 900])


main()
