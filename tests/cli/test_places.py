"""Results for places where none can be: one message with path and advice, and nothing is written."""

import shutil
from pathlib import Path

import pytest

from bikestab.scan.run import run_scan
from tests.scans import files, load

CONFIG = """\
bicycle: meijaard2007
grid: {lam: {values: [0.2, 0.3]}, sigma: {values: [0.07, 0.08]}, V: {values: [1, 5]}}
slices: [{V: 5}]
expect: [{V1: 4.2924}]
"""
COMMANDS = {
    "slice out --V 5 -o": ".png", "export out --intervals": ".csv", "export out --mesh": ".ply",
    "report out -o": ".html", "check a.yaml --junit": ".xml", "convert meijaard2007 -o": ".yaml",
    "eigen --bicycle meijaard2007 --csv": ".csv", "eigen --bicycle meijaard2007 -o": ".png",
    "sensitivity --bicycle meijaard2007 --csv": ".csv",
    "design --bicycle meijaard2007 --lam 0.3 --csv": ".csv",
    "compare meijaard2007 dikarev1981 -o": ".png",
}  # fmt: skip
PLACES = {  # and the exit code, and what is advised
    "none/x{}": (2, "make it: mkdir -p none"),
    "file/x{}": (2, "file is a file or in one, and no folder"),
    "folder{}": (2, "name a file in it, as folder"),
    "/proc/x{}": (2, "nothing can be made there: choose another place"),
}  # fmt: skip


@pytest.fixture(scope="module")
def volume(tmp_path_factory):
    folder = tmp_path_factory.mktemp("out")
    run_scan(load(f"{CONFIG}output: {folder}\n"))
    return folder


@pytest.fixture(autouse=True)
def there(bikestab, volume):
    Path("a.yaml").write_text(CONFIG, "utf-8")
    Path("file").write_text("mine", "utf-8")
    for ending in {"", *COMMANDS.values()}:
        Path(f"folder{ending}").mkdir()
    shutil.copytree(volume, "out")
    return files()


@pytest.mark.parametrize("command", COMMANDS)
def test_a_file(bikestab, there, command):
    for form, (wanted, advice) in PLACES.items():
        place = form.format(COMMANDS[command])
        code, out, err = bikestab(*command.split(), place)
        assert code == wanted, place
        assert not out or command.startswith("design")  # which has printed its table by then
        first, second = err.splitlines()[-2:]
        assert first.startswith(f"error: {place}: cannot be written (")
        assert advice in second
    assert files() == there
    assert Path("file").read_text("utf-8") == "mine"


@pytest.mark.parametrize(
    ("output", "advice"),
    [
        ("file", "it is a file, and no folder"),
        ("file/x", "choose another folder"),
        ("/proc/x", "choose another folder"),
        ("/dev/full", "it is a file, and no folder"),
    ],
)
def test_a_scans_folder(bikestab, there, output, advice):
    code, out, err = bikestab("scan", "a.yaml", "--set", f"output={output}")
    assert (code, out) == (2, "")
    first, second = err.splitlines()
    assert first.startswith(f"error: a.yaml: output: {output} cannot be made (")
    assert advice in second
    assert files() == there


@pytest.mark.parametrize("command", ["check a.yaml --junit", "init"])
def test_a_device_that_is_full(bikestab, there, command):
    code, out, err = bikestab(*command.split(), "/dev/full")
    assert (code, out) == (3, "")
    assert err == "error: /dev/full: the disk is full\n  make room there, and give the same command again\n"
    assert files() == there


def test_a_picture_without_ending_beside_what_is_there(bikestab, there):
    for place in ("folder", "file", "/dev/full"):
        code, out, err = bikestab("slice", "out", "--V", "5", "-o", place)
        assert (code, out) == (2, "")
        assert err.startswith(f"error: {place}: has no ending of a picture\n  allowed: .png")
    assert files() == there
    assert not Path("/dev/full.png").exists()
