"""Keys beside the 25 parameters that BicycleParameters' files have → left out where they agree with those.

Where one does not, the model is not that of the file, and both numbers are told.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from bikestab.errors import InputError
from bikestab.notation import MEIJAARD
from bikestab.units import quantity, shown, units_in

# What the equations do not know.
UNUSED = {
    "v": "a speed",
    "rider": "whether B has its rider",
    "xcl": "where a side force acts",
    "zcl": "where a side force acts",
    **dict.fromkeys(("lcs", "hbb", "lsp", "lst", "lamst", "whb", "LhbF", "LhbR"), "for placing a rider"),
}
_ZERO = {
    "yB", "yD", "yF", "yH", "yP", "yR", "xR", "alphaR", "alphaF",
    "IBxy", "IByz", "IHxy", "IHyz", "IRxz", "IFxz",
    *(f"kTphi_{state}" for state in ("phi", "del", "phid", "deld")),
}  # fmt: skip
_FEEDBACK = {
    "kTdel_phi": "k_phi",
    "kTdel_del": "k_delta",
    "kTdel_phid": "k_phidot",
    "kTdel_deld": "k_deltadot",
}
_MUST_BE: dict[str, tuple[str, Callable[[Mapping[str, float]], float]]] = {
    **{key: ("0", lambda n: 0.0) for key in _ZERO},
    "kRbb": ("kRaa", lambda n: n["kRaa"]),
    "kFbb": ("kFaa", lambda n: n["kFaa"]),
    "IRzz": ("IRxx", lambda n: n["IRxx"]),
    "IFzz": ("IFxx", lambda n: n["IFxx"]),
    "xF": ("w", lambda n: n["w"]),
    "zR": ("-rR", lambda n: -n["rR"]),
    "zF": ("-rF", lambda n: -n["rF"]),
    "d1": ("cos(lam) (w + c - rR tan(lam))", lambda n: _across(n, n["w"] + n["c"], n["rR"])),
    "d3": ("cos(lam) (rF tan(lam) - c)", lambda n: -_across(n, n["c"], n["rF"])),
}  # fmt: skip
_PARTS_OF_H = ("G", "S")  # handlebar and fork, where they were measured apart
CLOSE = 1e-6  # of SI units, and relative: positions that another program solved for carry 1e-8


def without_extras(values: Mapping[Any, Any]) -> tuple[dict[Any, Any], list[str]]:
    """The parameters alone, with a note on the others.

    InputError, with the key, for an extra one that contradicts the parameters.
    """
    kept, unused = dict(values), []
    agreeing: list[str] = []
    unchecked: list[str] = []
    numbers = _in_si(values)
    for key in values:
        if key in MEIJAARD:
            continue
        if key in _FEEDBACK:
            kept[_FEEDBACK[key]] = kept.pop(key)
            continue
        if key in UNUSED and (key != "rider" or isinstance(values[key], (bool, str, type(None)))):
            unused.append(key)
            del kept[key]
        elif key in _MUST_BE:
            checked = _check(key, values[key], numbers)
            (agreeing if checked else unchecked).append(key)
            del kept[key]
    apart = [key for key in values if _of_part(key)]
    for key in apart:
        del kept[key]
    notes = []
    if unused:
        notes.append(f"not in the equations, left out: {', '.join(unused)}")
    if agreeing:
        notes.append(f"follow from the others, and agree: {', '.join(agreeing)}")
    if unchecked:
        notes.append(f"cannot be compared with the others, left out: {', '.join(unchecked)}")
    if apart:
        notes.append(f"parts of H, left out: {', '.join(apart)}")
    return kept, ["; ".join(notes)] if notes else []


def _in_si(values: Mapping[Any, Any]) -> dict[str, float]:
    """The values that are numbers; others are told of where they are used."""
    numbers = {}
    for key, value in values.items():
        with suppress(InputError):
            numbers[key] = quantity(value, units_in(MEIJAARD.get(key, "")))
    return numbers


def _of_part(key: Any) -> bool:
    """Whether a key is of the handlebar or of the fork alone."""
    names = ("m{}", "x{}", "y{}", "z{}", "I{}xx", "I{}yy", "I{}zz", "I{}xz")
    return any(key == name.format(part) for part in _PARTS_OF_H for name in names)


def _check(key: str, value: Any, numbers: Mapping[str, float]) -> bool:
    """Whether the others were there to compare it with; InputError where it is no number or differs."""
    words, formula = _MUST_BE[key]
    if key not in numbers:
        raise InputError(
            f"{shown(value)} is not a number", key=(key,), hint=f"allowed: {words}, or leave it out"
        )
    try:
        wanted = formula(numbers)
    except KeyError:
        return False
    if not math.isclose(numbers[key], wanted, rel_tol=CLOSE, abs_tol=CLOSE):
        raise InputError(
            f"{numbers[key]:.9g} is not what the others say, {words} = {wanted:.9g}", key=(key,),
            hint="correct one of them, or leave this one out",
        )  # fmt: skip
    return True


def _across(n: Mapping[str, float], ahead: float, radius: float) -> float:
    """Distance of the steering axis from a wheel's centre, ``ahead`` of whose contact it meets the ground."""
    return math.cos(n["lam"]) * ahead - math.sin(n["lam"]) * radius
