"""What is in a volume, as one record."""

from __future__ import annotations

from math import prod
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
        "fields": volume.fields,
        "ensemble_samples": volume.samples,
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
    }
