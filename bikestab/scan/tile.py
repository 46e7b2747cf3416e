"""A tile of the grid → its fields, compressed, and what depends on its (λ, σ) alone.

A tile needs nothing but itself, so it can be computed by any process or machine, in any order.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.compiled import growth_rates
from bikestab.critical import Critical, critical
from bikestab.errors import ScanError
from bikestab.family import Family
from bikestab.fields import FIELDS, Points
from bikestab.gradients import speed_gradients
from bikestab.model import ExactTable, Floats
from bikestab.routh import CONDITIONS
from bikestab.scan.agreement import AGREEMENT, Agreement
from bikestab.scan.chunks import bundled, packed
from bikestab.scan.crosscheck import check
from bikestab.scan.ensemble import ensemble_statistics
from bikestab.scan.planes import sheets_of_planes
from bikestab.scan.sheets import Roots, Sheets, most_roots
from bikestab.scan.signs import undecided, violated_between
from bikestab.speeds import Intervals, intervals_between

if TYPE_CHECKING:
    from bikestab.config.variation import Ensemble

_POINTS = 1 << 14  # evaluated at a time, so that an array of them and its temporaries fit the cache
_SPEEDS = 256  # of them in a row, at most


@dataclass(frozen=True)
class Tile:
    """A part of the grid: x, y and V [m/s] of the families of one machine or many, and what is wanted of it.

    ``lowest`` says whether it has the lowest speeds of its (λ, σ): it then also gives what does not depend on
    V. ``above`` [m/s] is the last speed of the tile below, ``beyond`` the first of the next. ``block`` has a
    sweep's axes' lengths, and ``whole`` says whether these are all cells of the machines. Of many machines
    ``swept`` has a column (machine, 1) of each varied parameter. ``fast`` asks for the compiled kernel.
    """

    family: Family
    x: Floats
    y: Floats
    V: Floats
    fields: tuple[str, ...]
    chunk: tuple[int, ...]
    lowest: bool
    above: float = 0.0
    beyond: float = np.inf
    ensemble: Ensemble | None = None
    block: tuple[int, ...] = ()
    whole: bool = False
    swept: Mapping[str, Floats] = field(default_factory=dict)
    fast: bool = False
    gradients: bool = False

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values on each axis of a sweep, and of x, y and V."""
        return (*self.block, len(self.x), len(self.y), len(self.V))

    @property
    def cells(self) -> tuple[Floats, Floats]:
        """X and y of each cell, one after the other."""
        return np.repeat(self.x, len(self.y)), np.tile(self.y, len(self.x))

    def table(self) -> ExactTable:
        """The table (5, 4, cell) of all cells of all machines."""
        if self.swept:
            table = self.family.exact_table(*self.cells, self.swept)
        else:
            table = self.family.exact_table(self.x[:, np.newaxis], self.y)
        return table.reshape(*table.shape[:2], -1)


class Columns(NamedTuple):
    """What a tile's (λ, σ) have: the intervals of stable speed, the roots of each condition, and the spread.

    Where the tile has whole planes there are ``sheets`` of the roots, else the ``roots`` as they come.
    ``undecided`` (λ, σ) tells where there may be others. ``spread`` (λ, σ, item) is an ensemble's
    ``somewhere``, ``unbounded``, and quantiles of V1 and of V2. ``gradients`` are those of
    ``speed_gradients``, if they are asked for. All have a sweep's axes in front.
    """

    intervals: Intervals
    roots: dict[str, Roots]
    sheets: dict[str, Sheets]
    undecided: NDArray[np.bool_]
    spread: Floats
    gradients: Floats

    def to_bytes(self) -> bytes:
        """The columns as they are kept until the volume is written."""
        V1, V2, lower, upper, V1_error, V2_error, marginal = self.intervals.arrays().values()
        V, other = zip(*(self.sheets or self.roots).values(), strict=True)
        out = bytearray()
        for array in (
            np.stack([V1, V2, V1_error, V2_error]), np.stack([lower, upper, marginal]),
            np.cumsum([each.shape[-1] for each in V]),
            np.concatenate(V, axis=-1), np.concatenate(other, axis=-1), self.undecided, self.spread,
            self.gradients,
        ):  # fmt: skip
            head = json.dumps([array.dtype.str, array.shape]).encode()
            out += len(head).to_bytes(4, "little") + head + array.tobytes()
        return bytes(out)

    @classmethod
    def from_bytes(cls, data: bytes) -> Columns:
        """The columns that ``to_bytes`` turned into bytes."""
        ends, kinds, stops, V, other, *others = _arrays(data)
        kind, cuts = (Sheets, stops[:-1]) if other.dtype == np.uint8 else (Roots, len(CONDITIONS))
        each = zip(CONDITIONS, np.split(V, stops[:-1], axis=-1), np.split(other, cuts, axis=-1), strict=True)
        found: dict[str, Any] = {name: kind(*arrays) for name, *arrays in each}
        roots, sheets = ({}, found) if kind is Sheets else (found, {})
        (V1, V2, V1_error, V2_error), (lower, upper, marginal) = ends, kinds
        return cls(Intervals(V1, V2, lower, upper, V1_error, V2_error, marginal), roots, sheets, *others)


