"""Kooijman, Meijaard, Papadopoulos, Ruina and Schwab (2011): the two-mass-skate bicycle.

The paper's claims: without gyroscopic effect (skates do not spin) and without trail it is stable by itself.
The numbers of this file come from matrices and from 40 digits, not from the paper.
"""

import numpy as np
import pytest
from bicycleparameters.bicycle import ab_matrix, benchmark_par_to_canonical
from mpmath import mp, mpf

from bikestab.bicycle import Bicycle, parameters
from bikestab.model import canonical_matrices, characteristic_table
from bikestab.spectrum import eigenvalues_of, growth_rate_of
from bikestab.speeds import CAPSIZE, UNBOUNDED, WEAVE, critical_speeds, intervals_of
from tests.references import generate_speeds as reference

SPEEDS = (10.0, 100.0, 1000.0)  # m/s


@pytest.fixture(scope="module")
def bicycle():
    return Bicycle.preset("kooijman2011")


@pytest.fixture(scope="module")
def table(bicycle):
    return characteristic_table(bicycle, bicycle.lam, bicycle.sigma)


def matrix_eigenvalues(V):
    """Of BicycleParameters' matrices; a wheel that neither weighs nor spins may have any radius but zero."""
    machine = reference.SKATES | {"rR": 1.0, "rF": 1.0}
    return np.linalg.eigvals(ab_matrix(*benchmark_par_to_canonical(machine), V, machine["g"])[0])


def exact_table():
    return reference.polynomial(reference.SKATES, reference.SKATES["lam"], 0, 0, "refined")


def test_two_point_masses_on_skates_without_trail(bicycle):
    zero = {"A1", "B1", "D1", "C1", "R1", "A2", "B2", "D2", "C2", "R2", "delta", "sigma"}
    assert {p.name for p in parameters() if getattr(bicycle, p.name) == 0} == zero
    assert (bicycle.m1, bicycle.l1, bicycle.h1) == (10, 1.2, 0.4)
    assert (bicycle.m2, bicycle.l2, bicycle.h2) == (1, 1.02, 0.2)
    assert not bicycle.warnings


def test_mass_matrix_is_not_singular(bicycle, table):
    """Either mass moves in roll, the front one in steer too, being 3.7 cm ahead of the axis."""
    M = canonical_matrices(bicycle, bicycle.lam, bicycle.sigma)[0]
    d = 0.2 * np.sin(bicycle.lam) + 0.02 * np.cos(bicycle.lam)
    assert pytest.approx(np.array([[1.64, 0.2 * d], [0.2 * d, d**2]]), rel=1e-14) == M
    assert table[4, 0] == pytest.approx(1.6 * d**2, rel=1e-14)  # (1.64 − 0.04) d²: p4 is not zero


def test_capsize_condition_does_not_depend_on_speed(table):
    """The V² term of p0 is zero exactly, by cancellation; in 40 digits some 1e-40 of its terms is left."""
    assert table[0, 2] == 0
    assert table[0, 0] > 0
    assert np.isnan(critical_speeds(table)["p0"]).all()
    with mp.workdps(40):
        entry = exact_table()[0, 2]
        assert entry.size > 1
        assert abs(entry.value) < mpf("1e-38") * entry.size


def test_stable_from_weave_on_without_end(table):
    """The weave speed in 40 digits, to 1e-13: the front mass is 3.7 cm ahead of the axis, and the rounding
    of that difference of lengths of 1 m is 3e-15 of it.
    """
    found = intervals_of(table)
    with mp.workdps(40):
        ((lower, upper),) = reference.stable_intervals(exact_table())
    assert (found.lower.tolist(), found.upper.tolist()) == ([WEAVE], [UNBOUNDED])
    assert found.V2.tolist() == [np.inf]
    assert (lower.kind, upper.kind) == ("weave", "unbounded")
    assert found.V1[0] == pytest.approx(float(lower.V), rel=1e-13)
    assert found.V1[0] == pytest.approx(2.841, abs=5e-4)


def test_weave_speed_is_a_sign_change_of_the_matrix(table):
    V1 = intervals_of(table).V1[0]
    below, above = (matrix_eigenvalues(V1 * (1 + side)).real.max() for side in (-1e-9, 1e-9))
    assert below > 0 > above


@pytest.mark.parametrize("V", SPEEDS)
def test_eigenvalues_far_up(table, V):
    """To 1e-13 of each one, in 40 digits.

    The matrix's are right to 1e-13 of the largest only, which at 1000 m/s is 2e6 times the slowest one.
    """
    found = np.sort_complex(eigenvalues_of(table, V))
    with mp.workdps(40):
        exact = np.sort_complex([complex(s) for s in reference.eigenvalues(exact_table(), mpf(V))])
    assert found == pytest.approx(exact, rel=1e-13, abs=0)
    assert np.sort_complex(matrix_eigenvalues(V)) == pytest.approx(
        exact, rel=0, abs=1e-13 * np.abs(exact).max()
    )
    assert exact.real.max() < 0
    assert growth_rate_of(table, V) == pytest.approx(exact.real.max(), rel=1e-13)


def test_decay_fades_as_the_inverse_of_speed(table):
    """What is left far up is p2 (V s)² + p1 (V s) + p0 = 0, so that s V tends to −p1/(2 p2) ± …: never up."""
    slow = np.roots([table[2, 2], table[1, 1], table[0, 0]])
    assert slow.imag.max() > 0
    assert growth_rate_of(table, 1e5) * 1e5 == pytest.approx(slow.real[0], rel=1e-8)
    assert growth_rate_of(table, np.geomspace(2.85, 1e5, 200)).max() < 0


def test_only_spinning_wheels_can_bound_it(bicycle):
    """The V² term of p0 is c g cos λ ((C1° + C2°) S − h C2° sin λ): zero without spin, whatever the trail.

    A spinning rear wheel makes it positive, a front wheel negative, since h sin λ > S here.
    """
    for sigma in (-0.004, 0.1):
        assert characteristic_table(bicycle, bicycle.lam, sigma)[0, 2] == 0
    n = {key: value for key, value in bicycle.numbers().items() if value is not None}
    for spin, kind in (({"C1": 0.01, "R1": 0.3}, UNBOUNDED), ({"C2": 0.01, "R2": 0.3}, CAPSIZE)):
        found = intervals_of(characteristic_table(Bicycle.from_mapping(n | spin), bicycle.lam, 0))
        assert found.upper.tolist() == [kind]
