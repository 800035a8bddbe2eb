#!/usr/bin/env python3
"""Tests of check_layers.py: small trees with one known breach each."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import check_layers  # noqa: E402


def breaches(files):
    """What the checker says about a tree given as {path: text}."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = Path(root) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return check_layers.check(root)[0]


class LayerRule(unittest.TestCase):
    def test_lower_layers_and_own_folder_are_fine(self):
        self.assertEqual(
            breaches(
                {
                    "src/mesh/forest.cpp": '#include "mesh/forest.hpp"\n#include "parallel/world.hpp"\n'
                    '#include "core/index.hpp"\n#include <vector>\n',
                    "src/material/eos/linear.hpp": '#include "material/parameter.hpp"\n',
                    "src/app/main.cpp": '#include "timestep/step.hpp"\n#include <CLI/CLI.hpp>\n',
                }
            ),
            [],
        )

    def test_higher_layer_is_told_with_file_and_line(self):
        found = breaches({"src/core/vec.hpp": '#pragma once\n\n#include "mesh/forest.hpp"\n'})
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("src/core/vec.hpp:3:"), found)
        self.assertIn("layer 1 core may not include layer 3 mesh", found[0])

    def test_neighbour_in_the_same_layer_is_a_breach(self):
        found = breaches({"src/contact/touch.cpp": '#  include "cutcell/wall.hpp"\n'})
        self.assertEqual(len(found), 1)
        self.assertIn("contact may not include layer 6 cutcell", found[0])

    def test_angle_brackets_do_not_hide_our_own_folders(self):
        self.assertEqual(len(breaches({"src/field/halo.hpp": "#include <app/run/simulation.hpp>\n"})), 1)

    def test_own_headers_are_named_from_the_root(self):
        self.assertEqual(len(breaches({"src/core/a.cpp": '#include "a.hpp"\n'})), 1)
        self.assertEqual(len(breaches({"src/core/a.cpp": '#include "../core/a.hpp"\n'})), 1)

    def test_header_beside_a_file_comes_first(self):
        beside = {"src/core/a.hpp": "#pragma once\n"}
        self.assertEqual(breaches({**beside, "src/core/a.cpp": '#include "core/a.hpp"\n#include <vector>\n'}), [])
        late = breaches({**beside, "src/core/a.cpp": '#include <vector>\n#include "core/a.hpp"\n'})
        self.assertEqual(late, ['src/core/a.cpp:1: "core/a.hpp" is not the first include'])
        self.assertEqual(len(breaches({**beside, "src/core/a.cpp": "int n;\n"})), 1)

    def test_unknown_folder_is_a_breach(self):
        self.assertEqual(len(breaches({"src/utils/a.cpp": ""})), 1)
        self.assertEqual(len(breaches({"src/a.cpp": ""})), 1)

    def test_commented_include_is_ignored(self):
        self.assertEqual(breaches({"src/core/a.cpp": '// #include "app/main.hpp"\n'}), [])


class Fences(unittest.TestCase):
    def test_each_library_only_in_its_folders(self):
        headers = {
            "mpi.h": {"parallel", "mesh", "format"},
            "p4est.h": {"mesh"},
            "p8est_extended.h": {"mesh"},
            "sc_containers.h": {"mesh"},
            "hdf5.h": {"format"},
            "H5Fpublic.h": {"format"},
            "toml++/toml.h": {"config"},
        }
        for header, allowed in headers.items():
            for folder in check_layers.LAYER_OF:
                with self.subTest(header=header, folder=folder):
                    found = breaches({f"src/{folder}/a.cpp": f"#include <{header}>\n"})
                    self.assertEqual(len(found), 0 if folder in allowed else 1, found)


class Tree(unittest.TestCase):
    def test_names_without_a_folder_are_breaches(self):
        with tempfile.TemporaryDirectory() as root:
            (Path(root) / "src" / "core").mkdir(parents=True)
            found = check_layers.folders_missing(root, (("core",), ("mesh", "material")))
        self.assertEqual(len(found), 2)
        self.assertIn("there is no src/mesh", found[0])

    def test_missing_source_folder_is_an_error(self):
        with tempfile.TemporaryDirectory() as root, self.assertRaises(FileNotFoundError):
            check_layers.check(root)


if __name__ == "__main__":
    unittest.main()
