"""What is proved of a box, in the words and fractions of its record, and as a certificate."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.certify.bernstein import Floats
from bikestab.certify.centred import CentredProver
from bikestab.certify.conditions import condition_formulas
from bikestab.certify.grid import grid_of
from bikestab.certify.search import STABLE, UNDECIDED, UNSTABLE, Decided, Decides, Prover, search
from bikestab.errors import InputError
from bikestab.formulas import table_formulas
from bikestab.letters import PARAMETERS, Model
from bikestab.limits import check_speed, check_tilt, check_trail
from bikestab.stability import eigenvalues

MOST_TOLERANCES = 12
MOST_BERNSTEIN = 1  # tolerances: with two it decides 1 % more cells in 50 times the time
BERNSTEIN = "Bernstein coefficients"  # in tan(λ/2), σ, V or V² and what is varied
CENTRED = "centred form"  # values and derivatives in the middles of blocks, products of two derivatives
_PARTS = (1, 4, 4, 2, 2)  # that each tolerance is divided into, by their number; more are not


@dataclass(frozen=True)
class Proof:
    """A box of λ [rad], σ, V [m/s] and parameters ``varied``, cut by ``edges``, and what each cell is.

    ``method`` says how it was proved: by Bernstein coefficients, or by a centred form.
    """

    bicycle: Bicycle
    model: Model
    varied: tuple[str, ...]
    edges: tuple[Floats, ...]
    decided: Decided
    method: str

    @cached_property
    def cells(self) -> NDArray[np.uint8]:
        """0 undecided, 1 proved stable, 2 proved unstable, whatever is varied; shape (lam, sigma, V)."""
        each = self.decided.on_cells()
        each = each.reshape(*each.shape[:3], -1)
        first = each[..., 0]
        return np.where((each == first[..., np.newaxis]).all(axis=-1), first, np.uint8(UNDECIDED))

    @cached_property
    def fractions(self) -> tuple[float, float, float]:
        """Shares of the box's volume that are undecided, proved stable and proved unstable."""
        widths = [np.diff(edges) if edges[-1] > edges[0] else np.ones(1) for edges in self.edges[:3]]
        volume = np.einsum("i,j,k->ijk", *(width / width.sum() for width in widths))
        shares = [float(volume[self.cells == k].sum()) for k in range(3)]
        for k in range(3):  # whole boxes without the rounding of sums
            if np.all(self.cells == k):
                return tuple(float(i == k) for i in range(3))  # type: ignore[return-value]  # of three
        return shares[UNDECIDED], shares[STABLE], shares[UNSTABLE]

    @property
    def verdict(self) -> str:
        """``stable``, ``unstable``, ``mixed`` if both are there for certain, else ``undecided``."""
        found = set(np.unique(self.decided.verdicts).tolist())
        if found == {STABLE}:
            return "stable"
        if found == {UNSTABLE}:
            return "unstable"
        return "mixed" if {STABLE, UNSTABLE} <= found else "undecided"

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
        roots = eigenvalues(machine, V, lam=lam, sigma=sigma, model=self.model)
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
            "model": self.model,
            "delta": self.bicycle.delta,
            "box": {name: [float(e[0]), float(e[-1])] for name, e in zip(names, self.edges, strict=True)},
            "cells": list(self.cells.shape),
            "method": self.method,
            "verdict": self.verdict,
            "proved_stable": stable,
            "proved_unstable": unstable,
            "undecided": undecided,
            "undecided_by_halving": list(self.decided.halvings),
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
            "method": self.method,
            "model": self.model,
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
    every machine. One value is given twice. Raises InputError for machines that cannot be, and for more
    tolerances than MOST_TOLERANCES.
    """
    ranges = dict(tolerances or {})
    if bicycle.gains:
        problem = f"the bicycle {bicycle.name!r} has feedback, of which nothing can be proved"
        raise InputError(problem, hint="leave its gains out")
    if len(ranges) > MOST_TOLERANCES:
        raise InputError(
            f"{len(ranges)} tolerances at once are more than the {MOST_TOLERANCES} that can be proved",
            hint="leave some out, or prove boxes of them one after the other",
        )
    for name, edges in (("lam", lam), ("sigma", sigma), ("V", V)):
        if np.any(np.diff(edges) < 0):
            raise InputError(
                "edges do not ascend", key=(name,), hint="allowed: from the lowest to the highest"
            )
    for end in (0, -1):
        check_tilt(float(lam[end]), ("lam",))
        check_trail(float(sigma[end]), ("sigma",))
        check_speed(float(V[end]), ("V",))
    for end in (0, 1):
        if ranges:
            bicycle.replaced({name: ends[end] for name, ends in ranges.items()})
    many = len(ranges) > MOST_BERNSTEIN
    parts = _PARTS[len(ranges)] if len(ranges) < len(_PARTS) else 1
    others = [
        np.linspace(*ends, parts + 1) if ends[1] > ends[0] else np.array(ends) for ends in ranges.values()
    ]
    grid = grid_of([lam, sigma, V, *others])
    if many:
        prover: Decides = CentredProver(bicycle, tuple(ranges), model, grid)
    else:
        prover = Prover(condition_formulas(table_formulas(bicycle, tuple(ranges), model=model)), grid)
    decided = search(prover, progress=progress)
    return Proof(bicycle, model, tuple(ranges), grid.edges, decided, CENTRED if many else BERNSTEIN)
