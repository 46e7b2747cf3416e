"""A box → its proof, in parts: by several processes, and kept on disk until all are done."""

from __future__ import annotations

import pickle
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import ExitStack, closing, contextmanager
from functools import lru_cache
from hashlib import sha256
from itertools import pairwise, product
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bikestab import __version__
from bikestab.aside import cores
from bikestab.certify.box import Box
from bikestab.certify.proof import Proof
from bikestab.certify.search import Blocks, Decided, Decides, joined, search
from bikestab.errors import KEPT, NOT_KEPT, ScanError, WorkersLost
from bikestab.scan.processes import check_number, in_processes
from bikestab.scan.spool import MARK, Spool

_SIDE, _SIDE_VARIED = 64, 16  # cells along each side of a part, without tolerances and with
_ALONE = 2.0  # s before other processes are worth their start


class Part(NamedTuple):
    """A block of a box's cells to be decided; the box is pickled, once for all parts."""

    box: bytes
    start: Blocks
    most_blocks: int


def prove_in_parts(
    box: Box,
    *,
    jobs: int | None = None,
    most_blocks: int | None = None,
    keep: Path | None = None,
    progress: Callable[[float], None] = lambda share: None,
) -> Proof:
    """Prove a box's cells stable or unstable, by ``jobs`` processes, one for each core by default.

    After ``most_blocks`` were looked at, each part having its share, what is open stays undecided. Finished
    parts are kept in the file ``keep`` until all are done; from there the same proof goes on if it was
    stopped. Raises InputError for too many processes and where that file is another's or cannot be written,
    ScanError where a process dies or the disk is full.
    """
    if jobs:
        check_number(jobs)
    pickled = pickle.dumps(box)
    parts = [Part(pickled, start, _share(box, start, most_blocks)) for start in _starts(box)]
    with ExitStack() as stack:
        spool = None
        if keep and len(parts) > 1:
            spool = stack.enter_context(_spool(keep, box, most_blocks))
        done = {number: _read(spool, number, box) for number in spool.notes} if spool else {}
        progress(len(done) / len(parts))
        todo = [(number, part) for number, part in enumerate(parts) if number not in done]
        stack.enter_context(_told_of(spool))
        finished = stack.enter_context(closing(_finished(todo, jobs or cores())))
        for number, decided in finished:
            done[number] = decided
            if spool:
                notes = {"halvings": decided.halvings, "stopped": decided.stopped}
                spool.add(number, notes, decided.blocks.tobytes(), decided.verdicts.tobytes())
            progress(len(done) / len(parts))
        if spool:
            spool.remove()
    return Proof(box, joined([done[number] for number in range(len(parts))]))


@contextmanager
def _told_of(spool: Spool | None) -> Iterator[None]:
    """Where a proof ends too early, keep nothing empty, and say what is kept."""
    try:
        yield
    except BaseException as error:
        if not spool:
            raise
        if not spool.notes:
            spool.remove()
        if isinstance(error, KeyboardInterrupt):
            raise KeyboardInterrupt(KEPT if spool.notes else "") from None
        if isinstance(error, (WorkersLost, OSError)):
            problem = (
                str(error) if isinstance(error, WorkersLost) else f"{spool.path}: {error.strerror or error}"
            )
            raise ScanError(f"{problem}\n{KEPT if spool.notes else NOT_KEPT}") from None
        raise


def decide(part: Part) -> Decided:
    """Search a part."""
    return search(_prover(part.box), part.start, most_blocks=part.most_blocks)


@lru_cache(maxsize=1)
def _prover(box: bytes) -> Decides:
    found: Box = pickle.loads(box)  # from this program alone
    return found.prover()


def _starts(box: Box) -> list[Blocks]:
    """The parts' blocks, in order; sides are as equal as can be, and tolerances stay whole."""
    side = _SIDE_VARIED if box.varied else _SIDE
    spans = []
    for axis, edges in enumerate(box.edges):
        number = len(edges) - 1
        pieces = -(-number // side) if axis < 3 else 1
        ends = [number * i // pieces for i in range(pieces + 1)]
        spans.append(list(pairwise(ends)))
    return [np.array([block]) for block in product(*spans)]


def _share(box: Box, start: Blocks, most_blocks: int | None) -> int:
    if most_blocks is None:
        return 1 << 62
    cells = np.prod([len(edges) - 1 for edges in box.edges], dtype=float)
    return max(1, int(most_blocks * np.prod(start[0, :, 1] - start[0, :, 0], dtype=float) / cells))


def _finished(todo: list[tuple[int, Part]], jobs: int) -> Generator[tuple[int, Decided]]:
    """Decide parts here, and when that takes long in processes."""
    begin = time.monotonic()
    for done, (number, part) in enumerate(todo, 1):
        yield number, decide(part)
        processes = min(jobs, len(todo) - done)
        if processes > 1 and time.monotonic() - begin > _ALONE:
            yield from in_processes(todo[done:], processes, decide)
            return


def _spool(path: Path, box: Box, most_blocks: int | None) -> Spool:
    """The file of finished parts; those of another proof are dropped, but no other file is."""
    numbers = sorted(box.bicycle.given.items()), box.bicycle.g, box.bicycle.delta
    edges = [each.tolist() for each in box.edges]
    asked = (
        __version__,
        numbers,
        box.model,
        box.varied,
        edges,
        most_blocks,
    )  # another version proves otherwise
    identity = sha256(repr(asked).encode()).hexdigest()
    ours = False
    if path.is_file():
        with path.open("rb") as file:
            ours = file.read(len(MARK)) == MARK
    return Spool(path, {"proof": identity}, replace=ours)


def _read(spool: Spool, number: int, box: Box) -> Decided:
    data, notes = spool.read(number), spool.notes[number]
    axes = len(box.edges)
    count = len(data) // (16 * axes + 1)
    blocks = np.frombuffer(data, np.int64, count * axes * 2).reshape(count, axes, 2)
    verdicts = np.frombuffer(data, np.uint8, count, 16 * axes * count)
    cells = tuple(len(edges) - 1 for edges in box.edges)
    return Decided(cells, blocks, verdicts, tuple(notes["halvings"]), notes["stopped"])
