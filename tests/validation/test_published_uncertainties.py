"""Published machines with standard deviations of which a linear rule gets the stable speeds wrong.

Parameter files of BicycleParameters: the balance-assist e-bike of TU Delft, and the yellow road bicycle with
its fork reversed (Moore 2012).
"""

from pathlib import Path

import numpy as np
import pytest

import bikestab as bs
from bikestab.bicycle import Bicycle
from bikestab.config.template import starting_config
from bikestab.design.sensitivity import held, sensitivity
from bikestab.design.spread import own_spread
from bikestab.machines import Machines
from bikestab.model import characteristic_table
from bikestab.slopes import by_name, slopes_of
from bikestab.speeds import critical_speeds
from tests.configs import load

E_BIKE = """\
IBxx = 1.120 +/- 0.018
IBxz = 0.047 +/- 0.028
IByy = 3.16 +/- 0.08
IBzz = 2.119 +/- 0.030
IFxx = 0.0995 +/- 0.0005
IFyy = 0.1902 +/- 0.0009
IHxx = 0.2984 +/- 0.0031
IHxz = -0.038 +/- 0.007
IHyy = 0.257 +/- 0.006
IHzz = 0.0566 +/- 0.0033
IRxx = 0.1023 +/- 0.0006
IRyy = 0.1887 +/- 0.0007
c = 0.042 +/- 0.010
g = 9.80665
lam = 0.255 +/- 0.026
mB = 22.500 +/- 0.010
mF = 2.235 +/- 0.010
mH = 4.300 +/- 0.010
mR = 4.085 +/- 0.010
rF = 0.35231 +/- 0.00014
rR = 0.34895 +/- 0.00014
w = 1.113 +/- 0.008
xB = 0.519 +/- 0.012
xH = 0.921 +/- 0.016
zB = -0.521 +/- 0.015
zH = -0.860 +/- 0.006
"""
REVERSED = """\
IBxx = 0.225356076528 +/- 0.00092916150614
IBxz = 0.0178765751912 +/- 0.000129627296249
IByy = 0.387875498968 +/- 0.00457262650146
IBzz = 0.214710761906 +/- 0.000893315075898
IFxx = 0.0851500332546 +/- 0.000346541216905
IFyy = 0.146642875064 +/- 0.00158129157014
IHxx = 0.147496786888 +/- 0.000640700256464
IHxz = -0.0171836655309 +/- 0.000527993839439
IHyy = 0.119511786484 +/- 0.00245444440384
IHzz = 0.0293793112718 +/- 0.000366277717216
IRxx = 0.0876699101307 +/- 0.000356796414278
IRyy = 0.148661417202 +/- 0.0012536133519
c = 0.180294938773 +/- 0.00176864639495
g = 9.81 +/- 0.01
lam = 0.338593874887 +/- 0.00349065850399
mB = 3.31 +/- 0.02
mF = 1.9 +/- 0.02
mH = 2.45 +/- 0.02
mR = 2.57 +/- 0.02
rF = 0.341877060449 +/- 0.000122426879301
rR = 0.341375110244 +/- 0.000122426879301
w = 0.985 +/- 0.002
xB = 0.41244491511 +/- 0.00379563686367
xH = 0.918984961179 +/- 0.00455107965017
zB = -0.61783135503 +/- 0.00370055269932
zH = -0.816256856812 +/- 0.00225140598256
"""


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("ebike.txt").write_text(E_BIKE)
    Path("reversed.txt").write_text(REVERSED)


def ensemble_of(name, *overrides):
    """The volume of the config that ``init --uncertain`` writes, over the bicycle's own design alone."""
    bicycle = Bicycle.load(name)
    text = starting_config(name, "study.yaml", uncertain=True)
    Path("study.yaml").write_text(text)
    own = f"grid.lam={{values: [{bicycle.lam!r}]}}", f"grid.sigma={{values: [{bicycle.sigma!r}]}}"
    config = load(text, *own, "slices=[]", "ensemble.samples=20000", *overrides)
    with bs.scan(config, force=True).open() as volume:
        found = {name: volume.read(name)[0, 0] for name in (
            "probability", "probability_somewhere", "probability_unbounded", "V1_quantiles", "V2_quantiles"
        )}  # fmt: skip
        return found, volume.axis("quantile")


