"""Volumes that others made or that are damaged: one message with the object's name, never a wrong number."""

import json
import os
import signal
import subprocess
import sys
import time
from functools import partial

import h5py
import numpy as np
import pytest

from bikestab import watched
from bikestab.errors import InputError
from bikestab.export.summary import summary
from bikestab.export.volumes import export_intervals
from bikestab.volume import Volume
from tests.volumes import config_of

SWEEP = """\
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 3}
  sigma: {start: 0.05, stop: 0.15, num: 2}
  V: {start: 0, stop: 10, num: 4}
sweep: {delta: [0, 1]}
fields: [stable]
output: OUT
"""
DRAWN = SWEEP.replace("sweep: {delta: [0, 1]}", "ensemble: {m1: {normal: [80, 1]}, samples: 10, seed: 1}")


@pytest.fixture(scope="module")
def others(tmp_path_factory):
    """The bytes of a volume with a sweep, and of one with an ensemble."""
    from bikestab.scan.run import run_scan

    folder = tmp_path_factory.mktemp("others")
    texts = {"sweep": SWEEP, "drawn": DRAWN}
    return {name: run_scan(config_of(text, folder / name)).path.read_bytes() for name, text in texts.items()}


def replaced(name, values, **options):
    """Put another dataset in one's place."""

    def harm(file):
        attributes = dict(file[name].attrs)
        del file[name]
        data = file.create_dataset(name, data=values, **options)
        for key in ("units", "names"):
            if key in attributes:
                data.attrs[key] = attributes[key]

    return harm


def attribute(name, value):
    return lambda file: file.attrs.__setitem__(name, value)


def without(*names):
    def harm(file):
        for name in names:
            del file[name]

    return harm


def as_group(name):
    def harm(file):
        del file[name]
        file.create_group(name)

    return harm


def linked(name, link):
    def harm(file):
        del file[name]
        file[name] = link

    return harm


def parameters(change):
    def harm(file):
        numbers = json.loads(file.attrs["bicycle_parameters"])
        change(numbers)
        file.attrs["bicycle_parameters"] = json.dumps(numbers)

    return harm


def values(name, change):
    def harm(file):
        data = file[name][()]
        change(data)
        file[name][...] = data

    return harm


def set_at(index, value):
    return lambda data: data.__setitem__(index, value)


def virtual(file):
    shape, dtype = file["stable"].shape, file["stable"].dtype
    del file["stable"]
    layout = h5py.VirtualLayout(shape, dtype)
    layout[...] = h5py.VirtualSource("elsewhere.h5", "stable", shape)
    file.create_virtual_dataset("stable", layout)


def external(file):
    shape, dtype = file["stable"].shape, file["stable"].dtype
    del file["stable"]
    file.create_dataset("stable", shape, dtype, external=[("/etc/passwd", 0, h5py.h5f.UNLIMITED)])


def huge(file):
    del file["stable"]
    file.create_dataset("stable", (1 << 20, 1 << 20, 1 << 20), "u1", chunks=(1 << 10, 1 << 10, 1 << 10))


def empty(file):
    shape = file["stable"].shape
    del file["stable"]
    file.create_dataset("stable", shape, "u1", chunks=(1, 1, 1))


def promising(file):
    """Few bytes for many values: one chunk of a gigabyte, stored as ten bytes."""
    lam = np.linspace(0, 0.3, 1 << 10)
    for name in AXES:
        replaced(name, lam)(file)
    del file["stable"]
    data = file.create_dataset("stable", (1 << 10,) * 3, "u1", chunks=(1 << 10,) * 3, compression="gzip")
    data.id.write_direct_chunk((0, 0, 0), b"0123456789")


