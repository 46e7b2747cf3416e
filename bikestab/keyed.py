"""The keys and values of a file → the numbers of one machine, in one of the two notations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from bikestab.errors import InputError, Mistakes, nearest
from bikestab.gains import GAINS
from bikestab.limits import require
from bikestab.notation import MEASURED, MEIJAARD, OPTIONAL
from bikestab.rider import RIDER, flattened
from bikestab.units import quantity, shown, units_in

_OPTIONAL = {"g", "delta", "D1", "D2", "lam", "sigma", "trail", "R", "R1", "R2"}  # of the paper's notation


class Keyed(NamedTuple):
    """Whether these are the 25 parameters or the paper's; the numbers; ``name`` and ``source``."""

    meijaard: bool
    numbers: dict[str, float]
    texts: dict[str, str]


def keyed(values: Mapping[Any, Any], paper: Mapping[str, str], name: str) -> Keyed:
    """All numbers that a machine needs; ``paper`` has the keys of the paper's notation.

    InputError names a key that is unknown, missing or of a value that cannot be.
    """
    values = flattened(values)
    texts: dict[str, str] = {"name": name, "source": ""}
    for key in texts:
        if (text := values.pop(key, None)) is not None:
            if not isinstance(text, str):
                raise InputError(f"{shown(text)} is not text", key=(key,), hint="put it into quotes")
            texts[key] = str(text)  # YAML readers give subclasses
    meijaard = _is_meijaard(values, paper)
    notation = {**MEIJAARD, **RIDER} if meijaard else paper
    known = {**notation, **MEASURED, **GAINS}
    mistakes, numbers = Mistakes(), {}
    for key, value in values.items():
        with mistakes.kept():
            if key not in known:
                other = " (a key of the other notation)" if key in {**MEIJAARD, **RIDER, **paper} else ""
                raise InputError(
                    f"unknown parameter{other}",
                    key=(str(key),),
                    hint=nearest(str(key), [*known, "name", "source"]),
                )
            numbers[key] = quantity(value, units_in(known[key]), key=(key,))
    mistakes.tell()
    if MEASURED.keys() & numbers:
        from bikestab.geometry import in_notation  # most bicycles need no numpy

        numbers = in_notation(numbers, *(("w", "c") if meijaard else ("c", "sigma")))
    if meijaard:
        needed = notation if any(key in RIDER for key in numbers) else MEIJAARD
        require(numbers, [key for key in needed if key not in OPTIONAL], needed)
    else:
        _require_paper(numbers, paper)
    return Keyed(meijaard, numbers, texts)


def _is_meijaard(values: Mapping[Any, Any], paper: Mapping[str, str]) -> bool:
    only = [key for key in values if key in MEIJAARD and key not in paper]
    other = [key for key in values if key in paper and key not in MEIJAARD]
    return len(only) > len(other)


def _require_paper(numbers: dict[str, float], paper: Mapping[str, str]) -> None:
    """Check that nothing is missing, and put both radii in the place of ``R``."""
    if "R" in numbers:
        for key in ("R1", "R2"):
            if key in numbers:
                raise InputError("R and " + key + " are both given", key=(key,), hint="give R, or R1 and R2")
        numbers["R1"] = numbers["R2"] = numbers.pop("R")
    radii = ("R1", "R2") if "R1" in numbers or "R2" in numbers else ("R",)
    require(numbers, (*(key for key in paper if key not in _OPTIONAL), *radii), paper)
