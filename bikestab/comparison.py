"""Two machines over the designs of a box → where exactly one of them is stable."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Floats, Model
from bikestab.speeds import intervals_of

DESIGNS = 81  # per axis, where a box comes without its own
Ends = tuple[float, float]


class Side(NamedTuple):
    """One of two that are compared: a machine, its design if it has one, and a volume's stored speeds.

    ``design`` is λ [rad] and σ; ``stored`` V1 and V2 [m/s], (x, y, interval).
    """

    name: str
    bicycle: Bicycle
    model: Model
    design: tuple[float, float] | None
    stored: tuple[Floats, Floats] | None = None


class Box(NamedTuple):
    """Values of a ``Family``'s two parameters, the ends of a box of them and of speeds [m/s]; their names."""

    x: Floats
    y: Floats
    ends: tuple[Ends, Ends, Ends]
    names: tuple[str, str] = ("lam", "sigma")

    @property
    def cells(self) -> Floats:
        """The part of the plane (x, y) that each design stands for: up to half way to the next."""
        x, y = (_parts(values, ends) for values, ends in zip((self.x, self.y), self.ends[:2], strict=True))
        return x[:, np.newaxis] * y


def box_of(ends: tuple[Ends, Ends, Ends], names: tuple[str, str] = ("lam", "sigma")) -> Box:
    """A box with the middles of equal parts of its two parameters as designs."""
    middles = (np.arange(DESIGNS) + 0.5) / DESIGNS
    x, y = (start + (stop - start) * middles for start, stop in ends[:2])
    return Box(x, y, ends, names)


class Region(NamedTuple):
    """What one of two machines' stable regions has and the other has not, in a ``box``.

    ``apart`` (x, y) is for how many m/s exactly one of them is stable. The volumes of both regions, of
    their symmetric difference and of their union are in m/s times the units of x and y; ``mean`` [m/s] is by
    how much the stable speeds differ on the mean of the designs that have any. An axis of one value counts
    as one unit.
    """

    box: Box
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

    Along the speed it is exact; over x and y it is a sum over the box's designs. Raises InputError for a
    design that the equations cannot use, and for a machine without these parameters.
    """
    spans = [_spans(side, box) for side in (A, B)]
    one, other = ((high - low).sum(axis=-1) for low, high in spans)
    both = _overlap(*spans)
    apart = np.maximum(one + other - 2 * both, 0.0)  # rounding can make it negative
    union, cells = one + other - both, box.cells
    some = float(cells[union > 0].sum())
    difference = float((apart * cells).sum())
    return Region(
        box, apart, (float((one * cells).sum()), float((other * cells).sum())), difference,
        float((union * cells).sum()), difference / some if some else 0.0,
    )  # fmt: skip


def _parts(values: Floats, ends: Ends) -> Floats:
    if len(values) == 1 and ends[0] == ends[1]:
        return np.ones(1)
    return np.diff(np.concatenate([[ends[0]], (values[1:] + values[:-1]) / 2, [ends[1]]]))


def _spans(side: Side, box: Box) -> tuple[Floats, Floats]:
    """V1 and V2 (x, y, interval), cut at the box; where there is none both are its lower end."""
    if side.stored is None:
        family = Family(side.bicycle, side.model, *box.names)
        found = intervals_of(family.exact_table(box.x[:, np.newaxis], box.y))
        V1, V2 = found.V1, found.V2
    else:
        V1, V2 = side.stored
    some, V = np.isfinite(V1), box.ends[2]
    return np.where(some, V1, V[0]).clip(*V), np.where(some, V2, V[0]).clip(*V)


def _overlap(one: tuple[Floats, Floats], other: tuple[Floats, Floats]) -> Floats:
    low = np.maximum(one[0][..., :, np.newaxis], other[0][..., np.newaxis, :])
    high = np.minimum(one[1][..., :, np.newaxis], other[1][..., np.newaxis, :])
    return np.maximum(high - low, 0).sum(axis=(-2, -1))
