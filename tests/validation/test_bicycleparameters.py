"""The measured bicycles that come with BicycleParameters, against that package's own eigenvalues.

The numbers are read from the installed package: the bicycles of its application, its parameter sets and
its parameter dictionaries, whichever have all of Meijaard et al.'s (2007) parameters.
"""

from pathlib import Path

import bicycleparameters
import numpy as np
import pytest
from bicycleparameters import parameter_dicts
from bicycleparameters.io import load_parameter_text_file
from bicycleparameters.models import Meijaard2007Model
from bicycleparameters.parameter_sets import Meijaard2007ParameterSet
from ruamel.yaml import YAML
from scipy.optimize import linear_sum_assignment

from bikestab.bicycle import MEIJAARD, Bicycle
from bikestab.model import canonical_matrices, characteristic_table
from bikestab.spectrum import eigenvalues_of, growth_rate_of
from bikestab.speeds import intervals_of

PACKAGE = Path(bicycleparameters.__file__).parent
KEYS = set(MEIJAARD) - {"delta"}
V = np.linspace(0, 30, 121)  # m/s


def measured():
    """Every complete set of parameters, by the name of its file or dictionary."""
    found = {}
    for path in sorted(PACKAGE.glob("app-data/bicycles/*/Parameters/*Benchmark.txt")):
        lines = [line.split("=") for line in path.read_text("utf-8").splitlines() if "=" in line]
        found[path.stem] = {key.strip(): value.split("+/-")[0] for key, value in lines}
    for path in sorted(PACKAGE.glob("tests/parameter_sets/*.yml")):
        values = YAML(typ="safe").load(path.read_text("utf-8"))
        found[path.stem] = values.get("values", values)
    found |= {name: getattr(parameter_dicts, name) for name in dir(parameter_dicts) if name[0] != "_"}
    return {
        name: {key: float(values[key]) for key in KEYS}
        for name, values in found.items()
        if values.keys() >= KEYS
    }


MEASURED = measured()


@pytest.fixture(params=MEASURED)
def machine(request):
    return MEASURED[request.param]


@pytest.fixture
def table(machine):
    bicycle = Bicycle.from_mapping(machine)
    return characteristic_table(bicycle, bicycle.lam, bicycle.sigma)


def model_of(machine):
    """The package's own model of a machine."""
    return Meijaard2007Model(Meijaard2007ParameterSet({**machine, "v": 0.0}, includes_rider=False))


def growth_of(machine, V):
    """The package's largest real part at each of the speeds V."""
    return model_of(machine).calc_eigen(v=np.atleast_1d(V))[0].real.max(axis=-1)


def test_the_package_has_its_bicycles():
    """Nine measured ones and the benchmark of its application, and others; a move of its files shows here."""
    names = {name.removesuffix("Benchmark") for name in MEASURED if name.endswith("Benchmark")}
    assert names >= {"Browser", "Crescendo", "Fisher", "Pista", "Rigid", "Silver", "Yellow", "Yellowrev"}
    assert "benchmark-pistarider" in MEASURED
    assert "meijaard2007_browser_jason" in MEASURED


def test_matrices(machine):
    """To 1e-13 of each matrix's largest entry: both codes round sums of some ten terms."""
    bicycle = Bicycle.from_mapping(machine)
    found = canonical_matrices(bicycle, bicycle.lam, bicycle.sigma)
    for got, expected in zip(found, model_of(machine).form_reduced_canonical_matrices(), strict=True):
        assert got == pytest.approx(expected, rel=0, abs=1e-13 * np.abs(expected).max())


def test_eigenvalues(machine, table):
    """To 1e-12 of the largest one at that speed.

    The package takes a matrix's eigenvalues, which are right to ε times their condition. That is some
    hundreds where two are nearly equal, as below the weave speed; at none of these speeds is it more.
    """
    found, expected = eigenvalues_of(table[..., np.newaxis], V).T, model_of(machine).calc_eigen(v=V)[0]
    for got, want in zip(found, expected, strict=True):
        distance = np.abs(got[:, np.newaxis] - want)
        assert distance[linear_sum_assignment(distance)].max() <= 1e-12 * np.abs(want).max()


def test_stable_where_the_package_says_so(machine, table):
    intervals = intervals_of(table)
    inside = np.any((V[:, np.newaxis] > intervals.V1) & (V[:, np.newaxis] < intervals.V2), axis=1)
    assert np.array_equal(inside, growth_of(machine, V) < 0)
    assert np.array_equal(inside, growth_rate_of(table[..., np.newaxis], V) < 0)


def test_ends_are_sign_changes_of_the_package(machine, table):
    """Its growth rate changes sign within 1e-9 of V1 and of V2: where it crosses with some 0.1 s⁻¹ per m/s,
    rounding of 1e-13 s⁻¹ moves the crossing by 1e-12 m/s.
    """
    intervals = intervals_of(table)
    ends = [(V1, +1) for V1 in intervals.V1] + [(V2, -1) for V2 in intervals.V2]
    for end, side in ends:
        if np.isfinite(end) and end > 0:
            before, after = growth_of(machine, end * np.array([1 - 1e-9, 1 + 1e-9])) * side
            assert before > 0 > after


def test_a_measured_bicycle_without_upper_speed():
    """Yellow with its fork reversed, a trail of 0.18 m: conclusion 1 of the 1981 paper fails here too."""
    machine = MEASURED["YellowrevBenchmark"]
    bicycle = Bicycle.from_mapping(machine)
    found = intervals_of(characteristic_table(bicycle, bicycle.lam, bicycle.sigma))
    assert found.V1.tolist() == pytest.approx([3.7753], rel=0, abs=5e-5)
    assert found.V2.tolist() == [np.inf]
    assert growth_of(machine, np.geomspace(3.8, 1e3, 100)).max() < 0


FILES = [
    *sorted(PACKAGE.glob("app-data/bicycles/*/Parameters/*Benchmark.txt")),
    *sorted(PACKAGE.glob("tests/parameter_sets/benchmark-*.yml")),
]


@pytest.mark.filterwarnings("ignore:Using UFloat objects with std_dev==0")
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_its_files(path):
    """Read as they are, with every uncertainty that the package's own reader finds."""
    bicycle = Bicycle.load(str(path))
    assert {key: bicycle.given[key] for key in KEYS} == MEASURED[path.stem]
    own = load_parameter_text_file(path) if path.suffix == ".txt" else {}
    expected = {key: value.std_dev for key, value in own.items() if key in KEYS and value.std_dev}
    assert bicycle.deviations == expected
