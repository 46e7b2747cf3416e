"""Derivatives of stable speeds, of the lowest growth rate and of the first stable σ as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from bikestab.export.tables import Block, Columns

_TEXT = ("string", "")
_NUMBER = ("float64", "")
SENSITIVITY: Columns = {
    "interval": ("int32", "1"), "parameter": _TEXT, "value": _NUMBER, "unit": _TEXT,
    "dV1": _NUMBER, "dV2": _NUMBER, "elasticity_V1": ("float64", "1"), "elasticity_V2": ("float64", "1"),
    "change": _NUMBER, "dgrowth_rate": _NUMBER, "dsigma_min": _NUMBER,
}  # fmt: skip


def sensitivity_blocks(record: Mapping[str, Any], none: Sequence[Mapping[str, Any]]) -> Iterator[Block]:
    """The rows of SENSITIVITY from ``design.effects``: one per interval and parameter, as of interval 0 if
    there is ``none``. The last two columns are of the design and the same in all its intervals.
    """
    intervals = [interval["parameters"] for interval in record["intervals"]]
    slopes = {"dgrowth_rate": record["best"]["slope"], "dsigma_min": record["sigma_min"]["slope"]}
    for number, rows in enumerate(intervals or [none], 1 if intervals else 0):
        names = [row["name"] for row in rows]
        values = {"parameter": names} | {key: [of.get(name) for name in names] for key, of in slopes.items()}
        block: Block = {"interval": np.full(len(rows), number, np.int32)}
        for name, (kind, _) in SENSITIVITY.items():
            if name != "interval":
                own = values[name] if name in values else [row[name] for row in rows]
                block[name] = np.array(own, float if kind == "float64" else object)
        yield block
