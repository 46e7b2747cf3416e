"""Sign changes of the conditions on the grid, refined by scipy: a witness of the exact critical speeds.

The conditions are evaluated as they stand, without polynomials in V and without the exact speeds, at every
speed of the grid in some columns (λ, σ); where one changes its sign between two speeds, scipy's bracketing
root finder closes in on the zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.errors import ScanError
from bikestab.family import Family
from bikestab.model import Floats
from bikestab.rounding import NO_SIGN
from bikestab.routh import CONDITIONS, condition, conditions
from bikestab.scan.agreement import AGREEMENT, Agreement, by_rounding, size_of_terms
from bikestab.scan.linking import widened
from bikestab.scan.rootfinder import find_root
from bikestab.scan.sheets import Roots, Sheets
from bikestab.scan.tile import Tile

COLUMNS = 2_500  # looked at, at most; they have some four sign changes each
POINTS = 1 << 22  # of the grid that are evaluated for that, at most
_PART = 1 << 14  # of them at a time, so that they fit the cache
_STEPS = 0.7548776662466927, 0.5698402909980532  # of λ and σ: irrational, so that the columns lie evenly


class Brackets(NamedTuple):
    """Sign changes of one condition: tables (5, 4, bracket), the speeds on both sides, and all exact roots.

    ``exact`` [m/s] has shape (bracket, root), NaN where a cell has none.
    """

    table: Floats
    below: Floats
    above: Floats
    exact: Floats


class Bracketing:
    """The witness of one scan: tiles are given to ``add`` in any order, then ``agreement`` tells.

    Which columns are looked at depends on their place in the grid alone. ``V`` [m/s] are all its speeds,
    ``columns`` is the number of its (λ, σ), of all machines of a sweep.
    """

    def __init__(self, V: Floats, columns: int) -> None:
        self._V = V
        self._share = min(COLUMNS, POINTS / len(V)) / columns
        self._brackets: dict[str, list[Brackets]] = {name: [] for name in CONDITIONS}
        self._waiting: list[tuple[Family, Floats, Floats, dict[str, Floats]]] = []

    def add(
        self, place: tuple[int, int], tile: Tile, roots: Mapping[str, Roots | Sheets],
        undecided: NDArray[np.bool_],
    ) -> None:  # fmt: skip
        """Find the sign changes in some columns of a tile that begins at ``place`` and has these roots.

        Left out are the (λ, σ) where there may be others.
        """
        chosen = self._chosen(place, tile.shape[-3:-1]) & ~undecided
        exact = {name: found.V[chosen] for name, found in roots.items()}
        if tile.swept:
            self._look_at(_tables(tile, chosen), exact)
            return
        *_, i, j = np.nonzero(chosen)
        if self._waiting and self._waiting[0][0] != tile.family:
            self._look_at_waiting()
        self._waiting.append((tile.family, tile.x[i], tile.y[j], exact))

    def _look_at_waiting(self) -> None:
        """Look at the columns of all tiles of one machine: their tables are formed faster together."""
        if not self._waiting:
            return
        families, x, y, exact = zip(*self._waiting, strict=True)
        self._waiting = []
        most = {name: max(each[name].shape[-1] for each in exact) for name in CONDITIONS}
        whole = {
            name: np.concatenate([widened(each[name], most[name], np.nan) for each in exact])
            for name in CONDITIONS
        }
        self._look_at(families[0].table(np.concatenate(x), np.concatenate(y)), whole)

    def _look_at(self, tables: Floats, exact: dict[str, Floats]) -> None:
        step = max(1, _PART // len(self._V))
        for start in range(0, tables.shape[-1], step):
            some = slice(start, start + step)
            for first in range(0, len(self._V) - 1, _PART):
                V = self._V[first : first + _PART + 1]
                self._look(tables[..., some], V, {name: each[some] for name, each in exact.items()})

    def agreement(self) -> Agreement:
        """How far scipy's zeros are from the exact speeds. Raises ScanError where that is too far."""
        self._look_at_waiting()
        total = Agreement()
        for name, parts in self._brackets.items():
            if parts:
                total = total.combined(_compared(name, _whole(parts)))
        if total.largest > AGREEMENT:
            raise ScanError(
                "zeros of the conditions that scipy finds between speeds of the grid differ from the exact "
                f"critical speeds by {total.largest:.3g} m/s, more than the {AGREEMENT:g} m/s that both "
                "should reach; please report this with the config"
            )
        return total

    def _chosen(self, place: tuple[int, int], shape: tuple[int, ...]) -> NDArray[np.bool_]:
        i, j = (first + np.arange(n) for first, n in zip(place, shape, strict=True))
        return (_STEPS[0] * i[:, np.newaxis] + _STEPS[1] * j) % 1 < self._share

    def _look(self, table: Floats, V: Floats, exact: dict[str, Floats]) -> None:
        """Note the sign changes of a table (5, 4, cell) between neighbouring V."""
        for name, values in conditions(table[..., np.newaxis], V)._asdict().items():
            positive, negative = values > 0, values < 0
            changes = (positive[:, :-1] & negative[:, 1:]) | (negative[:, :-1] & positive[:, 1:])
            cell, k = np.nonzero(changes)
            if len(cell):
                self._brackets[name].append(Brackets(table[..., cell], V[k], V[k + 1], exact[name][cell]))


