"""Quantities with units, as cases and results write them: `3us`, `100 m/s`, `kg/(m s)`."""

import math
import re

from .errors import InputError

# Size in SI and exponents of m, s, kg, K and of the size of cells, in which contact gauges of
# earlier runs have their gaps.
BASE = {
    "m": (1, (1, 0, 0, 0, 0)),
    "s": (1, (0, 1, 0, 0, 0)),
    "g": (1e-3, (0, 0, 1, 0, 0)),
    "K": (1, (0, 0, 0, 1, 0)),
    "dx": (1, (0, 0, 0, 0, 1)),
    "Pa": (1, (-1, -2, 1, 0, 0)),
    "bar": (1e5, (-1, -2, 1, 0, 0)),
    "N": (1, (1, -2, 1, 0, 0)),
    "J": (1, (2, -2, 1, 0, 0)),
    "rad": (1, (0, 0, 0, 0, 0)),
    "deg": (math.pi / 180, (0, 0, 0, 0, 0)),
    "1": (1, (0, 0, 0, 0, 0)),
}
PREFIX = {"n": 1e-9, "u": 1e-6, "\u00b5": 1e-6, "\u03bc": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6, "G": 1e9}
NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$")
FACTOR = re.compile(r"([^\W\d]+|1)\^?(-?\d+)?$")


def _symbol(text):
    if text in BASE:
        return BASE[text]
    if text[:1] in PREFIX and text[1:] in BASE and text[1:] not in ("1", "dx", "deg"):
        size, exponents = BASE[text[1:]]
        return PREFIX[text[0]] * size, exponents
    raise InputError(f"unknown unit {text!r}")


def unit_of(text):
    """Size in SI and exponents of m, s, kg, K, dx of a unit such as `kg/(m s)`. @raises InputError."""
    size, exponents = 1.0, [0] * 5
    for sign, part in zip((1, -1), text.split("/", 1)):
        for word in re.sub(r"[()*]", " ", part).split():
            found = FACTOR.match(word)
            if not found:
                raise InputError(f"unknown unit {text!r}")
            power = sign * int(found[2] or 1)
            one, its = _symbol(found[1])
            size *= one**power
            exponents = [a + power * b for a, b in zip(exponents, its)]
    return size, tuple(exponents)


def split(text):
    """Number and unit of `500 m/s`; the unit is empty where there is none. @raises InputError."""
    found = NUMBER.match(text)
    if not found:
        raise InputError(f"{text!r} is not a number with a unit")
    return float(found[1]), found[2]


def convert(value, unit):
    """A number, or a text such as `3 us`, in a unit; a number without a unit has that one. @raises InputError."""
    if not isinstance(value, str):
        return float(value)
    number, own = split(value)
    if not own:
        return number
    (size, exponents), (wanted, needed) = unit_of(own), unit_of(unit)
    if exponents != needed:
        raise InputError(f"{value!r} is not a quantity in {unit}")
    return number * size / wanted
