"""scipy imported in two thirds of the time: without what it lists and does not use, and some of it alone."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec, module_from_spec
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


def alone(room: str, module: str, name: str, public: str = "") -> Any:
    """What a module of a room of scipy has by a name, without the rest; or what the public one has.

    What is imported for it is forgotten, so that whoever imports the room later gets all of it.

    >>> edt = alone("scipy.ndimage", "_morphology", "distance_transform_edt")
    """
    if room not in sys.modules and (spec := find_spec(room)):
        sys.modules[room] = module_from_spec(spec)  # as yet empty, and nothing in it is run
        try:
            with lean_numpy():
                return getattr(import_module(f"{room}.{module}"), name)
        except (ImportError, AttributeError):  # in another scipy it may be elsewhere
            pass
        finally:
            for each in [each for each in sys.modules if each == room or each.startswith(f"{room}.")]:
                del sys.modules[each]
    return getattr(import_module(f"{room}.{public}" if public else room), name)
