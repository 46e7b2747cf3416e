"""What values of the parameters the equations can use."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from bikestab.errors import InputError

MOST_TRAIL = 100.0  # of σ
MOST_SPEED = 1e6  # m/s; more would overflow in hurwitz3
MOST = 1e9  # of every parameter, in its SI unit; more would overflow in products of conditions
LEAST = 1e-50  # of SMALL and of speeds that are not zero; less would underflow there
SMALL = {"delta", "g", "R", "R1", "R2", "rR", "rF"}


def check_tilt(lam: float, key: tuple[str | int, ...]) -> None:
    """Raise InputError unless the steering axis meets the ground: |λ| < π/2."""
    if not abs(lam) < math.pi / 2:
        raise InputError(
            f"a steering axis tilted by {lam:g} rad does not meet the ground",
            key=key,
            hint="allowed: between -90deg and 90deg, both excluded; degrees are written 18deg",
        )


def check_trail(sigma: float, key: tuple[str | int, ...]) -> None:
    """Raise InputError for a trail beyond all sense, which would overflow in the conditions."""
    if not abs(sigma) <= MOST_TRAIL:
        raise InputError(
            f"a trail of {sigma:g} wheelbases is out of range",
            key=key,
            hint=f"allowed: -{MOST_TRAIL:g} ... {MOST_TRAIL:g}; sigma = trail / wheelbase",
        )


def check_speed(V: float, key: tuple[str | int, ...]) -> None:
    """Raise InputError for a negative speed, and for one beyond all sense."""
    if not 0 <= V <= MOST_SPEED:
        problem = f"{V:g} is a speed backwards" if V < 0 else f"{V:g} m/s is out of range"
        raise InputError(problem, key=key, hint=f"allowed: 0 ... {MOST_SPEED:g} m/s")
    if 0 < V < LEAST:
        raise InputError(f"{V:g} m/s is out of range", key=key, hint=f"allowed: 0, or from {LEAST:g} m/s on")


def exceeds(a: Any, b: Any) -> Any:
    """Whether a > b by more than rounding; of floats or arrays."""
    return a > b * (1 + 1e-9)  # published inertias of thin discs sit exactly on the limit


def half_digit(value: float) -> float:
    """What rounding to the last digit that it is written with may have changed a number by; 0 if whole."""
    digits = repr(float(value)).partition(".")[2]
    if not digits.strip("0") or "e" in digits:
        return 0.0
    return float(min(0.5 * 10.0 ** -len(digits), 0.02 * abs(value)))  # one digit alone may be exact


def doubts(A: Any, B: Any, C: Any, m: Any, R: Any, h: Any, ahead: Any) -> tuple[Any, Any, Any, Any]:
    """What no part of rigid bodies on the ground has; of floats or arrays.

    Inertias that no rigid body has; a wheel that no body of the part's mass is; a centre of mass below the
    ground; and, where neither of the first two is so, a wheel that does not fit into A and B: ``least_with``.
    ``ahead`` [m] is how far the wheel's centre is ahead of the part's centre of mass.
    """
    inertias, wheel = exceeds(C, A + B), exceeds(C, m * R**2)
    above = h - R
    rest = (m * R**2 - C) * (m * R**2 > C)  # of the mass, times R²; 0 where the wheel is all of it
    tight_A = exceeds(C / 2 * rest + C * m * above**2, A * rest)
    tight_B = exceeds(C / 2 * rest + C * m * ahead**2, B * rest)
    return inertias, wheel, h < 0, (tight_A | tight_B) > (inertias | wheel)


def part_warnings(
    i: str, part: str, A: float, B: float, C: float, m: float, R: float, h: float, ahead: float,
    slack: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> list[str]:  # fmt: skip
    """``doubts`` about one part in sentences; A, B and C may each be wrong by their ``slack``."""
    inertias, wheel, below, tight = doubts(A, B, C, m, R, h, ahead)
    still = doubts(A + slack[0], B + slack[1], max(C - slack[2], 0.0), m, R, h, ahead)
    inertias, tight = inertias & still[0], tight & still[3]
    sentences = []
    if inertias:
        sentences.append(
            f"no rigid {part} part has A{i} + B{i} < C{i}: {A:g} + {B:g} = {A + B:g} < {C:g} kg m²"
        )
    if wheel:
        sentences.append(f"no wheel within the {part} part has C{i} > m{i} R{i}²: {C:g} > {m * R**2:g} kg m²")
    if tight:
        least = {"A": (A, least_with(C, m, R, R - h)), "B": (B, least_with(C, m, R, ahead))}
        small = [
            f"{n}{i} = {value:g} < {lowest:.4g}" for n, (value, lowest) in least.items() if lowest > value
        ]
        sentences.append(f"no {part} part with a wheel of C{i} = {C:g} has {', '.join(small)} kg m²")
    if below:
        sentences.append(f"the {part} centre of mass is below the ground: h{i} = {h:g} m")
    return sentences


def least_with(C: float, m: float, R: float, away: float) -> float:
    """The least A or B [kg m²] of a part of mass m with a wheel of spin inertia C, C < m R², in it.

    A wheel has at least C/2 about any diameter, since C is at most the sum of two of those, and a mass of at
    least C/R², since none of it is farther from the axle than R. If its centre is ``away`` [m] from
    the part's centre of mass, it and the rest have their masses' moments about that as well
    (parallel axes), together m C/(m R² − C) times the distance squared.
    """
    rest = m * R**2 - C
    return C / 2 + (m * C / rest * away**2 if rest > 0 else math.inf if away else 0.0)


def allowed(key: str, value: Any, check: str) -> Any:
    """Whether a parameter is of the sign wanted, within MOST, and not too small; of floats or arrays."""
    within = abs(value) <= MOST
    if key in SMALL:
        within = within & ((value == 0) | (abs(value) >= LEAST))
    return within & (value > 0) if check == "positive" else within & ((value >= 0) | (check == ""))


def require(given: Mapping[str, float], required: Sequence[str], meanings: Mapping[str, str]) -> None:
    """Raise InputError unless every required parameter is given; it says what the first missing one means."""
    missing = [key for key in required if key not in given]
    if missing:
        raise InputError(
            f"missing parameter{'s' if len(missing) > 1 else ''}: {', '.join(missing)}",
            hint=f"{missing[0]}: {meanings[missing[0]]}",
        )


def check_value(key: str, value: float, check: str, meaning: str) -> None:
    """Raise InputError unless a parameter is of the sign wanted, within MOST, and not too small."""
    if abs(value) > MOST:
        digits = 17 if f"{value:g}" == f"{MOST:g}" else 6
        problem = f"{value:.{digits}g} is out of range"
        raise InputError(problem, key=(key,), hint=f"allowed: up to {MOST:g}")
    if key in SMALL and 0 < abs(value) < LEAST:
        raise InputError(f"{value:g} is out of range", key=(key,), hint=f"allowed: 0, or from {LEAST:g} on")
    if not allowed(key, value, check):
        limit = "> 0" if check == "positive" else ">= 0"
        raise InputError(f"{value:g} is not {check} ({meaning})", key=(key,), hint=f"allowed: {key} {limit}")


def check_product(key: str, D: float, a: str, A: float, b: str, B: float) -> None:
    """Raise InputError for a product of inertia that no body with A and B has."""
    if exceeds(abs(D), math.sqrt(A * B)):
        raise InputError(
            f"|{D:g}| is more than √({a} {b}) = {math.sqrt(A * B):g}",
            key=(key,),
            hint=f"allowed: |{key}| <= {math.sqrt(A * B):.6g} kg m²",
        )
