#!/usr/bin/env python3
"""Tests of check_sizes.py: functions, files, folders and rings of known size."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import check_sizes  # noqa: E402


def functions(text):
    """{name: (first line, lines)} of a C++ text."""
    return {name: (first, lines) for first, name, lines in check_sizes.cpp_functions(text)}


def breaches(files):
    """What the checker says about a tree given as {path: text}."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = Path(root) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return check_sizes.check(root)[0]


def lines(count):
    return "  n += 1;\n" * count


class Functions(unittest.TestCase):
    def test_from_its_head_to_its_brace(self):
        text = "namespace a {\n\n/// Says what.\ntemplate <int Dim, class T = std::vector<int>>\nint f(int a,\n      int b) {\n  if (a) {\n  }\n}\n}\n"
        self.assertEqual(functions(text), {"f": (5, 5)})

    def test_members_of_a_class(self):
        text = (
            "class A : public B {\n public:\n  A(int n)\n      : n_{n}, m_(n) {\n    ++n_;\n  }\n"
            "  int f() const noexcept { return n_; }\n  auto g() -> std::vector<int> {\n    return {1};\n  }\n"
            "  bool operator==(const A&) const = default;\n  int& operator[](int k) {\n    return v_[k];\n  }\n"
            " private:\n  int n_{0};\n  int m_ = 0;\n};\nA::~A() {\n}\n"
        )
        wanted = {"A": (3, 4), "f": (7, 1), "g": (8, 3), "operator[]": (12, 3), "A::~A": (19, 2)}
        self.assertEqual(functions(text), wanted)

    def test_declarations_and_values_are_no_functions(self):
        text = (
            "int f(int a = g(3));\nconstexpr std::array table{1, 2};\nstruct B { int a = 1; };\nenum class C { a, b };\n"
            "const Row rows[] = {{1, h(2)}, {3, 4}};\nextern \"C\" {\nint k();\n}\n"
        )
        self.assertEqual(functions(text), {})

    def test_a_lambda_counts_alone_only_outside_of_functions(self):
        self.assertEqual(functions("void f() {\n  auto g = [](int a) {\n    return a;\n  };\n}\n"), {"f": (1, 5)})
        text = "const std::vector<Row> rows = {\n    {1, [](int a) {\n       return h(a);\n     }},\n};\n"
        self.assertEqual(functions(text), {"lambda": (2, 3)})

    def test_braces_in_strings_comments_and_macros_do_not_count(self):
        text = "#define A(x) { \\\n  {\nvoid f() {\n  // }\n  g(\"}\", '}');\n}\n"
        self.assertEqual(functions(text), {"f": (3, 4)})

    def test_braces_that_do_not_balance_are_told(self):
        self.assertEqual(breaches({"src/core/a.hpp": "void f() {\n"}), ["src/core/a.hpp:1: braces do not balance"])
        self.assertEqual(breaches({"src/core/a.hpp": "int a;\n}\n"}), ["src/core/a.hpp:2: braces do not balance"])

    def test_limit(self):
        self.assertEqual(breaches({"src/core/a.cpp": "void f() {\n" + lines(58) + "}\n"}), [])
        found = breaches({"src/core/a.cpp": "\nvoid f() {\n" + lines(59) + "}\n"})
        self.assertEqual(found, ["src/core/a.cpp:2: function f of 61 lines, 60 allowed"])

    def test_python(self):
        found = breaches({"tools/a.py": "class A:\n    def f(self):\n" + "        n = 1\n" * 60})
        self.assertEqual(found, ["tools/a.py:2: function f of 61 lines, 60 allowed"])


class Files(unittest.TestCase):
    def test_limit_of_lines(self):
        self.assertEqual(breaches({"src/core/a.hpp": "int a;\n" * 400}), [])
        self.assertEqual(breaches({"src/core/a.hpp": "int a;\n" * 401}), ["src/core/a.hpp:1: file of 401 lines, 400 allowed"])

    def test_limit_of_a_folder(self):
        files = {f"src/core/a{k}.hpp": "" for k in range(30)}
        self.assertEqual(breaches({**files, "src/core/eos/b.hpp": ""}), [])
        self.assertEqual(breaches({**files, "src/core/b.hpp": ""}), ["src/core:1: folder of 31 files, 30 allowed"])


class Rings(unittest.TestCase):
    def test_headers_in_a_ring_are_told(self):
        found = breaches(
            {
                "src/core/a.hpp": '#pragma once\n#include "core/b.hpp"\n',
                "src/core/b.hpp": '#include <vector>\n#include "core/c.hpp"\n',
                "src/core/c.hpp": '\n\n#include "core/a.hpp"\n',
            }
        )
        ring = "core/a.hpp -> core/b.hpp -> core/c.hpp -> core/a.hpp"
        self.assertEqual(found, [f"src/core/c.hpp:3: headers include each other: {ring}"])

    def test_two_ways_to_the_same_header_are_no_ring(self):
        files = {
            "src/core/a.hpp": '#include "core/b.hpp"\n#include "core/c.hpp"\n',
            "src/core/b.hpp": '#include "core/c.hpp"\n',
            "src/core/c.hpp": "",
        }
        self.assertEqual(breaches(files), [])

    def test_a_header_that_includes_itself(self):
        self.assertEqual(len(breaches({"src/core/a.hpp": '#include "core/a.hpp"\n'})), 1)


if __name__ == "__main__":
    unittest.main()
