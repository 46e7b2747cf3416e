"""bikestab as a process: pipes, terminals, signals, limits of the system. No traceback ever."""

import os
import pty
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from bikestab import yamltext
from bikestab.config.file import parse_config
from bikestab.scan.run import run_scan

BIKESTAB = shutil.which("bikestab", path=str(Path(sys.executable).parent)) or shutil.which("bikestab")
GRID = """\
bicycle: meijaard2007
grid:
  lam: {{start: 0, stop: 0.5, num: {0}}}
  sigma: {{start: 0, stop: 0.2, num: {0}}}
  V: {{start: 0, stop: 12, num: {1}}}
fields: [stable{2}]
output: out
"""


def grid(columns, speeds, *fields):
    """A config with so many tilts and trails, and speeds."""
    return GRID.format(columns, speeds, "".join(f", {field}" for field in fields))


pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals, terminals and limits of POSIX")


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run(*args, **options):
    return subprocess.run([BIKESTAB, *args], text=True, **{"capture_output": True, **options})


def left_over():
    return [str(path) for path in Path().rglob("*") if path.is_file() and path.suffix != ".yaml"]


def assert_short(stderr):
    """An error in one to three lines."""
    assert stderr.startswith("error: ")
    assert len(stderr.splitlines()) <= 3, stderr[:1000]
    assert "Traceback" not in stderr


# --- exit codes of the installed program


@pytest.mark.parametrize(
    ("args", "code"),
    [
        (["--version"], 0),
        (["vrange", "--bicycle", "meijaard2007"], 0),
        (["check", "fails.yaml"], 1),
        (["vrange", "--lam", "abc"], 2),
        (["scan", "none.yaml"], 2),
    ],
)
def test_exit_codes(args, code):
    Path("fails.yaml").write_text(grid(3, 3) + "expect: [{stable: never}]\n")
    done = run(*args)
    assert done.returncode == code
    assert "Traceback" not in done.stderr
    assert (done.stdout == "") == (code == 2)
    if code == 2:
        assert_short(done.stderr)


def test_an_encoding_without_greek():
    environment = os.environ | {"PYTHONIOENCODING": "ascii", "LC_ALL": "C", "PYTHONUTF8": "0"}
    done = run("vrange", "--bicycle", "meijaard2007", "--lam", "0.1", env=environment)
    assert done.returncode in (0, 2, 3)
    assert "Traceback" not in done.stderr


# --- a reader that has had enough, and one that never was