def _tables(tile: Tile, chosen: NDArray[np.bool_]) -> Floats:
    """The tables (5, 4, cell) of chosen (…, x, y) of a tile of many machines."""
    i, j = np.nonzero(chosen.any(axis=tuple(range(len(tile.block)))))
    table = tile.family.table(tile.x[i], tile.y[j], tile.swept)
    return table[:, :, chosen[..., i, j].reshape(table.shape[2], -1)]


def _whole(parts: list[Brackets]) -> Brackets:
    most = max(part.exact.shape[-1] for part in parts)
    return Brackets(
        np.concatenate([part.table for part in parts], axis=-1),
        np.concatenate([part.below for part in parts]),
        np.concatenate([part.above for part in parts]),
        np.concatenate([widened(part.exact, most, np.nan) for part in parts]),
    )


def _compared(name: str, brackets: Brackets) -> Agreement:
    """Refine the sign changes of a condition and compare them with the nearest exact roots.

    Left out is what rounding alone may have made: a change between values that are no numbers.
    """
    table, below, above, exact = brackets
    clear = np.ones(len(below), bool)
    for V in (below, above):
        clear &= np.abs(condition(table, name, V)) > NO_SIGN * size_of_terms(table, name, V)
    table, below, above, exact = table[..., clear], below[clear], above[clear], exact[clear]
    zero = zeros(name, table, below, above)
    far = np.abs(exact - zero[:, np.newaxis])
    difference = np.where(np.isnan(far), np.inf, far).min(axis=1, initial=np.inf)
    loose = np.zeros(len(zero), bool)
    poor = np.flatnonzero(~(difference <= AGREEMENT))
    if len(poor):
        moved, reach = by_rounding(table[..., poor], name, zero[poor])
        loose[poor] = ~(moved < AGREEMENT) & (difference[poor] <= reach)
    return Agreement(
        len(zero),
        float(difference[~loose].max(initial=0)),
        int(np.count_nonzero(loose)),
        float(difference[loose].max(initial=0)),
        int(np.count_nonzero(~clear)),
    )


def zeros(name: str, table: Floats, below: Floats, above: Floats) -> Floats:
    """Where a condition of tables (5, 4, bracket) is zero between two speeds at which its signs differ [m/s].

    NaN where the root finder says that it failed, or ends where the condition is no number: with NaN at one
    end of a bracket it ends in success.
    """

    def value(V: Floats, bracket: NDArray[np.intp]) -> Floats:
        return condition(table[..., bracket], name, V)

    if not len(below):
        return below
    result = find_root()(value, (below, above), args=(np.arange(len(below)),))
    return np.where(result.success & np.isfinite(result.f_x), result.x, np.nan)
