"""Proofs in parts: the same by one process or several, stopped and gone on with, or at a limit of work."""

import errno
from contextlib import contextmanager

import numpy as np
import pytest

import bikestab.proving as proving
from bikestab.bicycle import Bicycle
from bikestab.certify.box import box_of
from bikestab.certify.proof import prove
from bikestab.certify.search import UNDECIDED
from bikestab.errors import KEPT, NOT_KEPT, InputError, ScanError, WorkersLost
from bikestab.proving import prove_in_parts

PAPER = Bicycle.preset("dikarev1981")
EDGES = [np.linspace(0, end, number + 1) for end, number in ((0.30, 10), (0.15, 9), (15.0, 13))]


@pytest.fixture(autouse=True)
def small_parts(monkeypatch):
    monkeypatch.setattr(proving, "_SIDE", 5)
    monkeypatch.setattr(proving, "_SIDE_VARIED", 5)


@pytest.fixture
def box():
    return box_of(PAPER, *EDGES, "refined", {})


@contextmanager
def stopped_after(number):
    """Ctrl-C after so many parts."""
    right, parts = proving.decide, iter(range(number))

    def decide(part):
        if next(parts, None) is None:
            raise KeyboardInterrupt
        return right(part)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(proving, "decide", decide)
        yield


@pytest.mark.parametrize("tolerances", [{}, {"m1": (79.0, 81.0), "h1": (0.99, 1.0)}])
def test_parts_are_the_whole(tolerances):
    whole = prove(PAPER, *EDGES, tolerances=tolerances)
    shares = []
    found = prove_in_parts(box_of(PAPER, *EDGES, "refined", tolerances), jobs=1, progress=shares.append)
    np.testing.assert_array_equal(found.cells, whole.cells)
    assert (found.fractions, found.verdict) == (pytest.approx(whole.fractions, abs=1e-12), whole.verdict)
    assert found.decided.halvings[-1] == pytest.approx(whole.decided.halvings[-1])
    if not tolerances:
        assert found.decided.halvings[-1] == pytest.approx(np.mean(found.cells == UNDECIDED))
    assert shares == sorted(shares)
    assert (len(shares), shares[0], shares[-1]) == (13, 0, 1)
    assert not found.decided.stopped


def test_several_processes_say_the_same(box, monkeypatch):
    monkeypatch.setattr(proving, "_ALONE", 0.0)
    one, two = prove_in_parts(box, jobs=1), prove_in_parts(box, jobs=2)
    assert one.certificate("1") == two.certificate("1")


def test_no_process_starts_without_a_part_for_it(box, monkeypatch):
    started = []

    def in_processes(parts, jobs, work):
        started.append((len(parts), jobs))
        for number, part in parts:
            yield number, work(part)

    monkeypatch.setattr(proving, "in_processes", in_processes)
    prove_in_parts(box, jobs=60)
    assert started == []  # it does not take long
    monkeypatch.setattr(proving, "_ALONE", -1.0)
    found = prove_in_parts(box, jobs=60)
    prove_in_parts(box, jobs=5)
    whole = box_of(PAPER, *(edges[:3] for edges in EDGES), "refined", {})
    prove_in_parts(whole, jobs=60)  # one part
    assert started == [(11, 11), (11, 5)]
    assert found.certificate("1") == prove_in_parts(box, jobs=1).certificate("1")
    with pytest.raises(InputError, match="too many for this machine"):
        prove_in_parts(box, jobs=10**4)


@pytest.mark.parametrize(
    ("error", "problem"),
    [
        (WorkersLost("a worker process died"), "a worker process died"),
        (OSError(errno.ENOSPC, "the disk is full"), "FILE: the disk is full"),
    ],
)
@pytest.mark.parametrize(("finished", "words"), [(1, KEPT), (0, NOT_KEPT)])
def test_what_is_kept_is_told(box, tmp_path, monkeypatch, finished, words, error, problem):
    keep = tmp_path / "proof.json.parts"

    def lost(todo, jobs):
        for number, part in todo[:finished]:
            yield number, proving.decide(part)
        raise error

    monkeypatch.setattr(proving, "_finished", lost)
    with pytest.raises(ScanError) as told:
        prove_in_parts(box, keep=keep)
    assert str(told.value) == f"{problem.replace('FILE', str(keep))}\n{words}"
    assert keep.exists() == bool(finished)
    with pytest.raises(type(error)):
        prove_in_parts(box)  # without a file nothing is said of it


