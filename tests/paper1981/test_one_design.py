"""Single designs: intervals and eigenvalues."""

import pytest

from bikestab.model import characteristic_table
from bikestab.paper1981.one_design import eigenvalues
from tests.small import study


def test_table_of_the_theory():
    """The table of docs/theory.md, from an independent eigenvalue code, to its printed digits."""
    expected = [[(4.056, 4.636)], [(3.913, 5.228)], [(4.807, None)], [(3.621, 3.633)], []]
    table = study()["figure3"]["table"]
    for row, ends in zip(table, expected, strict=True):
        found = [(i["V1"], i["V2"]) for i in row["intervals"]]
        assert len(found) == len(ends)
        for (V1, V2), (low, high) in zip(found, ends, strict=True):
            assert pytest.approx(low, abs=5e-4) == V1
            assert V2 is None if high is None else pytest.approx(high, abs=5e-4) == V2


def test_eigenvalues_are_those_of_the_polynomial(bicycle):
    values = [complex(*s) for s in eigenvalues(bicycle.with_delta(0.5), 0.2, 0.08, 4.3)]
    table = characteristic_table(bicycle.with_delta(0.5), 0.2, 0.08)
    for s in values:
        terms = [table[k, j] * 4.3**j * s**k for k in range(5) for j in range(4)]
        assert abs(sum(terms)) < 1e-10 * sum(map(abs, terms))
