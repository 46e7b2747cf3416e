"""An ensemble's random numbers, which depend on nothing but seed, name and number → machines."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle, parameters
from bikestab.errors import InputError
from bikestab.gains import GAINS
from bikestab.limits import MOST_TRAIL, allowed, doubts, exceeds
from bikestab.notation import CHECKS, INERTIAS, PARTS, reduced

_Floats = NDArray[np.float64]


def uniforms(seed: int, name: str, number: int) -> _Floats:
    """The first ``number`` random numbers between 0 and 1, both excluded, of the stream ``name``.

    Philox, a counter-based generator, keyed by a SHA-256 of seed and name: number i of a stream depends
    neither on other streams nor on how many are drawn.
    """
    key = int.from_bytes(hashlib.sha256(f"{seed} {name}".encode()).digest()[:16], "little")
    raw = np.random.Philox(key=key).random_raw(number)
    return ((raw >> np.uint64(12)).astype(float) + 0.5) * 2.0**-52


def standard_normal(uniform: _Floats) -> _Floats:
    """Random numbers between 0 and 1 as those of the standard normal distribution, by its inverse."""
    from statistics import NormalDist

    return np.fromiter(map(NormalDist().inv_cdf, uniform.tolist()), float, len(uniform))


@dataclass(frozen=True, kw_only=True)
class Machines:
    """Many machines, as ``coefficients`` takes them: the paper's parameters, of shape (sample, 1).

    Parameters that all of them share are plain numbers. Those of four rigid bodies keep their ``bodies``,
    from which the table is made as it is for one machine, but for ``parts`` that were given instead.
    """

    shape: tuple[int, ...]
    c: Any
    m1: Any
    l1: Any
    h1: Any
    A1: Any
    B1: Any
    D1: Any
    C1: Any
    R1: Any
    m2: Any
    l2: Any
    h2: Any
    A2: Any
    B2: Any
    D2: Any
    C2: Any
    R2: Any
    g: Any
    delta: Any
    bodies: Mapping[str, Any] | None = None
    parts: tuple[str, ...] = ()
    gains: Mapping[str, Any] = field(default_factory=dict)

    @property
    def number(self) -> int:
        """How many machines there are."""
        return self.shape[0]

    @classmethod
    def drawn(cls, bicycle: Bicycle, samples: Mapping[str, _Floats]) -> Machines:
        """Copies of a bicycle with ``samples`` (sample,) of parameters in its notation.

        Raises InputError where some are no machine; it names the parameter, how many they are, and the first.
        """
        machines, good = cls.tried(bicycle, samples)
        if not good.all():
            raise _refusal(bicycle, samples, np.flatnonzero(~good))
        return machines

    @classmethod
    def tried(cls, bicycle: Bicycle, samples: Mapping[str, _Floats]) -> tuple[Machines, NDArray[np.bool_]]:
        """As ``drawn``, with those that are no machine among them, and which (sample,) are one."""
        columns: dict[str, Any] = {name: values[:, np.newaxis] for name, values in samples.items()}
        shape = next(iter(columns.values())).shape
        good = np.ones(shape, dtype=bool)
        with np.errstate(all="ignore"):  # what no machine has may overflow
            if bicycle.bodies is not None:
                good &= _bodies_exist({**bicycle.bodies, **columns})
            machines = cls.varied(bicycle, columns, shape)
            good &= _machine_exists(vars(machines))
        return machines, good[:, 0]

    @classmethod
    def varied(cls, bicycle: Bicycle, columns: Mapping[str, _Floats], shape: tuple[int, ...]) -> Machines:
        """Copies of a bicycle, with arrays that broadcast to ``shape`` as some of its parameters; unchecked.

        They are those of its notation, or of the two parts that it is reduced to.
        """
        numbers: dict[str, Any] = {**bicycle.given, **columns}
        gains = {name: numbers.pop(name) for name in GAINS if name in numbers}
        columns = {name: values for name, values in columns.items() if name not in GAINS}
        ours = {} if bicycle.bodies is None else bicycle.notation
        parts = {name: values for name, values in columns.items() if name not in ours}
        if "R" in parts:
            parts["R1"] = parts["R2"] = parts.pop("R")
        bodies = None
        if bicycle.bodies is not None:
            bodies = {name: values for name, values in numbers.items() if name not in parts}
            numbers = reduced(bodies)
        numbers = {"delta": 0.0, **numbers, **parts}
        return cls(
            shape=shape,
            bodies=bodies,
            parts=(*parts,),
            gains=gains,
            **{p.name: numbers[p.name] for p in _PARAMETERS},
        )

    @property
    def exist(self) -> Any:
        """Which of them can be: where ``Bicycle`` would take the parameters; unchecked with ``varied``."""
        with np.errstate(all="ignore"):
            good = _machine_exists(vars(self))
            return good if self.bodies is None else good & _bodies_exist(self.bodies)

    def doubtful(self) -> dict[str, int]:
        """How many machines have what no rigid bodies on the ground can have, by what it is."""
        found = {}
        for i, part in (("1", "rear"), ("2", "front")):
            ahead = -self.l1 if i == "1" else self.c - self.l2
            A, B, C, m, R, h = (getattr(self, f"{letter}{i}") for letter in "ABCmRh")
            flags = doubts(A, B, C, m, R, h, ahead)
            words = (
                f"no rigid {part} part has A{i} + B{i} < C{i}",
                f"no wheel within the {part} part has C{i} > m{i} R{i}²",
                f"the {part} centre of mass is below the ground",
                f"no {part} part with a wheel of its C{i} has its A{i} and B{i}",
            )
            for text, flag in zip(words, flags, strict=True):
                found[text] = int(np.count_nonzero(np.broadcast_to(flag, self.shape)))
        return {text: number for text, number in found.items() if number}

    def part(self, samples: slice) -> Machines:
        """Some of the machines."""

        def chosen(numbers: Mapping[str, Any]) -> dict[str, Any]:
            return {name: value[samples] if np.ndim(value) else value for name, value in numbers.items()}

        numbers = chosen({p.name: getattr(self, p.name) for p in _PARAMETERS})
        bodies = None if self.bodies is None else chosen(self.bodies)
        shape = len(range(*samples.indices(self.number))), 1
        return Machines(shape=shape, bodies=bodies, parts=self.parts, gains=chosen(self.gains), **numbers)


_PARAMETERS = [p for p in parameters() if p.name not in ("lam", "sigma")]


def _machine_exists(n: Mapping[str, Any]) -> Any:
    """Where Bicycle would take the paper's parameters."""
    good = True
    for p in _PARAMETERS:
        good = good & allowed(p.name, n[p.name], p.metadata["check"])
    for name, gain in n["gains"].items():
        good = good & allowed(name, gain, "")
    for i in "12":
        A, B, C, D, R = (n[letter + i] for letter in "ABCDR")
        good = good & np.logical_not(exceeds(abs(D), np.sqrt(A * B))) & ((R > 0) | (C == 0))
    return good


