"""The two models, by eigenvalues."""

from dataclasses import replace

import numpy as np
import pytest

from bikestab.paper1981.maps import map_designs
from bikestab.paper1981.refinement import refinement
from tests.small import SPEEDS, TINY, brute, study


def test_volume_by_eigenvalues(bicycle):
    rng = np.random.default_rng(8)
    designs, speeds = rng.uniform([0, 0], [0.3, 0.15], (400, 2)), np.linspace(0.025, 14.975, 300)
    share = np.mean([(brute(bicycle, *design, speeds) < 0).mean() for design in designs])
    assert share * 0.3 * 0.15 * 15 == pytest.approx(0.0482246, rel=0.25)  # 7 % is one standard deviation


def test_unrefined_model_by_eigenvalues(bicycle):
    found = study()["refinement"]
    assert found["changed_coefficients"] == ["a4", "b3", "b6"]
    assert found["models"]["unrefined"]["capsize_over_p1"] < 1
    rng = np.random.default_rng(9)
    for design in rng.uniform([0, 0], [0.3, 0.15], (60, 2)):
        assert (brute(bicycle, *design, SPEEDS, model="unrefined") > 0).all()


def test_terms_of_the_refinement_do_not_depend_on_the_grid(bicycle):
    small = replace(TINY, grid=20)
    found = refinement(bicycle, map_designs(bicycle, 20), small)
    assert found.changed_terms == ["V^0 of p0", "V^2 of p0", "V^1 of p1", "V^0 of p2"]
