"""A machine and values of any parameters, tilt, trail and fork offset among them → machines with λ and σ."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from bikestab.bicycle import PAPER, Bicycle
from bikestab.errors import InputError, nearest
from bikestab.geometry import offset_of, tilt_from, trail_from
from bikestab.limits import check_tilt, check_trail
from bikestab.machines import Machines
from bikestab.units import as_built

TILT = {"lam": "steering-axis tilt [rad]", "head_angle": "head angle, 90° − tilt [rad]"}
TRAIL = {"sigma": "trail divided by the wheelbase [1]", "trail": "trail along the ground [m]"}
OFFSET = {"offset": "fork offset, of the front axle ahead of the steering axis [m]"}
FRONT = {**TILT, **TRAIL, **OFFSET}
_SYMBOLS = {"lam": "λ", "sigma": "σ", "delta": "δ", "offset": "b"}


class Parameter(NamedTuple):
    """How a parameter is called: as a key, in formulas, in words, and its unit."""

    name: str
    symbol: str
    meaning: str
    unit: str


def parameter_of(bicycle: Bicycle, name: str) -> Parameter:
    """What a parameter of the bicycle is called."""
    return Parameter(name, _SYMBOLS.get(name, name), *_meanings(bicycle)[name][:-1].rsplit(" [", 1))


def told_deviations(bicycle: Bicycle, deviations: Mapping[str, float]) -> str:
    """Standard deviations in words."""
    values = {name: as_built(sd, parameter_of(bicycle, name).unit) for name, sd in deviations.items()}
    return ", ".join(f"{name} {value}" for name, value in values.items())


def varied(
    bicycle: Bicycle, values: Mapping[str, Any], away: Mapping[str, Any] | None = None
) -> tuple[Bicycle | Machines, Any, Any]:
    """The machine or machines, λ [rad] and σ where some parameters have other ``values``, SI, unchecked.

    Values are arrays that broadcast together, of the bicycle's notation, the two parts' symbols, or FRONT.
    What is not given stays as the bicycle has it: its σ in the paper's notation, its trail ``c`` in that of
    Meijaard et al. An offset keeps the tilt, unless the trail is given with it. Tilt, trail and offset, by
    any of their names, may then be moved by what is in ``away``: each with the others as they are.
    """
    numbers = {name: np.asarray(value, dtype=float) for name, value in values.items()}
    others = {name: value for name, value in numbers.items() if not front_of(bicycle, name)}
    machine: Bicycle | Machines = bicycle
    if others:
        shape = np.broadcast_shapes(*(np.shape(value) for value in others.values()))
        machine = Machines.varied(bicycle, others, shape)
    lam: Any = numbers.get("lam", bicycle.lam)
    if "head_angle" in numbers:
        lam = 0.5 * np.pi - numbers["head_angle"]
    sigma, given = _sigma(bicycle, numbers, machine)
    if "offset" in numbers:
        if not given:
            sigma = trail_from(lam, numbers["offset"], machine.R2) / machine.c
        else:
            lam = tilt_from(sigma * machine.c, numbers["offset"], machine.R2)
    for name, step in (away or {}).items():
        lam, sigma = _moved(bicycle, name, step, machine, lam, sigma)
    return machine, lam, sigma


def _moved(
    bicycle: Bicycle, name: str, step: Any, machine: Bicycle | Machines, lam: Any, sigma: Any
) -> tuple[Any, Any]:
    if front_of(bicycle, name) == "tilt":
        return lam + (step if name == "lam" else -step), sigma
    if name == "offset":
        return lam, sigma - step / (machine.c * np.cos(lam))
    return lam, sigma + (step if name == "sigma" else step / machine.c)


def front_of(bicycle: Bicycle, name: str) -> str:
    """What of the front a parameter's name is: ``tilt``, ``trail``, ``offset``, or nothing of it."""
    if name in TILT:
        return "tilt"
    if name in TRAIL or (name == "c" and bicycle.bodies is not None):
        return "trail"
    return "offset" if name in OFFSET else ""


def fixed_by(bicycle: Bicycle, names: Iterable[str]) -> dict[str, str]:
    """Of tilt, trail and offset those that parameters of these names fix together, and which one does."""
    found = {front_of(bicycle, name): name for name in names}
    found.pop("", None)
    if {"trail", "offset"} <= found.keys():
        found.setdefault("tilt", found["offset"])
    if "offset" in found:
        found.setdefault("trail", found["offset"])
    elif {"tilt", "trail"} <= found.keys():
        found["offset"] = found["trail"]
    return found


