"""A family of designs: any two parameters of one machine → the table of its characteristic polynomial."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from bikestab.bicycle import Bicycle
from bikestab.machines import Machines
from bikestab.model import ExactTable, Floats, Model, characteristic_table, exact_table
from bikestab.variants import Parameter, check_names, check_values, own_value, parameter_of, varied


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
        check_names(self.bicycle, {"x": self.x, "y": self.y})

    @property
    def parameters(self) -> tuple[Parameter, Parameter]:
        """What x and y are called."""
        return parameter_of(self.bicycle, self.x), parameter_of(self.bicycle, self.y)

    @property
    def of_front(self) -> bool:
        """Whether the two are tilt and σ."""
        return (self.x, self.y) == ("lam", "sigma")

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

    def quick_table(
        self, x: ArrayLike, y: ArrayLike, others: Mapping[str, Any] | None = None,
        away: Mapping[str, Any] | None = None,
    ) -> Floats:  # fmt: skip
        """The same in double precision, for searches: right to the rounding of the terms of its entries.

        ``away`` moves tilt, trail and offset: see ``varied``.
        """
        machine, lam, sigma = varied(self.bicycle, {**(others or {}), self.x: x, self.y: y}, away)
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
        if bicycle.bodies is None or self.of_front:
            return bicycle.numbers()
        return {"g": bicycle.g, "delta": bicycle.delta, **bicycle.given}
