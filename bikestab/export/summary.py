"""What is in a volume, as one record."""

from __future__ import annotations

from itertools import product
from math import isfinite, prod
from typing import Any

import numpy as np

from bikestab.fields import coordinates
from bikestab.volume import Volume, uniform


def summary(volume: Volume) -> dict[str, Any]:
    """Names, counts and axes of a volume, as JSON can hold them. Raises InputError where it is damaged."""
    file, units = volume.file, coordinates(volume.family)
    checks = dict(file["boundary"].attrs)
    bracketed = checks.get("largest_bracketed_difference")  # earlier volumes have none
    number = np.count_nonzero(volume.read("upper"), axis=-1)
    return {
        "volume": str(volume.path),
        "title": volume.text("title"),
        "bicycle": volume.text("bicycle"),
        "model": volume.model,
        "delta": volume.bicycle.delta,
        "fields": [*volume.fields, *(["certified"] if "certified" in file else [])],
        "ensemble_samples": volume.samples,
        "drawn": _drawn(volume) if volume.samples else {},
        "points": prod(len(file[name]) for name in (*volume.swept, *volume.axes)),
        "stable_points": int(file.attrs["stable_points"]),
        "designs": int(number.size),
        "designs_with_a_stable_speed": int(np.count_nonzero(number)),
        "designs_with_several_intervals": int(np.count_nonzero(number > 1)),
        "designs_stable_without_upper_limit": int(np.count_nonzero(np.isinf(volume.read("V2")).any(axis=-1))),
        "designs_marginal": int(np.count_nonzero(volume.read("marginal"))) if "marginal" in file else None,
        "largest_boundary_difference": float(checks["largest_difference"]),
        "largest_bracketed_difference": None if bracketed is None else float(bracketed),
        "bikestab_version": volume.text("bikestab_version"),
        "config_sha256": volume.text("config_sha256"),
        "sweep": {name: values.tolist() for name, values in volume.swept.items()},
        "axes": {
            name: {
                "first": float(values[0]),
                "last": float(values[-1]),
                "num": len(values),
                "unit": units[name][0],
                "uniform": uniform(values),
            }
            for name, values in ((name, volume.axis(name)) for name in volume.axes)
        },
        "warnings": volume.text("warnings").splitlines(),
        "machines": _machines(volume) if volume.swept or volume.samples else [],
    }


def _machines(volume: Volume) -> list[dict[str, Any]]:
    """Each machine of a sweep, and what an ensemble says of the design of the grid nearest to its own."""
    names, axes = list(volume.swept), list(volume.swept.values())
    machines = []
    for values in product(*(axis.tolist() for axis in axes)):
        chosen = dict(zip(names, values, strict=True))
        one = volume.at(chosen)
        stable = np.count_nonzero(one.read("upper"), axis=-1)
        points = int(np.count_nonzero(one.read("stable"))) if "stable" in volume.fields else None
        at, quantiles = _quantiles(one)
        machines.append(
            {
                "set": chosen, "designs_with_a_stable_speed": int(np.count_nonzero(stable)),
                "stable_points": points, "at": at, "quantiles": quantiles,
            }
        )  # fmt: skip
    return machines


def _drawn(volume: Volume) -> dict[str, dict[str, list[float]]]:
    """An ensemble's parameters, each with the name of its distribution and the numbers of it."""
    from bikestab.config.variation import ensemble_in

    ensemble = ensemble_in(volume.text("config"))
    parameters = ensemble.parameters if ensemble else {}
    return {
        name: {kind: list(values) for kind, values in one.model_dump(exclude_unset=True).items()}
        for name, one in parameters.items()
    }


def _quantiles(volume: Volume) -> tuple[dict[str, float], list[dict[str, float | None]]]:
    if not volume.samples:
        return {}, []
    names = volume.axes[:2]
    own = volume.family.own
    values = [volume.axis(name) for name in names]
    middle = [x[len(x) // 2] if near is None else near for near, x in zip(own, values, strict=True)]
    cell = tuple(int(np.argmin(np.abs(x - near))) for near, x in zip(middle, values, strict=True))
    V1, V2 = (volume.read(f"{end}_quantiles", cell).tolist() for end in ("V1", "V2"))
    rows = [
        {"quantile": share, "V1": finite(a), "V2": finite(b)}
        for share, a, b in zip(volume.file["quantile"][()].tolist(), V1, V2, strict=True)
    ]
    return {name: float(x[i]) for name, x, i in zip(names, values, cell, strict=True)}, rows


def finite(value: float) -> float | None:
    """A number as records hold it: None for one that is not finite."""
    return value if isfinite(value) else None