def weave_speeds(bicycle, number, seed):
    """The highest weave speeds of drawn machines, if or not they capsize there; NaN where there is none."""
    random = np.random.default_rng(seed)
    drawn = {name: random.normal(bicycle.given[name], sd, number) for name, sd in bicycle.deviations.items()}
    lam, trail = drawn.pop("lam"), drawn.pop("c")
    machines, good = Machines.tried(bicycle, drawn)
    assert good.all()
    table = characteristic_table(machines, lam[:, np.newaxis], (trail / drawn["w"])[:, np.newaxis])[..., 0]
    return np.fmax.reduce(critical_speeds(table)["hurwitz3"])


def test_the_balance_assist_e_bike():
    speeds = "grid.V={values: [3.8]}"
    found, _ = ensemble_of("ebike.txt", speeds)
    assert found["probability_somewhere"] == pytest.approx(1 - 0.069, abs=0.008)
    # 6000 machines of another generator, their eigenvalues by numpy: 0.6155 ± 0.0063; first told as 0.59
    assert found["probability"][0] == pytest.approx(0.6155, abs=0.02)
    text = Path("study.yaml").read_text().splitlines()
    exact = "\n".join(line for line in text if not line.startswith(("  lam: {normal", "  c: {normal")))
    bicycle = Bicycle.load("ebike.txt")
    own = f"grid.lam={{values: [{bicycle.lam!r}]}}", f"grid.sigma={{values: [{bicycle.sigma!r}]}}"
    config = load(exact, *own, "slices=[]", "ensemble.samples=20000", speeds)
    with bs.scan(config, force=True).open() as volume:
        assert volume.read("probability")[0, 0, 0] == pytest.approx(0.94, abs=0.01)
    known = own_spread(sensitivity(bicycle), of_file=True, given={})
    assert known["V1"]["linear"] == pytest.approx(0.35, abs=0.01)
    # 120 000 machines of another generator: 0.37, with quantiles 3.01, 3.46 and 4.20, and up to 6.2 m/s
    assert known["V1"]["sampled"] == pytest.approx(0.370, abs=0.01)
    # 0.6 to 0.8, as first told, is the weave speed of all machines, of those too that are stable nowhere,
    # whose tail is so heavy that each thousand of draws has another deviation
    weave = np.array([weave_speeds(bicycle, 10_000, seed) for seed in range(5)])
    assert 0.55 < np.median(np.nanstd(weave, axis=1)) < 0.85
    assert np.nanmax(weave) > 15
    assert np.isnan(weave).mean() < 0.005
    ends = [known["V1"][key] for key in ("low", "median", "high")]
    assert ends == pytest.approx([3.01, 3.46, 4.20], abs=0.03)
    assert known["exists"] == pytest.approx(float(found["probability_somewhere"]), abs=0.01)
    assert known["V1"]["median"] == pytest.approx(found["V1_quantiles"][2], abs=0.02)


def test_the_reversed_road_bicycle():
    """Its interval has no upper limit, by 1.06 standard deviations: 14 to 15 % of draws have one."""
    found, quantiles = ensemble_of("reversed.txt", "ensemble.quantiles=[0.05, 0.5, 0.86]")
    bounded = 1 - found["probability_unbounded"] / found["probability_somewhere"]
    assert bounded == pytest.approx(0.145, abs=0.01)
    assert found["probability_somewhere"] == 1
    # the V² term of p0 ends the stability at high speeds where it becomes negative
    bicycle = Bicycle.load("reversed.txt")
    slopes = slopes_of(bicycle, bicycle.lam, bicycle.sigma)
    term = slopes.entries[0, 2]
    by = held(bicycle, bicycle.lam, bicycle.sigma, "trail", dict(by_name(slopes, term.slope)))
    deviation = np.sqrt(sum((by[name] * sd) ** 2 for name, sd in bicycle.deviations.items()))
    assert float(term.value.value) / deviation == pytest.approx(1.06, abs=0.02)
    # half of those that have an upper limit have it below the quantile of half their share
    found, _ = ensemble_of("reversed.txt", f"ensemble.quantiles=[{bounded / 2:.4f}]")
    assert found["V2_quantiles"][0] == pytest.approx(41, abs=2)
    assert np.isfinite(found["V1_quantiles"]).all()
    assert quantiles[1] == 0.5
