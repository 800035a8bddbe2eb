#!/usr/bin/env python3
"""Checks the sizes of functions, files and folders, and that no headers include each other in a ring.

At most: 60 lines a function (of C++: from its head, without `template <...>`, to its closing brace), 400 lines a file, 30 files of
source a folder; in src/, tests/, bench/, python/ and tools/. Prints one line for each breach, `file:line: what`, and exits with 1 if
there was any.

C++ is read by its braces, not parsed. A brace opens a function where it stands outside of functions and follows `)`, with
const, noexcept, a return type or a list of members between them. A lambda belongs to the function that it stands in; outside of
functions it counts as one itself. Bodies that a macro writes are not seen, and braces that do not balance because of #if would
mislead the count, so a file whose braces do not balance is a breach too.
"""

import ast
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import cpp_text  # noqa: E402

FUNCTION_LINES = 60
FILE_LINES = 400
FOLDER_FILES = 30

SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b[^()=]*$")
AFTER_PARAMETERS = re.compile(r"\)\s*(?:(?:const|noexcept|override|final|mutable|try|&&?)\s*)*(?:->[^;]*)?$")
MEMBERS = re.compile(r"\)\s*(?:noexcept\s*)?:[^:].*[)}]\s*$", re.DOTALL)
NAME = re.compile(r"((?:\w+(?:<[^<>()]*>)?::)*(?:operator[^\w\s(]+|operator\(\)|~?\w+))\s*(?:<[^<>()]*>)?\s*\(")
LAMBDA = re.compile(r"(?<!operator)\[[^\[\]]*\]\s*(?:<[^<>]*>\s*)?\((?:[^()]|\([^()]*\))*\)[^()]*$")
NOT_A_NAME = {"decltype", "requires", "noexcept", "alignas", "explicit"}


class Unbalanced(Exception):
    """A closing brace too many, or one too few; holds the line."""


def template_skipped(code, start, end):
    """Where the head code[start:end] begins behind `template <...>`."""
    while match := re.compile(r"\s*template\s*<").match(code, start, end):
        depth, start = 1, match.end()
        while depth and start < end:
            depth += {"<": 1, ">": -1}.get(code[start], 0)
            start += 1
    return start


def name_of(head):
    names = (match[1] for match in NAME.finditer(head) if match[1] not in NOT_A_NAME)
    return next(names, "without a name")


def beginning(code, start, brace):
    """Where the function begins whose body opens at `brace`, in the statement that begins at `start`; its name."""
    if match := LAMBDA.search(code, start, brace):
        return match.start(), "lambda"
    start = template_skipped(code, start, brace)
    start += len(code[start:brace]) - len(code[start:brace].lstrip())
    return start, name_of(code[start:brace])


def opens_function(head):
    """Whether the brace behind `head`, which stands outside of functions, opens the body of one."""
    if SCOPE.search(head):
        return False
    return bool(AFTER_PARAMETERS.search(head) or MEMBERS.search(head))


def cpp_functions(text):
    """(first line, name, lines) of each function of a C++ file. @raises Unbalanced."""
    code = cpp_text.without_directives(cpp_text.code_of(text))
    code = re.sub(r"\b(public|private|protected)\s*:", lambda m: " " * len(m.group()), code)
    stack = []  # (kind, where the head began, where the brace is)
    head, inside = 0, 0  # where the present statement began; depth of braces within a function
    for match in re.finditer(r"[{};]", code):
        where = match.start()
        if match.group() == "{":
            if inside:
                inside += 1
            elif SCOPE.search(code, head, where):
                stack.append(("scope", head, where))
                head = where + 1
            elif opens_function(code[head:where]):
                stack.append(("function", head, where))
                inside = 1
            else:
                stack.append(("value", head, where))
                head = where + 1
        elif match.group() == "}":
            if inside > 1:
                inside -= 1
                continue
            if not stack:
                raise Unbalanced(cpp_text.line_of(code, where))
            kind, began, brace = stack.pop()
            inside = 0
            head = where + 1
            if kind == "value":  # the statement goes on: `a{1}, b{2}`, a list of members
                head = began
            elif kind == "function":
                start, name = beginning(code, began, brace)
                first = cpp_text.line_of(code, start)
                yield first, name, cpp_text.line_of(code, where) - first + 1
        elif not inside:
            head = where + 1
    if stack:
        raise Unbalanced(cpp_text.line_of(code, stack[-1][2]))


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.lineno, node.name, node.end_lineno - node.lineno + 1


def file_breaches(path):
    """(line, text) of each breach in one file."""
    text = path.read_text(encoding="utf-8")
    length = len(text.splitlines())
    if length > FILE_LINES:
        yield 1, f"file of {length} lines, {FILE_LINES} allowed"
    try:
        functions = list(python_functions(text) if path.suffix == ".py" else cpp_functions(text))
    except Unbalanced as error:
        yield error.args[0], "braces do not balance"
        return
    for line, name, lines in functions:
        if lines > FUNCTION_LINES:
            yield line, f"function {name} of {lines} lines, {FUNCTION_LINES} allowed"


def rings(files, root):
    """(file, line, text) of each ring of includes below src/, once for each include that closes one."""
    source = root / "src"
    graph = {}
    for path in files:
        if source in path.parents:
            graph[path.relative_to(source).as_posix()] = [
                (line, header) for line, _, header in cpp_text.includes_of(path.read_text(encoding="utf-8"))
            ]
    done, way = set(), []

    def visit(header):
        way.append(header)
        for line, next_header in graph[header]:
            if next_header in way:
                ring = " -> ".join(way[way.index(next_header) :] + [next_header])
                yield f"src/{header}", line, f"headers include each other: {ring}"
            elif next_header in graph and next_header not in done:
                yield from visit(next_header)
        way.pop()
        done.add(header)

    for header in sorted(graph):
        if header not in done:
            yield from visit(header)


def check(root):
    """All breaches below root as lines of text, and the number of files."""
    root = Path(root)
    cpp = cpp_text.files_below(root)
    python = [path for folder in (*cpp_text.FOLDERS, "python", "tools") for path in sorted((root / folder).rglob("*.py"))]
    found = [
        f"{path.relative_to(root)}:{line}: {what}" for path in cpp + python for line, what in file_breaches(path)
    ]
    folders = {}
    for path in cpp + python:
        folders.setdefault(path.parent, []).append(path)
    for folder, inside in sorted(folders.items()):
        if len(inside) > FOLDER_FILES:
            found.append(f"{folder.relative_to(root)}:1: folder of {len(inside)} files, {FOLDER_FILES} allowed")
    found += [f"{name}:{line}: {what}" for name, line, what in rings(cpp, root)]
    return found, len(cpp + python)


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    found, count = check(root)
    for line in found:
        print(line)
    print(f"{count} files, {len(found)} too large or in a ring")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
