"""What is near and what hangs together, against scipy."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from bikestab.region.neighbours import connected, near


@pytest.mark.parametrize("distance", [0.003, 0.05, 0.4, 1.5])
@pytest.mark.parametrize("count", [0, 1, 500])
def test_near(distance, count):
    random = np.random.default_rng(count)
    others = random.random((2, count)) ** 3  # crowded at an end
    points = np.concatenate([random.random((2, 700)), others + 1e-3], axis=1).clip(0, 1)
    points[:, :4] = [[0, 0, 1, 1], [0, 1, 0, 1]]
    away = cKDTree(others.T).query(points.T)[0] if count else np.full(points.shape[1], np.inf)
    assert np.array_equal(near(points, others, distance), away <= distance)


@pytest.mark.parametrize("pairs", [0, 30, 300, 2000])
def test_connected(pairs):
    a, b = np.random.default_rng(pairs).integers(0, 1000, (2, pairs))
    graph = coo_array((np.ones(pairs), (a, b)), shape=(1000, 1000))
    _, expected = connected_components(graph, directed=False)
    _, first = np.unique(expected, return_index=True)
    assert np.array_equal(connected(a, b, 1000), first[expected])


def test_a_chain_is_one():
    links = np.arange(5000)
    assert not connected(links, links + 1, 5001).any()
    assert not connected(links[::-1] + 1, links[::-1], 5001).any()
