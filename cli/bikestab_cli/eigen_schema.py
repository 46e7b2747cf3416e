"""The JSON Schema of what eigen prints with --json."""

from __future__ import annotations

from bikestab_cli.shapes import (
    DESIGN,
    INTERVALS,
    NUMBERS,
    OVER,
    TEXTS,
    VERDICT,
    WHOSE,
    named,
    num,
    of_machines,
    or_problems,
    record,
    some,
    words,
)

_BRANCHES = some(
    record(
        "one continuous branch", branch=words("what it is at high speeds"),
        name=some(TEXTS, "its name at each speed"), re=some(NUMBERS, "real part [1/s]"),
        im=some(NUMBERS, "imaginary part [rad/s]"),
    ),
    "the four eigenvalues",
)  # fmt: skip
_COALESCENCES = some(
    record(
        "two eigenvalues meet", V=num("at this speed [m/s]"), branches=some({"type": "integer"}, "which two"),
        below=some(TEXTS, "their names below it"), above=some(TEXTS, "and above"),
    ),
    "where eigenvalues go from real to complex or back",
)  # fmt: skip
_PHASOR = record("a complex number; the larger of the two is 1", re=num("real"), im=num("imaginary"))
_SHAPES = some(
    record(
        "an eigenvalue", name=words("its mode"), re=num("[1/s]"), im=num("[rad/s]"),
        roll=_PHASOR, steer=_PHASOR,
    ),
    "the four eigenvalues at the speed, with --shapes",
)  # fmt: skip
_MOTION = record(
    "the motion, with --push; positive to the right",
    t=some(NUMBERS, "times [s]"), roll=some(NUMBERS, "[rad]"), steer=some(NUMBERS, "[rad]"),
    roll_rate=some(NUMBERS, "[rad/s]"), steer_rate=some(NUMBERS, "[rad/s]"), yaw=some(NUMBERS, "[rad]"),
    x=some(NUMBERS, "rear contact, along the road [m]"), y=some(NUMBERS, "rear contact, sideways [m]"),
    y_front=some(NUMBERS, "front contact, sideways [m]"),
    x_front=some(NUMBERS, "front contact, along the road [m]"),
)  # fmt: skip
_PUSH = {"type": "object", "additionalProperties": NUMBERS, "description": "states at the start [rad, rad/s]"}
_RANGES = some(
    record(
        "values of the parameter, from one to the other, in which motion is stable at the speed",
        ("bicycle", "set"), **WHOSE, at=num("the speed [m/s]"),
        start=named(NUMBERS, "an exact end of stability, or the least value of --over, in SI units"),
        stop=named(NUMBERS, "the same above it, or the greatest value"),
    ),
    "with --over: where the parameter's values are stable at the speed",
)  # fmt: skip
_ALONG = ("intervals", "marginal", "coalescences", "V", "branches")  # without --shapes and --push
_EIGEN = of_machines(
    "a design; with --shapes or --push what these give",
    (*_ALONG, "over", "at", "shapes", "push", "motion"),
    over=OVER, **DESIGN, intervals=INTERVALS, **VERDICT, coalescences=_COALESCENCES,
    V=some(NUMBERS, "speeds [m/s]"), branches=_BRANCHES, at=num("the speed [m/s]"), shapes=_SHAPES,
    push=_PUSH, motion=_MOTION,
)  # fmt: skip
_RESULTS = _EIGEN["properties"]["results"]
_KINDS = (_ALONG, ("at", "shapes"), ("at", "push", "motion"))  # of results: each has all of one, and no other
_RESULT = {**_RESULTS["items"], "oneOf": [{"required": [*kind]} for kind in _KINDS]}
EIGEN = or_problems(
    {
        **_EIGEN,
        "properties": {
            **_EIGEN["properties"], "results": {**_RESULTS, "items": _RESULT}, "ranges": _RANGES,
        },
    }
)  # fmt: skip
