"""Numbers of a run by the names that [expect] of a case understands (docs/reference/results.md).

They are computed from the tables that a run leaves, by the same rules as in the program. What the tables do not tell
is known where the case expects it: then the program has computed it.
"""

import math

import numpy

from .errors import InputError, UnknownName, unknown
from .tables import series
from .units import convert

CONTACT = ("made", "opens", "separates", "recloses", "reopens", "first-lift-off", "last-lift-off", "lasts")
EVENTS = ("contact", "opening", "separation", "reclosure", "ricochet", "lift-off", "failure", "fragment")
NAN = float("nan")
SAME = 1e-9  # part of the time within which ends of spans and of curves are one


# Of a record: t and y without NaN, as arrays.


def value_at(t, y, when):
    slack = SAME * abs(when)
    inside = len(t) and t[0] - slack <= when <= t[-1] + slack
    return float(numpy.interp(when, t, y)) if inside else NAN


def knots(t, start, end):
    """Where the record may bend between two ends; empty where it does not reach that far."""
    if not end > start:
        raise InputError(f"the span {start}..{end} is empty")
    slack = SAME * max(abs(start), abs(end))
    if not len(t) or start < t[0] - slack or end > t[-1] + slack:
        return numpy.zeros(0)
    return numpy.concatenate([[start], t[(t > start) & (t < end)], [end]])


def mean_over(t, y, start, end):
    at = knots(t, start, end)
    values = numpy.interp(at, t, y)
    return float(numpy.sum(numpy.diff(at) * (values[:-1] + values[1:]) / 2)) / (end - start) if len(at) else NAN


def rms_over(t, y, start, end):
    at = knots(t, start, end)
    if not len(at):
        return NAN
    off = numpy.interp(at, t, y) - mean_over(t, y, start, end)
    a, b = off[:-1], off[1:]
    return math.sqrt(float(numpy.sum(numpy.diff(at) * (a * a + a * b + b * b) / 3)) / (end - start))


def slope_over(t, y, start, end):
    at = knots(t, start, end)
    if not len(at):
        return NAN
    a, b = numpy.interp(at, t, y)[:-1], numpy.interp(at, t, y)[1:]
    s, e = (at - (start + end) / 2)[:-1], (at - (start + end) / 2)[1:]
    return 2 * float(numpy.sum(numpy.diff(at) * (a * (2 * s + e) + b * (s + 2 * e)))) / (end - start) ** 3


def unit_of_slope(unit, over):
    """`mm` over `us` is `mm/us`, `m/s` over it `m/(s us)`."""
    above, _, below = unit.partition("/")
    return f"{above}/({below.strip('()')} {over})" if below else f"{above}/{over}"


def crossing(t, y, k, level):
    """Where the line from record k - 1 to record k has a level."""
    return float(t[k - 1] + (level - y[k - 1]) / (y[k] - y[k - 1]) * (t[k] - t[k - 1]))


def arrival_at(t, y, level):
    if not len(t):
        return NAN
    there = numpy.flatnonzero(y >= level if y[0] < level else y <= level)
    if not len(there):
        return NAN
    return float(t[0]) if there[0] == 0 else crossing(t, y, there[0], level)


def last_at(t, y, level):
    crossed = numpy.flatnonzero((y[1:] < level) != (y[:-1] < level))
    return crossing(t, y, crossed[-1] + 1, level) if len(crossed) else NAN


def pull_back(y):
    """The fall from the largest value to the lowest behind it, before a rise by a tenth of that fall.

    A fall by 1 % of the largest value or less is noise on a plateau.
    """
    if not len(y):
        return NAN
    after = y[numpy.argmax(y) :]
    lowest = numpy.minimum.accumulate(after)
    fall = after[0] - lowest
    risen = numpy.flatnonzero((fall > 0.01 * abs(after[0])) & (after - lowest > 0.1 * fall))
    return float(fall[risen[0]]) if len(risen) else NAN