def test_what_is_kept_is_told_where_somebody_stops_it(box, tmp_path):
    keep = tmp_path / "proof.json.parts"
    for number, words in ((0, ""), (2, KEPT)):
        with stopped_after(number), pytest.raises(KeyboardInterrupt) as told:
            prove_in_parts(box, jobs=1, keep=keep)
        assert (str(told.value), keep.exists()) == (words, bool(number))


def test_parts_of_another_version_are_dropped(box, tmp_path, monkeypatch):
    keep = tmp_path / "proof.json.parts"
    with stopped_after(3), pytest.raises(KeyboardInterrupt):
        prove_in_parts(box, jobs=1, keep=keep)
    monkeypatch.setattr(proving, "__version__", "0.0.1")
    shares = []
    prove_in_parts(box, jobs=1, keep=keep, progress=shares.append)
    assert shares[0] == 0


def test_a_stopped_proof_goes_on(box, tmp_path):
    keep = tmp_path / "proof.json.parts"
    with stopped_after(4), pytest.raises(KeyboardInterrupt):
        prove_in_parts(box, jobs=1, keep=keep)
    assert keep.is_file()
    shares = []
    found = prove_in_parts(box, jobs=1, keep=keep, progress=shares.append)
    assert shares == pytest.approx([number / 12 for number in range(4, 13)])
    assert not keep.exists()
    assert found.certificate("1") == prove_in_parts(box, jobs=1).certificate("1")


def test_parts_of_another_proof_are_dropped_and_no_other_file(box, tmp_path):
    keep = tmp_path / "proof.json.parts"
    with stopped_after(3), pytest.raises(KeyboardInterrupt):
        prove_in_parts(box, jobs=1, keep=keep)
    for other in (
        box_of(PAPER, *EDGES, "unrefined", {}),
        box_of(PAPER.replaced({"m1": 81.0}), *EDGES, "refined", {}),
        box_of(PAPER, EDGES[0] + 1e-9, *EDGES[1:], "refined", {}),
    ):
        shares = []
        content = keep.read_bytes()
        prove_in_parts(other, jobs=1, keep=keep, progress=shares.append)
        assert shares[0] == 0
        keep.write_bytes(content)
    keep.write_text("a file of somebody's")
    with pytest.raises(InputError, match="is no file of bikestab"):
        prove_in_parts(box, jobs=1, keep=keep)
    assert keep.read_text() == "a file of somebody's"


def test_a_limit_of_work_leaves_cells_undecided(box):
    whole = prove_in_parts(box, jobs=1)
    for most in (1, 40, 400):
        found = prove_in_parts(box, jobs=1, most_blocks=most)
        assert found.decided.stopped
        assert found.record()["stopped"]
        assert np.all((found.cells == whole.cells) | (found.cells == UNDECIDED))
        assert np.any(found.cells != whole.cells)
        assert sum(found.fractions) == pytest.approx(1, abs=1e-12)
    assert not prove_in_parts(box, jobs=1, most_blocks=10**6).decided.stopped


def test_a_scans_proofs_go_on(tmp_path):
    """The volume has them whole or not at all."""
    from bikestab.certified import add_certified
    from bikestab.scan.run import run_scan
    from bikestab.volume import Volume
    from tests.certify.test_certified import CONFIG
    from tests.volumes import config_of

    config = config_of(CONFIG, tmp_path)
    path = run_scan(config).path
    with stopped_after(4), pytest.raises(KeyboardInterrupt):
        add_certified(path, config.machine, config.model, jobs=1)
    shares = []
    add_certified(path, config.machine, config.model, shares.append, jobs=1)
    assert shares[0] > 0
    assert [each.name for each in tmp_path.rglob("*.proofs")] == []
    with Volume(path) as volume:
        axes = [volume.axis(name) for name in ("lam", "sigma", "V")]
        np.testing.assert_array_equal(volume.read("certified"), prove(config.machine, *axes).cells)
