"""Correlated draws, lognormal and truncated ones, and tilts and trails that are uncertain."""

from pathlib import Path

import numpy as np
import pytest
from scipy import stats

import bikestab as bs
from bikestab.bicycle import Bicycle
from bikestab.config.scanconfig import ScanConfig
from bikestab.model import characteristic_table
from bikestab.routh import stable
from bikestab.speeds import intervals_of
from tests.configs import load, message

GOOD = """\
bicycle: meijaard2007
grid: {lam: {values: [18deg]}, sigma: {values: [0.0784313725490196]}, V: {values: [4.5, 5, 6]}}
ensemble:
  mB: {normal: [85, 4]}
  IBxx: {normal: [9.2, 1]}
  samples: 20000
"""
MEIJAARD = Bicycle.preset("meijaard2007")


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def correlation(ensemble):
    return np.corrcoef(ensemble.drawn["mB"], ensemble.drawn["IBxx"])[0, 1]


def test_correlated_as_the_config_says():
    plain = load(GOOD)
    linked = load(GOOD + "  correlation: {[mB, IBxx]: 0.8}\n")
    assert correlation(plain.ensemble) == pytest.approx(0, abs=0.03)
    assert correlation(linked.ensemble) == pytest.approx(0.8, abs=0.01)
    assert linked.sha256 != plain.sha256
    other = load(GOOD + "  correlation:\n    ? [IBxx, mB]\n    : 0.8\n")
    assert other.sha256 == linked.sha256
    again = ScanConfig(**{name: getattr(linked, name) for name in linked.model_fields_set})
    assert load(again.text).sha256 == linked.sha256
    for name, (mean, sd) in {"mB": (85, 4), "IBxx": (9.2, 1)}.items():
        assert stats.kstest(linked.ensemble.drawn[name], stats.norm(mean, sd).cdf).pvalue > 1e-3


def test_a_covariance_file():
    Path("cov.csv").write_text("mB,IBxx,xB\n16,3.2,0\n3.2,1,0\n0,0,0.0004\n")
    text = GOOD.replace("  mB: {normal: [85, 4]}\n  IBxx: {normal: [9.2, 1]}\n", "  covariance: cov.csv\n")
    ensemble = load(text).ensemble
    assert {name: one.normal for name, one in ensemble.parameters.items()} == {
        "mB": (85, 4), "IBxx": (9.2, 1), "xB": (0.3, 0.02),
    }  # fmt: skip
    assert ensemble.pairs == {("mB", "IBxx"): pytest.approx(0.8)}
    for content, words in (
        ("mB,IBxx\n1,2\n", "cov.csv is no covariance matrix"),
        ("mB,IBxx\n1,x\n1,1\n", "cov.csv is no covariance matrix"),
        ("mB,IBxx\n1,2\n3,1\n", "is not symmetric"),
        ("mb,IBxx\n1,0\n0,1\n", "did you mean 'mB'?"),
    ):
        Path("cov.csv").write_text(content)
        assert words in message(text)


def test_a_covariance_file_with_correlations_of_the_config():
    """Pair by pair: the config's count before the file's, whichever name is first, and the others stay."""
    Path("cov.csv").write_text("mB,IBxx,xB\n16,3.2,0.04\n3.2,1,0\n0.04,0,0.0004\n")
    text = GOOD.replace("  mB: {normal: [85, 4]}\n  IBxx: {normal: [9.2, 1]}\n", "  covariance: cov.csv\n")
    for typed, pairs in (
        ("{[xB, IBxx]: 0.1}", {("mB", "IBxx"): 0.8, ("mB", "xB"): 0.5, ("xB", "IBxx"): 0.1}),
        ("{[IBxx, mB]: 0.1}", {("IBxx", "mB"): 0.1, ("mB", "xB"): 0.5}),
        ("{[mB, IBxx]: 0}", {("mB", "IBxx"): 0, ("mB", "xB"): 0.5}),
        ("{}", {("mB", "IBxx"): 0.8, ("mB", "xB"): 0.5}),
    ):
        config = load(text + f"  correlation: {typed}\n")
        assert config.ensemble.pairs == pytest.approx(pairs)
        assert correlation(config.ensemble) == pytest.approx(
            pairs.get(("mB", "IBxx"), pairs.get(("IBxx", "mB"))), abs=0.03
        )
        again = ScanConfig(**{name: getattr(config, name) for name in config.model_fields_set})
        assert load(again.text).sha256 == config.sha256
    assert "'mB' is no pair" in message(text + "  correlation: {mB: 0.5}\n")
    assert "3 is not keys with values" in message(text + "  correlation: 3\n")
    assert "given twice" in message(text + "  correlation: {[mB, xB]: 0.5, [xB, mB]: 0.5}\n")
    assert "contradict" in message(text + "  correlation: {[mB, xB]: 0.99, [xB, IBxx]: -0.5}\n")


