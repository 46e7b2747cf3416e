"""table → its entries as numbers in twice double precision, in units that keep their products in range."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.halved import Halved, halved_double
from bikestab.model import ExactTable, Floats
from bikestab.rounding import CLOSE, ENTRY, LEFT
from bikestab.twofold import Double, Pair, Twofold

EVEN = (
    (0, 0),
    (0, 2),
    (1, 1),
    (1, 3),
    (2, 0),
    (2, 2),
    (3, 1),
    (4, 0),
)  # without damping
DAMPED = (*EVEN, (3, 0), (1, 0))
_LARGE = 2.0**60  # of entries whose products by three and four stay in range


class Entries:
    """Entries (cell,) of the tables of some cells, by (k, j): those that there are."""

    def __init__(self, numbers: dict[tuple[int, int], Twofold]) -> None:
        self.numbers = numbers
        self._halved: dict[tuple[int, int], Halved] = {}

    def at(self, cells: NDArray[Any]) -> Entries:
        """Some of the cells."""
        return Entries({key: a.at(cells) for key, a in self.numbers.items()})

    def __len__(self) -> int:
        return len(self.numbers[4, 0].value)

    def doubles(self) -> dict[tuple[int, int], Double]:
        """Them in double precision, with sizes that are themselves and 1/CLOSE of their errors."""
        return {
            key: Double(a.value, np.abs(a.value) + a.size * (ENTRY / CLOSE) if np.ndim(a.rest) else a.size)
            for key, a in self.numbers.items()
        }

    def sized(self) -> dict[tuple[int, int], Double]:
        """Them in double precision, with the sizes of all their terms."""
        return {key: Double(a.value, a.size) for key, a in self.numbers.items()}

    def cancelled(self) -> dict[tuple[int, int], Twofold]:
        """Them with sizes of what is left of each: products of three are right to CANCELLED of theirs."""
        return {
            key: Twofold(a.value, a.rest, np.abs(a.value) + LEFT * a.size) for key, a in self.numbers.items()
        }

    def pair(self, k: int, j: int, cell: Any = slice(None)) -> Pair:
        """One of them in twice double precision, in some cells."""
        a = self.numbers[k, j]
        return a.value[cell], a.rest[cell] if np.ndim(a.rest) else a.rest

    def halved(self, k: int, j: int) -> Halved:
        """One of them as a number of 79 bits."""
        if (k, j) not in self._halved:
            self._halved[k, j] = halved_double(*self.pair(k, j))
        return self._halved[k, j]


class Cells(NamedTuple):
    """A table (5, 4, cell); None for the other parts of an ``ExactTable`` where it is exactly its doubles."""

    value: Floats
    rest: Floats | None
    error: Floats | None

    def some(self, chosen: Any) -> Cells:
        """Some of the cells."""
        return self.each(lambda array: array[..., chosen])

    def each(self, change: Callable[[Floats], Floats]) -> Cells:
        """All parts that there are, changed alike."""
        others = (None if each is None else change(each) for each in self[1:])
        return Cells(change(self.value), *others)

    def has(self, key: tuple[int, int]) -> NDArray[np.bool_]:
        """Which cells have an entry: all but those where it is zero whatever the numbers are."""
        return self.value[key] != 0 if self.error is None else self.error[key] > 0

    def entry(self, key: tuple[int, int], unit: Floats | None) -> Twofold:
        """One of them, in a unit that is a power of two."""
        value, rest, error = (None if each is None else each[key] for each in self)
        if unit is not None:
            value, rest, error = (None if each is None else each * unit for each in (value, rest, error))
        return Twofold(value, 0.0 if rest is None else rest, None if error is None else error / ENTRY)


def cells_of(table: Floats | ExactTable) -> Cells:
    """The cells of a table (5, 4, *shape), one after the other."""
    cells = Cells(*table) if isinstance(table, ExactTable) else Cells(table, None, None)
    return cells.each(lambda array: array.reshape(*array.shape[:2], -1))


def scaled(table: Cells, keys: Sequence[tuple[int, int]], closed: bool) -> tuple[Entries, Floats | None]:
    """The entries in units of speed, time and size that bring p4, q0 and k near one, and the unit of speed.

    The units are powers of two, so that no bit changes: they keep products in range. In ``closed`` forms,
    where intervals to be cut do not depend on them, entries that are in range already stay as they are.
    """
    if closed and all(_moderate(table.value[key]) for key in keys):
        return Entries({key: table.entry(key, None) for key in keys}), None
    p4, k, q0 = (np.clip(np.frexp(table.value[key])[1], -300, 300) for key in ((4, 0), (3, 1), (2, 0)))
    time = (q0 - p4) // 2
    speed = np.clip(p4 + time - k, -200, 200)
    units = {(i, j): np.ldexp(1.0, time * (i - 4) + speed * j - p4) for i, j in keys}
    return Entries({key: table.entry(key, unit) for key, unit in units.items()}), np.ldexp(1.0, speed)


def _moderate(a: Floats) -> bool:
    """Whether products of three or four of these numbers are in range."""
    size = np.abs(a)
    if size.max(initial=0) >= _LARGE:
        return False
    return bool(size.min(initial=1) > 1 / _LARGE or np.all((size > 1 / _LARGE) | (size == 0)))