AXES = ("lam", "sigma", "V")
DAMAGE = {
    # attributes
    "no title": (lambda file: file.attrs.__delitem__("title"), "has no attribute 'title'"),
    "title of numbers": (attribute("title", 3), "the attribute 'title' is no text"),
    "titles": (attribute("title", ["a", "b"]), "the attribute 'title' is not a single value"),
    "title of bytes": (attribute("title", np.bytes_(b"\xff\xfe")), "the attribute 'title' is no UTF-8"),
    "empty title": (attribute("title", h5py.Empty("f4")), "the attribute 'title'"),
    "another model": (attribute("model", "tyres"), "the attribute 'model' is 'tyres'"),
    "text for a number": (attribute("stable_points", "many"), "the attribute 'stable_points' is no number"),
    "too many points": (attribute("stable_points", 10**9), "the attribute 'stable_points' is 1e+09"),
    "fewer than none": (attribute("stable_points", -1), "the attribute 'stable_points' is -1"),
    "complete twice": (attribute("complete", [1, 1]), "'complete' is not a single value"),
    "complete in words": (attribute("complete", "yes"), "'complete' is no number"),
    "not a hash": (attribute("config_sha256", "f00"), "the attribute 'config_sha256' is no SHA-256"),
    "another hash": (attribute("config_sha256", "0" * 64), "'config_sha256' is of another scan"),
    "NaN difference": (
        lambda file: file["boundary"].attrs.__setitem__("largest_difference", np.nan),
        "boundary: the attribute 'largest_difference' is nan",
    ),
    # parameters
    "no JSON": (attribute("bicycle_parameters", "m1: 80"), "bicycle_parameters: is no JSON"),
    "deep JSON": (attribute("bicycle_parameters", "[" * 5000), "bicycle_parameters: is no JSON"),
    "JSON list": (attribute("bicycle_parameters", "[80]"), "bicycle_parameters: is no JSON object"),
    "missing parameter": (parameters(lambda n: n.pop("m1")), "bicycle_parameters: has no m1"),
    "added parameter": (
        parameters(lambda n: n.update(tyre=1)),
        "bicycle_parameters: 'tyre' is no parameter",
    ),
    "text parameter": (parameters(lambda n: n.update(m1="80")), "bicycle_parameters: m1 is no number"),
    "null parameter": (parameters(lambda n: n.update(m1=None)), "bicycle_parameters: m1 is no number"),
    "NaN parameter": (parameters(lambda n: n.update(m1=np.nan)), "bicycle_parameters.m1: nan is not finite"),
    "negative mass": (parameters(lambda n: n.update(m1=-1)), "bicycle_parameters.m1: -1 is not positive"),
    "another mass": (parameters(lambda n: n.update(m1=81)), "'config_sha256' is of another scan"),
    # axes
    "short axis": (replaced("lam", [0.1]), "stable: has the shape 7 × 5 × 11, not the shape 1"),
    "no value": (replaced("lam", np.empty(0)), "lam: is empty"),
    "axis of another length": (replaced("lam", [0, 0.1]), "stable: has the shape 7 × 5 × 11, not"),
    "axis of two axes": (replaced("V", np.zeros((11, 1))), "V: has the shape 11 × 1, not one axis"),
    "axis of single precision": (replaced("V", np.arange(11, dtype="f4")), "V: has values of type float32"),
    "axis of text": (replaced("V", np.array([b"a"] * 11)), "V: has values of type |S1"),
    "axis backwards": (values("V", lambda data: data[::-1].sort()), "V: has values that do not increase"),
    "axis with NaN": (values("sigma", set_at(2, np.nan)), "sigma: is empty, or has values that are not fin"),
    "tilt beyond": (values("lam", set_at(-1, 2.0)), "lam: a steering axis tilted by 2 rad"),
    "speed below": (values("V", set_at(0, -1)), "V: -1 is a speed backwards"),
    "another speed": (values("V", set_at(1, 1.5)), "'config_sha256' is of another scan"),
    "another unit": (lambda file: file["lam"].attrs.__setitem__("units", "deg"), "lam: is in 'deg', not in"),
    "counter": (values("interval", set_at(0, 7)), "interval: has not the values 1, 2"),
    # objects
    "no field": (
        without("stable", "violated", "growth_rate", *["p0", "p1", "p2", "p3", "p4", "hurwitz3"]),
        "has no f",
    ),
    "no V1": (without("V1"), "V1: is missing"),
    "no bounds": (without("V1_error"), "V1_error: is missing"),
    "no root": (without("boundary/p0"), "boundary/p0: is missing"),
    "no boundary": (without("boundary"), "boundary: is no group"),
    "group": (as_group("V1"), "V1: is a group, not a dataset"),
    "dataset for a group": (linked("boundary", [1.0]), "boundary: is no group"),
    "dangling": (linked("V1", h5py.SoftLink("/nowhere")), "V1: is missing, damaged, or a link that"),
    "itself": (linked("V1", h5py.SoftLink("/V1")), "V1: is"),
    "link out": (linked("V1", h5py.ExternalLink("other.h5", "/V1")), "V1: is a link out of the file"),
    "link out of a group": (
        lambda file: file["boundary"].__setitem__("more", h5py.ExternalLink("other.h5", "/")),
        "boundary/more: is a link out of the file",
    ),
    "virtual": (virtual, "stable: is a virtual dataset"),
    "external": (external, "stable: has its values in another file"),
    "filter": (replaced("V1", np.zeros((7, 5, 1)), compression="lzf"), "V1: has a filter of kind 32000"),
    "huge": (huge, "stable: has the shape 1048576 × 1048576 × 1048576, not"),
    "not stored": (empty, "stable: has 0 of its 385 chunks"),
    "promising": (promising, "stable: claims more values than the file can hold"),
    "too many intervals": (replaced("interval", np.arange(1, 10**4, dtype="i4")), "interval: is longer than"),
    "probability without an ensemble": (
        lambda file: file.create_dataset("probability", data=np.zeros((7, 5, 11), "f4")),
        "probability: is there without an ensemble",
    ),
}
OF_SWEEP = {
    "no names": (lambda file: file["machine"].attrs.__delitem__("names"), "machine: is damaged and cannot"),
    "another name": (
        lambda file: file["machine"].attrs.__setitem__("names", np.bytes_("a b")),
        "machine: 'a' is no parameter",
    ),
    "no scale": (lambda file: file["machine"].attrs.__delitem__("DIMENSION_LIST"), "machine: is damaged"),
    "another delta": (values("delta", set_at(1, 2.0)), "'config_sha256' is of another scan"),
    "another machine": (values("machine", set_at((1, 2), 9.0)), "'config_sha256' is of another scan"),
    "no parameter axis": (without("parameter"), "is"),
}
OF_DRAWN = {
    "no samples": (lambda file: file.attrs.__delitem__("ensemble_samples"), "probability: is there without"),
    "samples": (attribute("ensemble_samples", 0), "the attribute 'ensemble_samples' is 0"),
    "no quantiles": (without("V1_quantiles"), "V1_quantiles: is missing"),
}