def test_correlations_of_the_bicycles_own_file():
    numbers = {
        name: value for name, value in Bicycle.preset("dikarev1981").numbers().items() if value is not None
    }
    del numbers["R1"], numbers["R2"]
    Path("mine.yaml").write_text("".join(f"{k}: {v}\n" for k, v in numbers.items()) + 'R: "0.35 +/- 0.01"\n')
    text = """\
bicycle: ./mine.yaml
grid: {lam: {values: [0.2]}, sigma: {values: [0.08]}, V: {values: [4, 5]}}
ensemble: {R1: {normal: [0.35, 0.01]}, R2: {normal: [0.35, 0.01]}, samples: 100}
"""
    drawn = load(text).ensemble.drawn
    np.testing.assert_allclose(drawn["R1"], drawn["R2"], rtol=1e-12)
    Path("cov.csv").write_text("R2,R1\n0.0001,0.00002\n0.00002,0.0001\n")  # counts before the bicycle's
    measured = text.replace("samples: 100}", "covariance: cov.csv, samples: 100}")
    assert load(measured).ensemble.pairs == {("R1", "R2"): pytest.approx(0.2)}
    drawn = load(text, "ensemble.correlation={}").ensemble.drawn
    assert abs(np.corrcoef(drawn["R1"], drawn["R2"])[0, 1]) < 0.3


def test_lognormal_and_truncated():
    text = GOOD.replace("{normal: [85, 4]}", "{lognormal: [85, 0.1]}")
    text = text.replace("{normal: [9.2, 1]}", "{truncated: [9.2, 1, 8.5, 11]}")
    for more in ("", "  correlation: {[mB, IBxx]: 0.6}\n"):
        drawn = load(text + more).ensemble.drawn
        assert stats.kstest(drawn["mB"], "lognorm", (0.1, 0, 85)).pvalue > 1e-3
        limits = (8.5 - 9.2, 11 - 9.2, 9.2, 1)
        assert stats.kstest(drawn["IBxx"], "truncnorm", limits).pvalue > 1e-3
        assert 8.5 <= drawn["IBxx"].min() < drawn["IBxx"].max() <= 11


@pytest.mark.parametrize(
    ("ensemble", "words"),
    [
        ("correlation: {[mB, IBxx]: 1.5}", "1.5 is no correlation\nallowed: -1 ... 1"),
        ("correlation: {[mB, xB]: 0.5}", "xB is not drawn\ndrawn: mB, IBxx"),
        ("correlation: {mB: 0.5}", "'mB' is no pair of two parameters"),
        ("correlation: {[mB, IBxx]: 0.5, [IBxx, mB]: 0.5}", "given twice"),
        ("correlation: 3", "3 is not keys with values"),
        ("xB: {lognormal: [-1, 0.1]}", "the median -1 is not positive"),
        ("xB: {truncated: [0.3, 0.1, 0.5]}", "is no 4 numbers"),
        ("xB: {truncated: [0.3, 0.01, 0.5, 0.6]}", "hardly any number"),
        ("c: {normal: [0.08, 0.01]}, trail: {normal: [0.08, 0.01]}", "ensemble.c is the trail as well"),
    ],
)
def test_mistakes(ensemble, words):
    text = GOOD.replace("  samples", f"  {ensemble}\n  samples".replace("}, ", "}\n  "))
    assert words in message(text)