def check_names(bicycle: Bicycle, names: Mapping[str, str]) -> None:
    """Raise InputError, with one's key, unless these are parameters of the bicycle that can vary together.

    ``names`` has them by keys. They must leave neither tilt nor trail open.
    """
    known = _meanings(bicycle)
    seen: dict[str, str] = {}
    for key, name in names.items():
        if name not in known:
            problem = f"the bicycle {bicycle.name!r} has no parameter {name!r}"
            raise InputError(problem, key=(key,), hint=nearest(name, known))
        front = front_of(bicycle, name)
        for one in (front,) if front else ("R1", "R2") if name == "R" else (name,):
            if one in seen:
                problem = f"{seen[one]} and {name} are one parameter"
                raise InputError(problem, key=(key,), hint="name two that differ")
            seen[one] = name
    if {"tilt", "trail", "offset"} <= seen.keys():
        problem = f"{seen['tilt']} and {seen['trail']} fix the offset"
        raise InputError(problem, key=([*names][-1],), hint="leave one of the three out")
    given = fixed_by(bicycle, names.values())
    for name, own, what in (("lam", bicycle.lam, "tilt"), ("sigma", bicycle.sigma, "trail")):
        if own is None and what not in given:
            problem = f"the bicycle {bicycle.name!r} has no {name} of its own"
            raise InputError(problem, key=(name,), hint=f"give it one, or let {name} vary too")


def check_values(bicycle: Bicycle, values: Mapping[str, float]) -> None:
    """Raise InputError, with the parameter's name as key, for values that no machine can have."""
    _machine_of(bicycle, values)
    fronts = {front_of(bicycle, name): name for name in values}
    if "offset" in fronts and "trail" in fronts:
        radius = float(varied(bicycle, values)[0].R2)
        if not abs(values["offset"]) < radius:
            problem = f"no head angle gives a trail with an offset of {values['offset']:g} m"
            hint = f"allowed: less than the front wheel's radius, {radius:g} m; 45 mm are written 45mm"
            raise InputError(problem, key=("offset",), hint=hint)
    _, lam, sigma = varied(bicycle, values)
    check_tilt(float(lam), (fronts.get("tilt", fronts.get("offset", "lam")),))
    check_trail(float(sigma), (fronts.get("trail", fronts.get("offset", "sigma")),))


def machine_at(bicycle: Bicycle, values: Mapping[str, float]) -> tuple[Bicycle, float, float]:
    """The machine with these values, λ [rad] and σ; measured as well as the bicycle in the same notation.

    It is one of two parts where some are symbols that the notation does not have. Raises InputError, with the
    parameter's name as key, for values that no machine can have.
    """
    machine = _machine_of(bicycle, values)
    _, tilt, trail = varied(bicycle, values)
    lam, sigma = float(tilt), float(trail)
    if bicycle.bodies is not None and machine.bodies is None:
        return dataclasses.replace(machine, lam=lam, sigma=sigma), lam, sigma
    if machine is bicycle:
        return machine, lam, sigma
    return machine.measured(bicycle.deviations, bicycle.correlations, machine.notes), lam, sigma


def _machine_of(bicycle: Bicycle, values: Mapping[str, float]) -> Bicycle:
    """The machine with these values, those of tilt, trail and offset left out."""
    rest = {name: value for name, value in values.items() if not front_of(bicycle, name)}
    given = {name: value for name, value in rest.items() if name in bicycle.notation}
    parts = {name: value for name, value in rest.items() if name not in given}
    machine = bicycle.replaced(given) if given else bicycle
    return Bicycle.from_mapping(machine.numbers(), name=bicycle.name).replaced(parts) if parts else machine


def own_value(bicycle: Bicycle, name: str) -> float | None:
    """The value that the bicycle itself has of a parameter; None where it has none, 0 of what is optional."""
    lam, sigma = bicycle.lam, bicycle.sigma
    derived = {
        "head_angle": None if lam is None else 0.5 * np.pi - lam,
        "trail": None if sigma is None else sigma * bicycle.c,
        "offset": None if lam is None or sigma is None else offset_of(lam, sigma, bicycle.c, bicycle.R2),
        "R": bicycle.R1 if bicycle.R1 == bicycle.R2 else None,
    }
    known = {**bicycle.numbers(), **bicycle.given, "lam": lam, "sigma": sigma, **derived}
    own = known.get(name, 0.0)
    return None if own is None else float(own)


def _meanings(bicycle: Bicycle) -> dict[str, str]:
    """What may vary: meaning and unit by name, those of the bicycle's own notation first."""
    own = {**bicycle.notation, **FRONT}
    return own | {name: meaning for name, meaning in PAPER.items() if name not in own}


def _sigma(bicycle: Bicycle, numbers: Mapping[str, Any], machine: Bicycle | Machines) -> tuple[Any, bool]:
    """σ without a thought of the offset, and whether it is given."""
    if "sigma" in numbers:
        return numbers["sigma"], True
    for name in ("trail", "c"):
        if name in numbers and front_of(bicycle, name) == "trail":
            return numbers[name] / machine.c, True
    if bicycle.bodies is not None:
        return bicycle.bodies["c"] / machine.c, False
    return bicycle.sigma, False
