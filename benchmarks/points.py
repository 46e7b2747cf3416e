"""How long bikestab takes for a grid point, beside what else computes the same, in one process.

    python benchmarks/points.py [--quick] [--json FILE]

The signs of all methods are compared before anything is timed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod

import common
import numpy as np
from bicycleparameters.models import Meijaard2007Model
from bicycleparameters.parameter_sets import Meijaard2007ParameterSet
from common import BICYCLE, BOX, DELTA, Aim, Report, Table, Task, measure, short
from numpy.typing import NDArray

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.compiled import available
from bikestab.critical import critical
from bikestab.family import Family
from bikestab.model import canonical_matrices, characteristic_table
from bikestab.notation import MEIJAARD
from bikestab.presets import preset_text
from bikestab.routh import conditions, violated
from bikestab.scan.signs import violated_between
from bikestab.scan.tile import Tile, compute, field_values
from bikestab.units import ANGLE, PURE, quantity

SHAPE = (64, 128)  # λ and σ of a tile, as a large scan has them
FEW = (16, 128, 256)  # a tile for what takes longer
MARGINAL = 1e-9  # s⁻¹, growth rates too small to have a sign in every method


def tile(shape: tuple[int, ...], delta: float, fields: tuple[str, ...]) -> Tile:
    """A tile that spans the box."""
    lam, sigma, V = (np.linspace(*BOX[name], n) for name, n in zip(BOX, shape, strict=True))
    bicycle = Bicycle.preset(BICYCLE).with_delta(delta)
    return Tile(Family(bicycle), lam, sigma, V, fields, (32, 32, 32), lowest=True)


def masks(t: Tile) -> NDArray[np.uint8]:
    """``violated`` (cell, V) of a tile and, to be timed as well, ``stable``."""
    table = characteristic_table(t.family.bicycle, t.x[:, np.newaxis], t.y).reshape(5, 4, -1)
    mask = violated_between(table, critical(table, rough=True), t.V, rough=True)
    field_values("stable", table, t, mask)
    return mask


def growth(t: Tile) -> NDArray[np.float32]:
    """``growth_rate`` of a tile."""
    table = characteristic_table(t.family.bicycle, t.x[:, np.newaxis], t.y).reshape(5, 4, -1)
    return field_values("growth_rate", table, t, np.empty((len(t.x) * len(t.y), len(t.V)), np.uint8))


@dataclass
class Sample:
    """Points of a tile: their indices in it, their first-order matrices (point, 4, 4), λ, trail and V."""

    at: tuple[NDArray, NDArray, NDArray]
    matrices: NDArray
    lam: NDArray
    c: NDArray
    V: NDArray


def sample(t: Tile, columns: int, speeds: int) -> Sample:
    n, m, k = t.shape
    cells = np.linspace(0, n * m - 1, columns).astype(int)
    V_at = np.linspace(0, k - 1, speeds).astype(int)
    at_lam, at_sigma = np.divmod(cells, m)
    A = np.zeros((columns, speeds, 4, 4))
    A[..., 0, 2] = A[..., 1, 3] = 1
    v = t.V[V_at][:, np.newaxis, np.newaxis]
    damping = np.diag([0, t.family.bicycle.delta])
    for row, i, j in zip(A, at_lam, at_sigma, strict=True):
        M, C1, K0, K2 = canonical_matrices(t.family.bicycle, t.x[i], t.y[j])
        row[:, 2:, :2] = -np.linalg.solve(M, t.family.bicycle.g * K0 + v**2 * K2)
        row[:, 2:, 2:] = -np.linalg.solve(M, v * C1 + damping)
    at = np.repeat(at_lam, speeds), np.repeat(at_sigma, speeds), np.tile(V_at, columns)
    return Sample(at, A.reshape(-1, 4, 4), t.x[at[0]], t.y[at[1]] * t.family.bicycle.c, t.V[at[2]])


def peer_model() -> Meijaard2007Model:
    """BicycleParameters' model of the same bicycle."""
    preset = yamltext.parse(preset_text(BICYCLE), BICYCLE).data
    values = {
        key: quantity(preset[key], ANGLE if key == "lam" else PURE) for key in MEIJAARD if key in preset
    }
    return Meijaard2007Model(Meijaard2007ParameterSet({**values, "v": 1.0}, True))


