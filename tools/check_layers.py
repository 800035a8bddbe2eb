#!/usr/bin/env python3
"""Checks which folder of src/ includes which: the layer rule and the fences around library headers.

A folder may include only itself and folders of a lower layer. A .cpp file includes the header beside it first, which
proves that this header compiles alone (CMake compiles the headers without a .cpp file by themselves). Usage: check_layers.py [ROOT], where ROOT holds
src/. Prints one line for every breach, `file:line: what (rule)`, and exits with 1 if there was any.
"""

import re
import sys
from pathlib import Path

LAYERS = (
    ("core",),
    ("parallel", "config"),
    ("mesh", "material", "format"),
    ("field", "kernels"),
    ("state",),
    ("cutcell", "contact"),
    ("levelset", "dynamics"),
    ("interface", "problem", "gauge"),
    ("timestep", "record"),
    ("picture",),
    ("app",),
)
LAYER_OF = {folder: number for number, folders in enumerate(LAYERS, start=1) for folder in folders}

# Library, pattern of its headers, folders that may include them.
FENCES = (
    ("MPI", re.compile(r"mpi(-ext)?\.h$"), ("parallel", "mesh", "format")),
    ("p4est", re.compile(r"(p4est|p8est|p6est|sc)(_\w+)?\.h$"), ("mesh",)),
    ("HDF5", re.compile(r"(hdf5(_hl)?|H5\w*)\.h$"), ("format",)),
    ("zlib", re.compile(r"z(conf|lib)\.h$"), ("format",)),
    ("Cairo", re.compile(r"(cairo/)?cairo(-\w+)?\.h$"), ("picture",)),
    ("toml++", re.compile(r"toml(\+\+/.*|\.hpp)$"), ("config",)),
)

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SUFFIXES = {".hpp", ".cpp", ".h", ".inl"}


def breaches_of_include(folder, quote, header):
    """The rules that one include line of a file in `folder` breaks, as texts."""
    for library, pattern, allowed in FENCES:
        if pattern.match(header) and folder not in allowed:
            yield f"<{header}> in {folder} ({library} only in {', '.join(allowed)})"
    target = header.split("/")[0] if "/" in header else None
    if target in LAYER_OF:
        if target != folder and LAYER_OF[target] >= LAYER_OF[folder]:
            yield (
                f'"{header}" in {folder} (layer {LAYER_OF[folder]} {folder} may not include '
                f"layer {LAYER_OF[target]} {target})"
            )
    elif quote == '"':
        yield f'"{header}" (our own headers are named from the source root: "folder/file.hpp")'


def breaches_of_file(path, source):
    """All breaches in one file below the folder `source`, as (line, text)."""
    parts = path.relative_to(source).parts
    if len(parts) == 1 or parts[0] not in LAYER_OF:
        yield 1, f"{parts[0]} is in no layer (add its folder to LAYERS in tools/check_layers.py)"
        return
    lines = enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
    includes = [(number, *match.groups()) for number, line in lines if (match := INCLUDE.match(line))]
    for number, quote, header in includes:
        for text in breaches_of_include(parts[0], quote, header):
            yield number, text
    beside = path.with_suffix(".hpp")
    if path.suffix == ".cpp" and beside.exists():
        own = beside.relative_to(source).as_posix()
        if not includes or includes[0][2] != own:
            yield (includes[0][0] if includes else 1), f'"{own}" is not the first include'


def check(root):
    """All breaches below root/src as lines of text; the number of files read. @raises FileNotFoundError."""
    source = Path(root) / "src"
    if not source.is_dir():
        raise FileNotFoundError(f"no folder {source}")
    files = sorted(p for p in source.rglob("*") if p.suffix in SUFFIXES)
    found = [
        f"{path.relative_to(root)}:{number}: {text}"
        for path in files
        for number, text in breaches_of_file(path, source)
    ]
    return found, len(files)


def folders_missing(root, layers=LAYERS):
    """The folders that `layers` names and root/src does not have, as lines of text."""
    return [
        f"tools/check_layers.py: LAYERS names {folder}, but there is no src/{folder}"
        for folders in layers
        for folder in folders
        if not (Path(root) / "src" / folder).is_dir()
    ]


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    found, count = check(root)
    found += folders_missing(root)
    for line in found:
        print(line)
    print(f"{count} files, {len(found)} breaches of the layer rule")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
