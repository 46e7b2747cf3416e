"""What is proved of a box, in the words and fractions of its record, and as a certificate."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.certify.bernstein import Floats
from bikestab.certify.box import Box, box_of
from bikestab.certify.search import STABLE, UNDECIDED, UNSTABLE, Decided, search
from bikestab.letters import PARAMETERS, Model
from bikestab.stability import eigenvalues


@dataclass(frozen=True)
class Proof:
    """A box of λ [rad], σ, V [m/s] and parameters, cut into cells, and what each cell is."""

    box: Box
    decided: Decided

    @property
    def bicycle(self) -> Bicycle:
        """The machine, of which ``varied`` are the parameters that may be anything in their ranges."""
        return self.box.bicycle

    @property
    def varied(self) -> tuple[str, ...]:
        """The parameters with tolerances."""
        return self.box.varied

    @property
    def edges(self) -> tuple[Floats, ...]:
        """Where the box is cut, in λ [rad], σ, V [m/s] and what is varied."""
        return self.box.edges

    @cached_property
    def cells(self) -> NDArray[np.uint8]:
        """0 undecided, 1 proved stable, 2 proved unstable, whatever is varied; shape (lam, sigma, V)."""
        return cells_of(self.decided)

    @cached_property
    def fractions(self) -> tuple[float, float, float]:
        """Shares of the box's volume that are undecided, proved stable and proved unstable."""
        return fractions_of(self.cells, self.edges)

    @property
    def verdict(self) -> str:
        """``stable``, ``unstable``, ``mixed`` if both are there for certain, else ``undecided``."""
        return verdict_of(self.decided.verdicts)

    def counterexample(self) -> dict[str, Any] | None:
        """The middle of the largest block that is proved unstable in a box that is not all so."""
        unstable = self.decided.verdicts == UNSTABLE
        if self.verdict == "unstable" or not unstable.any():
            return None
        blocks = self.decided.blocks[unstable]
        block = blocks[np.argmax(np.prod(blocks[:, :, 1] - blocks[:, :, 0], axis=1))]
        middle = [
            float(0.5 * (edges[start] + edges[stop]))
            for edges, (start, stop) in zip(self.edges, block.tolist(), strict=True)
        ]
        lam, sigma, V, *others = middle
        values = dict(zip(self.varied, others, strict=True))
        machine = self.bicycle.replaced(values) if values else self.bicycle
        roots = eigenvalues(machine, V, lam=lam, sigma=sigma, model=self.box.model)
        found = sorted(([float(s.real), float(s.imag)] for s in roots), reverse=True)
        return {
            "lam": lam,
            "sigma": sigma,
            "V": V,
            **({"set": values} if values else {}),
            "eigenvalues": found,
        }

    def record(self) -> dict[str, Any]:
        """The answer as JSON holds it."""
        undecided, stable, unstable = self.fractions
        names = ("lam", "sigma", "V", *self.varied)
        return {
            "bicycle": self.bicycle.name,
            "model": self.box.model,
            "delta": self.bicycle.delta,
            "box": {name: [float(e[0]), float(e[-1])] for name, e in zip(names, self.edges, strict=True)},
            "cells": list(self.cells.shape),
            "method": self.box.method,
            "verdict": self.verdict,
            "proved_stable": stable,
            "proved_unstable": unstable,
            "undecided": undecided,
            "undecided_by_halving": list(self.decided.halvings),
            "stopped": self.decided.stopped,
            "counterexample": self.counterexample(),
        }

    def certificate(self, version: str) -> str:
        """All that is needed to check the proof, as JSON: exact numbers and the blocks that are decided."""
        bicycle, decided = self.bicycle, self.decided
        own = bicycle.bodies or {name: getattr(bicycle, name) for name in PARAMETERS}
        proved = decided.verdicts != UNDECIDED
        told = {
            "format": "bikestab certificate 2",
            "version": version,
            "method": self.box.method,
            "model": self.box.model,
            "notation": "four bodies" if bicycle.bodies else "two parts",
            "machine": {name: float(value).hex() for name, value in own.items()},
            "varied": list(self.varied),
            "edges": [[float(x).hex() for x in edges] for edges in self.edges],
            "blocks": [
                [block, verdict]
                for block, verdict in zip(
                    decided.blocks[proved].tolist(), decided.verdicts[proved].tolist(), strict=True
                )
            ],
            "sha256": "",
        }
        told["sha256"] = sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()
        return json.dumps(told)


def cells_of(decided: Decided) -> NDArray[np.uint8]:
    """What cells of λ, σ and V are, whatever is varied."""
    each = decided.on_cells()
    each = each.reshape(*each.shape[:3], -1)
    first = each[..., 0]
    return np.where((each == first[..., np.newaxis]).all(axis=-1), first, np.uint8(UNDECIDED))


def fractions_of(cells: NDArray[np.uint8], edges: Sequence[Floats]) -> tuple[float, float, float]:
    """Shares of a box's volume whose cells are undecided, proved stable and proved unstable."""
    lam, sigma, V = (np.diff(e) / (e[-1] - e[0]) if e[-1] > e[0] else np.ones(1) for e in edges[:3])
    shares = [0.0] * 3
    for width, layer in zip(lam, cells, strict=True):  # one by one, for the memory
        for k in range(3):
            shares[k] += float(width * (sigma @ ((layer == k) @ V)))
    for k in range(3):  # whole boxes without the rounding of sums
        if np.all(cells == k):
            return tuple(float(i == k) for i in range(3))  # type: ignore[return-value]  # of three
    return shares[UNDECIDED], shares[STABLE], shares[UNSTABLE]


def verdict_of(verdicts: NDArray[np.uint8]) -> str:
    """The verdict on a box of verdicts on its parts."""
    found = set(np.unique(verdicts).tolist())
    if found == {STABLE}:
        return "stable"
    if found == {UNSTABLE}:
        return "unstable"
    return "mixed" if {STABLE, UNSTABLE} <= found else "undecided"


def prove(
    bicycle: Bicycle,
    lam: Floats,
    sigma: Floats,
    V: Floats,
    *,
    model: Model = "refined",
    tolerances: Mapping[str, tuple[float, float]] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Proof:
    """Prove cells between the edges ``lam`` [rad], ``sigma``, ``V`` [m/s] stable or unstable.

    ``tolerances`` are ranges of parameters in the bicycle's notation, within which a cell must be so for
    every machine. One value is given twice. Raises InputError as ``box_of``.
    """
    box = box_of(bicycle, lam, sigma, V, model, tolerances or {})
    return Proof(box, search(box.prover(), progress=progress))
