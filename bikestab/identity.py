"""What a scan computes → its identity: a hash of the values that decide the numbers."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def identity(
    model: str, machines: Floats, grid: list[Floats], fields: Iterable[str], sweep: Mapping[str, Floats],
    ensemble: Mapping[str, Any] | None, named: Sequence[str] = (), *, fast: bool = False,
) -> str:  # fmt: skip
    """The ``config_sha256`` of a scan.

    ``machines`` has a row of the paper's parameters for each machine, NaN where one is not given, ``grid``
    the values of λ, σ and V, ``fields`` the words with which a config asks for them, and ``sweep`` the values
    of its axes by their names. Where the grid has other axes than λ and σ, ``named`` are the names of
    both and of the parameters in each row. ``fast``
    tells that growth rates come from the compiled kernel.
    """
    return digest({
        "model": model, "machines": machines, "grid": grid, "fields": sorted(set(fields)),
        "sweep": [[name, values] for name, values in sweep.items()], "ensemble": ensemble,
        **({"named": list(named)} if named else {}),
        **({"fast": True} if fast else {}),
    })  # fmt: skip


def digest(values: Mapping[str, Any]) -> str:
    """The SHA-256 of values: mappings, lists, text, whole numbers, and arrays of double precision.

    Equal doubles give equal hashes, −0 and 0 too, and the order of a mapping's keys does not count.
    """
    text = json.dumps(values, sort_keys=True, default=_digest_of_array)
    return hashlib.sha256(text.encode()).hexdigest()


def _digest_of_array(values: ArrayLike) -> str:
    doubles = np.asarray(values, "<f8") + 0.0  # of −0 that makes 0
    return f"{doubles.shape} {hashlib.sha256(doubles.tobytes()).hexdigest()}"
