"""Reads what `recoil commands` prints: the commands and options that the program declares.

Run as a program it writes the manual page from it: recoil commands | tools/command_page.py VERSION > recoil.1
"""

import dataclasses
import re
import sys

ROW = re.compile(r"^\| (.*?[^\\]) \| (.*) \|$")

# What the page says besides the commands; exit codes are those of docs/conventions.md.
SYNOPSIS = [r"\fBrecoil\fR \fICOMMAND\fR [\fIARGUMENTS\fR]", r"\fBrecoil\fR [\fICOMMAND\fR] \fB\-\-help\fR | \fB\-\-version\fR"]
DESCRIPTION = """\
Recoil computes the impact of solids: bodies collide, slide and separate, each with its own sharp surface on a fixed
Cartesian mesh. A case is a TOML file in which every quantity carries its unit. `recoil new` writes one to start from, `recoil check`
finds its mistakes and predicts its answer, `recoil run` computes it."""
EXIT_CODES = [
    ("0", "finished, nothing to remark"), ("1", "internal error"), ("2", "bad input or usage"), ("3", "numerical failure"),
    ("4", "environment: disk, memory, MPI"), ("5", "finished, but an expectation failed"), ("6", "finished, but the verdict is doubtful"),
    ("75", "stopped with a checkpoint; `recoil resume` goes on"),
]  # fmt: skip
ENVIRONMENT = [
    ("RECOIL_DATA", "folder that holds materials/, cases/ and templates/, instead of that beside the program"),
    ("RECOIL_MATERIALS", "folders of materials of your own, with : between them"),
]


@dataclasses.dataclass
class Option:
    """An option, or an argument by its place (then without names). `value` is the name of what it takes, "" for a flag."""

    names: list[str]
    value: str
    doc: str


@dataclasses.dataclass
class Command:
    """`path` is "material show", `usage` the words behind it that must be given."""

    path: str
    usage: str
    doc: str
    options: list[Option]

    def arguments(self):
        """The least and the largest number of arguments by their place (None: any number)."""
        places = [o.value for o in self.options if not o.names]
        least = sum(f"[{p}]" not in self.usage for p in places)
        return least, None if any(p.endswith("...") for p in places) else len(places)

    def option(self, name):
        """The option of that name, or None."""
        return next((o for o in self.options if name in o.names), None)


def read(text):
    """The commands of the page, in its order."""
    commands = []
    for line in text.splitlines():
        if head := re.match(r"^`recoil ([a-z ]*[a-z])( .*)?`: (.*)\.$", line):
            commands.append(Command(head[1], (head[2] or "").strip(), head[3], []))
        elif (row := ROW.match(line)) and commands:
            words = re.findall(r"`([^`]*)`", row[1].replace("\\|", "|"))
            names = [w for w in words if w.startswith("-")]
            value = next((w for w in words if not w.startswith("-")), "")
            commands[-1].options.append(Option(names, value, row[2].replace("\\|", "|")))
    return commands


def roff(text):
    """Text for a manual page: nothing in it is a request, and `words` are bold."""
    text = text.replace("\\", r"\e").replace("-", r"\-").replace("'", r"\(aq")
    text = re.sub(r"`([^`]*)`", r"\\fB\1\\fR", text)
    return "\n".join("\\&" + line if line.startswith(".") else line for line in text.splitlines())


def option_entry(option):
    names = ", ".join(r"\fB" + roff(n) + r"\fR" for n in option.names)
    value = r"\fI" + roff(option.value) + r"\fR" if option.value else ""
    return f".TP\n{' '.join(w for w in (names, value) if w)}\n{roff(option.doc)}"


def manual(commands, version):
    """The manual page recoil(1) of these commands."""
    lines = [f'.TH RECOIL 1 "" "recoil {version}" "User Commands"', ".SH NAME", r"recoil \- hydrocode for the impact of solids"]
    lines += [".SH SYNOPSIS", "\n.br\n".join(SYNOPSIS), ".SH DESCRIPTION", roff(DESCRIPTION), ".SH COMMANDS"]
    for c in commands:
        lines += [f'.SS "recoil {roff(c.path)} {roff(c.usage)}"', roff(c.doc[0].upper() + c.doc[1:] + ".")]
        lines += [option_entry(o) for o in c.options]
    for title, entries in (("EXIT STATUS", EXIT_CODES), ("ENVIRONMENT", ENVIRONMENT)):
        lines.append(f".SH {title}")
        lines += [f".TP\n\\fB{roff(name)}\\fR\n{roff(doc)}" for name, doc in entries]
    lines += [".SH SEE ALSO", roff("`recoil explain KEY` explains a key of a case file; `recoil COMMAND --help` prints what stands here.")]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.stdout.write(manual(read(sys.stdin.read()), sys.argv[1]))
