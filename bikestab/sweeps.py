"""Which machine of a sweep is meant."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from bikestab.errors import InputError, nearest


def chosen(
    axes: Mapping[str, NDArray[np.float64]], values: Mapping[str, float], place: str
) -> dict[str, int]:
    """The number of the machine on each axis of a sweep at these ``values``.

    Raises InputError for an unknown or missing axis, and for a value that it does not have.
    """
    for name in values:
        if name not in axes:
            hint = nearest(name, axes) if axes else "its config has no sweep"
            raise InputError(f"has no axis {name!r}", place=place, hint=hint)
    allowed = {name: ", ".join(f"{value:g}" for value in axis) for name, axis in axes.items()}
    if missing := [name for name in axes if name not in values]:
        several = " and ".join(f"{name} = {allowed[name]}" for name in missing)
        example = " ".join(f"--at {name}={axes[name][0]:g}" for name in missing)
        hint = f"choose one, for example {example}"
        raise InputError(f"has several machines, with {several}", place=place, hint=hint)
    numbers = {}
    for name, axis in axes.items():
        near = int(np.argmin(np.abs(axis - values[name])))
        if not np.isclose(axis[near], values[name], rtol=1e-9, atol=0):
            raise InputError(
                f"has no {name} = {values[name]:g}", place=place, hint=f"allowed: {allowed[name]}"
            )
        numbers[name] = near
    return numbers
