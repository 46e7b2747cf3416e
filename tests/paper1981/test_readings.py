"""Other readings of the printed values."""

from bikestab.bicycle import Bicycle
from bikestab.paper1981.readings import judge_reading
from tests.small import TINY, all_readings, study

FINITE = "A1 ⇄ B1, A2 ⇄ B2, B2 = 0.36"  # with C = 0.5, the printed value


def test_there_are_36():
    found = all_readings()
    assert len(found) == 36
    assert [words for words, reading in found.items() if reading.printed] == ["as printed"]
    assert found["as printed"].bicycle == Bicycle.preset("dikarev1981")
    swapped = found[FINITE].bicycle
    assert (swapped.A1, swapped.B1, swapped.A2, swapped.B2) == (6.7, 3.3, 0.22, 0.36)
    assert (swapped.C1, swapped.C2) == (0.5, 0.5)


def test_verdicts_of_the_printed_values_are_those_of_the_study():
    found = judge_reading(all_readings()["as printed"], TINY.grid_readings)
    study_verdicts = {number: part["verdict"] for number, part in study()["conclusions"].items()}
    assert found.verdicts == study_verdicts
    assert not found.rigid


def test_the_reading_that_is_bounded_in_the_box():
    """Unbounded intervals from σ ≈ 0.156 on only."""
    found = judge_reading(all_readings()[FINITE], TINY.grid_readings)
    assert found.shares.unbounded == 0
    assert found.shares_wider_box.unbounded > 0
    assert found.verdicts["1"] == "holds with limits"


def test_a_possible_machine_refutes_conclusion_1_too():
    found = judge_reading(all_readings()["A1 ⇄ B1, C = 0.05"], TINY.grid_readings)
    assert found.rigid
    assert found.verdicts["1"] == "does not hold"
    assert found.formula_disagreements == 0


def test_counts_add_up():
    s = study()["sensitivity"]
    assert all(sum(count.values()) == s["number"] == len(s["readings"]) for count in s["counts"].values())
