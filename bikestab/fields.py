"""The axes of the grid, and the fields over it: each is one record here, which all others read.

Whoever adds a field adds its record to ``FIELDS``: configs may then ask for it, scans compute, pack and
store it, the schema and ``bikestab info`` list it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.routh import CONDITIONS, condition

Axis = str
Axes = tuple[Axis, Axis, Axis]
AXES: Axes = ("lam", "sigma", "V")  # where the grid has no other parameters than tilt and trail
GRADIENTS = "dV1"  # the word that asks for those of V1 and V2
COORDINATES: dict[Axis, tuple[str, str]] = {  # unit, meaning
    "lam": ("rad", "tilt of the steering axis from the vertical, top backwards"),
    "sigma": ("1", "trail divided by the wheelbase"),
    "V": ("m s-1", "forward speed"),
}


def coordinates(family: Family) -> dict[Axis, tuple[str, str]]:
    """Unit and meaning of the axes of a family's grid."""
    named = {parameter.name: (parameter.unit, parameter.meaning) for parameter in family.parameters}
    axes = {name: COORDINATES.get(name, about) for name, about in named.items()}
    return {**axes, "V": COORDINATES["V"]}


class Points(NamedTuple):
    """What a field is computed from: cells of (λ, σ), each at the same speeds.

    ``table`` has shape (5, 4, cell, 1), ``V`` [m/s] (V,) and ``violated`` (cell, V), the bit mask of
    ``routh``. ``probability`` (cell, V) is the ensemble's share of stable machines, if there is one.
    """

    table: Floats
    V: Floats
    violated: NDArray[np.uint8]
    probability: NDArray[np.float32] | None = None


@dataclass(frozen=True, kw_only=True)
class Field:
    """A field over (λ, σ, V).

    ``values`` gives it at points, shape (cell, V). ``asked`` is the word in a config that asks for it, and
    empty where it comes of itself. ``flags`` are the meanings of its values 0, 1 …, ``masks`` those of its
    bits. ``cost`` is in ns per point on one core; chunks in the file are at least ``packing`` times smaller.
    ``at_once``: its values come of the mask alone, so that there is no need to take few points at a time.
    """

    name: str
    dtype: type[np.generic]
    unit: str
    meaning: str
    values: Callable[[Points], NDArray]
    asked: str
    cost: float
    packing: float
    flags: tuple[str, ...] = ()
    masks: tuple[str, ...] = ()
    at_once: bool = False


def _stable(points: Points) -> NDArray:
    return (points.violated == 0).view(np.uint8)


def _violated(points: Points) -> NDArray:
    return points.violated


def _growth_rate(points: Points) -> NDArray:
    from bikestab.spectrum import growth_rate_of  # readers of volumes need none of it

    return growth_rate_of(points.table, points.V)


def _probability(points: Points) -> NDArray:
    assert points.probability is not None
    return points.probability


def _of_condition(name: str) -> Callable[[Points], NDArray]:
    return lambda points: condition(points.table, name, points.V)


_RECORDS = (
    Field(
        name="stable", dtype=np.uint8, unit="1", meaning="rectilinear motion is asymptotically stable",
        values=_stable, asked="stable", cost=1, packing=20, flags=("unstable", "stable"), at_once=True,
    ),
    Field(
        name="violated", dtype=np.uint8, unit="1", meaning="conditions of stability that do not hold",
        values=_violated, asked="violated", cost=1, packing=20, at_once=True,
        masks=tuple(f"{name}_not_positive" for name in CONDITIONS),
    ),
    Field(
        name="growth_rate", dtype=np.float32, unit="s-1", meaning="largest real part of the eigenvalues",
        values=_growth_rate, asked="growth_rate", cost=55, packing=1.3,
    ),
    Field(
        name="probability", dtype=np.float32, unit="1",
        meaning="share of the ensemble's machines that are stable",
        values=_probability, asked="", cost=0, packing=4,
    ),
    *(
        Field(
            name=name, dtype=np.float64, unit="", meaning=f"left side of the condition {name} > 0",
            values=_of_condition(name), asked="conditions", cost=10, packing=1,
        )
        for name in CONDITIONS
    ),
)  # fmt: skip
FIELDS: dict[str, Field] = {field.name: field for field in _RECORDS}  # in the order of the file


def askable() -> list[str]:
    """The words with which a config may ask for fields, and for the gradients of V1 and V2."""
    return [*dict.fromkeys(field.asked for field in FIELDS.values() if field.asked), GRADIENTS]


def gradient_names(axes: Sequence[Axis]) -> list[str]:
    """The datasets of the gradients of V1 and V2 over a grid's two parameters."""
    return [f"d{end}_d{name}" for end in ("V1", "V2") for name in axes[:2]]
