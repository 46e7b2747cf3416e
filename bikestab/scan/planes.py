"""Exact critical speeds over the whole planes (λ, σ) of machines → sheets, of many machines at once.

``sheets`` and ``linking`` have the rules, which are the same. What lies over itself is left to them.
"""

from __future__ import annotations

from math import prod
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.scan.linking import connected, first_free, rank_of
from bikestab.scan.links import Indices, links_of, pairs, place_of
from bikestab.scan.sheets import EDGES, Roots, Sheets, directed, is_end, sheets
from bikestab.speeds import Intervals


class _Layers(NamedTuple):
    """The sheets of one direction: the ``sheet`` of each root (machine, λ, σ, root), −1 where there is none.

    Each sheet belongs to a ``machine``, goes into a ``slot`` of its, and has ``number`` roots whose places
    have the sum ``total``. ``over_itself`` (machine,): those that are linked otherwise.
    """

    sheet: Indices
    machine: Indices
    slot: Indices
    number: Indices
    total: Floats
    over_itself: NDArray[np.bool_]


def sheets_of_planes(name: str, roots: Roots, intervals: Intervals) -> Sheets:
    """``sheets`` of a condition's roots (…, λ, σ, root) of any machines, each by itself.

    There are as many slots as the machine with most has.
    """
    shape = roots.V.shape[:-1]
    number, plane = prod(shape[:-2]), shape[-2:]
    flat = Roots(roots.V.reshape(number, *plane, roots.V.shape[-1]), roots.rising.reshape(number, *plane, 1))
    ends = Intervals(*(each.reshape(number, *plane, -1) for each in intervals.arrays().values()))
    found = directed(flat)
    layers = [_layers(V) for V in found]
    out, over_itself = {}, layers[0].over_itself | layers[1].over_itself
    if over_itself.any():
        layers = [_layers(np.where(over_itself.reshape(-1, 1, 1, 1), np.nan, V)) for V in found]
    for i in np.flatnonzero(over_itself).tolist():
        own = Intervals(*(each[i] for each in ends.arrays().values()))
        out[i] = sheets(name, Roots(flat.V[i], flat.rising[i]), own)
    slots = _slots(layers)
    width = max(*(1 + slot.max(initial=-1) for slot in slots), *(each.V.shape[-1] for each in out.values()))
    V_all, edge_all = np.full((number, *plane, width), np.nan), np.zeros((number, *plane, width), np.uint8)
    for i, (V, edge) in out.items():
        V_all[i, ..., : V.shape[-1]], edge_all[i, ..., : V.shape[-1]] = V, edge
    bounds = (ends.V1, ends.lower), (ends.V2, ends.upper)
    for V, (end, kind), layer, slot in zip(found, bounds, layers, slots, strict=True):
        there = layer.sheet >= 0
        at = (*np.nonzero(there)[:-1], slot[layer.sheet[there]])
        V_all[at], edge_all[at] = V[there], is_end(V, end, kind == EDGES.get(name))[there]
    return Sheets(V_all.reshape(*shape, width), edge_all.reshape(*shape, width))


def _layers(V: Floats) -> _Layers:
    """The sheets of the roots (machine, λ, σ, root) of one direction."""
    there, number = np.isfinite(V), len(V)
    sheet = np.where(there, np.arange(number).reshape(-1, 1, 1, 1), -1)  # one each, if that is all
    machine, slot, over_itself = np.arange(number), np.zeros(number, np.intp), np.zeros(number, bool)
    linked = np.flatnonzero(np.count_nonzero(V > 0, axis=-1).max(axis=(1, 2), initial=0) > 1)
    if len(linked):
        own, several = _linked(V[linked])
        over_itself[linked] = several
        touch = [pairs(own, own), pairs(own[:, 1:], own[:, :-1]), pairs(own[:, :, 1:], own[:, :, :-1])]
        size = np.bincount(own[own >= 0])
        slot = np.concatenate([slot, first_free(np.arange(len(size)), size, np.concatenate(touch, axis=1))])
        of = np.zeros(len(size), np.intp)
        of[own[own >= 0]] = linked[np.nonzero(own >= 0)[0]]
        machine = np.concatenate([machine, of])
        sheet[linked] = np.where(own >= 0, own + number, -1)
    count = np.bincount(sheet[there], minlength=len(machine))
    total = np.bincount(sheet[there], place_of(V[there]), minlength=len(machine)).astype(float)
    return _Layers(sheet, machine, slot, count, total, over_itself)


def _linked(V: Floats) -> tuple[Indices, NDArray[np.bool_]]:
    """What the links connect, numbered, and which machines have two roots of it in one cell."""
    there = np.isfinite(V)
    cell = np.repeat(np.arange(there[..., 0].size), np.count_nonzero(there, axis=-1).ravel())
    sheet = np.full(V.shape, -1)
    links = np.concatenate([links_of(V, axis) for axis in (0, 1)], axis=1)
    sheet[there] = label = connected(links, len(cell))
    over_itself = np.zeros(len(V), bool)
    over_itself[np.nonzero(there)[0][rank_of(label, cell)[1]]] = True
    return sheet, over_itself


def _slots(layers: list[_Layers]) -> list[Indices]:
    """The final slot of each sheet: slots in the order of their mean places, the rising one first."""
    at, rows = [], []
    for k, layer in enumerate(layers):
        most = int(layer.slot.max(initial=0)) + 1
        at.append(layer.machine * most + layer.slot)
        number, total = np.bincount(at[k], layer.number), np.bincount(at[k], layer.total)
        used = np.flatnonzero(number)
        rows.append((used // most, total[used] / number[used], np.full(len(used), k), used))
    machine, mean, direction, used = (np.concatenate(each) for each in zip(*rows, strict=True))
    order = np.lexsort((used, direction, mean, machine))
    place = np.arange(len(order)) - np.searchsorted(machine[order], machine[order])
    final = []
    for k in range(len(layers)):
        known = np.full(int(at[k].max(initial=-1)) + 1, -1)
        mine = direction[order] == k
        known[used[order][mine]] = place[mine]
        final.append(known[at[k]])
    return final
