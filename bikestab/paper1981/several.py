"""Several machines at once, so that small maps of many cost what a large one of a single machine does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.machines import Machines

_DESIGNS = 1 << 15  # at a time: a table of 10⁶ designs would take 160 MB
_NAMES = [name for name, field in Machines.__dataclass_fields__.items() if field.type == "Any"]  # numbers


def together(bicycles: Sequence[Bicycle]) -> Machines:
    """Bicycles as machines of shape (bicycle, 1, 1), to be broadcast against designs (n, m)."""
    shape = (len(bicycles), 1, 1)
    columns: dict[str, Any] = {
        name: np.array([getattr(b, name) for b in bicycles]).reshape(shape) for name in _NAMES
    }
    return Machines(shape=shape, **columns)


def groups(bicycles: Sequence[Bicycle], designs: int) -> Iterator[list[Bicycle]]:
    """As many bicycles at a time as fit, with this number of designs of each."""
    rest = iter(bicycles)
    while group := list(islice(rest, max(_DESIGNS // designs, 1))):
        yield group
