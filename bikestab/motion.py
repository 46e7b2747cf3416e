"""A design at a speed → the shapes of its modes, and its motion after a push: exact, from the eigenvectors.

Signs are those of Meijaard et al. (2007): roll, steer, yaw and the way sideways are positive to the right.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.arguments import Given, design_of, table_and_speeds
from bikestab.bicycle import Bicycle
from bikestab.errors import InputError, nearest
from bikestab.gains import rate_and_power
from bikestab.model import Floats, Model, canonical_matrices
from bikestab.modes import follow

STATES = ("roll", "steer", "roll_rate", "steer_rate")  # rad and rad/s
LARGE = 0.5  # rad, beyond which sines and angles are not nearly the same
QUARTER = math.pi / 2  # rad: what rolls beyond it has fallen, and no fork turns further
_ENOUGH = 250  # times, at least, until a quarter turn
_POOR = 1e5  # condition of the eigenvectors above which eigenvalues have all but met: 1e-11 is left
_SERIES = 0.1  # |s t| below which φ2 is summed, to 1e-16

Complex = NDArray[np.complex128]


class Shapes(NamedTuple):
    """The four eigenvalues [1/s] at a speed [m/s], their names, and roll and steer in each, (2, 4).

    Phasors: the larger of the two is 1, without phase; rates are the eigenvalue times these.
    """

    V: float
    names: tuple[str, ...]
    eigenvalues: Complex
    phasors: Complex


class Motion(NamedTuple):
    """Roll, steer and their rates (4, n) at times t [s], and the path: yaw [rad], and metres on the road.

    The rear contact is at ``x`` along the road and ``y`` to the right of it, the front one at ``x_front``, a
    wheelbase ahead, and ``y_front``.
    """

    V: float
    t: Floats
    states: Floats
    yaw: Floats
    x: Floats
    y: Floats
    y_front: Floats
    x_front: Floats


class _Moved(NamedTuple):
    """The states (4, n), the integral of steer over time, that of this integral, and the steer at first."""

    states: Floats
    once: Floats
    twice: Floats
    start: float


def shapes(
    bicycle: Bicycle, V: float | str, lam: Given = None, sigma: Given = None, *, model: Model = "refined"
) -> Shapes:
    """How roll and steer take part in each mode of one design at one speed.

    Null vectors of s² M + s (V C1 + δ) + g K0 + V² K2 of Meijaard et al. (2007), (5.3), at the eigenvalues of
    ``modes``. Raises InputError as ``bikestab.modes``.
    """
    table, speeds = table_and_speeds(bicycle, V, lam, sigma, model, None)
    if table.value.ndim > 2 or speeds.ndim:
        raise InputError("mode shapes are of one design at one speed", key=("V" if speeds.ndim else "lam",))
    found = follow(table, speeds)
    s = found.eigenvalues[:, 0]
    M, C, K = matrices(bicycle, float(speeds), lam, sigma, model=model)
    B = M[..., np.newaxis] * s**2 + C[..., np.newaxis] * s + K[..., np.newaxis]  # (2, 2, 4)
    row = np.argmax(np.abs(B).sum(axis=1), axis=0)  # the better of two rows that say the same
    first, second = B[row, 0, np.arange(4)], B[row, 1, np.arange(4)]
    q = np.stack([-second, first])
    largest = np.take_along_axis(q, np.argmax(np.abs(q), axis=0)[np.newaxis], axis=0)
    return Shapes(float(speeds), tuple(found.names[:, 0].tolist()), s, q / largest)


def matrices(
    bicycle: Bicycle, V: float, lam: Given = None, sigma: Given = None, *, model: Model = "refined"
) -> tuple[Floats, Floats, Floats]:
    """M, C and K of M q'' + C q' + K q = 0 at a speed [m/s]; q = (roll, steer), with damping and gains."""
    tilt, trail = (float(value) for value in design_of(bicycle, lam, sigma))
    M, C1, K0, K2 = canonical_matrices(bicycle, tilt, trail, model=model)
    C, K = V * C1 + np.diag([0.0, bicycle.delta]), bicycle.g * K0 + V * V * K2
    for name, gain in bicycle.gains:  # feedback of the steer torque
        of_roll, order, power = rate_and_power(name)
        (K, C)[order][1, 0 if of_roll else 1] += gain * V**power
    return M, C, K


