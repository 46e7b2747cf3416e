"""Finished tiles → the volume: what is counted over all of them, sheets over the whole plane, the file."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from bikestab.routh import CONDITIONS
from bikestab.scan.agreement import Agreement
from bikestab.scan.bracketing import Bracketing
from bikestab.scan.chunks import unbundled
from bikestab.scan.plan import Plan
from bikestab.scan.sheets import Atlas
from bikestab.scan.spool import Spool
from bikestab.scan.tile import Columns, keep_heap
from bikestab.scan.writer import VolumeWriter, new_volume


def assemble(plan: Plan, spool: Spool, path: Path) -> tuple[int, Agreement, Agreement]:
    """Write the volume from its tiles, all finished.

    Returns the number of stable points, and how far the conditions' signs and scipy agree with the exact
    speeds. Raises ScanError where scipy does not.
    """
    keep_heap()
    notes = spool.notes
    agreement, stable_points = Agreement(), 0
    for note in notes.values():
        agreement = agreement.combined(Agreement(*note["agreement"]))
        stable_points += note["stable_points"]

    @lru_cache(maxsize=1)  # they are needed twice, but memory does not bear those of every machine
    def atlases(member: int) -> dict[str, Atlas]:
        return _atlases(plan, spool, member)

    bracketing = Bracketing(plan.config.grid.values("V"), plan.points // plan.shape[-1])
    if plan.whole:
        widths = [note["sheets"] for note in notes.values() if note["columns_size"]]
    else:
        widths = [atlas.width for member in range(plan.members) for atlas in atlases(member).values()]
    with new_volume(path, plan) as writer:
        writer.create_columns(
            max(note["intervals"] for note in notes.values() if note["columns_size"]), max(widths)
        )
        for number in range(len(plan)):
            atlas = {} if plan.whole else atlases(plan.members_of(number)[0])
            _write(writer, plan, spool, number, atlas, bracketing)
        bracketed = bracketing.agreement()
        writer.finish(stable_points, agreement, bracketed)
    return stable_points, agreement, bracketed


def _atlases(plan: Plan, spool: Spool, member: int) -> dict[str, Atlas]:
    """The sheets of each condition over the (λ, σ) of one machine of the sweep."""
    tiles = plan.lowest(member)
    atlases = {}
    for name in CONDITIONS:
        rising, falling = zip(*(spool.notes[number]["most_roots"][name] for number in tiles), strict=True)
        atlases[name] = Atlas(name, (max(rising), max(falling)))
    for number in tiles:
        columns = _columns(spool, number)
        for name, atlas in atlases.items():
            atlas.add(plan.cell(number), columns.roots[name])
    for atlas in atlases.values():
        atlas.finish()
    return atlases


def _write(
    writer: VolumeWriter, plan: Plan, spool: Spool, number: int, atlases: dict[str, Atlas],
    bracketing: Bracketing,
) -> None:  # fmt: skip
    place, size = plan.place(number), spool.notes[number]["columns_size"]
    writer.write_fields(place, plan[number].shape, unbundled(spool.read(number, slice(size, None))))
    if size:
        columns = _columns(spool, number)
        found = columns.sheets or columns.roots
        bracketing.add(plan.cell(number), plan[number], found, columns.undecided)
        surfaces = columns.sheets or {
            name: atlas.sheets(plan.cell(number), columns.roots[name], columns.intervals)
            for name, atlas in atlases.items()
        }
        writer.write_columns(place, columns.intervals, surfaces, columns.spread, columns.gradients)


def _columns(spool: Spool, number: int) -> Columns:
    return Columns.from_bytes(spool.read(number, slice(spool.notes[number]["columns_size"])))
