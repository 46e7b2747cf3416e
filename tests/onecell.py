"""Tables of a single cell, and critical speeds that are others."""

import numpy as np

from bikestab.certain import Zeros
from bikestab.routh import CONDITIONS


def table_of(**rows):
    """A table of one cell from its rows; its other conditions hold at every speed."""
    table = np.zeros((5, 4, 1))
    table[:, 0, 0] = 1, 4, 6, 4, 1  # (s + 1)⁴
    for name, row in rows.items():
        table[CONDITIONS.index(name), :, 0] = [*row, *[0] * (4 - len(row))]
    return table


def with_speeds(exact, speeds):
    """Critical speeds with others for some conditions, as if they were exact."""
    zeros = {name: Zeros(V, 0 * V, 0 * V, exact.zeros[name].sure) for name, V in speeds.items()}
    return exact._replace(speeds={**exact.speeds, **speeds}, zeros={**exact.zeros, **zeros})
