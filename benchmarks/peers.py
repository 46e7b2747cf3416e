"""Other programs that find the edge of the stable region, beside this one.

    python benchmarks/peers.py [--quick] [--json FILE]

AUTO-07p runs where bifpy is installed (its build needs gfortran), marching cubes where scikit-image is; what
is not there is left out, with a word. Errors are distances in V from the exact speeds.
"""

from __future__ import annotations

import time
from typing import Any

import common
import numpy as np
from common import BICYCLE, BOX, Report, Table, Task, measure, short
from numpy.typing import NDArray
from points import peer_model

import bikestab as bs
from bikestab.model import characteristic_table, exact_table
from bikestab.routh import condition, conditions
from bikestab.speeds import critical_speeds

LOW, HIGH, COARSE = 0.0, 10.0, 100  # m/s; speeds that BicycleParameters is asked for before it is halved
KNOWN = 4.2923825363411, 6.0242620153884  # m/s, weave and capsize of the benchmark bicycle
CURVE = 300  # points of AUTO's on either side
BIKE = bs.Bicycle.preset(BICYCLE)


def halved(model: Any) -> tuple[float, float]:
    """V1 and V2 of one machine by BicycleParameters: signs at some speeds, then bisection."""

    def growth(V: Any) -> NDArray:
        return model.calc_eigen(v=np.atleast_1d(V))[0].real.max(axis=-1)

    V = np.linspace(LOW + 0.05, HIGH, COARSE)
    stable = growth(V) < 0
    ends = []
    for k in np.flatnonzero(stable[1:] != stable[:-1]):
        low, high = V[k], V[k + 1]
        while high - low > 1e-10:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if (growth(middle)[0] < 0) == stable[k] else (low, middle)
        ends.append(0.5 * (low + high))
    return ends[0], ends[1]


def one_machine(rounds: int) -> Table:
    model = peer_model()
    own = bs.stable_intervals(BIKE)
    assert np.allclose(halved(model), (own.V1[0], own.V2[0]), atol=1e-8), "V1 and V2 differ"
    tasks = [
        Task("bs.stable_intervals", lambda: bs.stable_intervals(BIKE)),
        Task(f"BicycleParameters, {COARSE} speeds and bisection", lambda: halved(model)),
    ]
    measure(tasks, rounds, 0.05)
    rows = [[t.name, short(1e3 * t.best), short(t.best / tasks[0].best)] for t in tasks]
    return Table(["V1 and V2 of one machine", "ms", "/ bs.stable_intervals"], rows)


def grid(n: int) -> list[NDArray]:
    return [np.linspace(*BOX[name], n) for name in BOX]


def from_exact(lam: NDArray, sigma: NDArray, V: NDArray, name: str) -> NDArray:
    """How far speeds are from the nearest zero of a condition at their (λ, σ) [m/s]."""
    exact = critical_speeds(exact_table(BIKE, lam, sigma))[name]
    far = np.abs(exact - V)
    return np.where(np.isnan(far), np.inf, far).min(axis=0)


def marching_cubes(sizes: list[int], rounds: int) -> Table | str:
    try:
        from skimage.measure import marching_cubes as triangles
    except ImportError:
        return "scikit-image is not installed: no marching cubes."
    rows = []
    for n in sizes:
        lam, sigma, V = grid(n)
        table = characteristic_table(BIKE, lam[:, np.newaxis], sigma)
        values = conditions(table[..., np.newaxis], V).hurwitz3
        tasks = [
            Task("exact", lambda table=table: critical_speeds(table)["hurwitz3"]),
            Task("cubes", lambda values=values: triangles(values, 0.0)),
        ]
        measure(tasks, rounds)
        places = triangles(values, 0.0)[0].T
        at = [
            np.interp(place, np.arange(n), axis) for place, axis in zip(places, (lam, sigma, V), strict=True)
        ]
        far = from_exact(*at, "hurwitz3")
        far = far[np.isfinite(far)]
        rows.append(
            [f"{n}³", short(1e3 * tasks[1].best), f"{np.median(far):.1e}", short(1e3 * tasks[0].best)]
        )
    head = [
        "hurwitz3 = 0",
        "marching cubes [ms]",
        "median error [m/s]",
        "critical_speeds of as many columns [ms]",
    ]
    return Table(head, rows)


def followed(auto: Any, name: str, start: float, number: int) -> NDArray:
    """Points (2, point) of λ and V at which a condition is zero, by continuation both ways from one."""
    size = abs(condition(characteristic_table(BIKE, BIKE.lam, BIKE.sigma), name, 2 * start))

    def residual(state: Any, parameters: Any) -> list[float]:
        table = characteristic_table(BIKE, float(parameters[0]), BIKE.sigma)
        return [float(condition(table, name, float(state[0]))) / size]

    def begin(state: Any, parameters: Any, _: Any) -> None:
        state[0], parameters[0] = start, BIKE.lam

    found = []
    for direction in (1, -1):
        settings = {
            "ips": auto.IPS_ALGEBRAIC_SYSTEM, "ndim": 1, "npar": 1, "nmx": number, "ntst": 20, "ncol": 4,
            "iad": 3, "ilp": 0, "isp": 0, "iads": 1, "itmx": 9, "itnw": 7, "nwtn": 3, "jac": 0,
            "ds": 2e-3 * direction, "dsmin": 1e-5, "dsmax": 5e-3, "rl0": BOX["lam"][0], "rl1": BOX["lam"][1],
            "a0": 0.0, "a1": 50.0, "epsl": 1e-10, "epsu": 1e-10, "epss": 1e-8,
        }  # fmt: skip
        points = auto.run(residual, begin, settings, icu=[1]).branches[0].points
        found += [(point.parameters[0], point.state[0]) for point in points]
    return np.array(found).T


def continuation(number: int) -> Table | str:
    try:
        from bifpy import auto
    except ImportError:
        return "bifpy is not installed (its build needs gfortran): no AUTO-07p."
    rows = []
    for name, start in zip(("hurwitz3", "p0"), KNOWN, strict=True):
        before = time.perf_counter()
        lam, V = followed(auto, name, start, number)
        seconds = time.perf_counter() - before
        same = np.linspace(*BOX["lam"], len(lam))
        own = Task("", lambda lam=same, name=name: critical_speeds(exact_table(BIKE, lam, BIKE.sigma))[name])
        measure([own], 3)
        worst = from_exact(lam, np.full(len(lam), BIKE.sigma), V, name).max()
        rows.append([f"{name} = 0", str(len(V)), short(seconds), f"{worst:.1e}", short(1e3 * own.best)])
    head = ["(V, λ)", "points", "AUTO-07p [s]", "largest error [m/s]", "critical_speeds at as many λ [ms]"]
    return Table(head, rows)


def run(quick: bool) -> Report:
    rounds = 1 if quick else 7
    parts = [
        one_machine(rounds),
        marching_cubes([17] if quick else [33, 65, 129], rounds),
        continuation(10 if quick else CURVE),
    ]
    return Report("Peers of the region", parts)


if __name__ == "__main__":
    common.main(__doc__, {"peers": run})
