#!/usr/bin/env python3
"""Checks that a C++ file includes the headers of the standard names that it uses.

    tools/check_includes.py          one line for each missing header, `file:line: name needs <header>`; exits with 1
    tools/check_includes.py --fix    inserts them where .clang-format wants them

A .cpp file also has what the .hpp beside it includes itself; what other headers bring along does not count. Only names
of the table below are looked for, as words in the text: the script knows nothing of types, `using` or macros, and it never calls an
include superfluous.
"""

import argparse
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import cpp_text  # noqa: E402

# Header, names in std:: that need it. Names that many headers define (std::begin, std::get, std::swap) are left out.
STANDARD = {
    "algorithm": "adjacent_find all_of any_of binary_search clamp copy_if copy_n count count_if equal fill fill_n find find_if "
    "find_if_not for_each is_sorted lower_bound max max_element merge min min_element minmax minmax_element "
    "none_of nth_element partial_sort partition remove_if replace reverse rotate shuffle sort stable_sort "
    "transform unique upper_bound",
    "array": "array",
    "atomic": "atomic",
    "bit": "bit_cast bit_ceil countr_zero has_single_bit popcount",
    "charconv": "from_chars to_chars",
    "chrono": "chrono",
    "cmath": "acos asin atan atan2 cbrt ceil copysign cos cosh erf exp expm1 fabs floor fma fmax fmin fmod hypot isfinite "
    "isinf isnan ldexp log log10 log1p log2 lround llround nan nextafter pow round signbit sin sinh sqrt tan tanh "
    "trunc",
    "cctype": "isalnum isalpha isdigit isspace isupper tolower toupper",
    "cstddef": "byte max_align_t nullptr_t ptrdiff_t size_t",
    "cstdint": "int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t intptr_t uintptr_t",
    "cstdio": "fclose fflush fopen fprintf fputs fwrite printf snprintf",
    "cstdlib": "abort atexit exit getenv strtod strtol system",
    "cstring": "memcmp memcpy memset strcmp strerror strlen",
    "ctime": "clock clock_t gmtime strftime time time_t",
    "exception": "current_exception exception exception_ptr rethrow_exception terminate uncaught_exceptions",
    "filesystem": "filesystem",
    "fstream": "fstream ifstream ofstream",
    "functional": "function greater less plus reference_wrapper",
    "initializer_list": "initializer_list",
    "iostream": "cerr cin cout",
    "iterator": "back_inserter istreambuf_iterator",
    "limits": "numeric_limits",
    "map": "map multimap",
    "memory": "make_shared make_unique make_unique_for_overwrite shared_ptr unique_ptr weak_ptr",
    "mutex": "call_once lock_guard mutex once_flag scoped_lock unique_lock",
    "numbers": "numbers",
    "numeric": "accumulate gcd inner_product iota lcm partial_sum",
    "optional": "nullopt optional",
    "random": "mt19937 mt19937_64 normal_distribution uniform_int_distribution uniform_real_distribution",
    "regex": "regex regex_match regex_replace regex_search smatch",
    "set": "multiset set",
    "span": "span",
    "sstream": "istringstream ostringstream stringstream",
    "stdexcept": "domain_error invalid_argument logic_error out_of_range runtime_error",
    "string": "stod stoi string to_string",
    "string_view": "string_view",
    "system_error": "errc error_code system_error",
    "thread": "jthread this_thread thread",
    "tuple": "make_tuple tie tuple tuple_element_t tuple_size_v",
    "type_traits": "conditional_t decay_t enable_if_t integral_constant is_convertible_v is_enum_v is_floating_point_v "
    "is_integral_v is_same_v is_trivially_copyable_v remove_cvref_t true_type underlying_type_t",
    "unordered_map": "unordered_map",
    "unordered_set": "unordered_set",
    "utility": "as_const exchange forward index_sequence make_index_sequence make_pair move pair",
    "variant": "get_if holds_alternative monostate variant variant_alternative_t variant_size_v visit",
    "vector": "vector",
}
OTHERS = {
    "fmt/format.h": r"\bfmt::(?:format|format_to|memory_buffer|print|runtime|to_string)\b",
    "nlohmann/json.hpp": r"\bnlohmann::(?:json|ordered_json)\b",
}
# Headers that bring a name as well, by the standard or by the library's own pages.
ALSO = {
    "size_t": {"cstdio", "cstdlib", "cstring", "ctime"},
    "print": {"fmt/core.h"},
    "format": {"fmt/core.h"},
    "json": {"nlohmann/json_fwd.hpp"},
}