def compare(t: Tile, s: Sample, model: Meijaard2007Model | None, few: slice) -> str:
    """Assert that the methods agree; returns what was found, in words."""
    mask, rate = masks(t), growth(t)
    table = characteristic_table(t.family.bicycle, t.x[:, np.newaxis], t.y).reshape(5, 4, -1, 1)
    assert np.array_equal(mask, violated(conditions(table, t.V))), "the roots and the conditions differ"
    at = mask.reshape(t.shape)[s.at] == 0
    peer = np.linalg.eigvals(s.matrices).real.max(axis=-1)
    clear = np.abs(peer) > MARGINAL
    assert np.array_equal(at[clear], peer[clear] < 0), "stable and eigvals differ"
    assert np.array_equal(np.signbit(rate[s.at])[clear], peer[clear] < 0), "growth_rate and eigvals differ"
    if model:
        other = model.calc_eigen(lam=s.lam[few], c=s.c[few], v=s.V[few])[0].real.max(axis=-1)
        assert np.array_equal(at[few][clear[few]], other[clear[few]] < 0), "stable and calc_eigen differ"
    return (
        f"δ = {t.family.bicycle.delta:g}: all signs agree at {np.count_nonzero(clear)} points, "
        f"{np.count_nonzero(at & clear)} of them stable; {np.count_nonzero(~clear)} were left out, "
        f"with a growth rate within ±{MARGINAL:g} 1/s."
    )


def own_tasks(delta: float) -> dict[str, Task]:
    """What bikestab is timed at."""
    wanted = ("stable", "violated")
    small = tile(FEW, delta, ("growth_rate",))
    tasks = {}
    for speeds in (256, 512):
        t = tile((*SHAPE, speeds), delta, wanted)
        name = f"stable + violated, {speeds} speeds"
        tasks[name] = Task(name, lambda t=t: masks(t), prod(t.shape))
    name = "the same in a scan"
    tasks[name] = Task(f"{name}: checked, intervals, compressed", lambda: compute(t), prod(t.shape))
    tasks["growth_rate"] = Task("growth_rate", lambda: growth(small), prod(small.shape))
    if available():
        fast = replace(small, fast=True)
        tasks["fast"] = Task("growth_rate by the compiled kernel", lambda: growth(fast), prod(fast.shape))
    return tasks


def peer_tasks(s: Sample, model: Meijaard2007Model, few: slice) -> dict[str, Task]:
    """What else is timed."""
    two = np.empty((2, *SHAPE, 512), np.uint8)
    source = np.ones_like(two)
    number = len(s.V[few])
    return {
        "eigvals": Task(
            "numpy.linalg.eigvals, 4×4 stack ready made", lambda: np.linalg.eigvals(s.matrices), len(s.V)
        ),
        "calc_eigen": Task(
            "BicycleParameters calc_eigen(lam, c, v)",
            lambda: model.calc_eigen(lam=s.lam[few], c=s.c[few], v=s.V[few]),
            number,
        ),
        "calc_eigen_v": Task(
            "BicycleParameters calc_eigen(v), one λ and c", lambda: model.calc_eigen(v=s.V[few]), number
        ),
        "fill": Task("ndarray.fill of as many bytes", lambda: two.fill(0), two[0].size),
        "copy": Task("copy of as many bytes", lambda: np.copyto(two, source), two[0].size),
    }


def run(quick: bool) -> Report:
    """Compare, time, report."""
    report = Report("Points: ns per grid point, one process")
    model = peer_model()
    few = slice(None, None, 64 if quick else 32)
    samples, own = {}, {}
    for delta in (0.0, DELTA):
        t = tile(FEW, delta, ("growth_rate",))
        samples[delta] = sample(t, 64 if quick else 256, 32)
        report.parts.append(compare(t, samples[delta], None if delta else model, few))
        own[delta] = own_tasks(delta)
    np.empty(1 << 21)  # numpy's freed memory then stays in the process, as in a scan
    peers = peer_tasks(samples[0.0], model, few)
    every = [task for tasks in (*own.values(), peers) for task in tasks.values()]
    measure(every, rounds=1 if quick else 15, at_least=0.0 if quick else 0.03)

    eigvals, calc_eigen = peers["eigvals"].ns, peers["calc_eigen"].ns
    rows = []
    for label, tasks in ((f"bikestab, δ = {d:g}: ", own[d]) for d in own):
        rows += [[label + task.name, *_numbers(task, eigvals, calc_eigen)] for task in tasks.values()]
    rows += [[task.name, *_numbers(task, eigvals, calc_eigen)] for task in peers.values()]
    report.parts.append(Table(["", "ns", "eigvals / this", "calc_eigen / this"], rows))
    for delta, tasks in own.items():
        for name, by_eigvals, by_peer in (
            ("stable + violated, 512 speeds", 2000, 20_000),
            ("growth_rate", 40, 500),
        ):
            words, ns = f"{name}, δ = {delta:g}: times faster than", tasks[name].ns
            report.aims.append(Aim(f"{words} eigvals", by_eigvals, eigvals / ns))
            report.aims.append(Aim(f"{words} calc_eigen", by_peer, calc_eigen / ns))
        report.data[f"delta {delta:g}"] = {name: {"ns": task.ns} for name, task in tasks.items()}
    report.data["peers"] = {name: {"ns": task.ns} for name, task in peers.items()}
    return report


def _numbers(task: Task, eigvals: float, calc_eigen: float) -> list[str]:
    return [short(task.ns), short(eigvals / task.ns), short(calc_eigen / task.ns)]


if __name__ == "__main__":
    common.main(__doc__, {"points": run})
