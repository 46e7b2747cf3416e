"""A tile of the grid → its fields, compressed, and what depends on its (λ, σ) alone.

A tile needs nothing but itself, so it can be computed by any process or machine, in any order.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.critical import Critical, critical
from bikestab.errors import ScanError
from bikestab.fields import FIELDS, Points
from bikestab.model import ExactTable, Floats, Model, exact_table
from bikestab.routh import CONDITIONS
from bikestab.scan.agreement import AGREEMENT, Agreement
from bikestab.scan.chunks import bundled, packed
from bikestab.scan.crosscheck import check
from bikestab.scan.ensemble import ensemble_statistics
from bikestab.scan.sheets import Roots, most_roots
from bikestab.scan.signs import undecided, violated_between
from bikestab.speeds import Intervals, intervals_between

if TYPE_CHECKING:
    from bikestab.config.variation import Ensemble

_POINTS = 1 << 14  # evaluated at a time, so that an array of them and its temporaries fit the cache


@dataclass(frozen=True)
class Tile:
    """A part of the grid: λ [rad], σ [1] and V [m/s] of one machine, and what is wanted of it.

    ``lowest`` says whether it has the lowest speeds of its (λ, σ): it then also gives what does not depend on
    V. Else ``above`` [m/s] is the last speed of the tile below.
    """

    bicycle: Bicycle
    model: Model
    lam: Floats
    sigma: Floats
    V: Floats
    fields: tuple[str, ...]
    chunk: tuple[int, int, int]
    lowest: bool
    above: float = 0.0
    ensemble: Ensemble | None = None

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of λ, σ and V."""
        return len(self.lam), len(self.sigma), len(self.V)


class Columns(NamedTuple):
    """What a tile's (λ, σ) have: the intervals of stable speed, the roots of each condition, and the spread.

    ``undecided`` (λ, σ) tells where there may be other roots. ``spread`` (λ, σ, item) is an ensemble's
    ``somewhere``, ``unbounded``, and quantiles of V1 and of V2.
    """

    intervals: Intervals
    roots: dict[str, Roots]
    undecided: NDArray[np.bool_]
    spread: Floats

    def to_bytes(self) -> bytes:
        """The columns as they are kept until the volume is written."""
        V1, V2, lower, upper, V1_error, V2_error, marginal = self.intervals.arrays().values()
        V = [roots.V for roots in self.roots.values()]
        rising = [roots.rising for roots in self.roots.values()]
        out = io.BytesIO()
        for array in (
            np.stack([V1, V2, V1_error, V2_error]), np.stack([lower, upper, marginal]),
            np.cumsum([each.shape[-1] for each in V]),
            np.concatenate(V, axis=-1), np.concatenate(rising, axis=-1), self.undecided, self.spread,
        ):  # fmt: skip
            np.save(out, array, allow_pickle=False)
        return out.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> Columns:
        """The columns that ``to_bytes`` turned into bytes."""
        file = io.BytesIO(data)
        ends, kinds, stops, V, rising, *others = (np.load(file, allow_pickle=False) for _ in range(7))
        each = zip(np.split(V, stops[:-1], axis=-1), np.split(rising, len(CONDITIONS), axis=-1), strict=True)
        roots = {name: Roots(*arrays) for name, arrays in zip(CONDITIONS, each, strict=True)}
        (V1, V2, V1_error, V2_error), (lower, upper, marginal) = ends, kinds
        return cls(Intervals(V1, V2, lower, upper, V1_error, V2_error, marginal), roots, *others)


class Finished(NamedTuple):
    """A computed tile: what is counted over all tiles, the columns' bytes if any, and the fields' chunks."""

    notes: dict[str, Any]
    columns: bytes
    chunks: bytes