def extreme(t, y, pick, span):
    at = knots(t, *span) if span else t
    return float(pick(numpy.interp(at, t, y))) if len(at) else NAN


WITHOUT_ARGUMENT = {
    "peak": lambda y: float(y[numpy.argmax(numpy.abs(y))]) if len(y) else NAN,
    "last": lambda y: float(y[-1]) if len(y) else NAN,
    "pullback": pull_back,
}
AT_A_LEVEL = {"arrival": arrival_at, "until": last_at}
OVER_A_SPAN = {"mean": mean_over, "rms": rms_over, "slope": slope_over}
EXTREMES = {"max": numpy.max, "min": numpy.min}
REDUCTIONS = (*WITHOUT_ARGUMENT, *AT_A_LEVEL, *OVER_A_SPAN, *EXTREMES)


def gauge_value(run, name):
    """Value and unit of `gauge.NAME.COLUMN`, then `@TIME` or `.reduction@argument`."""
    name, _, argument = name.partition("@")
    rest, _, how = name.rpartition(".")
    if how not in REDUCTIONS:
        if not argument:
            raise unknown("value of a record", how, (*REDUCTIONS, "@TIME"))
        rest, how = name, "at"
    column = run.series(rest)
    unit, over = column.attrs["unit"], column.attrs["units"][column.index.name]
    column = column.dropna()
    t, y = column.index.to_numpy(float), column.to_numpy(float)
    if bool(argument) == (how in WITHOUT_ARGUMENT) and how not in EXTREMES:
        raise InputError(f"{how!r} needs an argument after '@'" if not argument else f"{how!r} takes nothing after '@'")
    if how in WITHOUT_ARGUMENT:
        return WITHOUT_ARGUMENT[how](y), unit
    if how == "at":
        return value_at(t, y, convert(argument, over)), unit
    if how in AT_A_LEVEL:
        return AT_A_LEVEL[how](t, y, convert(argument, unit)), over
    span = [convert(end, over) for end in argument.split("..")] if argument else None
    if span and len(span) != 2:
        raise InputError(f"{argument!r} is not a span such as 0.2us..0.5us")
    if how in EXTREMES:
        return extreme(t, y, EXTREMES[how], span), unit
    return OVER_A_SPAN[how](t, y, *span), unit_of_slope(unit, over) if how == "slope" else unit


def contacts(run):
    """Times [us] in the order of CONTACT, for each pair that has touched."""
    events = run.events
    found = {}
    for pair in events.loc[events["event"] == "contact", "bodies"].unique():
        own = events[events["bodies"] == pair]

        def when(kind, number=0, own=own):
            times = own.loc[own["event"] == kind, "time"].to_list()
            return times[number] if -len(times) <= number < len(times) else NAN

        made, opens = when("contact"), when("opening")
        found[pair] = (made, opens, when("separation"), when("reclosure"), when("opening", 1), when("lift-off"),
                       when("lift-off", -1), opens - made)  # fmt: skip
    return found


def contact_value(run, name):
    """Value and unit of `contact.A-B.WHAT`; the bodies in either order."""
    _, pair, what = (name.split(".", 2) + ["", ""])[:3]
    first, _, second = pair.partition("-")
    for body in (first, second):
        if body not in run.bodies:
            raise unknown("body", body, run.bodies)
    if what not in CONTACT:
        raise unknown("value of a contact", what, CONTACT)
    found = contacts(run)
    times = found.get(pair) or found.get(f"{second}-{first}")
    return (times[CONTACT.index(what)] if times else NAN), "us"


def failure_value(run, name):
    """Value and unit of `failure.BODY.time`, or of a place along an axis."""
    _, body, what = (name.split(".", 2) + ["", ""])[:3]
    if body not in run.bodies:
        raise unknown("body", body, run.bodies)
    if what != "time" and what not in run.axes:
        raise unknown("value of a failure", what, ("time", *run.axes))
    events = run.events
    first = events[(events["event"] == "failure") & (events["bodies"] == body)].head(1)
    column, unit = ("time", "us") if what == "time" else (f"place.{what}", "mm")
    return (float(first[column].iloc[0]) if len(first) else NAN), unit


