"""Shell commands in the pages of docs/: finds their blocks, and holds the commands of Recoil against what the program declares.

A block is shell if it is indented by four spaces, or fenced as ```sh or ```bash, and begins with one of STARTS. What the page
says right before it decides what becomes of it: nothing (it is run), or <!-- parsed only: REASON -->. The same with
"all parsed only" anywhere in a page holds for the whole page. A ```text block that follows shows lines that the commands print.
"""

import dataclasses
import pathlib
import re
import shlex
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import command_page  # noqa: E402

STARTS = re.compile(
    r"(recoil|make|cmake|ctest|docker|sudo|apt-get|mpirun|srun|sbatch|python3|export|source|git|(tools|build|\.ci)/\S+) |#!/bin/bash"
)
MARKER = re.compile(r"<!-- parsed only: .+ -->$")
WHOLE_PAGE = re.compile(r"^<!-- all parsed only: .+ -->$", re.M)
INLINE = re.compile(r"`(recoil [a-z][^`]*)`")


@dataclasses.dataclass
class Block:
    page: pathlib.Path
    line: int
    text: str
    kind: str  # "sh", "text", or another fence
    runs: bool = False

    def place(self):
        return f"{self.page.relative_to(ROOT)}:{self.line}"

    def commands(self):
        """Its lines without comments, continued ones joined."""
        joined = re.sub(r"\\\n\s*", "", self.text)
        found = [re.sub(r"(^|\s+)#.*$", "", line).strip() for line in joined.splitlines()]
        return [line for line in found if line]


def pages():
    """All pages with commands for users and developers."""
    own = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    return sorted(p for p in own if not {"reference", "site"} & set(p.relative_to(ROOT).parts)) + sorted((ROOT / "cases").glob("*/README.md"))


def raw_blocks(lines):
    """Fenced and indented blocks: the number of the line before, the kind of the fence, the lines."""
    n = 0
    while n < len(lines):
        begin = n
        if lines[n].startswith("```"):
            end = next(k for k in range(n + 1, len(lines)) if lines[k] == "```")
            yield begin, lines[n][3:], lines[n + 1 : end]
            n = end
        elif lines[n].startswith("    ") and n > 0 and not lines[n - 1]:
            while n + 1 < len(lines) and (lines[n + 1].startswith("    ") or not lines[n + 1]):
                n += 1
            yield begin, "", [line[4:] for line in lines[begin : n + 1]]
        n += 1


def blocks_of(page):
    """Shell blocks and blocks of output of a page, in their order."""
    text = page.read_text()
    parsed_only = WHOLE_PAGE.search(text) or page.is_relative_to(ROOT / "cases")
    lines, found = text.splitlines(), []
    for begin, kind, inside in raw_blocks(lines):
        if kind in ("", "sh", "bash") and STARTS.match(inside[0] + " "):
            before = next((line for line in reversed(lines[:begin]) if line), "")
            runs = not parsed_only and not MARKER.match(before)
            found.append(Block(page, begin + 1, "\n".join(inside), "sh", runs))
        elif kind == "text":
            found.append(Block(page, begin + 1, "\n".join(inside), kind))
    return found


def inline_commands(page):
    """Commands of Recoil in the middle of a sentence, with the line where they stand."""
    text = page.read_text()
    return [(text.count("\n", 0, m.start()) + 1, " ".join(m[1].split())) for m in INLINE.finditer(text)]


def pieces(command):
    """The commands of a line: split at |, &&, ; and so on; redirections go."""
    parser = shlex.shlex(command, posix=True, punctuation_chars="|&;<>()")
    parser.whitespace_split = True
    parser.commenters = ""
    words, all_words = [], []
    skip = False
    for token in parser:
        if token and set(token) <= set("|&;()"):
            all_words.append(words)
            words = []
        elif token and set(token) <= set("<>"):
            skip = True
        elif skip:
            skip = False
        else:
            words.append(token)
    return [w for w in [*all_words, words] if w]


def recoil_words(words):
    """The words behind the program's name where it is called, also behind sudo, mpirun -n 8 and docker run; else None."""
    for n, word in enumerate(words):
        if word == "recoil" or word.endswith("/recoil"):
            if n + 1 < len(words) and words[n + 1] in ("make", "recoil", "&&"):  # an image of that name
                continue
            if n > 0 and words[n - 1] in ("-t", "install", "remove"):
                return None
            return words[n + 1 :]
    return None


class Declared:
    """What the program declares, read from the page of its commands."""

    def __init__(self, text):
        self.commands = {c.path: c for c in command_page.read(text)}

    def find(self, words):
        """The command that the words begin with, and the rest."""
        for length in (2, 1):
            if (name := " ".join(words[:length])) in self.commands:
                return self.commands[name], words[length:]
        return None, words

    def mistake(self, words, whole=True):
        """What is wrong with these words behind `recoil`; None: nothing. whole=False: arguments may be missing."""
        if words[:1] in (["--version"], ["--help"]):
            return None
        command, rest = self.find(words)
        if command is None:
            groups = {path.split()[0] for path in self.commands}
            return None if not whole and words[0] in groups else f"there is no command `recoil {' '.join(words[:2])}`"
        places, waiting = 0, False
        for word in rest:
            if waiting:
                waiting = False
            elif word.startswith("-") and not re.match(r"-[\d.]", word) and len(word) > 1:
                option = command.option(word.split("=")[0])
                if option is None and word != "--help":
                    return f"`recoil {command.path}` has no option {word}"
                waiting = option is not None and option.value != "" and "=" not in word
            else:
                places += 1
        least, most = command.arguments()
        if waiting and whole:
            return f"{rest[-1]} takes a value"
        if (whole and places < least) or (most is not None and places > most):
            return f"`recoil {command.path}` takes {command.usage}, here are {places} arguments"
        return None
