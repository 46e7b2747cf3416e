"""Processor times of columns and single designs in this process: ns per column, or per design, as JSON.

``against.py`` runs this with the Python of each build. An earlier one needs no more than numpy; names that it
has otherwise are looked up.
"""

from __future__ import annotations

import importlib
import json
import time
from collections.abc import Callable
from typing import Any

BOX = (0.0, 0.6, 64), (0.0, 0.15, 128)  # λ [rad] and σ: a tile of a scan


def measured() -> dict[str, float]:
    """Processor times of this build: ns per column, and µs per design."""
    import numpy as np

    from bikestab.bicycle import Bicycle

    model, speeds = importlib.import_module("bikestab.model"), importlib.import_module("bikestab.speeds")
    intervals_of = getattr(speeds, "intervals_of", None) or speeds.stable_intervals
    table_of = model.characteristic_table
    exact_of = getattr(model, "exact_table", table_of)
    lam, sigma = np.linspace(*BOX[0])[:, np.newaxis], np.linspace(*BOX[1])
    flat = np.repeat(lam.ravel(), BOX[1][2]), np.tile(sigma, BOX[0][2])
    np.empty(1 << 21)  # as scans do: glibc keeps what is freed
    out, number = {}, lam.size * sigma.size
    for delta in (0.0, 1.0):
        bicycle = Bicycle.preset("meijaard2007").with_delta(delta)
        table = table_of(bicycle, lam, sigma)
        tasks: dict[str, tuple[Callable[[], Any], int]] = {
            "table": (lambda b=bicycle: table_of(b, lam, sigma), number),
            "table of pairs": (lambda b=bicycle: table_of(b, *flat), number),
            "critical": (lambda t=table: speeds.critical(t), number),
            "intervals": (lambda t=table: intervals_of(t), number),
            "table and intervals": (lambda b=bicycle: intervals_of(exact_of(b, lam, sigma)), number),
            "table of one design": (lambda b=bicycle: table_of(b, 0.3, 0.08), 1),
            "table and intervals of one design": (lambda b=bicycle: intervals_of(exact_of(b, 0.3, 0.08)), 1),
        }  # fmt: skip
        for name, (run, many) in tasks.items():
            best = float("inf")
            for _ in range(4 if many > 1 else 40):
                start = time.process_time()
                run()
                best = min(best, time.process_time() - start)
            out[f"δ = {delta:g}: {name}"] = best / many * 1e9
    return out


if __name__ == "__main__":
    print(json.dumps(measured()))
