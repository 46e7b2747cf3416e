"""Machines around a design: what is uncertain of it moves from the value that the design itself has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.geometry import offset_of
from bikestab.machines import Machines
from bikestab.variants import front_of, own_value, varied


def around(
    bicycle: Bicycle, design: Mapping[str, Any], steps: Mapping[str, Any]
) -> tuple[Bicycle | Machines, Any, Any]:
    """The machine or machines, λ [rad] and σ that are ``steps`` away from a design, SI, unchecked.

    ``design`` has values of free parameters as ``varied`` takes them, ``steps`` changes of uncertain ones;
    all broadcast together. Tilt, trail and offset move each with the others as they are, an offset with the
    tilt; all else from its value in the design, which may follow from what is free.
    """
    values = dict(design)
    centre: Bicycle | Machines = bicycle
    if any(name not in (*bicycle.notation, *design) for name in steps):
        centre = varied(bicycle, design)[0]
    away = {name: step for name, step in sorted(steps.items()) if front_of(bicycle, name)}
    for name, step in steps.items():
        if name not in away:
            for each in ("R1", "R2") if name == "R" and name not in design else (name,):
                values[each] = _own(bicycle, design, centre, each) + step
    return varied(bicycle, values, away)


def _own(bicycle: Bicycle, design: Mapping[str, Any], centre: Bicycle | Machines, name: str) -> Any:
    if name in design:
        return design[name]
    return own_value(bicycle, name) if name in bicycle.notation else getattr(centre, name)


def values_around(
    bicycle: Bicycle, design: Mapping[str, float], steps: Mapping[str, float]
) -> dict[str, float]:
    """The values that the machine ``steps`` away from a design has of the parameters that these move."""
    machine, lam, sigma = around(bicycle, design, steps)
    known = {
        "lam": lam, "head_angle": 0.5 * np.pi - lam, "sigma": sigma, "trail": sigma * machine.c,
        "offset": offset_of(lam, sigma, machine.c, machine.R2), "R": machine.R1,
    }  # fmt: skip
    if bicycle.bodies is not None:
        known["c"] = known["trail"]
    for name in steps.keys() - known.keys():
        own = name in bicycle.notation
        known[name] = _own(bicycle, design, machine, name) + steps[name] if own else getattr(machine, name)
    return {name: float(known[name]) for name in steps}
