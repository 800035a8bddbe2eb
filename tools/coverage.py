#!/usr/bin/env python3
"""Writes what tests have reached as pages, and prints it by folder: tools/coverage.py build/coverage [-j JOBS]

FOLDER is a build with RECOIL_COVERAGE=ON whose tests have run; gcovr reads it. The pages are FOLDER/index.html.
`make coverage` does all of it.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def run_gcovr(build, jobs):
    """Lets gcovr write the pages; what it knows of each file. @raises CalledProcessError."""
    summary = build / "coverage.json"
    command = ["gcovr", "--root", str(ROOT), "--filter", "src/", "--object-directory", str(build), "-j", str(jobs)]
    command += ["--exclude-throw-branches", "--html-details", str(build / "index.html"), "--json-summary", str(summary)]
    subprocess.run([*command, str(build)], cwd=ROOT, check=True)
    return json.loads(summary.read_text(encoding="utf-8"))["files"]


def by_folder(files):
    """{folder of src/: (lines reached, lines)}, and of all together under 'all'."""
    found = {}
    for file in files:
        folder = Path(file["filename"]).parts[1]
        for key in (folder, "all"):
            reached, lines = found.get(key, (0, 0))
            found[key] = reached + file["line_covered"], lines + file["line_total"]
    return found


def least(files, count):
    """The files with the smallest part reached, of those with ten lines or more: (percent, lines not reached, name)."""
    parts = [
        (100 * file["line_covered"] / file["line_total"], file["line_total"] - file["line_covered"], file["filename"])
        for file in files
        if file["line_total"] >= 10
    ]
    return sorted(parts)[:count]


def table(files):
    """What is printed, as lines."""
    folders = by_folder(files)
    everything = folders.pop("all", (0, 0))
    for folder, (reached, lines) in [*sorted(folders.items()), ("all", everything)]:
        yield f"{folder:12} {100 * reached / max(lines, 1):6.1f} % of {lines} lines"
    yield "least:"
    for percent, lost, name in least(files, 15):
        yield f"{percent:6.1f} %, {lost} lines not reached: {name}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("-j", "--jobs", type=int, default=1)
    options = parser.parse_args()
    files = run_gcovr(options.folder.resolve(), options.jobs)
    if not files:
        sys.exit(f"no counts below {options.folder}: have its tests run?")
    for line in table(files):
        print(line)
    print(f"pages: {options.folder}/index.html")
    return 0


if __name__ == "__main__":
    sys.exit(main())