def body_value(run, name):
    """Value and unit of `body.NAME.QUANTITY` at the end, from the history or from a gauge of that body."""
    _, body, what = (name.split(".", 2) + ["", ""])[:3]
    if body not in (*run.bodies, "total"):
        raise unknown("body", body, (*run.bodies, "total"))
    history = run.history

    def last(column):
        return float(series(history, f"{body}.{column}").iloc[-1])

    head, _, axis = what.partition(".")
    if what == "energy":
        return last("kinetic") + last("internal"), history.attrs["units"][f"{body}.kinetic"]
    if head == "velocity":
        return last(f"momentum.{axis}" if axis else "momentum") / last("mass"), "m/s"
    if f"{body}.{what}" in history:
        return last(what), history.attrs["units"][f"{body}.{what}"]
    for gauge, entry in run.case.get("gauge", {}).items():
        if entry["kind"] == "body" and entry["body"] == body:
            return gauge_value(run, f"gauge.{gauge}.{what}.last")
    raise InputError(f"the tables of {run.folder} do not tell {name!r}: add a gauge of kind body, or an expectation")


def fragments_value(run, name):
    """Value and unit of `fragments.BODY.pieces`, `.rubble-mass`, `.N.mass` and `.N.velocity.AXIS`, at the end."""
    _, body, what = (name.split(".", 2) + ["", ""])[:3]
    if body not in run.bodies:
        raise unknown("body", body, run.bodies)
    table = run.fragments
    units = table.attrs["units"]
    own = table[(table["time"] == table["time"].max()) & (table["body"] == body)]
    pieces = own[own["kind"] == "piece"]
    if what == "pieces":
        return float(len(pieces)), "1"
    if what == "rubble-mass":
        return float(own.loc[own["kind"] == "rubble", "mass"].sum()), units["mass"]
    number, _, column = what.partition(".")
    column = f"velocity.{run.axes[0]}" if column == "velocity" and len(run.axes) == 1 else column
    known = ("mass", *(f"velocity.{axis}" for axis in run.axes))
    if number not in ("1", "2", "3") or column not in known:
        raise unknown("value of fragments", what, ("pieces", "rubble-mass", *(f"1.{name}" for name in known)))
    place = int(number) - 1
    return (float(pieces[column].iloc[place]) if place < len(pieces) else NAN), units[column]


def counted_value(run, name):
    """Value and unit of `budget.NAME.WHAT`, `floor.NAME`, `run.steps` and `event.KIND`."""
    kind, _, rest = name.partition(".")
    if kind == "event":
        if rest not in EVENTS:
            raise unknown("event", rest, EVENTS)
        return bool((run.events["event"] == rest).any()), ""
    known = {"run": {"steps": run.summary["steps"]}, "floor": run.summary["floors"]}.get(kind)
    if kind == "budget":
        known = {f"{n}.{what}": x for n, one in run.summary["budgets"].items() for what, x in one.items()}
    if rest not in known:
        raise unknown(kind, rest, known)
    return float(NAN if known[rest] is None else known[rest]), "1"


KINDS = {
    "gauge": gauge_value,
    "contact": contact_value,
    "failure": failure_value,
    "fragments": fragments_value,
    "body": body_value,
    "budget": counted_value,
    "floor": counted_value,
    "run": counted_value,
    "event": counted_value,
}


def measure(run, name):
    """Value and unit of a quantity. @raises UnknownName, InputError."""
    kind = name.partition(".")[0]
    try:
        if kind not in KINDS:
            raise unknown("kind of quantity", kind, KINDS)
        return KINDS[kind](run, name)
    except (UnknownName, InputError):
        expected = run.summary["expect"].get(name, {}) if run.finished else {}
        if "value" not in expected:
            raise
        return (NAN if expected["value"] is None else expected["value"]), expected.get("unit", "1")
