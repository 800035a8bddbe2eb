"""The version of the package, which is that of the program."""

import pathlib
import re


def version():
    """Of the source tree where the package lies in one, else of what pip has installed."""
    cmake = pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt"
    found = re.search(r"project\(recoil VERSION ([0-9.]+)", cmake.read_text()) if cmake.is_file() else None
    if found:
        return found[1]
    from importlib import metadata

    return metadata.version("recoil")
