"""Certificates of which bytes or parts are changed, left out or doubled."""

from __future__ import annotations

import copy
import json
from functools import cache
from hashlib import sha256
from typing import Any

import numpy as np
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.certify.proof import prove
from tests.fuzz.damage import damaged
from tests.fuzz.harness import Case

BOXES = [  # machine; λ, σ, V; tolerances; few blocks each, since a check takes 0.2 s of each
    ("dikarev1981", ((0.2, 0.21), (0.08, 0.081), (4.2, 4.5)), {}),
    ("dikarev1981", ((0.2, 0.2), (0.08, 0.08), (4.2, 4.3)), {"m1": (79.9, 80.1)}),
    ("meijaard2007", ((0.31, 0.32), (0.078, 0.079), (4.8, 5.6)), {}),
    ("kooijman2011", ((0.1, 0.1), (0.01, 0.01), (0.0, 1.0)), {}),
]
NASTY = [
    None, True, 0, -1, 3, 10**30, 1e308, float("nan"), "", "x", "0x1p0", "-0x1p-1074", "0x1p1023", "nan",
    "inf", "1e9", "9" * 400, "\0", "\ud800", [], {}, [[]], [0, 1], [[0, 1], 1], {"a": 1}, "four bodies",
    "unrefined", ["m1"] * 9, ["mB"], ["0x0p0"] * 30, "[" * 50,
]  # fmt: skip


@cache
def certificates() -> list[str]:
    """Sound ones."""
    made = []
    for name, box, tolerances in BOXES:
        edges = map(np.array, box)
        made.append(prove(Bicycle.preset(name), *edges, tolerances=tolerances).certificate("1"))
    return made


@st.composite
def damaged_certificates(draw: Any) -> Case:
    """A certificate that says something else, or nothing."""
    text = certificates()[draw(st.integers(0, len(BOXES) - 1))]
    if draw(st.booleans()):
        return Case(("certify", "--verify", "c"), {"c": draw(damaged(text.encode()))})
    whole = json.loads(text)
    for _ in range(draw(st.integers(1, 3))):
        _changed(draw, whole)
    if draw(st.integers(0, 3)):  # most have the hash of what they say
        told = json.dumps({**whole, "sha256": ""}, sort_keys=True)
        whole["sha256"] = sha256(told.encode()).hexdigest()
    return Case(("certify", "--verify", "c"), {"c": json.dumps(whole).encode()})


def _changed(draw: Any, part: Any) -> None:
    """Something at some depth in it is dropped, doubled, put in or replaced."""
    places = list(part) if isinstance(part, dict) else list(range(len(part)))
    if not places:
        return
    at = draw(st.sampled_from(places))
    if isinstance(part[at], (dict, list)) and draw(st.integers(0, 3)):
        _changed(draw, part[at])
        return
    kind = draw(st.sampled_from(["replace", "replace", "drop", "double"]))
    if kind == "drop":
        del part[at]
    elif kind == "double" and isinstance(part, list):
        part.append(part[at])
    else:
        part[at] = copy.deepcopy(draw(st.sampled_from(NASTY)))
