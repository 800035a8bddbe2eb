"""Gives the package the version of the program, which stands in the project's CMakeLists.txt."""

import pathlib
import re

from setuptools import setup

CMAKE = pathlib.Path(__file__).resolve().parent.parent / "CMakeLists.txt"
setup(version=re.search(r"project\(recoil VERSION ([0-9.]+)", CMAKE.read_text())[1])
