"""What functions of a machine are given, numbers or text with units → arrays that the equations can use."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError, nearest
from bikestab.gains import infinite_at_rest
from bikestab.limits import check_speed, check_tilt, check_trail
from bikestab.model import MODELS, ExactTable, Floats, Model, exact_table
from bikestab.units import ANGLE, PURE, SPEED, quantity, shown

Given: TypeAlias = ArrayLike | None  # None: the bicycle's own
_EXAMPLE = {"lam": "0.2", "sigma": "0.08"}


def design_of(bicycle: Bicycle, lam: Given, sigma: Given) -> tuple[Floats, Floats]:
    """The λ [rad] and σ [1] that are given, or else the bicycle's own, each as an array.

    Raises InputError, with the key ``lam`` or ``sigma``, where there is none, or one that cannot be used.
    """
    chosen = {
        "lam": bicycle.lam if lam is None else lam, "sigma": bicycle.sigma if sigma is None else sigma
    }  # fmt: skip
    if missing := [name for name, value in chosen.items() if value is None]:
        problem = f"the bicycle {bicycle.name!r} has no {' and no '.join(missing)} of its own"
        examples = [f"{name}={_EXAMPLE[name]}" for name in missing]
        hint = f"give {'one' if len(missing) == 1 else 'both'}, for example {' '.join(examples)}"
        raise InputError(problem, key=missing[:1], hint=hint)
    tilt, trail = (_checked(name, value) for name, value in chosen.items() if value is not None)
    return tilt, trail


def table_and_speeds(
    bicycle: Bicycle, V: ArrayLike, lam: Given, sigma: Given, model: Model, delta: Any
) -> tuple[ExactTable, Floats]:
    """The table of the designs, and the speeds. InputError for what cannot be used or broadcast together."""
    if not isinstance(bicycle, Bicycle):
        hint = "Bicycle.load takes a name or a file, Bicycle.from_mapping parameters"
        raise InputError(f"{shown(bicycle)} is no Bicycle", key=("bicycle",), hint=hint)
    if model not in MODELS:
        raise InputError(f"there is no model {model!r}", key=("model",), hint=nearest(str(model), MODELS))
    tilt, trail = design_of(bicycle, lam, sigma)
    speeds = _checked("V", V)
    if np.any(speeds == 0):
        check_at_rest(bicycle)
    try:
        np.broadcast_shapes(tilt.shape, trail.shape, speeds.shape)
    except ValueError:
        shapes = ", ".join(
            f"{k} {x.shape}" for k, x in (("lam", tilt), ("sigma", trail), ("V", speeds)) if x.ndim
        )
        hint = "give each an axis of its own, as lam[:, None]"
        raise InputError(f"shapes do not broadcast together: {shapes}", hint=hint) from None
    return exact_table(bicycle.with_delta(delta), tilt, trail, model=model), speeds


def check_at_rest(bicycle: Bicycle) -> None:
    """Raise InputError, with the key ``V``, for a bicycle that has no equations at V = 0."""
    if names := infinite_at_rest(dict(bicycle.gains)):
        problem = f"{names[0]}/V of the bicycle {bicycle.name!r} is infinite at V = 0"
        raise InputError(problem, key=("V",), hint="allowed: above 0")


def _checked(name: str, given: ArrayLike) -> Floats:
    """Numbers, or text with units, as an array of what the equations can use."""
    units, check = {
        "lam": (ANGLE, check_tilt), "sigma": (PURE, check_trail), "V": (SPEED, check_speed),
    }[name]  # fmt: skip
    values = np.asarray(given)
    if values.dtype.kind not in "iuf":
        numbers = [quantity(x, units, key=(name,)) for x in values.ravel().tolist()]
        values = np.reshape(numbers, values.shape)
    values = values.astype(float)
    for extreme in (values.min(initial=0), values.max(initial=0)):  # NaN is both
        check(float(extreme), (name,))
    return values
