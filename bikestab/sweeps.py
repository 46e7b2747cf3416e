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
    numbers = {}
    for name, axis in axes.items():
        allowed = ", ".join(f"{value:g}" for value in axis)
        if name not in values:
            problem = f"has several machines, with {name} = {allowed}"
            hint = f"choose one, for example --at {name}={axis[0]:g}"
            raise InputError(problem, place=place, hint=hint)
        near = int(np.argmin(np.abs(axis - values[name])))
        if not np.isclose(axis[near], values[name], rtol=1e-9, atol=0):
            raise InputError(f"has no {name} = {values[name]:g}", place=place, hint=f"allowed: {allowed}")
        numbers[name] = near
    return numbers
