"""Two machines over the designs of a box → where exactly one of them is stable."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import Floats, Model, exact_table
from bikestab.speeds import intervals_of

DESIGNS = 81  # per axis, where a box comes without its own
Ends = tuple[float, float]


class Side(NamedTuple):
    """One of two that are compared: a machine, its design if it has one, and a volume's stored speeds.

    ``design`` is λ [rad] and σ; ``stored`` V1 and V2 [m/s], (lam, sigma, interval).
    """

    name: str
    bicycle: Bicycle
    model: Model
    design: tuple[float, float] | None
    stored: tuple[Floats, Floats] | None = None


class Box(NamedTuple):
    """Designs λ [rad] and σ, and the ends of a box of them and of speeds [m/s]."""

    lam: Floats
    sigma: Floats
    ends: tuple[Ends, Ends, Ends]

    @property
    def cells(self) -> Floats:
        """The part of the plane (lam, sigma) that each design stands for: up to half way to the next."""
        lam, sigma = (_parts(x, ends) for x, ends in zip(self[:2], self.ends[:2], strict=True))
        return lam[:, np.newaxis] * sigma


def box_of(ends: tuple[Ends, Ends, Ends]) -> Box:
    """A box with the middles of equal parts of its λ and σ as designs."""
    middles = (np.arange(DESIGNS) + 0.5) / DESIGNS
    lam, sigma = (start + (stop - start) * middles for start, stop in ends[:2])
    return Box(lam, sigma, ends)


class Region(NamedTuple):
    """What one of two machines' stable regions has and the other has not, in a box.

    ``apart`` (lam, sigma) is for how many m/s exactly one of them is stable. The volumes of both regions,
    of their symmetric difference and of their union are in rad m/s; ``mean`` [m/s] is by how much the stable
    speeds differ on the mean of the designs that have any. An axis of one value counts as one unit.
    """

    apart: Floats
    volumes: tuple[float, float]
    difference: float
    union: float
    mean: float

    @property
    def share(self) -> float:
        """The symmetric difference as a share of the union; 0 where both are empty."""
        return self.difference / self.union if self.union else 0.0


def region(A: Side, B: Side, box: Box) -> Region:
    """The symmetric difference of two machines' stable regions.

    Along the speed it is exact; over λ and σ it is a sum over the box's designs. Raises InputError for a
    design that the equations cannot use.
    """
    spans = [_spans(side, box) for side in (A, B)]
    one, other = ((high - low).sum(axis=-1) for low, high in spans)
    both = _overlap(*spans)
    apart = np.maximum(one + other - 2 * both, 0.0)  # rounding can make it negative
    union, cells = one + other - both, box.cells
    some = float(cells[union > 0].sum())
    difference = float((apart * cells).sum())
    return Region(
        apart, (float((one * cells).sum()), float((other * cells).sum())), difference,
        float((union * cells).sum()), difference / some if some else 0.0,
    )  # fmt: skip


def _parts(values: Floats, ends: Ends) -> Floats:
    if len(values) == 1 and ends[0] == ends[1]:
        return np.ones(1)
    return np.diff(np.concatenate([[ends[0]], (values[1:] + values[:-1]) / 2, [ends[1]]]))


def _spans(side: Side, box: Box) -> tuple[Floats, Floats]:
    """V1 and V2 (lam, sigma, interval), cut at the box; where there is none both are its lower end."""
    if side.stored is None:
        found = intervals_of(exact_table(side.bicycle, box.lam[:, np.newaxis], box.sigma, model=side.model))
        V1, V2 = found.V1, found.V2
    else:
        V1, V2 = side.stored
    some, V = np.isfinite(V1), box.ends[2]
    return np.where(some, V1, V[0]).clip(*V), np.where(some, V2, V[0]).clip(*V)


def _overlap(one: tuple[Floats, Floats], other: tuple[Floats, Floats]) -> Floats:
    low = np.maximum(one[0][..., :, np.newaxis], other[0][..., np.newaxis, :])
    high = np.minimum(one[1][..., :, np.newaxis], other[1][..., np.newaxis, :])
    return np.maximum(high - low, 0).sum(axis=(-2, -1))
