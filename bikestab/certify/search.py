"""An octree over the cells of a box: whole blocks are decided where they can be, and divided where not."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from bikestab.certify.bernstein import SPEED, Bernstein, bernstein, bounds
from bikestab.certify.conditions import Condition
from bikestab.certify.grid import Grid, Side

UNDECIDED, STABLE, UNSTABLE = range(3)
Blocks = NDArray[np.int64]  # (block, axis, 2): the first cell, and the one behind the last
ORDER = ("p4", "p0", "p1", "p2", "p3", "hurwitz3")  # the dearest last
_SIZE = 1 << 17  # numbers worked on at a time, which fit the cache


class Decided(NamedTuple):
    """Blocks that together are all cells, each once, and a verdict on each.

    ``halvings`` is which part of the cells was undecided before each halving of blocks, and at the end;
    ``stopped`` tells that it ended before, at a limit of work.
    """

    cells: tuple[int, ...]
    blocks: Blocks
    verdicts: NDArray[np.uint8]
    halvings: tuple[float, ...]
    stopped: bool = False

    def on_cells(self) -> NDArray[np.uint8]:
        """The verdict on each cell."""
        out = np.zeros(self.cells, np.uint8)
        single = np.all(self.blocks[:, :, 1] - self.blocks[:, :, 0] == 1, axis=1)
        out[tuple(self.blocks[single, :, 0].T)] = self.verdicts[single]
        larger = ~single & (self.verdicts != UNDECIDED)
        for block, verdict in zip(self.blocks[larger].tolist(), self.verdicts[larger].tolist(), strict=True):
            out[tuple(slice(*ends) for ends in block)] = verdict
        return out


class Decides(Protocol):
    """What decides blocks of cells: by Bernstein coefficients here, by the centred form elsewhere."""

    grid: Grid

    def verdicts(self, blocks: Blocks, positive: NDArray[np.bool_]) -> NDArray[np.uint8]: ...


class Prover:
    """The six conditions on a box, ready to be bounded on any block of its cells."""

    def __init__(self, conditions: Mapping[str, Condition], grid: Grid) -> None:
        self.grid = grid
        self._sides: dict[str, list[Side]] = {}
        self._whole: dict[str, Bernstein] = {}
        for name in ORDER:
            sides = grid.places(conditions[name].squared)
            self._sides[name] = sides
            self._whole[name] = bernstein(conditions[name].polynomial, [side.ends for side in sides])
        self._zero_at_rest = grid.edges[SPEED][0] == 0 and any(c.at_rest for c in conditions.values())

    def verdicts(self, blocks: Blocks, positive: NDArray[np.bool_]) -> NDArray[np.uint8]:
        """Whether blocks are stable or unstable throughout.

        ``positive`` (block, condition) tells which conditions are known to hold, and is completed.
        """
        verdicts = np.zeros(len(blocks), np.uint8)
        for i, name in enumerate(ORDER):
            open_ = np.flatnonzero(~positive[:, i] & (verdicts == UNDECIDED))
            step = max(1, _SIZE // self._whole[name].coefficients.size)
            for start in range(0, len(open_), step):
                some = open_[start : start + step]
                low, high = bounds(self._whole[name], *self._places(name, blocks[some]))
                positive[some, i] = low > 0
                verdicts[some[(high < 0) & positive[some, 0]]] = UNSTABLE  # of p4 s⁴ + …, p4 > 0
        at_rest = self._zero_at_rest & (blocks[:, SPEED, 0] == 0)
        verdicts[positive.all(axis=1) & ~at_rest] = STABLE
        return verdicts

    def _places(self, name: str, blocks: Blocks) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        sides = enumerate(self._sides[name])
        low, high = zip(
            *((side.low[blocks[:, i, 0]], side.high[blocks[:, i, 1] - 1]) for i, side in sides), strict=True
        )
        return np.stack(low, axis=1), np.stack(high, axis=1)


def search(
    prover: Decides, start: Blocks | None = None, *, most_blocks: int = 1 << 62, only_stable: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Decided:  # fmt: skip
    """Decide blocks, from the whole box down to single cells, or from one block at the ``start``.

    No halving begins after ``most_blocks`` were looked at; what is open then stays undecided.
    With ``only_stable`` the search ends when a block is unstable, or a cell undecided.
    """
    cells = prover.grid.cells
    blocks = np.array([[(0, number) for number in cells]]) if start is None else start
    all_cells = float(_sizes(blocks).sum())
    positive = np.zeros((1, len(ORDER)), bool)
    done: list[Blocks] = []
    verdicts: list[NDArray[np.uint8]] = []
    looked_at, left, stopped, halvings = 0, 0, False, []
    while len(blocks):
        looked_at += len(blocks)
        found = prover.verdicts(blocks, positive)
        final = (found != UNDECIDED) | np.all(blocks[:, :, 1] - blocks[:, :, 0] == 1, axis=1)
        spoiled = only_stable and np.any((found == UNSTABLE) | (final & (found == UNDECIDED)))
        if looked_at >= most_blocks or spoiled:
            stopped = not final.all()
            final[:] = True
        halvings.append(float((left + _sizes(blocks[found == UNDECIDED]).sum()) / all_cells))
        left += int(
            _sizes(blocks[final & (found == UNDECIDED)]).sum()
        )  # cells, some of them sooner than others
        done.append(blocks[final])
        verdicts.append(found[final])
        blocks, positive = _divided(blocks[~final], positive[~final])
        if progress:
            progress(1 - _sizes(blocks).sum() / all_cells)
    return Decided(cells, np.concatenate(done), np.concatenate(verdicts), tuple(halvings), stopped)


def joined(parts: Sequence[Decided]) -> Decided:
    """What was decided of parts that together are all cells, as one."""
    first, most = parts[0], max(len(part.halvings) for part in parts)
    sizes = np.array([_sizes(part.blocks).sum() for part in parts], dtype=float)
    levels = [part.halvings + part.halvings[-1:] * (most - len(part.halvings)) for part in parts]
    halvings = tuple((sizes @ np.array(levels) / sizes.sum()).tolist())
    blocks = np.concatenate([part.blocks for part in parts])
    verdicts = np.concatenate([part.verdicts for part in parts])
    return Decided(first.cells, blocks, verdicts, halvings, any(part.stopped for part in parts))


def _sizes(blocks: Blocks) -> NDArray[np.int64]:
    """How many cells each block has."""
    return np.prod(blocks[:, :, 1] - blocks[:, :, 0], axis=1)


def _divided(blocks: Blocks, positive: NDArray[np.bool_]) -> tuple[Blocks, NDArray[np.bool_]]:
    """Halves of each block along each axis that has more than one cell."""
    for axis in range(blocks.shape[1]):
        start, stop = blocks[:, axis].T
        more = stop - start > 1
        middle = (start + stop) // 2
        first, second = blocks.copy(), blocks[more]
        first[more, axis, 1] = middle[more]
        second[:, axis, 0] = middle[more]
        blocks, positive = np.concatenate([first, second]), np.concatenate([positive, positive[more]])
    return blocks, positive
