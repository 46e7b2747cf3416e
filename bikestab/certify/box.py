"""A machine and ranges of its designs, speeds and parameters → a box that can be proved, if it is one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.certify.bernstein import Floats
from bikestab.certify.centred import CentredProver
from bikestab.certify.conditions import condition_formulas
from bikestab.certify.grid import grid_of
from bikestab.certify.search import Decides, Prover
from bikestab.errors import InputError
from bikestab.formulas import table_formulas
from bikestab.letters import Model
from bikestab.limits import check_speed, check_tilt, check_trail

MOST_TOLERANCES = 12
MOST_BERNSTEIN = 1  # tolerances: with two it decides 1 % more cells in 50 times the time
BERNSTEIN = "Bernstein coefficients"  # in tan(λ/2), σ, V or V² and what is varied
CENTRED = "centred form"  # values and derivatives in the middles of blocks, products of two derivatives
PARTS = (1, 4, 4, 2, 2)  # that each tolerance is divided into, by their number; more are not


@dataclass(frozen=True)
class Box:
    """A box of λ [rad], σ, V [m/s] and parameters ``varied``, cut into cells by ``edges``."""

    bicycle: Bicycle
    model: Model
    varied: tuple[str, ...]
    edges: tuple[Floats, ...]

    @property
    def method(self) -> str:
        """How it is proved: by Bernstein coefficients, or by a centred form."""
        return CENTRED if len(self.varied) > MOST_BERNSTEIN else BERNSTEIN

    def prover(self) -> Decides:
        """What decides blocks of its cells."""
        grid = grid_of(self.edges)
        if self.method == CENTRED:
            return CentredProver(self.bicycle, self.varied, self.model, grid)
        formulas = table_formulas(self.bicycle, self.varied, model=self.model)
        return Prover(condition_formulas(formulas), grid)


def box_of(
    bicycle: Bicycle, lam: Floats, sigma: Floats, V: Floats, model: Model,
    tolerances: Mapping[str, tuple[float, float]], parts: Sequence[int] = PARTS,
) -> Box:  # fmt: skip
    """The box between the edges, and between the ends of ``tolerances``, which are cut here into ``parts``.

    Raises InputError for machines that cannot be, for what is no box of theirs, and for more tolerances than
    MOST_TOLERANCES.
    """
    if bicycle.gains:
        problem = f"the bicycle {bicycle.name!r} has feedback, of which nothing can be proved"
        raise InputError(problem, hint="leave its gains out; 'bikestab vrange' has exact speeds with them")
    if len(tolerances) > MOST_TOLERANCES:
        raise InputError(
            f"{len(tolerances)} tolerances at once are more than the {MOST_TOLERANCES} that can be proved",
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
        if tolerances:
            bicycle.replaced({name: ends[end] for name, ends in tolerances.items()})
    number = parts[len(tolerances)] if len(tolerances) < len(parts) else 1
    others = [
        np.linspace(*ends, number + 1) if ends[1] > ends[0] else np.array(ends)
        for ends in tolerances.values()
    ]
    sides = tuple(np.asarray(each, dtype=float) for each in (lam, sigma, V, *others))
    return Box(bicycle, model, tuple(tolerances), sides)
