"""Real processes that are killed at random moments, and a real disk that is full."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import pytest

from bikestab.config.file import load_config
from bikestab.errors import KEPT
from bikestab.scan import plan
from bikestab.scan.plan import Plan
from bikestab.scan.run import run_scan

pytestmark = [
    pytest.mark.usefixtures("in_an_empty_folder"),
    pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="nothing can be killed here"),
]

KILLS = 50
TILE_BYTES = 1 << 20
CONFIG = """\
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 128}
  sigma: {start: 0, stop: 0.15, num: 128}
  V: {start: 0, stop: 15, num: 400}
fields: [violated, growth_rate]
output: out
"""
RUN = f"""
import sys
from pathlib import Path
from bikestab.scan import plan
from bikestab.config.file import load_config
from bikestab.errors import ScanError
from bikestab.scan.run import run_scan

plan._TILE_BYTES = {TILE_BYTES}

def progress(done, points):
    print(done, flush=True)
    if done and len(sys.argv) > 3:
        Path("disk/ballast").write_bytes(bytes(int(sys.argv[3])))

try:
    run_scan(load_config("a.yaml", ["output=" + sys.argv[1]]), jobs=int(sys.argv[2]), progress=progress)
except ScanError as error:
    sys.exit(str(error))
"""


def start(output="out", jobs=1, *args):
    return subprocess.Popen(
        [sys.executable, "-c", RUN, output, str(jobs), *map(str, args)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


@pytest.fixture
def expected(monkeypatch):
    """The volume of a scan that nobody disturbs."""
    monkeypatch.setattr(plan, "_TILE_BYTES", TILE_BYTES)
    Path("a.yaml").write_text(CONFIG)
    config = load_config("a.yaml", ["output=out"])
    assert len(Plan(config)) == 26
    path = run_scan(config).path
    data = path.read_bytes()
    shutil.rmtree(path.parent)
    return data


def living():
    """The processes whose current folder is this one, but for the test's own."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if folder.joinpath("cwd").readlink() == Path.cwd() and int(folder.name) != os.getpid():
                found.append(folder.name)
        except OSError:
            continue
    return found


def assert_sound(expected):
    """There is no volume, or the whole one."""
    volume = Path("out/volume.h5")
    if volume.exists():
        with h5py.File(volume) as file:
            assert file.attrs["complete"] == 1
        assert volume.read_bytes() == expected
    return volume.exists()


def test_kills_at_random_moments_lose_nothing_and_leave_nobody(expected):
    seed = random.randrange(10**6)
    sys.stdout.write(f"seed {seed}\n")  # pytest shows it if the test fails
    rng = random.Random(seed)
    kills = finished = resumed = 0
    before, patience = 0, 0.6
    while kills < KILLS or not finished:
        process = start("out", rng.choice([1, 2]))
        begun = int(process.stdout.readline() or 0)  # nothing if the one before had just written the volume
        resumed += begun > 0
        patience = (
            1.3 * patience if begun == before else 0.6
        )  # where a tile takes longer than that on a busy machine
        before = begun
        try:
            process.wait(rng.uniform(0, patience))
        except subprocess.TimeoutExpired:
            process.kill()
            kills += 1
        process.communicate()  # its workers have its pipes: this waits for their end
        if process.returncode == 0:
            assert assert_sound(expected)
            assert [path.name for path in Path("out").iterdir()] == ["volume.h5"]
            shutil.rmtree("out")
            finished += 1
        else:
            assert process.returncode == -signal.SIGKILL
            assert_sound(expected)
    assert resumed > 5
    end = time.monotonic() + 10
    while living():
        assert time.monotonic() < end, f"still there: {living()}"
        time.sleep(0.05)


# --- a disk that is full


@pytest.fixture
def disk():
    """A file system of its own in the folder 'disk', and a function that sets its size in bytes."""
    folder = Path("disk").absolute()
    folder.mkdir()

    def mount(*options):
        command = ["mount", "-t", "tmpfs", "-o", ",".join(options), "tmpfs", str(folder)]
        return subprocess.run(command, capture_output=True).returncode

    if not shutil.which("mount") or mount("size=1m"):
        pytest.skip("needs the right to mount a file system")
    try:
        yield lambda size: mount("remount", f"size={size}")
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


@pytest.mark.parametrize("phase", ["computing", "writing the volume"])
def test_a_full_disk_keeps_what_is_finished(disk, expected, phase):
    size = len(expected)  # the tiles are about as large
    disk(4 * size if phase == "computing" else int(1.6 * size))
    ballast = [int(3.5 * size)] if phase == "computing" else []
    process = start("disk/out", 1, *ballast)
    out, err = process.communicate()
    assert err == f"disk/out/volume.h5: the disk is full\n{KEPT}\n"
    assert process.returncode == 1
    assert [path.name for path in Path("disk/out").iterdir()] == ["volume.h5.tiles"]
    computed = int(out.split()[-1])
    assert (computed < 128 * 128 * 400) == (phase == "computing")
    Path("disk/ballast").unlink(missing_ok=True)
    disk(4 * size)
    process = start("disk/out")
    out, err = process.communicate()
    assert (process.returncode, err) == (0, "")
    assert int(out.split()[0]) == computed  # it goes on from there
    shutil.move("disk/out/volume.h5", "full.h5")
    done = start("disk/out")
    done.communicate()
    assert Path("full.h5").read_bytes() == Path("disk/out/volume.h5").read_bytes()
