"""scipy's vectorised root finder by itself: to import all of ``scipy.optimize`` takes three times as long."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec, module_from_spec
from typing import Any

from bikestab.lean import lean_numpy

_ROOM = "scipy.optimize"


def find_root() -> Callable[..., Any]:
    """``scipy.optimize.elementwise.find_root``, from its own module where that can be had alone.

    What is imported for it is forgotten, so that whoever imports ``scipy.optimize`` later gets all of it.
    """
    if _ROOM not in sys.modules and (spec := find_spec(_ROOM)):
        sys.modules[_ROOM] = module_from_spec(spec)  # as yet empty, and nothing in it is run
        try:
            with lean_numpy():
                return import_module(f"{_ROOM}._elementwise").find_root
        except (ImportError, AttributeError):  # in another scipy it may be elsewhere
            pass
        finally:
            for name in [name for name in sys.modules if name == _ROOM or name.startswith(f"{_ROOM}.")]:
                del sys.modules[name]
    return import_module(f"{_ROOM}.elementwise").find_root