def motion(
    bicycle: Bicycle, V: float | str, push: Mapping[str, float], t: ArrayLike,
    lam: Given = None, sigma: Given = None, *, model: Model = "refined",
) -> Motion:  # fmt: skip
    """The motion after a push: the states at t = 0 that ``push`` gives by name, in rad and rad/s, others 0.

    A sum of the modes, each with its exponential; where eigenvalues all but meet, and their vectors with
    them, the exponential of the matrix. The path is the exact integral of rolling without slip,
    yaw' = (V steer + trail steer') cos λ / wheelbase and y' = V yaw.
    Raises InputError for an unknown state, a negative time, and as ``shapes``.
    """
    x0, t = _initial(push), np.atleast_1d(np.asarray(t, dtype=float))
    if np.any(t < 0) or not np.all(np.isfinite(t)):
        raise InputError("a time is negative or not finite", key=("t",), hint="allowed: 0 and above")
    found = shapes(bicycle, V, lam, sigma, model=model)
    vectors = np.concatenate([found.phasors, found.phasors * found.eigenvalues])  # (4 states, 4 modes)
    vectors = vectors / np.linalg.norm(vectors, axis=0)
    with np.errstate(over="ignore", invalid="ignore"):
        if np.linalg.cond(vectors) < _POOR:
            moved = _of_modes(vectors, found.eigenvalues, x0, t)
        else:
            moved = _of_matrix(*matrices(bicycle, found.V, lam, sigma, model=model), x0, t)
        moved.states[:, t == 0] = x0[:, np.newaxis]  # as given, without the rounding of the sum
        tilt, trail = (float(value) for value in design_of(bicycle, lam, sigma))
        result = _path(bicycle, (tilt, trail), found.V, t, moved)
    if not all(np.all(np.isfinite(values)) for values in result[1:]):
        raise InputError("it grows beyond all numbers", key=("t",), hint="ask for a shorter time")
    return result


def leaves(found: Motion, angle: float = LARGE) -> float | None:
    """The first time [s] at which roll or steer is beyond an angle [rad], if there is one."""
    size = np.abs(found.states[:2]).max(axis=0)
    beyond = np.flatnonzero(size > angle)
    if not len(beyond):
        return None
    k = int(beyond[0])
    return float(np.interp(angle, size[k - 1 : k + 1], found.t[k - 1 : k + 1])) if k else float(found.t[0])


def before_a_quarter_turn(motion: Callable[[Floats], Motion], found: Motion) -> Motion:
    """A motion, given for times, as it was ``found`` or to where roll or steer is a quarter turn before."""
    times = len(found.t)
    while (end := leaves(found, QUARTER)) is not None:
        shown = int(np.searchsorted(found.t, end))
        if shown >= _ENOUGH or not shown:
            return motion(np.append(found.t[:shown], end))
        found = motion(np.linspace(0, found.t[shown], times))
    return found


def _initial(push: Mapping[str, float]) -> Floats:
    for name in push:
        if name not in STATES:
            raise InputError(f"there is no state {name!r}", key=("push",), hint=nearest(name, STATES))
    return np.array([float(push.get(name, 0.0)) for name in STATES])


def _of_modes(vectors: Complex, s: Complex, x0: Floats, t: Floats) -> _Moved:
    parts = np.linalg.solve(vectors, x0.astype(complex))
    z = s[:, np.newaxis] * t
    one, two = _phi(z)
    steer = (vectors[1] * parts)[:, np.newaxis]
    states = ((vectors * parts) @ np.exp(z)).real
    return _Moved(
        states, (steer * one).sum(axis=0).real * t, (steer * two).sum(axis=0).real * t * t, float(x0[1])
    )


def _phi(z: Complex) -> tuple[Complex, Complex]:
    """(e^z − 1)/z and (e^z − 1 − z)/z²."""
    small = np.abs(z) < _SERIES
    safe = np.where(small, 1.0, z)
    series = sum(z**k / math.factorial(k + 2) for k in range(10))
    one = np.where(small, 1 + z * series, np.expm1(safe) / safe)
    return one, np.where(small, series, (one - 1) / safe)


def _of_matrix(M: Floats, C: Floats, K: Floats, x0: Floats, t: Floats) -> _Moved:
    """The same from the exponential of a matrix, with the two integrals as further states."""
    from scipy.linalg import expm  # eigenvalues that all but meet are rare

    A = np.zeros((6, 6))
    A[:2, 2:4] = np.eye(2)
    A[2:4, :4] = -np.linalg.solve(M, np.hstack([K, C]))
    A[4, 1] = A[5, 4] = 1.0
    end = expm(A * t[:, np.newaxis, np.newaxis]) @ np.concatenate([x0, np.zeros(2)])
    return _Moved(end[:, :4].T, end[:, 4], end[:, 5], float(x0[1]))


def _path(bicycle: Bicycle, design: tuple[float, float], V: float, t: Floats, moved: _Moved) -> Motion:
    """The motion with its path, from the steer's integrals."""
    lam, trail = design[0], design[1] * bicycle.c
    turn, steer, start = math.cos(lam) / bicycle.c, moved.states[1], moved.start
    yaw = turn * (V * moved.once + trail * (steer - start))
    y = V * turn * (V * moved.twice + trail * (moved.once - start * t)) + 0.0  # not -0
    front = y + math.cos(lam) * (V * moved.once - trail * start)  # y + c yaw − trail cos λ steer
    return Motion(V, t, moved.states, yaw, V * t, y, front, V * t + bicycle.c)
