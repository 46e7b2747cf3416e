"""Scans on a Dask cluster of real processes, one of them killed on the way."""

import socket
import subprocess
import sys
import threading
import time
from contextlib import suppress
from importlib import import_module
from pathlib import Path

import pytest

from bikestab.errors import InputError, ScanError
from bikestab.scan import cluster
from bikestab.scan.run import run_scan
from tests.scans import config_of, files

distributed = pytest.importorskip("distributed")
psutil = pytest.importorskip("psutil")

pytestmark = [
    pytest.mark.usefixtures("in_an_empty_folder", "small_tiles"),
    pytest.mark.filterwarnings("default"),  # Dask's own sockets and loops
]

SHAPE = (64, 128, 320)  # ten tiles


def config(more="fields: [growth_rate]\n"):
    return config_of(SHAPE, more=more)


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(tmp_path_factory.mktemp("here"))
        patched.setattr(import_module("bikestab.scan.plan"), "_TILE_BYTES", 1)
        return run_scan(config()).path.read_bytes()


def workers():
    """The worker processes of clusters that this process has."""
    found = psutil.Process().children(recursive=True)
    return [child for child in found if "spawn_main" in " ".join(child.cmdline())]


def test_a_cluster_of_this_machine(expected):
    assert run_scan(config(), scheduler="local:2").path.read_bytes() == expected
    assert files() == ["out/volume.h5"]
    assert workers() == []


def test_a_worker_that_is_killed_is_no_loss(expected):
    killed = []

    def progress(done, points):
        if done and not killed:
            victim = workers()[0]
            victim.kill()
            killed.append(victim.pid)

    result = run_scan(config(), scheduler="local:2", progress=progress)
    assert len(killed) == 1
    assert result.path.read_bytes() == expected


def test_a_running_scheduler(expected):
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0", silence_logs="CRITICAL"
    ) as running:
        path = run_scan(config(), scheduler=running.scheduler_address).path
    assert path.read_bytes() == expected


def test_a_cluster_that_goes_away_keeps_what_is_finished(expected, monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)
    running = distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0", silence_logs="CRITICAL"
    )

    def progress(done, points):
        if done:
            running.scale(0)

    with running, pytest.raises(ScanError, match=r"(?s)the cluster .*the same command goes on from there"):
        run_scan(config(), scheduler=running.scheduler_address, progress=progress)
    assert files() == ["out/volume.h5.tiles"]
    assert run_scan(config()).path.read_bytes() == expected


def test_a_cluster_without_workers(monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address="127.0.0.1:0") as running,
        pytest.raises(ScanError, match="has had no worker for 1 s\nno part of it was finished"),
    ):
        run_scan(config(), scheduler=running.scheduler_address)
    assert files() == []


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("local:x", "'local:x' is no number of processes"),
        ("local:0", "'local:0' is no number of processes"),
        ("tcp://127.0.0.1:1", "no Dask scheduler answers at 'tcp://127.0.0.1:1'"),
        ("somewhere", "no Dask scheduler answers at 'somewhere'"),
    ],
)
def test_nobody_there(address, message, monkeypatch):
    monkeypatch.setattr(cluster, "ANSWER", 0.5)
    begin = time.monotonic()
    with pytest.raises(InputError, match=message) as caught:
        run_scan(config(), scheduler=address)
    assert "for example --scheduler " in str(caught.value)
    assert time.monotonic() - begin < 20
    assert files() == []


@pytest.mark.parametrize("says", [b"", b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n"])
def test_who_is_there_is_no_scheduler(says, monkeypatch):
    monkeypatch.setattr(cluster, "ANSWER", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as server:
        guests = []

        def serve():
            with suppress(OSError):  # the server is closed
                while True:
                    guests.append(server.accept()[0])
                    guests[-1].sendall(says)

        threading.Thread(target=serve, daemon=True).start()
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        begin = time.monotonic()
        with pytest.raises(ScanError) as caught:
            run_scan(config(), scheduler=address)
        assert time.monotonic() - begin < 5
        assert str(caught.value).startswith(f"no Dask scheduler answers at '{address}': who is there said")
        assert "\n" not in str(caught.value)
        for guest in guests:
            guest.close()
    assert files() == []


def test_other_versions_of_a_cluster_are_one_line(monkeypatch):
    here = distributed.client.version_module.get_versions()
    here["packages"]["msgpack"] = "0.0.1"
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0", silence_logs="CRITICAL"
    ) as running:
        monkeypatch.setattr(distributed.client.version_module, "get_versions", lambda: here)
        with pytest.warns(UserWarning, match="other versions") as caught:
            run_scan(config(), scheduler=running.scheduler_address)
    texts = [str(warning.message) for warning in caught if "version" in str(warning.message).lower()]
    assert texts == ["the cluster has other versions of msgpack than this machine"]


def test_another_version_is_refused(monkeypatch):
    """Its results might be other bytes. The workers are processes: they have the true versions."""
    monkeypatch.setattr(cluster, "__version__", "0.0.0")
    with pytest.raises(ScanError, match=r"a worker of the cluster has bikestab .*, and 0.0.0 is here"):
        run_scan(config(), scheduler="local:1")


SCRIPT = """
from bikestab.scan import plan
from bikestab.config.file import load_config
from bikestab.scan.run import run_scan
import psutil

plan._TILE_BYTES = 1
print("once", flush=True)
killed = []

def progress(done, points):
    if done and not killed:
        found = psutil.Process().children(recursive=True)
        killed.append([child for child in found if "spawn_main" in " ".join(child.cmdline())][0].kill())

run_scan(load_config("a.yaml"), scheduler="local:2", progress=progress)
"""


def test_a_script_without_a_guard_is_not_run_again():
    """Neither by the workers nor by one that takes a lost one's place."""
    Path("a.yaml").write_text(config().text)
    Path("script.py").write_text(SCRIPT)
    done = subprocess.run([sys.executable, "script.py"], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "once\n", "")
    assert files() == ["a.yaml", "out/volume.h5", "script.py"]
