"""Pendulum measurements, reduced by BicycleParameters: its numbers, deviations and correlations are kept.

The measurements are those of the bicycle Browser in the repository of BicycleParameters (Moore 2012).
"""

import sys

import pytest
from bicycleparameters.io import load_parameter_text_file
from bicycleparameters.main import calculate_benchmark_from_measured
from uncertainties import covariance_matrix

import bikestab as bs
from bikestab.errors import InputError

BROWSER = """\
lF = 0.293+/-0.001
lP = 1.05+/-0.001
nF = 13
lR = 0.29325+/-0.001
nR = 13
aB1 = 0.098+/-0.003
aB2 = 0.169+/-0.003
aB3 = -0.294+/-0.003
aH1 = 0.474+/-0.003
aH2 = 0.383+/-0.003
aH3 = 0.215+/-0.003
mF = 2.02+/-0.02
mP = 5.56+/-0.02
mB = 9.86+/-0.02
mH = 3.22+/-0.02
mR = 3.11+/-0.02
alphaB1 = 3.4+/-0.2
alphaB2 = 138.7+/-0.2
alphaB3 = 229.8+/-0.2
alphaH1 = 346.7+/-0.2
alphaH2 = 28.1+/-0.2
alphaH3 = 287.0+/-0.2
f = 0.0705+/-0.001
dF = 28.06+/-0.01
dP = 0.03+/-0.0001
w = 1.121+/-0.002
dR = 27.85+/-0.01
gamma = 67.1+/-0.2
g = 9.81 +/- 0.01
hbb = 0.295
TcB1 = 1.71730688911+/-4.98313880734e-06
TcF1 = 1.4811273727+/-7.31000200392e-06
TcH1 = 1.60185105189+/-6.90549490599e-06
TcR1 = 1.36108970039+/-3.90671672693e-06
TtB1 = 2.09957410356+/-8.09275635443e-05
TtB2 = 2.37671750273+/-2.4333984297e-05
TtB3 = 1.83976940999+/-1.02546435087e-05
TtF1 = 0.787577011406+/-1.46269721914e-06
TtH1 = 1.36879552035+/-5.95874853641e-06
TtH2 = 1.29527226157+/-6.44254076091e-06
TtH3 = 0.760950957261+/-2.80094376959e-06
TtP1 = 1.89399317145+/-5.93377589066e-06
TtR1 = 0.796564786052+/-1.16766813788e-06
"""


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
