"""The best designs of several free parameters as the rows of a table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from bikestab.design.free import Free, FreeBest
from bikestab.export.tables import FRONT, Block, Columns
from bikestab.variants import parameter_of


def optima_columns(free: Free) -> Columns:
    """What a design is called, its free parameters, and the columns of FRONT."""
    units = {name: ("float64", parameter_of(free.bicycle, name).unit) for name in free.ends}
    return {"design": ("string", ""), **units, **FRONT}


def optima_blocks(best: FreeBest) -> Iterator[Block]:
    """One row for each design that there is; a number that is None is missing."""
    rows: list[dict[str, Any]] = [
        {"design": name, **design, **design["over"]} for name, design in best.designs.items()
    ]
    texts = {"design", "at", "lower", "upper"}
    names = dict.fromkeys(name for row in rows for name in row if name != "over")
    if rows:
        yield {
            name: np.array([row[name] for row in rows], object if name in texts else float) for name in names
        }
