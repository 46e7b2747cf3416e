"""What values of the parameters the equations can use."""

from __future__ import annotations

import math
from typing import Any

from bikestab.errors import InputError

MOST_TRAIL = 100.0  # of σ
MOST_SPEED = 1e6  # m/s; more would overflow in hurwitz3
MOST = 1e9  # of every parameter, in its SI unit; more would overflow in products of conditions


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


def exceeds(a: Any, b: Any) -> Any:
    """Whether a > b by more than rounding; of floats or arrays."""
    return a > b * (1 + 1e-9)  # published inertias of thin discs sit exactly on the limit


def doubts(A: Any, B: Any, C: Any, m: Any, R: Any, h: Any) -> tuple[Any, Any, Any]:
    """Whether a part has inertias that no rigid body, a wheel that no body of its mass, or a centre that
    nothing on the ground has; of floats or arrays.
    """
    return exceeds(C, A + B), exceeds(C, m * R**2), h < 0


def allowed(value: Any, check: str) -> Any:
    """Whether a parameter is of the sign wanted and within MOST; of floats or arrays."""
    within = abs(value) <= MOST
    return within & (value > 0) if check == "positive" else within & ((value >= 0) | (check == ""))


def check_value(key: str, value: float, check: str, meaning: str) -> None:
    """Raise InputError unless a parameter is of the sign wanted and within MOST."""
    if abs(value) > MOST:
        raise InputError(f"{value:g} is out of range", key=(key,), hint=f"allowed: up to {MOST:g}")
    if not allowed(value, check):
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
