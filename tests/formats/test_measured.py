"""Pendulum measurements, reduced by BicycleParameters: its numbers, deviations and correlations are kept.

The measurements are those of the bicycle Browser in the repository of BicycleParameters (Moore 2012).
"""

import sys
from pathlib import Path

import pytest
from bicycleparameters.io import load_parameter_text_file
from bicycleparameters.main import calculate_benchmark_from_measured
from uncertainties import covariance_matrix

import bikestab as bs
from bikestab.errors import InputError

BROWSER = (Path(__file__).parents[1] / "references" / "browser_measured.txt").read_text("utf-8")


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "BrowserMeasured.txt"
    file.write_text(BROWSER)
    return file


@pytest.mark.filterwarnings("ignore:the matrix subclass", "ignore:Using UFloat")
def test_as_the_package_reduces_them(path):
    expected = calculate_benchmark_from_measured(load_parameter_text_file(path))[0]
    bicycle = bs.Bicycle.load(str(path))
    assert bicycle.given == {key: expected[key].nominal_value for key in bicycle.given}
    assert len(bicycle.deviations) == 26
    names = list(bicycle.deviations)
    covariance = covariance_matrix([expected[name] for name in names])
    for i, a in enumerate(names):
        assert bicycle.deviations[a] ** 2 == pytest.approx(covariance[i][i], rel=1e-13)
        for j, b in enumerate(names[:i]):
            scale = bicycle.deviations[a] * bicycle.deviations[b]
            found = bicycle.correlations.get((b, a), 0.0) * scale
            assert found == pytest.approx(covariance[i][j], rel=1e-12, abs=1e-9 * scale)
    assert bicycle.correlations["IRxx", "IFxx"] > 0.99  # both hung from one rod, whose stiffness is in both


def test_its_speeds_are_those_of_the_parameters_it_prints(path):
    """V1 and V2 as of the package's own benchmark file of this bicycle."""
    found = bs.stable_intervals(bs.Bicycle.load(str(path)))
    assert (found.V1[0], found.V2[0]) == pytest.approx((4.19537563, 4.3501115), abs=1e-7)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("TtP1 = ", "# TtP1 = ", "the measurement TtP1 is missing"),
        ("mP = 5.56+/-0.02", "mP = heavy", "line 13: mP: 'heavy' is not a number"),
        ("TtH2 = ", "xx = ", "the measurement TtH2 is missing"),
    ],
)
def test_refused(path, old, new, message):
    path.write_text(BROWSER.replace(old, new))
    with pytest.raises(InputError) as caught:
        bs.Bicycle.load(str(path))
    assert message in str(caught.value)


def test_without_the_package(path, monkeypatch):
    monkeypatch.setitem(sys.modules, "bicycleparameters.main", None)
    with pytest.raises(InputError, match="pip install 'bikestab\\[measured\\]'"):
        bs.Bicycle.load(str(path))
