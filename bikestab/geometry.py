"""What builders measure of a steering axis, head angle, trail and fork offset → λ and σ, and back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from bikestab.errors import InputError
from bikestab.limits import check_tilt, check_trail
from bikestab.notation import MEASURED
from bikestab.units import ANGLE, LENGTH, PURE, Units

GIVEN: dict[str, Units] = {
    "lam": ANGLE, "sigma": PURE, "head_angle": ANGLE, "trail": LENGTH, "offset": LENGTH,
}  # fmt: skip
_SAME_LENGTH, _SAME_ANGLE = 2e-4, 1e-4  # m, rad: what tables print of a design agrees with itself


def offset_of(lam: Any, sigma: Any, wheelbase: Any, radius: Any) -> Any:
    """Fork offset b = R2 sin λ − c1 [m] with the mechanical trail c1 = σ c cos λ; floats or arrays."""
    return radius * np.sin(lam) - sigma * wheelbase * np.cos(lam)


def trail_from(lam: Any, offset: Any, radius: Any) -> Any:
    """The trail along the ground [m] of a front wheel whose axle is ``offset`` [m] ahead of the axis."""
    return (radius * np.sin(lam) - offset) / np.cos(lam)


def sigma_limits(lam: Any, offset: tuple[float, float], wheelbase: Any, radius: Any) -> tuple[Any, Any]:
    """The least and the most σ at tilts λ [rad] with which the fork offset [m] is within two ends."""
    return tuple(trail_from(lam, end, radius) / wheelbase for end in offset[::-1])


def tilt_from(trail: Any, offset: Any, radius: Any) -> Any:
    """The tilt λ [rad] with which an offset gives a trail, both in metres; NaN where none does.

    R2 sin λ − trail cos λ = √(R2² + trail²) sin(λ − atan(trail/R2)), which is the offset. There is one such
    tilt for every offset of less than the radius, and for others two or none that is one of a bicycle.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        lam = np.arctan2(trail, radius) + np.arcsin(np.divide(offset, np.hypot(radius, trail)))
    return np.where(np.abs(offset) < radius, lam, np.nan)


def tilt_of(head_angle: Any) -> Any:
    """λ [rad] of a head angle [rad]; of whole degrees the double that the tilt in degrees has."""
    degree = math.pi / 180
    return (90 - head_angle / degree) * degree


def design_given(
    given: Mapping[str, Any],
    wheelbase: float,
    radius: float,
    own: tuple[float | None, float | None] = (None, None),
) -> tuple[Any, Any]:
    """λ [rad] and σ of a design of which some of GIVEN are given, in SI, floats or arrays,
    and of its machine's ``own`` values.

    Two of tilt, trail and offset fix the third; where only the offset is given, the own tilt is kept, or
    else the own trail. Values broadcast together. None stands for what remains unknown. Raises InputError
    with the key for values that cannot be used, and for three that contradict each other.
    """
    n = {name: np.asarray(value, dtype=float) for name, value in given.items()}
    tilt, sigma = n.get("lam"), n.get("sigma")
    _check(tilt, check_tilt, "lam")
    _check(sigma, check_trail, "sigma")
    if "head_angle" in n:
        _check(n["head_angle"], _check_head_angle, "head_angle")
        tilt = _agreed(("head_angle", "lam"), tilt_of(n["head_angle"]), tilt, 1.0, "rad")
    if "trail" in n:
        _check(n["trail"] / wheelbase, check_trail, "trail")
        sigma = _agreed(("trail", "sigma"), n["trail"] / wheelbase, sigma, wheelbase, "m")
    if "offset" not in n:
        return own[0] if tilt is None else tilt, own[1] if sigma is None else sigma
    b = n["offset"]
    if tilt is None and sigma is None:
        tilt = None if own[0] is None else np.asarray(own[0])
        sigma = None if own[1] is None or tilt is not None else np.asarray(own[1])
    if tilt is None and sigma is None:
        return None, None
    if sigma is None:
        sigma = trail_from(tilt, b, radius) / wheelbase
        _check(sigma, check_trail, "offset")
    elif tilt is None:
        tilt = tilt_from(sigma * wheelbase, b, radius)
        if np.any(np.isnan(tilt)):
            problem = f"no head angle gives this trail with an offset of {_first(b, np.isnan(tilt)):g} m"
            hint = f"allowed: less than the front wheel's radius, {radius:g} m; 45 mm are written 45mm"
            raise InputError(problem, key=("offset",), hint=hint)
        _check(tilt, check_tilt, "offset")
    else:
        _consistent(tilt, sigma * wheelbase, b, radius)
    return tilt, sigma


