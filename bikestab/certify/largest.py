"""A design and sides in given proportions → the largest box around it that is proved stable.

The box grows by a factor of the sides. What is not stable at one factor is not at a larger one, so that the
largest is found by halving; a box counts when it is proved, whatever the boxes tried before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.certify.box import Box, box_of
from bikestab.certify.proof import Proof
from bikestab.certify.search import search
from bikestab.errors import InputError, nearest
from bikestab.letters import Model
from bikestab.model import exact_table
from bikestab.speeds import intervals_of
from bikestab.stability import growth_rate, stable_intervals
from bikestab.variants import front_of, varied

FARTHEST = 100.0  # times the sides; a larger box is not looked for
MOST_BLOCKS = 20_000  # that are looked at for one box
_LEAST = 2.0**-20
_CLOSE = 1.002  # the factor proved, and the next that is not, as a ratio
_CELLS = 32  # along tilt, trail and speed
_PARTS = (1, 4, 16, 8, 4, 2, 2)  # of each tolerance, by their number: blocks are few around a box's corner
_BOX = ("lam", "sigma", "V")
T = TypeVar("T")


@dataclass(frozen=True)
class Around:
    """A design, and the half ``sides`` of a box around it, by ``lam`` [rad], ``sigma``, ``V`` and parameters.

    ``speeds`` [m/s] are those in the smallest of such boxes, at least; with a side V they are its middle.
    """

    bicycle: Bicycle
    model: Model
    lam: float
    sigma: float
    speeds: tuple[float, float]
    sides: Mapping[str, float]

    def ends(self, factor: float) -> dict[str, tuple[float, float]]:
        """The ends of the box with so many times these sides."""
        middles = {"lam": (self.lam,) * 2, "sigma": (self.sigma,) * 2, "V": self.speeds}
        middles |= {name: (_own(self.bicycle, name),) * 2 for name in self.sides if name not in middles}
        sides = {name: factor * self.sides.get(name, 0.0) for name in middles}
        return {name: (low - sides[name], high + sides[name]) for name, (low, high) in middles.items()}

    def unstable_corner(self, factor: float) -> dict[str, Any] | None:
        """A corner of this box that is not stable, and how fast it grows there; None where none is found."""
        ends = self.ends(factor)
        speeds = ends.pop("V")
        names = [name for name, (low, high) in ends.items() if low < high]
        grid = np.meshgrid(*(ends[name] for name in names), indexing="ij")
        values = dict(zip(names, (each.ravel() for each in grid), strict=True))
        corners = {"lam": self.lam, "sigma": self.sigma, **values}
        found = intervals_of(exact_table(*varied(self.bicycle, corners), model=self.model))
        for V in speeds:
            for i in np.flatnonzero(~((found.V1 < V) & (V < found.V2)).any(axis=-1)):
                at = {name: float(each[i]) for name, each in values.items()}
                rate = self._growth_rate(at, V)
                if rate > 0:
                    return {
                        **{name: pair[0] for name, pair in ends.items()},
                        **at,
                        "V": V,
                        "growth_rate": rate,
                    }
        return None

    def _growth_rate(self, at: Mapping[str, float], V: float) -> float:
        own = {name: value for name, value in at.items() if name not in _BOX}
        machine = self.bicycle.replaced(own) if own else self.bicycle
        place = {"lam": at.get("lam", self.lam), "sigma": at.get("sigma", self.sigma)}
        return float(growth_rate(machine, V, **place, model=self.model))

    def box(self, factor: float) -> Box:
        """The box with so many times these sides. InputError where there is none."""
        ends = self.ends(factor)
        lam, sigma, V = (
            np.linspace(*ends[name], _CELLS + 1 if ends[name][0] < ends[name][1] else 2) for name in _BOX
        )
        tolerances = {name: pair for name, pair in ends.items() if name not in _BOX}
        return box_of(self.bicycle, lam, sigma, V, self.model, tolerances, _PARTS)

    def proof(self, factor: float) -> Proof | None:
        """The proof that this box is stable.

        None for one that has an unstable corner, is undecided, or takes more than MOST_BLOCKS.
        """
        box = self.box(factor)
        if self.unstable_corner(factor):
            return None
        proof = Proof(box, search(box.prover(), most_blocks=MOST_BLOCKS, only_stable=True))
        return proof if proof.verdict == "stable" else None


class Largest(NamedTuple):
    """The largest box that was proved, with so many times the sides.

    ``beyond`` is the smallest factor that was tried without a proof, None if there is none up to FARTHEST;
    ``why`` says what there is no machine for at its ends, if so. ``point`` is a corner that is not stable, of
    the smallest box where one was found: with ``spoiled`` times the sides.
    """

    around: Around
    factor: float
    proof: Proof
    beyond: float | None
    why: str
    point: dict[str, Any] | None
    spoiled: float | None


def largest_box(around: Around) -> Largest:
    """The largest box, to 0.2 % of its sides.

    Raises InputError for a design that is not stable at all of the speeds, for no sides, and where not even
    a millionth of them can be proved.
    """
    if not any(side > 0 for side in around.sides.values()):
        raise InputError("no side of the box grows", key=("sd",), hint="give one, such as trail=5mm")
    if not around.proof(0.0):
        raise _not_stable(around)
    held: tuple[float, Proof] | None = None
    factor, failed, why = 1.0, None, ""
    while failed is None or held is None or failed > held[0] * _CLOSE:
        found, problem = _tried(around.proof, factor)
        if found:
            held = factor, found
        else:
            failed, why = factor, problem
        if held and failed is None:
            if factor >= FARTHEST:
                break
            factor = min(2 * factor, FARTHEST)
        elif held is None:
            factor /= 2
            if factor < _LEAST:
                raise InputError(
                    "no box of these sides is proved stable", key=("sd",), hint=why or "try others"
                )
        elif failed is not None:
            factor = 0.5 * (held[0] + failed)
    spoiled, point = (None, None) if failed is None or why else _spoiled(around, held[0], failed)
    return Largest(around, *held, failed, why, point, spoiled)


def _spoiled(around: Around, held: float, failed: float) -> tuple[float | None, dict[str, Any] | None]:
    """The smallest factor from ``failed`` on at which a corner is not stable, to 0.2 %, and that corner."""
    low, high = held, failed
    while not (point := around.unstable_corner(high)):
        low, high = high, 2 * high
        if high > FARTHEST or _tried(around.box, high)[1]:
            return None, None
    while high > low * _CLOSE and high > failed:
        middle = 0.5 * (low + high)
        nearer = around.unstable_corner(middle)
        low, high, point = (low, middle, nearer) if nearer else (middle, high, point)
    return high, point


def _tried(ask: Callable[[float], T], factor: float) -> tuple[T | None, str]:
    """What is asked of a box, or why there is no such box."""
    try:
        return ask(factor), ""
    except InputError as error:
        return None, f"{'.'.join(map(str, error.key))}: {error.problem}"


def _not_stable(around: Around) -> InputError:
    bicycle, (low, high) = around.bicycle, around.speeds
    found = stable_intervals(bicycle, around.lam, around.sigma, model=around.model)
    pairs = zip(found.V1.tolist(), found.V2.tolist(), strict=True)
    ends = [f"from {V1:.4g} to {V2:.4g} m/s" for V1, V2 in pairs if not np.isnan(V1)]
    problem = f"the design is not stable at all speeds from {low:g} to {high:g} m/s"
    hint = f"it is {' and '.join(ends)}" if ends else "it is so at no speed"
    return InputError(problem, key=("stable",), hint=hint)


def around_design(
    bicycle: Bicycle, model: Model, design: tuple[float, float], deviations: Mapping[str, float],
    stable: tuple[float, float] | None, V: float | None = None, V_max: float = 30.0,
) -> Around:  # fmt: skip
    """A design, λ [rad] and σ, with sides in the proportions of ``deviations``, by any name of a parameter.

    The speeds are ``stable``; without, they grow from the middle of the interval of stable speeds that has
    ``V``, or of the widest, in proportion to it up to ``V_max``. Raises InputError for a parameter that is no
    side of a box, and without a stable speed.
    """
    lam, sigma = design
    sides: dict[str, float] = {}
    for name, deviation in deviations.items():
        side, scale = _side(bicycle, name)
        if side in sides:
            raise InputError(f"{name} is a side already", key=("sd",), hint="give one name of it")
        sides[side] = deviation / scale
    if stable:
        return Around(bicycle, model, lam, sigma, stable, sides)
    found = stable_intervals(bicycle, lam, sigma, model=model)
    pairs = [(V1, min(V2, V_max)) for V1, V2 in zip(found.V1.tolist(), found.V2.tolist(), strict=True)]
    pairs = [(V1, V2) for V1, V2 in pairs if V1 < V2 and (V is None or V1 < V < V2)]
    if not pairs:
        problem = "the design has no stable speed" if V is None else f"the design is not stable at {V:g} m/s"
        raise InputError(problem, key=("stable" if V is None else "judged",), hint="give another design")
    V1, V2 = max(pairs, key=lambda pair: pair[1] - pair[0])
    middle = 0.5 * (V1 + V2)
    return Around(bicycle, model, lam, sigma, (middle, middle), {**sides, "V": middle - V1})


def _side(bicycle: Bicycle, name: str) -> tuple[str, float]:
    """The side of a box that a parameter is, and how many of it are one of the side's unit."""
    kind = front_of(bicycle, name)
    if kind == "tilt":
        return "lam", 1.0
    if kind == "trail":
        return "sigma", 1.0 if name == "sigma" else bicycle.c
    fixed = {"rider.inertia_mass", "w" if bicycle.bodies else "c"}
    allowed = {*bicycle.given, "g", "delta"} - {"lam", "sigma", "c"} - fixed
    if kind == "offset" or name not in allowed:
        known = sorted({*allowed, "head_angle", "trail"})
        hint = "give head_angle and trail" if kind == "offset" or name in fixed else nearest(name, known)
        raise InputError(f"{name} is no side of a box around {bicycle.name}", key=("sd",), hint=hint)
    return name, 1.0


def _own(bicycle: Bicycle, name: str) -> float:
    given = bicycle.given
    return given[name] if name in given else float(getattr(bicycle, name))
