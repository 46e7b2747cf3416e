"""Tables of a single cell."""

import numpy as np

from bikestab.routh import CONDITIONS


def table_of(**rows):
    """A table of one cell from its rows; its other conditions hold at every speed."""
    table = np.zeros((5, 4, 1))
    table[:, 0, 0] = 1, 4, 6, 4, 1  # (s + 1)⁴
    for name, row in rows.items():
        table[CONDITIONS.index(name), :, 0] = [*row, *[0] * (4 - len(row))]
    return table
