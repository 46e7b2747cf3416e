"""The largest ball of stable machines, in standard deviations of parameters, and the design at its centre.

The radius around a design is the distance to the nearest machine that is not stable at all of some speeds.
Rays find where the stable machines end, and steps to tangent planes the nearest of these ends. The centre
then moves by linear programs in which each of them counts with the slope of its distance, as for a
Chebyshev centre.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.design.around import around, values_around
from bikestab.design.rays import FARTHEST, first_ends
from bikestab.draws import evenly
from bikestab.errors import InputError
from bikestab.lean import lean_numpy
from bikestab.limits import MOST, MOST_TRAIL
from bikestab.machines import Machines, standard_normal
from bikestab.model import Floats, Model, characteristic_table
from bikestab.routh import conditions
from bikestab.speeds import intervals_of
from bikestab.variants import check_names, own_value

with lean_numpy():
    from scipy.optimize import linprog

_RAYS, _MANY = 32, 1024  # directions that are tried while the centre moves, and at its end
_CONTACTS, _APART = 12, 0.95  # nearest ends that are refined together, and the cosine of what is apart
_TURNS = 8  # steps of theirs
_SPEEDS = 7  # at which the conditions are looked at
_STEEPEST = 1.57  # rad
_STARTS, _TRIED = 2, 128


class Robust(NamedTuple):
    """The centre (n,), the ball's radius, and a machine on its surface by the uncertain parameters."""

    x: Floats
    radius: float
    nearest: dict[str, float]