def refused(content, harm, problem, path):
    path.write_bytes(content)
    with h5py.File(path, "a") as file:
        harm(file)
    with pytest.raises(InputError) as caught:
        Volume(path)
    text = str(caught.value)
    assert text.startswith(f"{path}: {problem}") or (text.startswith(f"{path}: ") and problem in text), text
    assert len(text.splitlines()) <= 2
    assert caught.value.__cause__ is None


@pytest.mark.parametrize("name", DAMAGE)
def test_damage_is_named(equal, tmp_path, name):
    refused(equal[0].read_bytes(), *DAMAGE[name], tmp_path / "copy.h5")


@pytest.mark.parametrize("name", OF_SWEEP)
def test_damage_of_a_sweep_is_named(others, tmp_path, name):
    refused(others["sweep"], *OF_SWEEP[name], tmp_path / "copy.h5")


@pytest.mark.parametrize("name", OF_DRAWN)
def test_damage_of_an_ensemble_is_named(others, tmp_path, name):
    refused(others["drawn"], *OF_DRAWN[name], tmp_path / "copy.h5")


@pytest.mark.parametrize(
    ("name", "value", "read"),
    [
        ("upper", 9, summary),
        ("marginal", 7, summary),
        ("violated", 64, lambda volume: volume.read("violated")),
        ("growth_rate", np.nan, lambda volume: volume.read("growth_rate", (0,))),
    ],
)
def test_values_out_of_range_are_refused_where_they_are_read(equal, tmp_path, name, value, read):
    path = tmp_path / "copy.h5"
    path.write_bytes(equal[0].read_bytes())
    with h5py.File(path, "a") as file:
        file[name][0, 0] = value
    with Volume(path) as volume, pytest.raises(InputError, match=f"copy.h5: {name}: has values that"):
        read(volume)


@pytest.mark.parametrize("name", ["V1", "V2"])
@pytest.mark.parametrize("value", [np.nan, -np.inf, np.inf, -1.0])
@pytest.mark.parametrize("sweep", [False, True])
def test_ends_that_are_not_those_of_their_intervals_are_refused(equal, others, tmp_path, name, value, sweep):
    path = tmp_path / "copy.h5"
    path.write_bytes(others["sweep"] if sweep else equal[0].read_bytes())
    with h5py.File(path, "a") as file:
        some = np.argwhere((file["upper"][()] > 0) & np.isfinite(file["V2"][()]))[0]
        none = np.argwhere(file["upper"][()] == 0)[0]
        file[name][tuple(some)] = value
    with Volume(path) as volume:
        chosen = volume.at({"delta": volume.swept["delta"][some[0]]}) if sweep else volume
        where = tuple(map(int, some[1:] if sweep else some))
        for part in ((), (where[0],), (slice(where[0], where[0] + 1),), where):
            with pytest.raises(InputError, match=f"copy.h5: {name}: has values that are not what upper says"):
                chosen.read(name, part)
    with h5py.File(path, "a") as file:
        file[name][tuple(none)] = 3.0
    with Volume(path) as volume, pytest.raises(InputError, match="not what upper says"):
        volume.read(name)


