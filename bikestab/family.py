"""A family of designs: any two parameters of one machine → the table of its characteristic polynomial."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bikestab.bicycle import PAPER, Bicycle
from bikestab.errors import InputError, nearest
from bikestab.limits import check_tilt, check_trail
from bikestab.machines import Machines
from bikestab.model import Floats, Model, characteristic_table, exact_table

_TILT = {"lam": "steering-axis tilt [rad]", "head_angle": "head angle, 90° − tilt [rad]"}
_TRAIL = {"sigma": "trail divided by the wheelbase [1]", "trail": "trail along the ground [m]"}
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
    ``lam`` [rad], ``head_angle`` [rad] = π/2 − λ, ``sigma``, ``trail`` [m] = σ c, ``delta``. All others stay
    as the bicycle has them: its own σ in the paper's notation, its own trail ``c`` [m] in the other one,
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
        for name, own in (("lam", self.bicycle.lam), ("sigma", self.bicycle.sigma)):
            if own is None and not any(name in kind for kind in kinds):
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
        bike = self.bicycle
        derived = {
            "head_angle": None if bike.lam is None else 0.5 * np.pi - bike.lam,
            "trail": None if bike.sigma is None else bike.sigma * bike.c,
            "R": bike.R1 if bike.R1 == bike.R2 else None,
        }
        known = {**bike.numbers(), **bike.given, "lam": bike.lam, "sigma": bike.sigma, **derived}
        return known.get(self.x, 0.0), known.get(self.y, 0.0)  # what is optional is zero where not given

    def table(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Characteristic tables (5, 4, *shape) at values of the two parameters that broadcast together.

        Values are taken as they are: see ``check``. The entries are those of ``exact_table`` as doubles.
        """
        machine, lam, sigma = self._designs(x, y)
        return exact_table(machine, lam, sigma, model=self.model).value

    def quick_table(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """The same in double precision, for searches: right to the rounding of the terms of its entries."""
        machine, lam, sigma = self._designs(x, y)
        return characteristic_table(machine, lam, sigma, model=self.model)

    def geometry(self, x: ArrayLike, y: ArrayLike) -> tuple[Any, Any, Bicycle | Machines]:
        """Tilt λ [rad], σ and the machine at values of the two parameters; they broadcast together."""
        machine, lam, sigma = self._designs(x, y)
        return lam, sigma, machine

    def check(self, x: float, y: float) -> None:
        """Raise InputError, with the parameter's name as key, for values that no machine can have."""
        lam, sigma, _ = self.geometry(x, y)
        for check, value, known in ((check_tilt, lam, _TILT), (check_trail, sigma, _TRAIL)):
            named = [name for name in (self.x, self.y) if name in known]
            check(float(value), (named[0] if named else next(iter(known)),))
        values = {name: v for name, v in ((self.x, x), (self.y, y)) if name not in _TILT | _TRAIL}
        given = {name: value for name, value in values.items() if name in self.bicycle.notation}
        parts = {name: value for name, value in values.items() if name not in given}
        bicycle = self.bicycle.replaced(given) if given else self.bicycle
        if parts:
            Bicycle.from_mapping({**bicycle.numbers(), "lam": float(lam), "sigma": float(sigma), **parts})

    def _designs(self, x: ArrayLike, y: ArrayLike) -> tuple[Bicycle | Machines, Any, Any]:
        """Machines, λ and σ."""
        values = {self.x: np.asarray(x, dtype=float), self.y: np.asarray(y, dtype=float)}
        machine: Bicycle | Machines = self.bicycle
        others = {name: value for name, value in values.items() if name not in _TILT | _TRAIL}
        if others:
            shape = np.broadcast_shapes(*(np.shape(value) for value in others.values()))
            machine = Machines.varied(self.bicycle, others, shape)
        return machine, self._tilt(values), self._trail(values, machine)

    def _tilt(self, values: dict[str, Floats]) -> Any:
        if "head_angle" in values:
            return 0.5 * np.pi - values["head_angle"]
        return values.get("lam", self.bicycle.lam)

    def _trail(self, values: dict[str, Floats], machine: Bicycle | Machines) -> Any:
        """Values of σ."""
        if "sigma" in values:
            return values["sigma"]
        trail: Any = values.get("trail")
        if self.bicycle.bodies is not None:
            trail = values.get("c", trail)
            trail = self.bicycle.bodies["c"] if trail is None else trail
        return self.bicycle.sigma if trail is None else trail / machine.c

    @property
    def _meanings(self) -> dict[str, str]:
        """What may vary: meaning and unit by name."""
        return {**PAPER, **self.bicycle.notation, **_TILT, **_TRAIL}

    def _kind(self, name: str) -> set[str]:
        """The parameters of the equations that a name alone fixes."""
        if name in _TILT:
            return {"lam"}
        if name in _TRAIL or (name == "c" and self.bicycle.bodies is not None):
            return {"sigma"}
        return {"R1", "R2"} if name == "R" else {name}