@dataclass(frozen=True)
class Ball:
    """Machines around designs: ``ends`` are of the free parameters, ``deviations`` of the uncertain ones.

    ``stable`` are the speeds [m/s] at all of which machines must be stable. Raises InputError, with the key
    ``sd``, for parameters that the bicycle does not have.
    """

    bicycle: Bicycle
    model: Model
    stable: tuple[float, float]
    ends: Mapping[str, tuple[float, float]]
    deviations: Mapping[str, float]

    def __post_init__(self) -> None:
        try:
            check_names(self.bicycle, {name: name for name in {**self.ends, **self.deviations}})
        except InputError as error:
            raise InputError(error.problem, key=("sd",), hint=error.hint) from None
        for name, deviation in self.deviations.items():
            if not 0 < deviation <= MOST:
                problem = f"{name}={deviation:g} is no standard deviation"
                raise InputError(problem, key=("sd",), hint=f"allowed: above 0 up to {MOST:g}")
            if name == "R" and name not in self.ends and own_value(self.bicycle, name) is None:
                problem = f"the bicycle {self.bicycle.name!r} has two wheels that differ, and no R"
                raise InputError(problem, key=("sd",), hint="give R1 and R2")

    @cached_property
    def unit(self) -> Floats:
        """One standard deviation of each uncertain parameter (m,)."""
        return np.array(list(self.deviations.values()), dtype=float)

    def margin(self, x: Floats, z: Floats) -> Floats:
        """How far (S,) machines are from losing a condition: positive where they are stable at the speeds.

        Of designs x (n, S), at z (m, S) standard deviations: the least of the six conditions of (2.2) over
        the speeds, each in units of ``scale``. What is no machine has −1.
        """
        table, good = self._tables(x, z)
        values = self._conditions(table)
        values /= self.scale
        return np.where(good, values.min(axis=(0, 1)), -1.0)

    def certain(self, x: Floats, z: Floats) -> NDArray[np.bool_]:
        """Which of such machines are stable at all of the speeds, by their exact intervals."""
        table, good = self._tables(x, z)
        found = intervals_of(table)
        A, B = self.stable
        return np.asarray(good & np.any((found.V1 <= A) & (found.V2 >= B), axis=-1))

    @cached_property
    def scale(self) -> Floats:
        """The sizes of the conditions (condition, V, 1) in the middle of the box."""
        middle = np.mean(list(self.ends.values()), axis=1)[:, np.newaxis]
        table, _ = self._tables(middle, np.zeros((len(self.deviations), 1)))
        return np.maximum(np.abs(self._conditions(table)), 1e-300)

    def _conditions(self, table: Floats) -> Floats:
        """The six of (2.2) (condition, V, S) at speeds from the first to the last."""
        number = 1 if self.stable[0] == self.stable[1] else _SPEEDS
        return np.array(conditions(table[:, :, np.newaxis], np.linspace(*self.stable, number)[:, np.newaxis]))

    def _tables(self, x: Floats, z: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """Tables (5, 4, S), and which are of a machine."""
        steps = dict(zip(self.deviations, self.unit[:, np.newaxis] * z, strict=True))
        with np.errstate(all="ignore"):  # what no machine has may overflow
            machine, lam, sigma = around(self.bicycle, dict(zip(self.ends, x, strict=True)), steps)
            lam, sigma = (np.broadcast_to(value, x.shape[1:]) for value in (lam, sigma))
            good = (np.abs(lam) < _STEEPEST) & (np.abs(sigma) < MOST_TRAIL)
            lam, sigma = np.where(good, lam, 0.0), np.where(good, sigma, 0.0)  # of which there are sines
            if isinstance(machine, Machines):
                good = good & machine.exist
            table = characteristic_table(machine, lam, sigma, model=self.model)
            return np.where(good, table, 0.0), good

    def reach(self, x: Floats, u: Floats) -> Floats:
        """How far (S,) rays in directions u (m, S) from designs x (n, S) stay stable, in standard deviations.

        The first end only; a ball that is larger than FARTHEST is cut.
        """
        return first_ends(lambda far, ray: self.margin(x[:, ray], far * u[:, ray]), u.shape[1])


def directions(dimensions: int, number: int) -> Floats:
    """Unit vectors (m, number), evenly spread, and those along the axes first."""
    axes = np.hstack([np.eye(dimensions), -np.eye(dimensions)])
    points = evenly(dimensions, number)
    normal = standard_normal(np.clip(points.ravel(), 1e-12, 1 - 1e-12)).reshape(points.shape).T
    return np.hstack([axes, normal / np.linalg.norm(normal, axis=0)])


def contacts(ball: Ball, x: Floats, rays: int = _RAYS) -> tuple[Floats, Floats]:
    """The nearest ends of the stable machines around a design (n,): directions (m, C), and distances (C,).

    From the nearest ends of rays by steps to the nearest point of the tangent plane, as design points of
    reliability are found (Hasofer and Lind 1974, Rackwitz and Fiessler 1978).
    """
    u = directions(len(ball.deviations), rays)
    distance = ball.reach(np.repeat(x[:, np.newaxis], u.shape[1], axis=1), u)
    chosen: list[int] = []
    for i in np.argsort(distance, kind="stable"):  # the nearest that lie apart
        if len(chosen) < _CONTACTS and all(u[:, i] @ u[:, j] < _APART for j in chosen):
            chosen.append(int(i))
    u, distance = u[:, chosen], distance[chosen]
    z = u * distance
    for _ in range(_TURNS):
        value, slope = _slopes(ball, x, z)
        square = np.maximum((slope**2).sum(axis=0), 1e-300)
        nearest = slope * ((slope * z).sum(axis=0) - value) / square
        z = z + 0.7 * (nearest - z)
        length = np.maximum(np.linalg.norm(z, axis=0), 1e-12)
        z = np.where(length > FARTHEST, z * (FARTHEST / length), z)
    turned = z / np.maximum(np.linalg.norm(z, axis=0), 1e-12)
    reached = ball.reach(np.repeat(x[:, np.newaxis], turned.shape[1], axis=1), turned)
    better = reached < distance
    return np.where(better, turned, u), np.where(better, reached, distance)


def _slopes(ball: Ball, x: Floats, z: Floats) -> tuple[Floats, Floats]:
    """The margin (C,) at z (m, C), and its slopes (m, C)."""
    m, C = z.shape
    h = 1e-5 * (1 + np.abs(z).max())
    moves = np.hstack([np.zeros((m, 1)), h * np.eye(m), -h * np.eye(m)])
    points = (z[:, np.newaxis] + moves[:, :, np.newaxis]).reshape(m, -1)
    values = ball.margin(np.repeat(x[:, np.newaxis], points.shape[1], axis=1), points).reshape(2 * m + 1, C)
    return values[0], (values[1 : m + 1] - values[m + 1 :]) / (2 * h)


def most_robust(ball: Ball, first: Floats) -> Robust | None:
    """The best centre, from the best of the designs ``first`` (n, S); None where none of them is stable."""
    m = len(ball.deviations)
    inside = first[:, ball.margin(first, np.zeros((m, first.shape[1]))) > 0][:, :_TRIED]
    if not inside.shape[1]:
        return None
    u = directions(m, 16)
    pairs = np.repeat(inside, u.shape[1], axis=1), np.tile(u, inside.shape[1])
    rough = ball.reach(*pairs).reshape(inside.shape[1], -1).min(axis=1)
    best: Robust | None = None
    for i in np.argsort(-rough, kind="stable")[:_STARTS]:
        found = _climbed(ball, inside[:, i])
        if best is None or found.radius > best.radius:
            best = found
    return best


def _climbed(ball: Ball, x: Floats) -> Robust:
    """The centre that linear programs reach from a design."""
    low, high = np.array(list(ball.ends.values()), dtype=float).T
    u, distance = contacts(ball, x)
    trust = 0.2 * (high - low)
    for _ in range(40):
        if np.all(trust < 1e-4 * (high - low) + 1e-300):
            break
        step = _step(ball, x, u, distance, trust, low, high)
        moved = np.clip(x + step, low, high)
        new_u, new_distance = contacts(ball, moved)
        if new_distance.min() > distance.min() * (1 + 1e-7):
            x, u, distance = moved, new_u, new_distance
            trust = np.minimum(1.5 * trust, 0.3 * (high - low))
        else:
            trust = 0.35 * trust
    u, distance = contacts(ball, x, _MANY)
    nearest = int(np.argmin(distance))
    away = ball.unit * distance[nearest] * u[:, nearest]
    steps = dict(zip(ball.deviations, away.tolist(), strict=True))
    at = values_around(ball.bicycle, dict(zip(ball.ends, x.tolist(), strict=True)), steps)
    return Robust(x, float(distance[nearest]), at)


def _step(
    ball: Ball, x: Floats, u: Floats, distance: Floats, trust: Floats, low: Floats, high: Floats
) -> Floats:
    """The step (n,) within ``trust`` that makes the least distance largest, as their slopes tell."""
    n, C = len(x), len(distance)
    h = 0.02 * trust
    points = x[:, np.newaxis, np.newaxis] + np.stack([np.diag(h), -np.diag(h)], axis=-1).reshape(n, 1, -1)
    at = np.broadcast_to(points, (n, C, 2 * n)).reshape(n, -1)
    along = np.repeat(u[:, :, np.newaxis], 2 * n, axis=2).reshape(len(u), -1)
    reach = ball.reach(at, along).reshape(C, n, 2)
    slope = (reach[..., 0] - reach[..., 1]) / (2 * h)
    rows = np.hstack([-slope, np.ones((C, 1))])  # t − slope·step ≤ distance
    bounds = [(max(-t, a - c), min(t, b - c)) for t, a, b, c in zip(trust, low, high, x, strict=True)]
    solved = linprog([*np.zeros(n), -1.0], A_ub=rows, b_ub=distance, bounds=[*bounds, (None, None)])
    return np.asarray(solved.x[:n]) if solved.status == 0 else np.zeros(n)
