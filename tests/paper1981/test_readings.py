"""Other readings of the printed values."""

import pytest

from bikestab.bicycle import Bicycle
from bikestab.paper1981.readings import exchanged
from bikestab.paper1981.study import plain
from tests.small import all_readings, record, study

FINITE = "A1 ⇄ B1, A2 ⇄ B2, B2 = 0.36"  # with C = 0.5, the printed value


def judged(words):
    return next(row for row in record().sensitivity.readings if row.reading == words)


def test_there_are_60():
    found = all_readings()
    assert len(found) == 60
    assert [words for words, reading in found.items() if reading.printed] == ["as printed"]
    assert found["as printed"].bicycle == Bicycle.preset("dikarev1981")
    swapped = found[FINITE].bicycle
    assert (swapped.A1, swapped.B1, swapped.A2, swapped.B2) == (6.7, 3.3, 0.22, 0.36)
    assert (swapped.C1, swapped.C2) == (0.5, 0.5)


def test_verdicts_of_the_printed_values_are_those_of_the_study():
    found = judged("as printed")
    study_verdicts = {number: part["verdict"] for number, part in study()["conclusions"].items()}
    assert plain(found.judged.everywhere.verdicts) == study_verdicts
    forwards = {number: part["verdict_forwards"] for number, part in study()["conclusions"].items()}
    assert plain(found.judged.forwards.verdicts)["1"] == forwards["1"]
    assert not found.possible


def test_the_reading_that_is_bounded_in_the_box():
    """Unbounded intervals from σ ≈ 0.156 on only."""
    found = judged(FINITE)
    whole = found.judged.everywhere
    assert whole.shares.unbounded == 0
    assert whole.shares_wider_box.unbounded > 0
    assert whole.verdicts.finite_interval == "holds with limits"


def test_a_possible_machine_refutes_conclusion_1_too():
    found = judged("A1 ⇄ B1, C = 0.05")
    assert found.possible
    assert found.judged.everywhere.verdicts.finite_interval == "does not hold"
    assert found.judged.forwards.verdicts.finite_interval == "holds"
    assert found.judged.formula_disagreements == 0


def test_counts_add_up():
    s = study()["sensitivity"]
    for count in s["counts"].values():
        assert sum(count["all"].values()) == s["number"] - s["stable_nowhere"]
    assert s["number"] == len(s["readings"])


def test_readings_that_rigid_bodies_can_have():
    """24, 16 and 12 of the 32 with C = 0.05, 0.1, 0.25, 0.5; the wheel's C2 as computed by hand."""
    s = study()["sensitivity"]["possible"]
    assert (s["tried"], s["by_sums"], s["by_diameters"], s["by_parallel_axes"]) == (40, 32, 20, 16)
    others = [r for r in exchanged(Bicycle.preset("dikarev1981")) if r.bicycle.C2 != 0.175]
    assert (len(others), sum(not r.bicycle.warnings for r in others)) == (32, 12)
    C2 = s["largest_C2"]
    assert pytest.approx(0.0502, abs=5e-5) == C2
    rim = C2 / 0.35**2
    assert C2 / 2 + rim * 2.7 / (2.7 - rim) * 0.15**2 == pytest.approx(0.036, rel=1e-9)
