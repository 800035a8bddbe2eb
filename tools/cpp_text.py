"""C++ files as the checks of the source read them."""

import re
from pathlib import Path

FOLDERS = ("src", "tests", "bench")
SUFFIXES = {".hpp", ".cpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')

_NOT_CODE = re.compile(
    r"""//(?:[^\n\\]|\\.|\\\n)*          # comment to the end of the line
      | /\*.*?\*/                        # comment
      | \bR"(?P<mark>[^()\\\s]*)\(.*?\)(?P=mark)"
      | "(?:[^"\\\n]|\\.)*"
      | (?<![0-9a-fA-F])'(?:[^'\\\n]|\\.)+'  # a character, not the mark between digits
    """,
    re.DOTALL | re.VERBOSE,
)


def files_below(root):
    """All C++ files of the project below root, sorted."""
    folders = (Path(root) / folder for folder in FOLDERS)
    return sorted(path for folder in folders for path in folder.rglob("*") if path.suffix in SUFFIXES)


def _spaces(match):
    return re.sub(r"[^\n]", " ", match.group())


def code_of(text):
    """`text` with comments, strings and characters as spaces; every line stays where it is."""
    return _NOT_CODE.sub(_spaces, text)


def without_directives(code):
    """`code` with preprocessor lines, and the lines that continue them, as spaces."""
    return re.sub(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", _spaces, code, flags=re.MULTILINE)


def includes_of(text):
    """(line number, '<' or '"', header) of each include in `text`."""
    lines = enumerate(text.splitlines(), start=1)
    return [(number, *match.groups()) for number, line in lines if (match := INCLUDE.match(line))]


def line_of(text, position):
    return text.count("\n", 0, position) + 1