def in_notation(numbers: Mapping[str, float], wheelbase: str, trail: str) -> dict[str, float]:
    """A machine's numbers with its tilt and ``trail``, a key in metres or ``sigma``, in place of MEASURED.

    ``wheelbase`` is the key of that. Raises InputError as ``design_given``.
    """
    left = {name: value for name, value in numbers.items() if name not in MEASURED}
    c, radius = left.get(wheelbase, 0.0), left.get("rF", left.get("R2", left.get("R")))
    if not c > 0 or radius is None:
        return left  # of which the parameters' own checks tell
    given: dict[str, float] = {name: left.pop(name) for name in ("lam", "sigma") if name in left}
    given |= {name: numbers[name] for name in MEASURED if name in numbers}
    if trail != "sigma" and trail in left:
        given["sigma"] = left.pop(trail) / c
    lam, sigma = design_given(given, c, radius)
    if lam is not None:
        left["lam"] = float(lam)
    if sigma is not None:
        typed = numbers.get(trail, numbers.get("trail"))  # to the last digit
        left[trail] = float(sigma) if trail == "sigma" else float(sigma * c) if typed is None else typed
    return left


def _check(values: Any, check: Any, key: str) -> None:
    if values is not None:
        for extreme in (np.min(values), np.max(values)):  # NaN is both
            check(float(extreme), (key,))


def _check_head_angle(head_angle: float, key: tuple[str | int, ...]) -> None:
    if not 0 < head_angle < math.pi:
        raise InputError(
            f"a head angle of {head_angle:g} rad is out of range",
            key=key, hint="allowed: between 0deg and 180deg, both excluded; degrees are written 71deg",
        )  # fmt: skip


def _agreed(names: tuple[str, str], value: Any, known: Any, scale: float, unit: str) -> Any:
    """``known`` if there is one, which must then be as ``value``; else that. Both are told scaled."""
    if known is None:
        return value
    apart = np.abs(value - known) * scale > (_SAME_ANGLE if unit == "rad" else _SAME_LENGTH)
    if np.any(apart):
        a, b = (_first(x * scale, apart) for x in (value, known))
        problem = f"{' and '.join(names)} are both given, and differ: {a:.6g} {unit} and {b:.6g} {unit}"
        raise InputError(problem, key=names[:1], hint="give one of them")
    return known


def _consistent(tilt: Any, trail: Any, offset: Any, radius: float) -> None:
    follows = trail_from(tilt, offset, radius)
    apart = np.abs(follows - trail) > _SAME_LENGTH
    if np.any(apart):
        angle = 90 - math.degrees(_first(tilt, apart))
        b, wrong, right = (1000 * _first(x, apart) for x in (offset, trail, follows))
        raise InputError(
            f"a head angle of {angle:.6g}° and an offset of {b:.6g} mm give a trail of {right:.6g} mm, "
            f"not {wrong:.6g} mm",
            key=("offset",), hint="give two of head angle, trail and offset",
        )  # fmt: skip


def _first(values: Any, chosen: Any) -> float:
    return float(np.broadcast_to(values, np.shape(chosen))[chosen].flat[0])
