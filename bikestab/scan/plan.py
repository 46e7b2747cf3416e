"""A scan's config → its tiles: how the grid is cut, in the volume's own order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import ceil, prod
from typing import Any

import numpy as np

from bikestab.config.scanconfig import ScanConfig
from bikestab.fields import AXES, FIELDS
from bikestab.scan.tile import Tile

_COLUMN, _SAMPLE = 2.0, 1.0  # µs per (λ, σ), per (λ, σ) and sample; on one core
_TILE_BYTES = 1 << 24  # of a tile's fields before compression


@dataclass(frozen=True)
class Plan:
    """The tiles of a scan.

    A tile has one machine of the sweep, a rectangle of (λ, σ) and as many speeds as memory bears; its
    sides are multiples of the file's chunks. An ensemble takes long per (λ, σ): its rectangles are small.
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
    def chunk(self) -> tuple[int, int, int]:
        """A chunk of a field in the file: a slice across any axis reads one layer of them."""
        sides = (16, 16, 64) if self.config.ensemble else (32, 32, 32)
        return tuple(map(min, sides, self.config.grid.shape))  # type: ignore[return-value]  # three of each

    @cached_property
    def tile(self) -> tuple[int, int, int]:
        """The largest tile."""
        n, m, _ = map(min, (16, 16, 1) if self.config.ensemble else (64, 128, 1), self.config.grid.shape)
        each = sum(np.dtype(FIELDS[name].dtype).itemsize for name in self.fields)
        chunk = self.chunk[2]
        speeds = max(1, _TILE_BYTES // (n * m * each) // chunk) * chunk
        return tuple(map(min, (n, m, speeds), self.config.grid.shape))  # type: ignore[return-value]  # three

    @cached_property
    def _counts(self) -> tuple[int, ...]:
        grid = zip(self.config.grid.shape, self.tile, strict=True)
        return (self.members, *(ceil(n / step) for n, step in grid))

    def __len__(self) -> int:
        return prod(self._counts)

    def place(self, number: int) -> tuple[int, ...]:
        """The tile's first index in the volume."""
        member, *at = np.unravel_index(number, self._counts)
        lead = np.unravel_index(member, self.lead) if self.lead else ()
        return (*map(int, lead), *(int(i) * n for i, n in zip(at, self.tile, strict=True)))

    def cell(self, number: int) -> tuple[int, int]:
        """The tile's first indices of λ and σ."""
        i, j = self.place(number)[-3:-1]
        return i, j

    @property
    def members(self) -> int:
        """How many machines the sweep has."""
        return prod(self.lead)

    def member(self, number: int) -> int:
        """The number of a tile's machine."""
        return number * self.members // len(self)

    def lowest(self, member: int) -> list[int]:
        """The numbers of the tiles with the lowest speeds of one machine, row by row."""
        _, n, m, k = self._counts
        return [(member * n * m + i) * k for i in range(n * m)]

    def __getitem__(self, number: int) -> Tile:
        first = self.place(number)[-3:]
        lam, sigma, V = (
            self._axes[name][i : i + n] for name, i, n in zip(AXES, first, self.tile, strict=True)
        )
        lowest = number % self._counts[3] == 0
        above = 0.0 if lowest else float(self._axes["V"][first[-1] - 1])
        config = self.config
        bicycle = config.members[self.member(number)].bicycle
        return Tile(
            bicycle, config.model, lam, sigma, V, self.fields, self.chunk, lowest, above, config.ensemble
        )

    @cached_property
    def _axes(self) -> dict[str, Any]:
        return {name: self.config.grid.values(name) for name in AXES}

    def seconds(self) -> float:
        """About how long one core takes."""
        columns = self.points / self.shape[-1]
        samples = self.config.ensemble.samples if self.config.ensemble else 0
        each = sum(FIELDS[name].cost for name in self.fields)
        return 1e-9 * each * self.points + 1e-6 * columns * (_COLUMN + _SAMPLE * samples)
