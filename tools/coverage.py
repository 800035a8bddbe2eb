#!/usr/bin/env python3
"""Prints what part of the lines tests have reached, by folder: tools/coverage.py build/coverage [-j JOBS]

FOLDER is a build with RECOIL_COVERAGE=ON whose tests have run; gcov reads it. FOLDER/coverage.json has the lines that were missed in
each file. (gcovr 5.2, Debian 12's, stops at functions of one name on two lines.) `make coverage` does all of it.
"""

import argparse
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def count_object(data):
    """{file of src/: {line: times}} of one object, from gcov."""
    said = subprocess.run(["gcov", "--json-format", "--stdout", str(data)], capture_output=True, check=False, cwd=data.parent).stdout
    counted = json.loads(said) if said else {"files": []}
    found = {}
    for file in counted["files"]:
        name = Path(counted["current_working_directory"], file["file"]).resolve()
        if not name.is_relative_to(ROOT / "src"):
            continue
        lines = found.setdefault(name.relative_to(ROOT).as_posix(), {})
        for line in file["lines"]:
            lines[line["line_number"]] = max(lines.get(line["line_number"], 0), line["count"])
    return found


def count_lines(build, jobs):
    """[{filename, line_covered, line_total, missed}]: a line counts as reached where it is in any object."""
    times = {}
    with ThreadPoolExecutor(jobs) as team:
        for found in team.map(count_object, sorted(build.rglob("*.gcda"))):
            for name, lines in found.items():
                own = times.setdefault(name, {})
                for line, count in lines.items():
                    own[line] = max(own.get(line, 0), count)
    files = []
    for name, lines in sorted(times.items()):
        missed = sorted(line for line, count in lines.items() if count == 0)
        files.append({"filename": name, "line_covered": len(lines) - len(missed), "line_total": len(lines), "missed": missed})
    (build / "coverage.json").write_text(json.dumps(files, indent=1) + "\n", encoding="utf-8")
    return files


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
    files = count_lines(options.folder.resolve(), options.jobs)
    if not files:
        sys.exit(f"no counts below {options.folder}: have its tests run?")
    for line in table(files):
        print(line)
    print(f"lines: {options.folder}/coverage.json")
    return 0


if __name__ == "__main__":
    sys.exit(main())
