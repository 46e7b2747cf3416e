"""A scan's config → its tiles: how the grid is cut, in the volume's own order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import ceil, prod

import numpy as np

from bikestab.config.scanconfig import ScanConfig
from bikestab.fields import FIELDS, GRADIENTS
from bikestab.model import Floats
from bikestab.scan.tile import Tile

_COLUMN, _SAMPLE = 2.0, 1.0  # µs per (λ, σ), per (λ, σ) and sample; on one core
_SAVED = 42.0  # ns per point, by the compiled kernel
_TILE_BYTES = 1 << 24  # of a tile's fields before compression
_TILE_COLUMNS = 64, 128  # λ and σ of a tile; with small grids as many (λ, σ) of several machines
_CHUNK = 32, 32, 32
_ENSEMBLE_COLUMNS, _ENSEMBLE_CHUNK = (16, 16), (16, 16, 64)


@dataclass(frozen=True)
class Plan:
    """The tiles of a scan.

    A tile has one machine of the sweep, a rectangle of (λ, σ) and as many speeds as memory bears; its
    sides are multiples of the file's chunks. Where a machine's whole grid is less than that, it has several
    machines, which follow each other. An ensemble takes long per (λ, σ): its rectangles are small.
    """

    config: ScanConfig

    @cached_property
    def fields(self) -> tuple[str, ...]:
        """The fields that the volume holds, in the file's order."""
        asked = {*self.config.fields, *([""] if self.config.ensemble else [])}
        return tuple(name for name, field in FIELDS.items() if field.asked in asked)

    @cached_property
    def lead(self) -> tuple[int, ...]:
        """The lengths of the sweep's axes."""
        return tuple(len(axis.values) for axis in self.config.axes)

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """The shape of the volume's fields."""
        return (*self.lead, *self.config.grid.shape)

    @property
    def points(self) -> int:
        """How many points they have."""
        return prod(self.shape)

    @cached_property
    def chunk(self) -> tuple[int, ...]:
        """A chunk of a field in the file: a slice across any axis reads one layer of them."""
        sides = _ENSEMBLE_CHUNK if self.config.ensemble else _CHUNK
        within = tuple(map(min, sides, self.config.grid.shape))
        most = prod(sides) // prod(within) if within == self.config.grid.shape else 1
        return (*_block(self.lead, min(most, self._machines)), *within)

    @cached_property
    def tile(self) -> tuple[int, ...]:
        """The largest tile."""
        steps = zip(_block(self.lead, self._machines), self.lead, self.chunk, strict=False)
        block = (n if n == whole else n // step * step for n, whole, step in steps)
        return (*block, *self._tile_of_one)

    @cached_property
    def _tile_of_one(self) -> tuple[int, ...]:
        """The largest tile of one machine."""
        grid, (n, m) = self.config.grid.shape, map(min, self._columns, self.config.grid.shape)
        chunk = min((_ENSEMBLE_CHUNK if self.config.ensemble else _CHUNK)[2], grid[2])
        speeds = max(1, _TILE_BYTES // (n * m * self._bytes) // chunk) * chunk
        return tuple(map(min, (n, m, speeds), grid))

    @property
    def _columns(self) -> tuple[int, int]:
        return _ENSEMBLE_COLUMNS if self.config.ensemble else _TILE_COLUMNS

    @cached_property
    def _bytes(self) -> int:
        """Of a point's fields."""
        return sum(np.dtype(FIELDS[name].dtype).itemsize for name in self.fields)

    @cached_property
    def _machines(self) -> int:
        """How many machines a tile may have; their ensembles are drawn one by one."""
        grid = self.config.grid.shape
        if self.config.ensemble or self._tile_of_one != grid:
            return 1
        return max(1, min(prod(self._columns) // prod(grid[:2]), _TILE_BYTES // (prod(grid) * self._bytes)))

    @cached_property
    def _counts(self) -> tuple[int, ...]:
        return tuple(ceil(n / step) for n, step in zip(self.shape, self.tile, strict=True))

    def __len__(self) -> int:
        return prod(self._counts)

    def place(self, number: int) -> tuple[int, ...]:
        """The tile's first index in the volume."""
        at = np.unravel_index(number, self._counts)
        return tuple(int(i) * n for i, n in zip(at, self.tile, strict=True))

    def cell(self, number: int) -> tuple[int, int]:
        """The tile's first indices of λ and σ."""
        i, j = self.place(number)[-3:-1]
        return i, j

    @property
    def members(self) -> int:
        """How many machines the sweep has."""
        return prod(self.lead)

    @property
    def whole(self) -> bool:
        """Whether a tile has all (λ, σ) of its machines."""
        return self.tile[-3:-1] == self.config.grid.shape[:2]

    def members_of(self, number: int) -> range:
        """The numbers of a tile's machines."""
        if not self.lead:
            return range(1)
        first = self.place(number)[:-3]
        start = int(np.ravel_multi_index(first, self.lead))
        return range(start, start + prod(self._block_at(first)))

    def _block_at(self, first: tuple[int, ...]) -> tuple[int, ...]:
        """How many values of the sweep's axes the tile has that begins there."""
        return tuple(min(step, n - i) for step, n, i in zip(self.tile, self.lead, first, strict=False))

    def lowest(self, member: int) -> list[int]:
        """The numbers of the tiles with the lowest speeds of one machine, row by row.

        It must have tiles of its own.
        """
        *_, n, m, k = self._counts
        return [(member * n * m + i) * k for i in range(n * m)]

    def __getitem__(self, number: int) -> Tile:
        config, place = self.config, self.place(number)
        x, y, V = (
            values[i : i + n] for values, i, n in zip(self._axes, place[-3:], self.tile[-3:], strict=True)
        )
        lowest = place[-1] == 0
        last = place[-1] + len(V)
        above = 0.0 if lowest else float(self._axes[2][place[-1] - 1])
        beyond = float(self._axes[2][last]) if last < len(self._axes[2]) else np.inf
        members = self.members_of(number)
        family, swept = config.family(members[0]), {}
        if len(members) > 1:
            family, values = config.family(None), [config.members[member].values for member in members]
            swept = {name: np.array([[each[name]] for each in values]) for name in values[0]}
        return Tile(
            family, x, y, V, self.fields, self.chunk, lowest, above, beyond, config.ensemble,
            block=self._block_at(place[:-3]), whole=self.whole,
            gradients=GRADIENTS in config.fields, swept=swept, fast=config.compiled,
        )  # fmt: skip

    @cached_property
    def _axes(self) -> list[Floats]:
        return [self.config.grid.values(name) for name in self.config.grid.names]

    def seconds(self) -> float:
        """About how long one core takes."""
        columns = self.points / self.shape[-1]
        samples = self.config.ensemble.samples if self.config.ensemble else 0
        each = sum(FIELDS[name].cost for name in self.fields)
        if self.config.compiled:
            each -= _SAVED
        return 1e-9 * each * self.points + 1e-6 * columns * (_COLUMN + _SAMPLE * samples)


def _block(axes: tuple[int, ...], most: int) -> tuple[int, ...]:
    """The sides of the largest block of the axes whose elements follow each other, ``most`` of them."""
    sides: list[int] = []
    for n in reversed(axes):
        sides.insert(0, max(1, min(n, most)))
        most //= n
    return tuple(sides)
