"""A scan that was stopped: what is finished is kept, and the end is as if nothing had been."""

import errno
import multiprocessing
import shutil
from importlib import import_module
from pathlib import Path

import pytest

from bikestab.errors import ScanError
from bikestab.scan import writer
from bikestab.scan.plan import Plan
from bikestab.scan.processes import in_turn
from bikestab.scan.run import run_scan
from bikestab.scan.spool import Spool
from bikestab.scan.tile import compute
from tests.scans import config_of, files

pytestmark = pytest.mark.usefixtures("in_an_empty_folder", "small_tiles")

SHAPE = (5, 6, 150)  # five tiles once they are cut
KEPT = ["out/volume.h5.tiles"]
DONE = ["out/volume.h5"]


def config(more="", shape=SHAPE, **options):
    return config_of(shape, more=more, **options)


def whole(more="", shape=SHAPE):
    """The bytes of the volume that an undisturbed scan writes elsewhere, of the same text."""
    path = run_scan(config(more, shape)).path
    data = path.read_bytes()
    shutil.rmtree("out")
    return data


def stop_after(number, error=KeyboardInterrupt):
    """A progress that ends the scan when so many tiles are finished."""
    calls = []

    def progress(done, points):
        calls.append(done)
        if len(calls) > number:
            raise error

    return progress


def interrupted(number, *args, error=KeyboardInterrupt, **options):
    with pytest.raises(error):
        run_scan(config(*args), progress=stop_after(number, error), **options)


# --- stopped between tiles


@pytest.mark.parametrize("number", range(6))
def test_a_stopped_scan_goes_on_and_ends_with_the_same_bytes(number, computed):
    expected = whole()
    assert len(computed) == len(Plan(config())) == 5
    begins = computed.copy()
    computed.clear()
    interrupted(number)
    assert files() == (KEPT if number else [])
    calls = []
    result = run_scan(config(), progress=lambda *call: calls.append(call))
    assert computed == begins  # each once
    assert calls[0] == (len(calls) and 30 * min(150, 32 * number), 4500)
    assert calls[-1] == (4500, 4500)
    assert result.computed
    assert result.path.read_bytes() == expected
    assert files() == DONE


@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError, MemoryError, SystemExit, ScanError])
def test_nothing_is_left_if_no_tile_was_finished(error):
    interrupted(0, error=error)
    assert files() == []
    assert run_scan(config()).computed


@pytest.mark.parametrize(
    "more", ["delta: 2\n", "fields: [violated, conditions]\n", "sweep: {m1: [70, 80]}\n"]
)
@pytest.mark.parametrize("shape", [(70, 130, 3), (5, 6, 70)])
def test_other_scans_stopped_again_and_again(more, shape):
    if "sweep" in more and shape[0] > 64:
        pytest.skip("the others do")
    expected = whole(more, shape)
    for _ in range(len(Plan(config(more, shape)))):
        with pytest.raises(KeyboardInterrupt):
            run_scan(config(more, shape), progress=stop_after(1))
    assert files() == KEPT
    result = run_scan(config(more, shape))
    assert result.path.read_bytes() == expected
    shutil.rmtree("out")
    assert run_scan(config(more, shape)) == result  # the agreement too: it was kept as text


# --- processes


def test_processes_give_the_same_bytes():
    expected = whole()
    assert run_scan(config(), jobs=2).path.read_bytes() == expected
    assert files() == DONE


def test_a_scan_stopped_in_processes_goes_on_in_one():
    """And no process is left over while the exception is looked at."""
    expected = whole()
    before = set(multiprocessing.active_children())
    with pytest.raises(RuntimeError):
        run_scan(config(), jobs=2, progress=stop_after(2, RuntimeError))
    assert set(multiprocessing.active_children()) <= before
    assert files() == KEPT
    assert run_scan(config()).path.read_bytes() == expected


