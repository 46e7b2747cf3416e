"""scipy imported in two thirds of the time: without parts of numpy that it lists and does not use."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np

_UNUSED = "f2py", "testing"


class _Late(ModuleType):
    """A module that is imported when something of it is asked for."""

    def __getattr__(self, name: str) -> Any:
        return getattr(import_module(self.__name__), name)


@contextmanager
def lean_numpy() -> Iterator[None]:
    """Within it, what copies all names of numpy imports no front end of a compiler, nor unittest.

    >>> with lean_numpy():
    ...     from scipy.spatial import Delaunay
    """
    late = {name: _Late(f"numpy.{name}") for name in _UNUSED if name not in vars(np)}
    vars(np).update(late)
    try:
        yield
    finally:
        for name, module in late.items():
            if vars(np).get(name) is module:  # else it was imported after all
                delattr(np, name)
