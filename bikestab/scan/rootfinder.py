"""scipy's vectorised root finder by itself: to import all of ``scipy.optimize`` takes three times as long."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bikestab.lean import alone


def find_root() -> Callable[..., Any]:
    """``scipy.optimize.elementwise.find_root``."""
    find: Callable[..., Any] = alone("scipy.optimize", "_elementwise", "find_root", "elementwise")
    return find