NAME = re.compile(r"\bstd::(\w+)")
HEADER_OF = {name: header for header, names in STANDARD.items() for name in names.split()}


def uses(code):
    """(position, name as written, header, other headers that will do) of each name of the table."""
    for match in NAME.finditer(code):
        header = HEADER_OF.get(match[1])
        if header:
            yield match.start(), match[0], header, ALSO.get(match[1], set())
    for header, pattern in OTHERS.items():
        for match in re.finditer(pattern, code):
            yield match.start(), match[0], header, ALSO.get(match[0].rsplit("::", 1)[1], set())


def headers_of(path, text):
    """What the file includes itself, and for a .cpp what the .hpp beside it does."""
    found = {header for _, _, header in cpp_text.includes_of(text)}
    beside = path.with_suffix(".hpp")
    if path.suffix == ".cpp" and beside.exists():
        found |= {header for _, _, header in cpp_text.includes_of(beside.read_text(encoding="utf-8"))}
    return found


def missing(path, text):
    """{header: (line, name)} of the first use of each header that the file lacks."""
    code = cpp_text.without_directives(cpp_text.code_of(text))
    there = headers_of(path, text)
    found = {}
    for position, name, header, others in sorted(uses(code)):
        if header not in there and not others & there:
            found.setdefault(header, (cpp_text.line_of(code, position), name))
    return found


def rank(quote, header):
    """Place of an include among the blocks: <name.h>, <name>, "name"."""
    if quote == '"':
        return 3
    return 1 if header.endswith(".h") else 2


def insert(path, text, header):
    """`text` of the file `path` with an include of <header> in its block; a new block where there is none."""
    lines = text.splitlines(keepends=True)
    line = f"#include <{header}>\n"
    there = [(number - 1, rank(quote, name), name) for number, quote, name in cpp_text.includes_of(text)]
    if there and path.suffix == ".cpp" and Path(there[0][2]).stem == path.stem.removesuffix("_test"):
        there[0] = (there[0][0], 0, there[0][2])  # the file's own header stands before all others
    own = rank("<", header)
    for number, block, name in there:
        if block == own and name > header:
            return "".join(lines[:number] + [line] + lines[number:])
    before = [(number, block) for number, block, _ in there if block <= own]
    if before:
        number, block = before[-1]
        new = [line] if block == own else ["\n", line]
        return "".join(lines[: number + 1] + new + lines[number + 1 :])
    if there:
        number = there[0][0]
        return "".join(lines[:number] + [line, "\n"] + lines[number:])
    pragma = next((k + 1 for k, text in enumerate(lines) if text.startswith("#pragma once")), 0)
    new = ["\n", line] if pragma else [line, "\n"]
    return "".join(lines[:pragma] + new + lines[pragma:])


def check(root, fix=False):
    """Missing headers below root as lines of text, and the number of files. With `fix` inserts them."""
    found = []
    files = cpp_text.files_below(root)
    # Headers first: what is inserted there is there for the .cpp files beside them.
    for path in sorted(files, key=lambda path: path.suffix != ".hpp"):
        text = path.read_text(encoding="utf-8")
        lacks = missing(path, text)
        name = path.relative_to(root)
        found += [f"{name}:{number}: {used} needs <{header}>" for header, (number, used) in lacks.items()]
        if fix and lacks:
            for header in lacks:
                text = insert(path, text, header)
            path.write_text(text, encoding="utf-8")
    return sorted(found), len(files)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=Path(__file__).resolve().parent.parent, type=Path)
    parser.add_argument("--fix", action="store_true", help="insert what is missing")
    options = parser.parse_args()
    found, count = check(options.root, options.fix)
    if options.fix:
        print(f"{count} files, {len(found)} includes inserted")
        return 0
    for line in found:
        print(line)
    print(f"{count} files, {len(found)} missing includes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
