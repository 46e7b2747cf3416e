"""A family of designs: any two parameters of one machine → the table of its characteristic polynomial."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from numpy.typing import ArrayLike

from bikestab.bicycle import PAPER, Bicycle
from bikestab.errors import InputError, nearest
from bikestab.machines import Machines
from bikestab.model import ExactTable, Floats, Model, characteristic_table, exact_table
from bikestab.variants import FRONT, check_values, fixed_by, front_of, own_value, varied

_SYMBOLS = {"lam": "λ", "sigma": "σ", "delta": "δ"}


class Parameter(NamedTuple):
    """How a parameter is called: as a key, in formulas, in words, and its unit."""

    name: str
    symbol: str
    meaning: str
    unit: str


@dataclass(frozen=True)
class Family:
    """The designs of a bicycle in which the parameters ``x`` and ``y`` vary.

    They may be any two of the notation the bicycle is given in (the paper's symbols, with ``R`` for equal
    radii, or the 25 of Meijaard et al.), the paper's symbols of the two parts of a bicycle given by 25, or
    ``lam`` [rad], ``head_angle`` [rad] = π/2 − λ, ``sigma``, ``trail`` [m] = σ c, ``offset`` [m], ``delta``.
    An offset fixes the trail, and with a trail the tilt. All others stay as the bicycle has them: its own σ
    in the paper's notation, its own trail ``c`` [m] in the other one,
    where inertias are about axes fixed in the frame and so do not turn with the tilt.

    Raises InputError for an unknown name, for two names of the same thing, and where the bicycle has no
    tilt or trail of its own and neither x nor y is one.
    """

    bicycle: Bicycle
    model: Model = "refined"
    x: str = "lam"
    y: str = "sigma"

    def __post_init__(self) -> None:
        for axis, name in (("x", self.x), ("y", self.y)):
            if name not in self._meanings:
                raise InputError(
                    f"the bicycle {self.bicycle.name!r} has no parameter {name!r}",
                    key=(axis,), hint=nearest(name, self._meanings),
                )  # fmt: skip
        kinds = [self._kind(name) for name in (self.x, self.y)]
        if kinds[0] & kinds[1]:
            raise InputError(
                f"{self.x} and {self.y} are one parameter", key=("y",), hint="name two that differ"
            )
        given = fixed_by(self.bicycle, (self.x, self.y))
        for name, own, what in (("lam", self.bicycle.lam, "tilt"), ("sigma", self.bicycle.sigma, "trail")):
            if own is None and what not in given:
                raise InputError(
                    f"the bicycle {self.bicycle.name!r} has no {name} of its own",
                    key=(name,), hint=f"give it one, or name {name} as x or y",
                )  # fmt: skip

    @property
    def parameters(self) -> tuple[Parameter, Parameter]:
        """What x and y are called."""
        x, y = (
            Parameter(name, _SYMBOLS.get(name, name), *self._meanings[name][:-1].rsplit(" [", 1))
            for name in (self.x, self.y)
        )
        return x, y

    @property
    def own(self) -> tuple[float | None, float | None]:
        """The values that the bicycle itself has of x and y."""
        return own_value(self.bicycle, self.x), own_value(self.bicycle, self.y)

    def exact_table(self, x: ArrayLike, y: ArrayLike, others: Mapping[str, Any] | None = None) -> ExactTable:
        """Characteristic tables with bounds at values of the two parameters that broadcast together.

        ``others`` are values of further parameters by their names. All are taken as they are: see ``check``.
        """
        machine, lam, sigma = varied(self.bicycle, {**(others or {}), self.x: x, self.y: y})
        return exact_table(machine, lam, sigma, model=self.model)

    def table(self, x: ArrayLike, y: ArrayLike, others: Mapping[str, Any] | None = None) -> Floats:
        """The same as doubles, of shape (5, 4, *shape)."""
        return self.exact_table(x, y, others).value

    def quick_table(self, x: ArrayLike, y: ArrayLike, others: Mapping[str, Any] | None = None) -> Floats:
        """The same in double precision, for searches: right to the rounding of the terms of its entries."""
        machine, lam, sigma = varied(self.bicycle, {**(others or {}), self.x: x, self.y: y})
        return characteristic_table(machine, lam, sigma, model=self.model)

    def geometry(self, x: ArrayLike, y: ArrayLike) -> tuple[Any, Any, Bicycle | Machines]:
        """Tilt λ [rad], σ and the machine at values of the two parameters; they broadcast together."""
        machine, lam, sigma = varied(self.bicycle, {self.x: x, self.y: y})
        return lam, sigma, machine

    def check(self, x: float, y: float) -> None:
        """Raise InputError, with the parameter's name as key, for values that no machine can have."""
        check_values(self.bicycle, {self.x: x, self.y: y})

    @property
    def kept(self) -> dict[str, float | None]:
        """The bicycle's numbers from which the family can be made again: those of two parts, or of bodies."""
        bicycle = self.bicycle
        if bicycle.bodies is None or (self.x, self.y) == ("lam", "sigma"):
            return bicycle.numbers()
        return {"g": bicycle.g, "delta": bicycle.delta, **bicycle.given}

    @property
    def _meanings(self) -> dict[str, str]:
        """What may vary: meaning and unit by name."""
        return {**PAPER, **self.bicycle.notation, **FRONT}

    def _kind(self, name: str) -> set[str]:
        """The parameters of the equations that a name alone fixes."""
        front = front_of(self.bicycle, name)
        return {front} if front else {"R1", "R2"} if name == "R" else {name}
