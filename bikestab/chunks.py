"""Arrays → the compressed chunks of an HDF5 dataset, as HDF5's own gzip and shuffle filters make them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import product

import numpy as np
from isal import isal_zlib
from numpy.typing import NDArray

LEVEL = 1  # of isal's 0 … 3; higher ones are slower and hardly smaller here


def places(shape: tuple[int, ...], chunk: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """The first index of each chunk of an array, in its own order."""
    return product(*(range(0, n, step) for n, step in zip(shape, chunk, strict=True)))


def packed(values: NDArray, chunk: tuple[int, ...]) -> list[bytes]:
    """The chunks of an array in the order of ``places``, each as the bytes that the file holds.

    A chunk at the border is filled up with zeros, as HDF5 wants it.
    """
    return [
        _compressed(values[tuple(slice(i, i + n) for i, n in zip(place, chunk, strict=True))], chunk)
        for place in places(values.shape, chunk)
    ]


def _compressed(part: NDArray, chunk: tuple[int, ...]) -> bytes:
    if part.shape != chunk:
        whole = np.zeros(chunk, part.dtype)
        whole[tuple(slice(n) for n in part.shape)] = part
        part = whole
    if part.itemsize > 1:  # shuffle: first all first bytes, then all second ones
        part = np.ascontiguousarray(part).reshape(-1).view(np.uint8).reshape(-1, part.itemsize).T
        return isal_zlib.compress(part.tobytes(), LEVEL)
    raw = part.tobytes()
    constant, packed = _constant(len(raw), raw[0])
    return packed if raw == constant else isal_zlib.compress(raw, LEVEL)


@lru_cache
def _constant(size: int, value: int) -> tuple[bytes, bytes]:
    """The bytes of a chunk of one value, and what they are compressed; most chunks of a mask are such."""
    raw = bytes([value]) * size
    return raw, isal_zlib.compress(raw, LEVEL)