def _arrays(data: bytes) -> Iterator[NDArray]:
    """Arrays, each behind the length of its description, and that: dtype and shape."""
    at = 0
    while at < len(data):
        begin = at + 4 + int.from_bytes(data[at : at + 4], "little")
        dtype, shape = json.loads(data[at + 4 : begin])
        array = np.frombuffer(data, dtype, prod(shape), begin).reshape(shape)
        at = begin + array.nbytes
        yield array


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
    whole = tile.table()
    table, exact = whole.value, critical(whole, rough=not tile.lowest)
    mask = violated_between(whole, exact, tile.V, (tile.above, tile.beyond), rough=not tile.lowest)
    agreement = check(table, exact, mask, tile.V, tile.above)
    if agreement.largest > AGREEMENT:
        raise _disagreement(agreement)
    notes = {"stable_points": int(np.count_nonzero(mask == 0)), "agreement": agreement}
    probability, spread = _ensemble(tile) if tile.ensemble else (None, np.empty((*tile.shape[:-1], 0)))
    chunks = []
    for name in tile.fields:
        chunks += packed(field_values(name, table, tile, mask, probability), tile.chunk)
    columns = b""
    if tile.lowest:
        of_columns = _columns(whole, exact, spread, tile)
        columns = of_columns.to_bytes()
        notes["intervals"] = of_columns.intervals.V1.shape[-1]
        if tile.whole:
            notes["sheets"] = max(sheets.V.shape[-1] for sheets in of_columns.sheets.values())
        else:
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
    if tile.fast and name == "growth_rate":
        return growth_rates(table, tile.V).reshape(tile.shape)
    field = FIELDS[name]
    if field.at_once:
        return field.values(Points(table[..., np.newaxis], tile.V, mask)).reshape(tile.shape)
    out = np.empty(mask.shape, field.dtype)
    speeds = -(-len(tile.V) // -(-len(tile.V) // _SPEEDS))  # equal parts, for a short one costs more
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
    family, quantiles = tile.family, tile.ensemble.quantiles
    draws, away = tile.ensemble.parted(family.bicycle, (family.x, family.y))
    statistics = ensemble_statistics(family, draws, *tile.cells, tile.V, quantiles, away, fast=tile.fast)
    spread = np.column_stack([statistics.somewhere, statistics.unbounded, statistics.V1, statistics.V2])
    return statistics.probability, spread.reshape(*tile.shape[:-1], -1)


def _columns(table: ExactTable, exact: Critical, spread: Floats, tile: Tile) -> Columns:
    shape, in_sheets = spread.shape[:-1], tile.whole
    intervals = intervals_between(table, exact)
    roots = {}
    for name in CONDITIONS:
        V = exact.speeds[name].T.reshape(*shape, len(exact.speeds[name]))
        roots[name] = Roots(V, (exact.sign[name] < 0).reshape(*shape, 1))
    ends = Intervals(*(field.reshape(*shape, field.shape[-1]) for field in intervals.arrays().values()))
    gradients = np.empty((*ends.V1.shape, 0))
    if tile.gradients:
        found = speed_gradients(tile.family, *tile.cells, intervals, tile.swept)
        gradients = found.reshape(*ends.V1.shape, 4)
    sheets = {}
    if in_sheets:
        sheets = {name: sheets_of_planes(name, each, ends) for name, each in roots.items()}
    return Columns(
        ends, {} if in_sheets else roots, sheets, undecided(exact).reshape(shape), spread, gradients
    )


def _disagreement(agreement: Agreement) -> ScanError:
    problem = (
        "the conditions' signs at the grid's speeds or beside the exact critical speeds are not those that "
        "these give"
        if np.isinf(agreement.largest)
        else f"zeros of the conditions differ from the exact critical speeds by {agreement.largest:.3g} m/s, "
        f"more than the {AGREEMENT:g} m/s that both should reach"
    )
    return ScanError(f"{problem}; please report this with the config")