def compute(tile: Tile) -> Finished:
    """Evaluate a tile.

    Raises ScanError where the exact critical speeds and the conditions themselves do not agree.
    """
    keep_heap()
    whole = exact_table(tile.bicycle, tile.lam[:, np.newaxis], tile.sigma, model=tile.model)
    whole = whole.reshape(5, 4, -1)
    table, exact = whole.value, critical(whole)
    mask = violated_between(table, exact, tile.V)
    agreement = check(table, exact, mask, tile.V, tile.above)
    if agreement.largest > AGREEMENT:
        raise _disagreement(agreement)
    notes = {"stable_points": int(np.count_nonzero(mask == 0)), "agreement": agreement}
    probability, spread = _ensemble(tile) if tile.ensemble else (None, np.empty((*tile.shape[:2], 0)))
    chunks = []
    for name in tile.fields:
        chunks += packed(field_values(name, table, tile, mask, probability), tile.chunk)
    columns = b""
    if tile.lowest:
        of_columns = _columns(whole, exact, spread)
        columns = of_columns.to_bytes()
        notes["intervals"] = of_columns.intervals.V1.shape[-1]
        notes["most_roots"] = {name: most_roots(roots) for name, roots in of_columns.roots.items()}
    return Finished(notes, columns, bundled(chunks))


def keep_heap() -> None:
    """Keep freed memory in the process: temporaries otherwise return to the system one by one.

    glibc raises its limits for that to the size of the largest mapped block freed so far. Without it
    a tile without growth rates takes half as long again.
    """
    np.empty(1 << 21)


def field_values(
    name: str,
    table: Floats,
    tile: Tile,
    mask: NDArray[np.uint8],
    probability: NDArray[np.float32] | None = None,
) -> NDArray:
    """A field at a tile's points, from its table (5, 4, cell), mask and probability (cell, V); (λ, σ, V)."""
    field = FIELDS[name]
    out = np.empty(mask.shape, field.dtype)
    speeds = min(len(tile.V), 256)
    cells = max(1, _POINTS // speeds)
    for i in range(0, len(out), cells):
        part = table[:, :, i : i + cells, np.newaxis]
        for k in range(0, len(tile.V), speeds):
            at = np.s_[i : i + cells, k : k + speeds]
            share = None if probability is None else probability[at]
            with np.errstate(over="ignore"):  # what single precision cannot hold is inf in the file
                out[at] = field.values(Points(part, tile.V[k : k + speeds], mask[at], share))
    return out.reshape(tile.shape)


def _ensemble(tile: Tile) -> tuple[NDArray[np.float32], Floats]:
    """The probability at each point (cell, V), and the spread of ``Columns``."""
    assert tile.ensemble is not None
    n, m, _ = tile.shape
    machines, quantiles = tile.ensemble.machines(tile.bicycle), tile.ensemble.quantiles
    lam, sigma = np.repeat(tile.lam, m), np.tile(tile.sigma, n)
    statistics = ensemble_statistics(machines, lam, sigma, tile.V, tile.model, quantiles)
    spread = np.column_stack([statistics.somewhere, statistics.unbounded, statistics.V1, statistics.V2])
    return statistics.probability, spread.reshape(n, m, -1)


def _columns(table: ExactTable, exact: Critical, spread: Floats) -> Columns:
    shape = spread.shape[:2]
    intervals = intervals_between(table, exact)
    roots = {}
    for name in CONDITIONS:
        V = exact.speeds[name].T.reshape(*shape, len(exact.speeds[name]))
        roots[name] = Roots(V, (exact.sign[name] < 0).reshape(*shape, 1))
    ends = Intervals(*(field.reshape(*shape, field.shape[-1]) for field in intervals.arrays().values()))
    return Columns(ends, roots, undecided(exact).reshape(shape), spread)


def _disagreement(agreement: Agreement) -> ScanError:
    problem = (
        "the conditions' signs at the grid's speeds or beside the exact critical speeds are not those that "
        "these give"
        if np.isinf(agreement.largest)
        else f"zeros of the conditions differ from the exact critical speeds by {agreement.largest:.3g} m/s, "
        f"more than the {AGREEMENT:g} m/s that both should reach"
    )
    return ScanError(f"{problem}; please report this with the config")