def _bodies_exist(n: Mapping[str, Any]) -> Any:
    """Where ``two_parts`` would take the 25 parameters."""
    good = True
    for key, check in CHECKS.items():
        good = good & allowed(key, n.get(key, 1.0), check)
    for inertia in INERTIAS:
        xx, zz, xz = (n.get(inertia + axes, 0.0) for axes in ("xx", "zz", "xz"))
        good = good & np.logical_not(exceeds(abs(xz), np.sqrt(xx * zz)))
    for _, bodies in PARTS:
        good = good & (sum(n.get(m, 0.0) for m in bodies) > 0)
    return good & (abs(n["c"] / n["w"]) <= MOST_TRAIL)


def _refusal(bicycle: Bicycle, samples: Mapping[str, _Floats], refused: NDArray[np.intp]) -> InputError:
    """Why the first of the ``refused`` samples is none."""
    number = len(next(iter(samples.values())))
    values = {name: float(column[refused[0]]) for name, column in samples.items()}
    first = ", ".join(f"{name} = {value:.6g}" for name, value in values.items())
    are = "is no machine" if len(refused) == 1 else "are no machines"
    try:
        bicycle.replaced(values)
    except InputError as error:
        return InputError(
            f"{len(refused)} of {number} samples {are}; the first has {first}: {error.problem}",
            key=error.key,
            hint=f"{error.hint}; take a narrower distribution, or uniform: [low, high]",
        )
    raise AssertionError("the limits of many machines are not those of one")