def test_correlations_that_contradict_each_other():
    text = GOOD + "  xB: {normal: [0.3, 0.01]}\n"
    text += "  correlation: {[mB, IBxx]: 0.9, [mB, xB]: 0.9, [IBxx, xB]: -0.9}\n"
    assert "contradict each other" in message(text)


def test_uncertain_tilt_and_trail_agree_with_machines_one_by_one():
    """Drawn by numpy, each reduced as a machine of its own."""
    text = GOOD.replace("  mB", "  c: {normal: [0.08, 0.01]}\n  head_angle: {normal: [72deg, 1deg]}\n  mB")
    config = load(text)
    with bs.scan(config).open() as volume:
        found = volume.read("probability")[0, 0]
        somewhere = float(volume.read("probability_somewhere")[0, 0])
    random, number = np.random.default_rng(3), 20_000
    counts, some = np.zeros(3), 0
    for _ in range(2000):
        machine = MEIJAARD.replaced({
            "c": random.normal(0.08, 0.01), "lam": np.pi / 2 - random.normal(*np.radians([72, 1])),
            "mB": random.normal(85, 4), "IBxx": random.normal(9.2, 1),
        })  # fmt: skip
        table = characteristic_table(machine, machine.lam, machine.sigma)
        counts += stable(table[..., np.newaxis], np.array([4.5, 5, 6]))
        some += int(intervals_of(table).number > 0)
    spread = 5 * np.sqrt(0.25 / 2000 + 0.25 / number)
    np.testing.assert_allclose(found, counts / 2000, atol=spread)
    assert somewhere == pytest.approx(some / 2000, abs=spread)


def test_draws_of_the_grids_own_axes_are_spread_around_each_point():
    """A point of the grid has the probability of an ensemble around that point alone."""
    text = GOOD.replace("{values: [18deg]}", "{values: [16deg, 18deg, 20deg]}")
    text = text.replace("  mB: {normal: [85, 4]}\n", "  lam: {normal: [18deg, 1deg]}\n").replace(
        "20000", "500"
    )
    with bs.scan(load(text)).open() as volume:
        whole = volume.read("probability")
    for i, degrees in enumerate((16, 18, 20)):
        alone = text.replace("[16deg, 18deg, 20deg]", f"[{degrees}deg]").replace(
            "18deg, 1deg", f"{degrees}deg, 1deg"
        )
        with bs.scan(load(alone), force=True).open() as volume:
            np.testing.assert_allclose(volume.read("probability")[0], whole[i], atol=1e-6)


@pytest.mark.parametrize(
    ("distribution", "expected"),
    [
        ("{truncated: [0.3, 0.05, 0.3, 0.4]}", stats.truncnorm(0, 2, 0.3, 0.05)),
        ("{truncated: [0.2, 0.1, 0.3, 0.4]}", stats.truncnorm(1, 2, 0.2, 0.1)),  # its mean is outside
        ("{truncated: [0.3, 0.05, 0.2, 0.4]}", stats.truncnorm(-2, 2, 0.3, 0.05)),
        ("{lognormal: [0.3, 0.1]}", stats.lognorm(0.1, 0, 0.3)),
        ("{uniform: [0.25, 0.4]}", stats.uniform(0.25, 0.15)),
        ("{normal: [0.3, 0.01]}", stats.norm(0.3, 0.01)),
    ],
)
def test_half_of_the_machines_are_on_either_side_of_a_point_of_the_grid(distribution, expected):
    ensemble = load(GOOD.replace("  mB: {normal: [85, 4]}\n", f"  lam: {distribution}\n")).ensemble
    assert ensemble.parameters["lam"].median == pytest.approx(expected.median(), rel=1e-12)
    _, away = ensemble.parted(MEIJAARD, ("lam", "sigma"))
    assert np.mean(away["lam"] < 0) == pytest.approx(0.5, abs=0.015)
