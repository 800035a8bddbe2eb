#!/usr/bin/python3
"""Reads a VTKHDF file with VTK's own reader and prints what it saw as one JSON object.

usage: read_vtkhdf.py FILE

{"cells": [{"type": 9, "points": [[x, y, z], ...]}, ...],
 "arrays": {"pressure_GPa": {"components": 1, "kind": "float", "values": [...]}},
 "time": seconds or null}

Exit code 77 where VTK is not installed, 1 where its reader refuses the file.
"""

import json
import sys

try:
    from vtkmodules.vtkCommonCore import vtkIdList
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError as error:
    print(f"VTK is not installed: {error}", file=sys.stderr)
    sys.exit(77)


def flat(array):
    """All numbers of a vtkDataArray, tuple after tuple."""
    return [value for n in range(array.GetNumberOfTuples()) for value in array.GetTuple(n)]


def cells(grid):
    """Type and corner places of each cell."""
    ids, result = vtkIdList(), []
    for n in range(grid.GetNumberOfCells()):
        grid.GetCellPoints(n, ids)
        points = [list(grid.GetPoint(ids.GetId(k))) for k in range(ids.GetNumberOfIds())]
        result.append({"type": grid.GetCellType(n), "points": points})
    return result


def main():
    reader = vtkHDFReader()
    if not reader.CanReadFile(sys.argv[1]):
        print(f"VTK cannot read {sys.argv[1]}", file=sys.stderr)
        return 1
    reader.SetFileName(sys.argv[1])
    reader.Update()
    grid = reader.GetOutputDataObject(0)
    if not grid.IsA("vtkUnstructuredGrid"):
        print(f"VTK sees a {grid.GetClassName()}", file=sys.stderr)
        return 1
    arrays = {}
    for n in range(grid.GetCellData().GetNumberOfArrays()):
        array = grid.GetCellData().GetArray(n)
        arrays[array.GetName()] = {
            "components": array.GetNumberOfComponents(),
            "kind": array.GetDataTypeAsString(),
            "values": flat(array),
        }
    time = grid.GetFieldData().GetArray("TimeValue")
    print(json.dumps({"cells": cells(grid), "arrays": arrays, "time": time.GetTuple1(0) if time else None}))
    return 0


sys.exit(main())
