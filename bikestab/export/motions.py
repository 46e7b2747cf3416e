"""Mode shapes, motions after a push, and modes against a parameter as the rows of tables."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

import numpy as np

from bikestab.against import Against
from bikestab.export.tables import MODES, Block, Columns, modes_blocks
from bikestab.motion import STATES, Motion, Shapes

_REAL = ("float64", "1")
SHAPES: Columns = {
    "V": ("float64", "m/s"), "name": ("string", ""), "re": ("float64", "1/s"), "im": ("float64", "1/s"),
    "roll_re": _REAL, "roll_im": _REAL, "steer_re": _REAL, "steer_im": _REAL,
}  # fmt: skip
MOTION: Columns = {
    "t": ("float64", "s"), "roll": ("float64", "rad"), "steer": ("float64", "rad"),
    "roll_rate": ("float64", "rad/s"), "steer_rate": ("float64", "rad/s"), "yaw": ("float64", "rad"),
    "x": ("float64", "m"), "y": ("float64", "m"), "y_front": ("float64", "m"),
    "x_front": ("float64", "m"),
}  # fmt: skip


def shapes_blocks(found: Shapes) -> Iterator[Block]:
    """The rows of SHAPES: one for each eigenvalue."""
    roll, steer = found.phasors
    yield {
        "V": np.full(4, found.V), "name": np.array(found.names), "re": found.eigenvalues.real,
        "im": found.eigenvalues.imag, "roll_re": roll.real, "roll_im": roll.imag,
        "steer_re": steer.real, "steer_im": steer.imag,
    }  # fmt: skip


def motion_blocks(found: Motion) -> Iterator[Block]:
    """The rows of MOTION: one for each time."""
    states = dict(zip(STATES, found.states, strict=True))
    path = {"x": found.x, "y": found.y, "y_front": found.y_front, "x_front": found.x_front}
    yield {"t": found.t, **states, "yaw": found.yaw, **path}


def against_columns(found: Against, beside: Collection[str] = ()) -> Columns:
    """MODES with the parameter, and others ``beside`` it, in front."""
    return {**dict.fromkeys((*beside, found.name), ("float64", "")), **MODES}


def against_blocks(found: Against, beside: Mapping[str, float] | None = None) -> Iterator[Block]:
    """The rows of MODES for each value of the parameter, which is in the first column with those beside."""
    for value, modes in zip(found.values, found.modes, strict=True):
        for block in modes_blocks(modes):
            front = {**(beside or {}), found.name: value}
            yield {**block, **{name: np.full(len(block["V"]), each) for name, each in front.items()}}
