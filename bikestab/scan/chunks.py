"""Arrays → the compressed chunks of an HDF5 dataset, as HDF5's own gzip and shuffle filters make them.

Many chunks can be bundled into one string of bytes.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from functools import lru_cache
from itertools import product
from math import prod

import numpy as np
from isal import isal_zlib
from numpy.typing import NDArray

# Levels 1 and 2 make chunks some 15 % smaller, but not the same in every process:
# findings/isal_bytes_differ_between_processes.sh
LEVEL = 0


def places(shape: tuple[int, ...], chunk: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """The first index of each chunk of an array, in its own order."""
    return product(*(range(0, n, step) for n, step in zip(shape, chunk, strict=True)))


def packed(values: NDArray, chunk: tuple[int, ...]) -> list[bytes]:
    """The chunks of an array in the order of ``places``, each as the bytes that the file holds.

    A chunk at the border is filled up with zeros, as HDF5 wants it.
    """
    parts = _parts(values, chunk)
    if values.itemsize > 1:  # shuffle: first all first bytes, then all second ones
        each = parts.view(np.uint8).reshape(*parts.shape, values.itemsize).swapaxes(1, 2)
        return [isal_zlib.compress(np.ascontiguousarray(part), LEVEL) for part in each]
    same = parts.min(axis=1) == parts.max(axis=1)
    return [
        _constant(part.size, int(part[0])) if constant else isal_zlib.compress(part, LEVEL)
        for part, constant in zip(parts, same, strict=True)
    ]


def bundled(chunks: list[bytes]) -> bytes:
    """Chunks as one string of bytes: their number, their lengths, themselves."""
    head = np.array([len(chunks), *(len(chunk) for chunk in chunks)], np.int64)
    return b"".join([head.tobytes(), *chunks])


def unbundled(data: bytes) -> list[memoryview]:
    """The chunks that ``bundled`` made one of."""
    number = int(np.frombuffer(data, np.int64, 1)[0])
    ends = np.frombuffer(data, np.int64, number, 8).cumsum() + 8 * (number + 1)
    view = memoryview(data)
    return [view[start:end] for start, end in zip([8 * (number + 1), *ends[:-1]], ends, strict=True)]


def _parts(values: NDArray, chunk: tuple[int, ...]) -> NDArray:
    """The chunks of an array one below the other, each a row."""
    sides = [-(-n // step) for n, step in zip(values.shape, chunk, strict=True)]
    whole = tuple(n * step for n, step in zip(sides, chunk, strict=True))
    if whole != values.shape:
        filled = np.zeros(whole, values.dtype)
        filled[tuple(slice(n) for n in values.shape)] = values
        values = filled
    # what a chunk has of the last axis is copied in one go
    rows = np.ascontiguousarray(values).view(f"V{chunk[-1] * values.itemsize}")
    steps = (*chunk[:-1], 1)
    cut = rows.reshape([n for pair in zip(sides, steps, strict=True) for n in pair])
    order = [*range(0, cut.ndim, 2), *range(1, cut.ndim, 2)]
    return np.ascontiguousarray(cut.transpose(order)).view(values.dtype).reshape(prod(sides), prod(chunk))


@lru_cache
def _constant(size: int, value: int) -> bytes:
    return zlib.compress(bytes([value]) * size)  # slower, but smaller, and once for all such chunks