def test_tiles_that_finish_in_another_order(monkeypatch):
    expected = whole()

    def backwards(todo):
        yield from [(number, compute(tile)) for number, tile in todo][::-1]

    monkeypatch.setattr(import_module("bikestab.scan.run"), "in_turn", backwards)
    assert run_scan(config()).path.read_bytes() == expected


def test_short_scans_start_no_processes(monkeypatch):
    monkeypatch.setattr(import_module("bikestab.scan.run"), "in_processes", None)
    monkeypatch.setattr(import_module("bikestab.scan.run"), "cores", lambda: 8)
    assert run_scan(config(), jobs=None).computed


def test_long_ones_use_every_core(monkeypatch):
    asked = []

    def in_processes(todo, jobs):
        asked.append(jobs)
        return in_turn(todo)

    monkeypatch.setattr(import_module("bikestab.scan.run"), "in_processes", in_processes)
    monkeypatch.setattr(import_module("bikestab.scan.run"), "cores", lambda: 3)
    monkeypatch.setattr(Plan, "seconds", lambda _: 100.0)
    interrupted(3, jobs=None)
    assert run_scan(config(), jobs=None).computed
    assert asked == [3, 2]  # of two tiles that are left


# --- stopped while the volume is written


@pytest.mark.parametrize("method", ["create_columns", "write_fields", "write_columns", "finish"])
@pytest.mark.parametrize(
    "error", [KeyboardInterrupt(), OSError(errno.ENOSPC, "No space left on device")], ids=["Ctrl-C", "full"]
)
def test_a_volume_that_was_not_finished_is_written_again(method, error, monkeypatch, computed):
    expected = whole()
    computed.clear()

    def stop(*args):
        raise error

    with monkeypatch.context() as patched:
        patched.setattr(writer.VolumeWriter, method, stop)
        kind, message = (
            (KeyboardInterrupt, None)
            if isinstance(error, KeyboardInterrupt)
            else (
                ScanError,
                "the disk is full\nwhat is finished is kept; the same command goes on from there",
            )
        )
        with pytest.raises(kind, match=message):
            run_scan(config())
    assert files() == KEPT
    assert run_scan(config()).path.read_bytes() == expected
    assert len(computed) == 5
    assert files() == DONE


def test_what_a_killed_run_left_is_no_hindrance():
    expected = whole()
    interrupted(3)
    Path("out/volume.h5.partial").write_bytes(expected[:5000])
    with Path("out/volume.h5.tiles").open("ab") as file:
        file.write(b"half a record")
    assert run_scan(config()).path.read_bytes() == expected
    assert files() == DONE


# --- the disk


@pytest.mark.parametrize("number", [0, 1, 3])
def test_a_full_disk_is_told_with_what_is_kept(number, monkeypatch):
    added = []

    def add(spool, *args):
        if len(added) == number:
            raise OSError(errno.ENOSPC, "No space left on device")
        added.append(args)
        return really_add(spool, *args)

    really_add = Spool.add
    with monkeypatch.context() as patched:
        patched.setattr(Spool, "add", add)
        with pytest.raises(ScanError, match=r"^out/volume\.h5: the disk is full\n") as caught:
            run_scan(config())
    kept = "what is finished is kept; the same command goes on from there"
    assert str(caught.value).endswith(kept if number else "no part of it was finished")
    assert files() == (KEPT if number else [])


@pytest.mark.parametrize("number", [1, 4, 5])
def test_a_removed_output_folder(number):
    """It is noticed with the next tile, or at the latest when the volume is to be written."""
    calls = []

    def remove(done, points):
        calls.append(done)
        if len(calls) == number + 1:
            shutil.rmtree("out")

    with pytest.raises(ScanError) as caught:
        run_scan(config(), progress=remove)
    assert "was removed" in str(caught.value) or "nothing was left behind" in str(caught.value)
    assert len(calls) == number + 1
    assert files() == []
    assert run_scan(config()).computed