def test_another_order_of_bytes_is_none_of_what_is_read(equal, tmp_path):
    """HDF5 keeps either; Arrow takes that of the machine alone."""
    path = tmp_path / "volume.h5"
    path.write_bytes(equal[0].read_bytes())
    with h5py.File(path, "a") as file:
        for name in ("V", "V1", "V1_error"):
            replaced(name, file[name][()].astype(">f8"))(file)
    with Volume(path) as volume, Volume(equal[0]) as original:
        for name in ("V", "V1", "V1_error"):
            assert volume.file[name].dtype == ">f8"
            assert volume.read(name).dtype == np.dtype("f8")
            np.testing.assert_array_equal(volume.read(name), original.read(name))
        export_intervals(volume, [str(tmp_path / "a.parquet")])


def test_what_others_add_is_no_hindrance(equal, tmp_path):
    path = tmp_path / "copy.h5"
    path.write_bytes(equal[0].read_bytes())
    with h5py.File(path, "a") as file:
        file["mine"] = h5py.SoftLink("/V1")
        file["again"] = file["/"]  # a group within itself
        file.create_group("notes")["text"] = "seen"
    with Volume(path) as volume:
        assert volume.read("V1").shape == (7, 5, 1)


# --- the watched process


def for_ever():
    while True:
        time.monotonic()


@pytest.mark.parametrize(
    ("check", "problem"),
    [
        (for_ever, "HDF5 does not come to an end with it in 1 s"),
        (lambda: os.kill(os.getpid(), signal.SIGSEGV), "HDF5 crashes over it"),
        (lambda: os._exit(0), "HDF5 crashes over it"),
    ],
)
def test_a_check_that_does_not_answer(check, problem, monkeypatch):
    monkeypatch.setattr(watched, "LIMIT", 1)
    with pytest.raises(InputError, match=problem):
        watched.watched(check)


def test_a_check_raises_what_it_raises_here():
    def check():
        raise InputError("is bad", key=("lam",), hint="allowed: good")

    with pytest.raises(InputError) as caught:
        watched.watched(check)
    assert str(caught.value.at("a.h5")) == "a.h5: lam: is bad\nallowed: good"


def test_a_limit_of_processor_time_below_ours(equal):
    """As of ``ulimit -t 3``, in a process of its own: the limit of this one must stay."""
    program = (
        "import resource, sys; resource.setrlimit(resource.RLIMIT_CPU, (3, 3));"
        "import bikestab; print(bikestab.open_volume(sys.argv[1]).title)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, equal[0]], capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.stderr) == ("a small scan\n", "")


def test_where_the_ends_of_children_are_not_kept(equal):
    before = signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    try:
        with Volume(equal[0]) as volume:
            assert volume.title == "a small scan"
        with pytest.raises(InputError, match="HDF5 crashes over it"):
            watched.watched(lambda: os.kill(os.getpid(), signal.SIGSEGV))
        with pytest.raises(ValueError, match="odd"):
            watched.watched(partial(odd, ValueError("odd")))
    finally:
        signal.signal(signal.SIGCHLD, before)


def odd(error):
    raise error


class Unpicklable(Exception):
    def __init__(self, one, two):
        super().__init__(f"{one} and {two}")
        self.hook = lambda: None


@pytest.mark.parametrize("error", [Unpicklable("this", "that"), ValueError("this and that" + 5000 * "!")])
def test_an_error_that_cannot_go_through_the_pipe(error):
    with pytest.raises(RuntimeError, match=rf"{type(error).__name__}: this and that"):
        watched.watched(partial(odd, error))


def test_nothing_is_left_of_a_check_that_is_interrupted(monkeypatch):
    children = []

    def interrupted(pid, options):
        monkeypatch.undo()
        children.append(pid)
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "waitpid", interrupted)
    with pytest.raises(KeyboardInterrupt):
        watched.watched(for_ever)
    with pytest.raises(ChildProcessError):
        os.waitpid(children[0], os.WNOHANG)


def test_opening_takes_no_descriptors(equal):
    before = len(os.listdir("/proc/self/fd"))  # noqa: PTH208  # names alone
    for _ in range(3):
        with Volume(equal[0]):
            pass
    assert len(os.listdir("/proc/self/fd")) == before  # noqa: PTH208


def test_a_bad_volume_in_the_way_of_a_scan_is_told(tmp_path, equal):
    from bikestab.scan.run import run_scan

    path = tmp_path / "volume.h5"
    path.write_bytes(equal[0].read_bytes())
    with h5py.File(path, "a") as file:
        del file["V1"]
    config = partial(config_of, SWEEP, tmp_path)
    with pytest.raises(InputError, match=r"volume.h5 exists, and V1 is missing.*\n--force replaces it"):
        run_scan(config())
    assert run_scan(config(), force=True).computed
