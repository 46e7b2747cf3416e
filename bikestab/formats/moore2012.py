"""Axes along the steering axis (Moore 2012): bodies C, D, E and F there → the 25 parameters.

Axis 3 points down along the steering axis, axis 1 forward across it. ``d1`` and ``d3`` are the distances of
the rear and the front wheel's centre from the steering axis, ``d2`` what lies between their feet along it;
``l1 l2`` lead from the rear wheel's centre to the frame's centre of mass, ``l3 l4`` from the front one's to
the fork's. So the inertia of the fork about the steering axis is ``ie33`` and what its mass adds.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bikestab.errors import InputError
from bikestab.formats.found import quantities

MOORE2012: dict[str, str] = {
    "d1": "rear wheel's centre to the steering axis [m]",
    "d2": "between the feet of d1 and d3, along the steering axis [m]",
    "d3": "front wheel's centre ahead of the steering axis [m]",
    "l1": "frame's centre of mass ahead of the rear wheel's centre, across the steering axis [m]",
    "l2": "frame's centre of mass below the rear wheel's centre, along the steering axis [m]",
    "l3": "fork's centre of mass ahead of the front wheel's centre, across the steering axis [m]",
    "l4": "fork's centre of mass below the front wheel's centre, along the steering axis [m]",
    "rr": "rear wheel radius [m]",
    "rf": "front wheel radius [m]",
    "g": "acceleration due to gravity [m/s²]",
}
_BODIES = {
    "c": ("B", "frame"),
    "d": ("R", "rear wheel"),
    "e": ("H", "fork and handlebar"),
    "f": ("F", "front wheel"),
}
for _body, (_, _name) in _BODIES.items():
    MOORE2012 |= {f"m{_body}": f"mass of the {_name} [kg]"}
    _axes = ("11", "22", "31", "33") if _body in "ce" else ("11", "22")
    MOORE2012 |= {f"i{_body}{axes}": f"inertia of the {_name} [kg m²]" for axes in _axes}
IGNORED = {"v", "d4", "d5"}  # a speed, and where a side force acts
_MUST_BE = dict.fromkeys(("ic12", "ic23", "ie12", "ie23"), "") | {"id33": "id11", "if33": "if11"}
MOORE2012 |= dict.fromkeys(_MUST_BE, "follows from symmetry [kg m²]")
_OPTIONAL = {"g", "ic22", "ie22", *_MUST_BE}
_SAME = 1e-6


def converted(values: Mapping[Any, Any]) -> dict[str, float]:
    """The 25 parameters; InputError, with its key, for a mistake, and for bodies that are not symmetric."""
    n = quantities(values, MOORE2012, optional=_OPTIONAL, ignored=IGNORED)
    for key, other in _MUST_BE.items():
        if abs(n.get(key, n.get(other, 0.0)) - n.get(other, 0.0)) > _SAME:
            hint = (
                f"allowed: {other} = {n[other]:.9g}"
                if other
                else "allowed: 0, as of bodies that are symmetric"
            )
            raise InputError(f"{n[key]:.9g} is not what the equations have", key=(key,), hint=hint)
    lam = _tilt(n)
    sin, cos = math.sin(lam), math.cos(lam)
    w = (n["d1"] + n["d3"]) * cos + n["d2"] * sin
    found = {"w": w, "c": (n["rf"] * sin - n["d3"]) / cos, "lam": lam, "rR": n["rr"], "rF": n["rf"]}
    found |= {"g": n["g"]} if "g" in n else {}
    for body, (letter, _) in _BODIES.items():
        found[f"m{letter}"] = n[f"m{body}"]
        if body in "df":
            found |= {f"I{letter}xx": n[f"i{body}11"], f"I{letter}yy": n[f"i{body}22"]}
    for body, letter, x, z, across, along in (
        ("c", "B", 0.0, -n["rr"], n["l1"], n["l2"]),
        ("e", "H", w, -n["rf"], n["l3"], n["l4"]),
    ):
        found |= {f"x{letter}": x + across * cos + along * sin, f"z{letter}": z - across * sin + along * cos}
        i11, i31, i33 = (n[f"i{body}{axes}"] for axes in ("11", "31", "33"))
        found[f"I{letter}xx"] = i11 * cos * cos + 2 * i31 * sin * cos + i33 * sin * sin
        found[f"I{letter}zz"] = i11 * sin * sin - 2 * i31 * sin * cos + i33 * cos * cos
        found[f"I{letter}xz"] = (i33 - i11) * sin * cos + i31 * (cos * cos - sin * sin)
        if f"i{body}22" in n:
            found[f"I{letter}yy"] = n[f"i{body}22"]
    return found


def _tilt(n: Mapping[str, float]) -> float:
    """The tilt [rad] with which both wheels stand on the ground: d2 cos λ − (d1 + d3) sin λ = rr − rf."""
    across, along, higher = n["d1"] + n["d3"], n["d2"], n["rr"] - n["rf"]
    if not abs(higher) < math.hypot(across, along):
        problem = (
            f"with these d1, d2 and d3 wheels of {n['rr']:g} and {n['rf']:g} m cannot stand on one ground"
        )
        raise InputError(problem, key=("d2",), hint="allowed: |rr - rf| below the distance of the axles")
    return math.acos(higher / math.hypot(across, along)) - math.atan2(across, along)
