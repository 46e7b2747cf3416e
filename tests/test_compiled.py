"""The compiled kernel against the reference, and that nothing needs it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab import compiled, kernels, yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.file import parse_config
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.model import characteristic_table, exact_table
from bikestab.scan.ensemble import ensemble_statistics
from bikestab.scan.run import run_scan
from bikestab.spectrum import eigenvalues_of, growth_rate_of
from bikestab.speeds import intervals_of
from bikestab.volume import Volume
from tests.strategies import machines

ROOT = Path(__file__).parent.parent
needed = pytest.mark.skipif(not compiled.available(), reason="no C compiler has made the kernel")
NAMES = ["dikarev1981", "meijaard2007", "kooijman2011", "sharp1971"]


@needed
def test_what_was_made_of_other_sources_is_not_taken(tmp_path):
    for path in (kernels.LIBRARY, *kernels.LIBRARY.parent.glob("*.c")):
        shutil.copy(path, tmp_path)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(kernels, "LIBRARY", tmp_path / kernels.LIBRARY.name)
        assert kernels.library.__wrapped__() is not None
        with (tmp_path / "growth.c").open("a") as file:
            file.write("/* changed */")
        assert kernels.library.__wrapped__() is None


@needed
def test_entries_out_of_range_are_left_to_the_reference():
    table = np.zeros((5, 4, 1))
    for key, value in {
        (0, 0): 1.24e-301, (0, 2): -3.98e-300, (1, 0): 6.7e-299, (1, 3): 1.9e-298, (2, 0): 19.8,
        (2, 2): 1.4e152, (3, 0): 1.07e147, (3, 1): 2e-298, (4, 0): 1e-3,
    }.items():  # fmt: skip
        table[key] = value
    with np.errstate(all="ignore"):
        expected = intervals_of(table)
        V1, V2 = compiled.stable_speeds(table)
    np.testing.assert_array_equal(V1, expected.V1)
    np.testing.assert_array_equal(V2, expected.V2)


def table_of(bicycle, n=6, m=7, most=0.6):
    lam, sigma = np.repeat(np.linspace(-0.1, most, n), m), np.tile(np.linspace(-0.05, 0.3, m), n)
    return exact_table(bicycle, lam, sigma).value


def assert_close(table, V):
    """Within 1e-7 of the reference as single precision, and what rounding leaves of it near zero."""
    found = compiled.growth_rates(table, V)
    expected = growth_rate_of(table[..., np.newaxis], V).astype(np.float32)
    size = np.abs(eigenvalues_of(table[..., np.newaxis], V)).max(axis=0)
    assert found.dtype == np.float32
    finite = np.isfinite(expected)
    np.testing.assert_array_equal(found[~finite], expected[~finite])
    far = np.abs(found.astype(float) - expected)[finite]
    assert np.all(far <= (1e-7 * np.abs(expected) + 1e-13 * size)[finite])


@needed
@pytest.mark.parametrize("delta", [0, 1e-3, 1.0, 30.0])
@pytest.mark.parametrize("name", NAMES)
def test_usual_machines(name, delta):
    table = table_of(Bicycle.preset(name).with_delta(delta))
    for V in (
        np.linspace(0, 10, 101),
        np.linspace(0, 40, 33),
        np.array([0, 0.1, 0.5, 3, 3.01, 8, 30, 31, 200]),
    ):
        assert_close(table, V)


@needed
@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    machine=machines, delta=st.just(0.0) | st.floats(1e-6, 10), first=st.floats(0, 5), step=st.floats(1e-6, 1)
)
def test_random_machines(machine, delta, first, step):
    table = table_of(Bicycle.from_mapping({**machine, "delta": delta}), 3, 4, 0.8)
    assert_close(table, first + step * np.arange(70))


@needed
@pytest.mark.parametrize("step", [1e-9, 1e-6, 1e-3])
def test_through_a_coalescence(step):
    """That of the benchmark bicycle's two real eigenvalues [m/s], and numpy's eigenvalues as a witness."""
    bicycle = Bicycle.preset("meijaard2007")
    table = exact_table(bicycle, np.array([bicycle.lam]), np.array([bicycle.sigma])).value
    V = 0.68428307889246 + step * np.arange(-40, 41)
    assert_close(table, V)
    p = np.polynomial.polynomial.polyval(V, np.moveaxis(table[..., 0], 1, 0), tensor=True)
    witness = [np.roots(row[::-1]).real.max() for row in p.T]
    np.testing.assert_allclose(compiled.growth_rates(table, V)[0], witness, rtol=1e-6)


@needed
def test_random_speeds_through_coalescences_of_many_designs():
    """Steps so wide that pairs form and part again between two speeds."""
    V = np.sort(np.random.default_rng(3).uniform(0, 30, 64))
    for delta in (0, 0.5):
        assert_close(table_of(Bicycle.preset("sharp1971").with_delta(delta), 12, 13, 0.9), V)


@needed
def test_a_value_depends_neither_on_other_cells_nor_on_where_tiles_are_cut():
    table, V = table_of(Bicycle.preset("meijaard2007").with_delta(0.7), 9, 11), np.linspace(0, 12, 200)
    whole = compiled.growth_rates(table, V)
    for cells in (slice(0, 1), slice(5, 38), slice(17, 99, 3)):
        np.testing.assert_array_equal(compiled.growth_rates(table[..., cells], V), whole[cells])
    for k in (compiled.START, 3 * compiled.START):
        np.testing.assert_array_equal(compiled.growth_rates(table, V[:k]), whole[:, :k])
        np.testing.assert_array_equal(compiled.growth_rates(table, V[k:]), whole[:, k:])


@needed
def test_what_is_no_quartic_is_left_to_the_reference():
    table = table_of(Bicycle.preset("meijaard2007"), 2, 2)
    table[4, 0, 1] = 0
    table[:4, :, 2] = 0
    found = compiled.growth_rates(table, np.linspace(0, 5, 10))
    assert np.all(np.isinf(found[1]))
    assert np.all(found[2] == 0)
    assert np.all(np.isfinite(found[[0, 3]]))


# --- stable speeds


def assert_same_intervals(table):
    V1, V2 = compiled.stable_speeds(table)
    expected = intervals_of(table)
    most = expected.V1.shape[-1]
    assert V1.shape == V2.shape == expected.V1.shape
    for found, end in ((V1, expected.V1), (V2, expected.V2)):
        np.testing.assert_array_equal(np.isnan(found), np.isnan(end[..., :most]))
        np.testing.assert_allclose(found, end, rtol=1e-9, atol=1e-9)


@needed
@pytest.mark.parametrize("delta", [0, 1e-3, 1.0, 30.0])
@pytest.mark.parametrize("name", NAMES)
def test_stable_speeds_of_usual_machines(name, delta):
    assert_same_intervals(table_of(Bicycle.preset(name).with_delta(delta), 40, 41, 0.9).reshape(5, 4, 40, 41))


@needed
@settings(max_examples=100, deadline=None, derandomize=True)
@given(machine=machines, delta=st.just(0.0) | st.floats(1e-9, 30))
def test_stable_speeds_of_random_machines(machine, delta):
    assert_same_intervals(table_of(Bicycle.from_mapping({**machine, "delta": delta}), 5, 6, 0.9))


@needed
def test_stable_speeds_published():
    """Of the benchmark bicycle, to 40 digits in Meijaard et al. (2007) and after."""
    bicycle = Bicycle.preset("meijaard2007")
    V1, V2 = compiled.stable_speeds(characteristic_table(bicycle, bicycle.lam, bicycle.sigma))
    assert (V1[0], V2[0]) == pytest.approx((4.2923825363411, 6.0242620153884), rel=1e-13)


@needed
def test_tables_of_other_systems_are_left_to_the_reference():
    table = table_of(Bicycle.preset("meijaard2007"))
    table[2, 1] = 0.3
    table[0, :, 3] = 0
    assert_same_intervals(table)


@needed
@pytest.mark.parametrize("delta", [0, 0.8])
def test_ensembles(delta):
    bicycle = Bicycle.preset("meijaard2007").with_delta(delta)
    random = np.random.default_rng(4)
    draws = {"mB": random.normal(85, 9, 300), "xB": random.normal(0.3, 0.03, 300)}
    cells = np.repeat(np.linspace(0.1, 0.5, 4), 3), np.tile(np.linspace(0.03, 0.12, 3), 4)
    arguments = Family(bicycle), draws, *cells, np.linspace(0, 12, 40), [0.1, 0.5, 0.9]
    for found, expected in zip(
        ensemble_statistics(*arguments, fast=True), ensemble_statistics(*arguments), strict=True
    ):
        np.testing.assert_allclose(found, expected, rtol=1e-9)


# --- in a scan


def config_of(folder, more=""):
    text = (
        "bicycle: meijaard2007\ngrid:\n  lam: {start: 0.1, stop: 0.5, num: 6}\n"
        "  sigma: {start: 0.03, stop: 0.13, num: 5}\n  V: {start: 0, stop: 9, num: 70}\n"
        f"output: {folder}\n{more}"
    )
    return parse_config(yamltext.parse(text, "scan.yaml"))


@needed
def test_a_volume_says_that_it_was_used_and_is_no_other_scan_s(tmp_path):
    run_scan(config_of(tmp_path / "a"))
    run_scan(config_of(tmp_path / "b", "fast: true\n"))
    with h5py.File(tmp_path / "a/volume.h5") as plain, h5py.File(tmp_path / "b/volume.h5") as fast:
        assert fast["growth_rate"].attrs["kernel"] == b"compiled"
        assert "kernel" not in plain["growth_rate"].attrs
        np.testing.assert_allclose(fast["growth_rate"], plain["growth_rate"], rtol=1e-7, atol=1e-12)
        for name in ("stable", "violated", "V1", "V2"):
            np.testing.assert_array_equal(fast[name], plain[name])
    with Volume(tmp_path / "b") as volume:
        assert volume.text("config_sha256") == config_of(tmp_path, "fast: true\n").sha256
    with pytest.raises(InputError, match="fast: false there, true here"):
        run_scan(config_of(tmp_path / "a", "fast: true\n"))
    with pytest.raises(InputError, match="fast: true there, false here"):
        run_scan(config_of(tmp_path / "b"))


def test_it_is_another_scan_only_where_there_are_growth_rates(tmp_path):
    fields = "fields: [stable]\n"
    assert config_of(tmp_path, "fast: true\n").sha256 != config_of(tmp_path).sha256
    assert config_of(tmp_path, "fast: false\n").sha256 == config_of(tmp_path).sha256
    assert config_of(tmp_path, "fast: true\n" + fields).sha256 == config_of(tmp_path, fields).sha256


def test_without_it_one_message_says_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setattr(compiled, "library", lambda: None)
    with pytest.raises(InputError, match="kernel is not there") as raised:
        run_scan(config_of(tmp_path, "fast: true\n"))
    assert raised.value.key == ("fast",)
    assert "leave fast out" in raised.value.hint
    assert not list(tmp_path.iterdir())
    run_scan(config_of(tmp_path, "fast: true\nfields: [stable]\n"))


# --- how it is made


def hook(target, **variables):
    """What the build hook's own compilation says, in a process with these variables."""
    program = (
        f"import sys; sys.path.insert(0, {str(ROOT)!r})\n"
        f"from hatch_build import compiled; from pathlib import Path; print(compiled(Path({str(target)!r})))"
    )
    run = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        check=True,
    )
    return run.stdout.strip()


@pytest.mark.parametrize("compiler", ["false", "no-such-compiler", "'unclosed"])
def test_a_build_goes_on_without_a_compiler(tmp_path, compiler):
    assert hook(tmp_path / "kernels.bin", CC=compiler) == "False"
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(not shutil.which("cc"), reason="there is no C compiler")
def test_a_build_with_a_compiler_has_it(tmp_path):
    assert hook(tmp_path / "kernels.bin", CC="cc") == "True"
    assert (tmp_path / "kernels.bin").stat().st_size > 1000