@pytest.mark.parametrize(
    "args",
    [
        ["schema"],
        ["vrange", "--bicycle", "meijaard2007", "--lam", "0.3:0.4:3000"],
        ["vrange", "--bicycle", "meijaard2007", "--lam", "0.3:0.4:1000", "--json"],
        ["--help"],
    ],
    ids=["schema", "table", "json", "help"],
)
def test_head(args):
    """Like ``bikestab … | head -1``: done, and not a word about it."""
    process = subprocess.Popen([BIKESTAB, *args], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.readline()
    process.stdout.close()
    stderr = process.stderr.read()
    process.stderr.close()
    assert (process.wait(), stderr) == (0, b"")


@pytest.mark.parametrize(
    ("lam", "code", "told"),
    [(0.3, 1, b"1 of 1 expectations failed\n"), (0.1, 0, b"")],
    ids=["fails", "holds"],
)
def test_check_that_nobody_reads(lam, code, told):
    """Like ``bikestab check … | head -0``: the exit code says what was found."""
    Path("a.yaml").write_text(grid(3, 3) + f"expect: [{{lam: {lam}, sigma: 0.08, stable: never}}]\n")
    process = subprocess.Popen([BIKESTAB, "check", "a.yaml"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.close()
    stderr = process.stderr.read()
    process.stderr.close()
    assert (process.wait(), stderr) == (code, told)


@pytest.mark.parametrize("args", [["schema"], ["vrange", "--bicycle", "meijaard2007"]])
def test_stdout_on_a_full_disk(args):
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    with open("/dev/full", "w") as full:  # noqa: PTH123  # a device
        done = run(*args, capture_output=False, stdout=full, stderr=subprocess.PIPE)
    assert done.returncode == 3
    assert_short(done.stderr)


def test_stdout_that_is_closed():
    done = subprocess.run(
        ["sh", "-c", '"$0" vrange --bicycle meijaard2007 >&-', BIKESTAB], capture_output=True, text=True
    )
    assert "Traceback" not in done.stderr
    assert done.returncode in (0, 3)


# --- terminals


def on_a_terminal(*args):
    """Run with stderr on a terminal: exit code, stdout, what the terminal got."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen([BIKESTAB, *args], stdout=subprocess.PIPE, stderr=theirs)
    os.close(theirs)
    seen = b""
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:  # Linux's word for the end
            break
        if not part:
            break
        seen += part
    os.close(ours)
    out = process.stdout.read().decode()
    process.stdout.close()
    return process.wait(), out, seen.decode()


def test_a_terminal_sees_the_progress():
    Path("a.yaml").write_text(grid(230, 100, "growth_rate"))
    code, out, seen = on_a_terminal("scan", "a.yaml", "--jobs", "1")
    assert code == 0
    lines = seen.split("\r")
    assert len(lines) > 3
    for line in lines[1:-1]:
        pattern = r"a\.yaml: \d+ % of 5\.29 M points, [0-9.]+ [kM] points/s, 0:\d\d left\x1b\[K|\x1b\[K"
        assert re.fullmatch(pattern, line)
    assert lines[-1] == "\x1b[K"  # nothing of it stays
    assert out.startswith("a.yaml: out/volume.h5, 1 picture: ")
    assert len(out.splitlines()) == 1


def test_elsewhere_scan_is_quiet():
    Path("a.yaml").write_text(grid(20, 30))
    done = run("scan", "a.yaml")
    assert (done.returncode, done.stderr) == (0, "")
    assert len(done.stdout.splitlines()) == 1


# --- signals


def start_a_long_scan(*args):
    """A running scan of which some tiles are finished; it would take many seconds."""
    Path("a.yaml").write_text(grid(400, 100, "growth_rate", "conditions"))
    process = subprocess.Popen(
        [BIKESTAB, "scan", "a.yaml", *args],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # also where a CI ignores it
    )
    tiles, sizes = Path("out/volume.h5.tiles"), set()
    while len(sizes) < 2:  # at the second the first tile is whole
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.02)
        if tiles.exists() and tiles.stat().st_size > 100_000:
            sizes.add(tiles.stat().st_size)
    return process


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c(jobs):
    process = start_a_long_scan("--jobs", jobs)
    process.send_signal(signal.SIGINT)
    try:
        out, err = process.communicate(timeout=60)
    finally:
        process.kill()
    assert (process.returncode, out) == (130, "")
    kept = "a.yaml: what is finished is kept; the same command goes on from there"
    assert err == f"error: interrupted\n  {kept}\n"
    assert left_over() == ["out/volume.h5.tiles"]


def test_what_kill_leaves_is_no_volume():
    process = start_a_long_scan("--jobs", "1")
    process.kill()
    process.communicate()
    assert left_over() == ["out/volume.h5.tiles"]
    done = run("info", "out")
    assert done.returncode == 2
    assert_short(done.stderr)
    Path("a.yaml").write_text(grid(5, 5))
    done = run("scan", "a.yaml")
    assert_short(done.stderr)
    assert (
        "out/volume.h5.tiles has tiles of another scan that was not finished (another config)" in done.stderr
    )
    assert done.returncode == 2
    assert left_over() == ["out/volume.h5.tiles"]
    assert run("scan", "a.yaml", "--force").returncode == 0
    assert sorted(left_over()) == ["out/region.png", "out/volume.h5"]


# --- a disk that fills up


def limited(size):
    def set_limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return set_limit


@pytest.mark.parametrize("size", [1_000, 100_000, 2_000_000])
def test_a_file_that_cannot_grow(size):
    """A write that fails ends the scan with a message, wherever it happens, and leaves nothing."""
    Path("a.yaml").write_text(grid(50, 80, "conditions"))
    done = run("scan", "a.yaml", preexec_fn=limited(size))
    assert_short(done.stderr)
    assert (done.returncode, done.stdout) == (3, "")
    assert left_over() == []


def test_a_picture_that_cannot_grow():
    run_scan(parse_config(yamltext.parse(grid(5, 5), "a.yaml")))
    done = run("slice", "out", "--lam", "0.2", "-o", "a.png", preexec_fn=limited(5_000))
    assert done.returncode in (2, 3)
    assert_short(done.stderr)
    assert not Path("a.png").exists()
