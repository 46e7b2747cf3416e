"""What docs/theory.md and the README say of the reproduction is what it computes."""

import re
from pathlib import Path

import pytest

from tests.small import numbers, study

TOP = Path(__file__).parents[2]
THEORY = " ".join((TOP / "docs" / "theory.md").read_text("utf-8").split())


def test_readings():
    s = study()["sensitivity"]
    for text in (THEORY, (TOP / "README.md").read_text("utf-8")):
        assert re.search(r"(\d+) readings", text)[1] == str(s["number"])
    assert f"C2 is at most {s['possible']['largest_C2']:.4f} kg m²" in THEORY


def test_lines_of_forks_and_of_no_upper_limit():
    line = numbers(1)["forwards"]["line"]
    assert f"σ ≤ {line['slope_forwards']:.5f} tan λ" in THEORY
    assert f"σ = {line['least']:.5f} + {line['slope']:.5f} tan λ" in THEORY
    assert line["apart"]
    assert line["least"] == pytest.approx(0.012, abs=5e-4)
