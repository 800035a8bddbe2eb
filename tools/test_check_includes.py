#!/usr/bin/env python3
"""Tests of check_includes.py and of cpp_text.py: small trees with what is missing known."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import check_includes  # noqa: E402
import cpp_text  # noqa: E402


def in_tree(files, fix=False):
    """What the checker says about a tree given as {path: text}, and the tree as it is then."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = Path(root) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        found, _ = check_includes.check(Path(root), fix)
        return found, {name: (Path(root) / name).read_text(encoding="utf-8") for name in files}


def fixed(text, name="src/core/a.hpp"):
    return in_tree({name: text}, fix=True)[1][name]


class Code(unittest.TestCase):
    def test_comments_strings_and_characters_become_spaces(self):
        text = "a // std::map\nb /* {\n */ c \"}\\\"{\" d '{' e\n"
        code = cpp_text.code_of(text)
        self.assertEqual(code.split(), ["a", "b", "c", "d", "e"])
        self.assertEqual([len(line) for line in code.splitlines()], [len(line) for line in text.splitlines()])

    def test_raw_strings_and_marks_between_digits(self):
        code = cpp_text.code_of('x = R"--(one " { )" two)--"; n = 1\'000\'000; m = {2};\n')
        self.assertNotIn("one", code)
        self.assertIn("m = {2};", code)

    def test_directives_go_with_the_lines_that_continue_them(self):
        code = cpp_text.without_directives("#define A(x) { \\\n  std::map<x> \\\n  y\nint z;\n")
        self.assertEqual(code.split(), ["int", "z;"])


class Missing(unittest.TestCase):
    def test_name_without_its_header_is_told_once_with_file_and_line(self):
        found, _ = in_tree({"src/core/a.hpp": "#pragma once\n\nstd::vector<int> a;\nstd::vector<int> b;\n"})
        self.assertEqual(found, ["src/core/a.hpp:3: std::vector needs <vector>"])

    def test_a_longer_name_is_another_name(self):
        found, _ = in_tree({"src/core/a.hpp": "std::string_view a;\n"})
        self.assertEqual(found, ["src/core/a.hpp:1: std::string_view needs <string_view>"])

    def test_names_in_comments_and_strings_do_not_count(self):
        self.assertEqual(in_tree({"src/core/a.hpp": '// std::vector\nconst char* a = "std::map";\n'})[0], [])

    def test_a_cpp_file_has_what_its_own_header_includes(self):
        header = {"src/core/a.hpp": "#pragma once\n#include <vector>\n"}
        use = '#include "core/a.hpp"\nstd::vector<int> a;\n'
        self.assertEqual(in_tree({**header, "src/core/a.cpp": use})[0], [])
        self.assertEqual(len(in_tree({**header, "src/core/b.cpp": use})[0]), 1)

    def test_one_of_several_headers_will_do(self):
        self.assertEqual(in_tree({"src/core/a.hpp": "#include <cstring>\nstd::size_t a;\n"})[0], [])

    def test_libraries(self):
        found, _ = in_tree({"bench/a.cpp": "auto a = fmt::format(b);\n", "tests/unit/b.cpp": "nlohmann::json b;\n"})
        self.assertEqual(
            found,
            ["bench/a.cpp:1: fmt::format needs <fmt/format.h>", "tests/unit/b.cpp:1: nlohmann::json needs <nlohmann/json.hpp>"],
        )


class Fix(unittest.TestCase):
    def test_into_the_block_in_order(self):
        text = "#pragma once\n\n#include <array>\n#include <vector>\n\n#include \"core/b.hpp\"\n\nstd::map<int, int> a;\n"
        self.assertEqual(fixed(text), text.replace("<array>\n", "<array>\n#include <map>\n"))

    def test_at_the_end_of_the_block(self):
        text = "#pragma once\n\n#include <array>\n\n#include \"core/b.hpp\"\n\nstd::map<int, int> a;\n"
        self.assertEqual(fixed(text), text.replace("<array>\n", "<array>\n#include <map>\n"))

    def test_a_new_block_before_our_own_headers(self):
        text = '#pragma once\n\n#include "core/b.hpp"\n\nstd::map<int, int> a;\n'
        self.assertEqual(fixed(text), text.replace('#include "', '#include <map>\n\n#include "'))

    def test_a_new_block_after_the_own_header(self):
        for name in ("src/core/b.cpp", "tests/unit/core/b_test.cpp"):
            text = '#include "core/b.hpp"\n\n#include "core/c.hpp"\n\nstd::map<int, int> a;\n'
            wanted = text.replace('b.hpp"\n', 'b.hpp"\n\n#include <map>\n')
            self.assertEqual(fixed(text, name), wanted)

    def test_blocks_of_libraries_and_of_the_standard(self):
        text = "#include <gtest/gtest.h>\n\nauto a = fmt::format(std::string());\n"
        wanted = "#include <fmt/format.h>\n#include <gtest/gtest.h>\n\n#include <string>\n\nauto a = fmt::format(std::string());\n"
        self.assertEqual(fixed(text, "tests/unit/core/b_test.cpp"), wanted)

    def test_a_file_without_includes(self):
        self.assertEqual(fixed("#pragma once\n\nstd::map<int, int> a;\n"), "#pragma once\n\n#include <map>\n\nstd::map<int, int> a;\n")
        self.assertEqual(fixed("std::map<int, int> a;\n", "src/core/b.cpp"), "#include <map>\n\nstd::map<int, int> a;\n")

    def test_what_a_header_gets_its_cpp_file_has(self):
        files = {
            "src/core/a.cpp": '#include "core/a.hpp"\n\nstd::map<int, int> a;\n',
            "src/core/a.hpp": "#pragma once\n\nextern std::map<int, int> a;\n",
        }
        found, tree = in_tree(files, fix=True)
        self.assertEqual(found, ["src/core/a.hpp:3: std::map needs <map>"])
        self.assertEqual(tree["src/core/a.cpp"], files["src/core/a.cpp"])

    def test_nothing_is_missing_afterwards(self):
        text = "#include <zlib.h>\n\nstd::vector<std::string> a = fmt::format(std::move(b), std::size_t(1));\n"
        self.assertEqual(in_tree({"src/core/a.hpp": fixed(text)})[0], [])


if __name__ == "__main__":
    unittest.main()
