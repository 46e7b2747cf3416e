"""Output options write into pipes and devices, follow links, and refuse folders."""

import csv
import io
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

BIKESTAB = shutil.which("bikestab", path=str(Path(sys.executable).parent)) or shutil.which("bikestab")
EIGEN = ("eigen", "--bicycle", "meijaard2007", "--V", "0:10:3")
OPTIONS = {
    "eigen --csv": (*EIGEN, "--csv"),
    "eigen -o": (*EIGEN, "-o"),
    "bicycles -o": ("bicycles", "meijaard2007", "-o"),
    "init": ("init", "--force"),
}


def shell(command, **options):
    return subprocess.run(
        ["bash", "-c", command, BIKESTAB], capture_output=True, text=True, timeout=60, **options
    )


def rows(text):
    table = list(csv.reader(io.StringIO(text)))
    assert table[0] == ["V", "branch", "name", "re", "im"]
    assert {len(row) for row in table} == {5}
    return len(table) - 1


@pytest.mark.parametrize(
    "command",
    [
        '"$0" {} --csv /dev/stdout',
        '"$0" {} --csv /dev/stdout | cat',
        '"$0" {} --csv >(cat) 2>&1 >/dev/null | cat',
    ],
    ids=["stdout", "pipe", "process substitution"],
)
def test_a_table_to_another_program(command):
    done = shell(command.format(" ".join(EIGEN)))
    assert done.returncode == 0
    assert "Traceback" not in done.stderr
    assert rows(done.stdout) == 12
    assert done.stderr in ("", "/dev/stdout\n")


def test_stdout_that_is_a_file_keeps_what_it_had(tmp_path):
    log = tmp_path / "log"
    log.write_text("before\n")
    done = shell(f'"$0" {" ".join(EIGEN)} --csv /dev/stdout >> {log}')
    assert (done.returncode, done.stderr) == (0, "/dev/stdout\n")
    first, rest = log.read_text().split("\n", 1)
    assert (first, rows(rest)) == ("before", 12)


@pytest.mark.parametrize("option", OPTIONS)
@pytest.mark.parametrize("kind", ["link", "folder", "loop", "long", "device"])
def test_what_is_there_stays(bikestab, tmp_path, option, kind):
    ending = ".png" if option.endswith("-o") else ".csv"
    path = tmp_path / ("a" * 300 if kind == "long" else f"there{ending}")
    target = tmp_path / f"target{ending}"
    if kind == "link":
        target.write_text("old")
    elif kind == "device":
        target = Path("/dev/null")
    elif kind == "loop":
        target = path
    if kind == "folder":
        path.mkdir()
    elif kind != "long":
        path.symlink_to(target)
    code, out, err = bikestab(*OPTIONS[option], path.with_suffix(ending) if kind == "long" else path)
    if kind in ("link", "device"):
        assert (code, err) == (0, "")
        assert out.startswith(str(path))
        assert path.is_symlink()
        assert path.is_char_device() if kind == "device" else target.stat().st_size > 3
    else:
        assert (code, out) == (2, "")
        assert err.startswith(f"error: {str(path)[:60]}")
        assert ": cannot be written (" in err
    assert len(list(tmp_path.iterdir())) == {"link": 2, "long": 0}.get(kind, 1)


def test_a_reader_that_has_had_enough():
    done = shell(f'"$0" {" ".join(EIGEN)} --csv /dev/stdout | head -1')
    assert (done.stdout, "Traceback" in done.stderr) == ("V,branch,name,re,im\n", False)


def test_a_volume_behind_a_link(bikestab, tmp_path):
    config = "bicycle: meijaard2007\ngrid:\n" + "".join(
        f"  {name}: {{start: 0, stop: {stop}, num: 3}}\n"
        for name, stop in (("lam", 0.3), ("sigma", 0.1), ("V", 9))
    )
    for title in ("one", "two"):  # computed, then given another title
        Path("a.yaml").write_text(config + f"title: {title}\noutput: out\n")
        if title == "one":
            Path("out").mkdir()
            Path("disk").mkdir()
            Path("out/volume.h5").symlink_to(tmp_path / "disk/big.h5")
        code, _, err = bikestab("scan", "a.yaml")
        assert (code, err) == (0, "")
        assert Path("out/volume.h5").is_symlink()
        assert [path.name for path in Path("disk").iterdir()] == ["big.h5"]
        assert f"{title}\n" in bikestab("info", "out")[1]


def _mine(name):
    from bikestab.presets import preset_text

    Path(name).write_text(preset_text("meijaard2007"), "utf-8")


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (("eigen", "--bicycle", "mine.yaml", "--csv", "mine.yaml"), "is read by this command"),
        (("eigen", "--bicycle", "mine.yaml", "--csv", "link.yaml"), "is read by this command"),
        (("eigen", "--csv", "mine.yaml"), "is a bicycle's file"),
        (("certify", "a.yaml", "-o", "./a.yaml"), "is read by this command"),
        (("check", "a.yaml", "--junit", "a.yaml"), "is read by this command"),
        (("check", "--junit", "a.yaml", "b.yaml"), "is a scan's config"),
        (("check", "b.yaml", "--junit", "other.yaml"), "is YAML"),
        (("report", "out", "-o", "out/volume.h5"), "is read by this command"),
        (("report", "out", "-o", "copy.page"), "is a volume"),
    ],
)
def test_nothing_that_is_read_is_replaced(bikestab, args, words):
    _mine("mine.yaml")
    Path("link.yaml").symlink_to("mine.yaml")
    for name in ("a.yaml", "b.yaml"):
        Path(name).write_text("bicycle: mine.yaml\nexpect: [{V1: 4.29, within: 1%}]\n", "utf-8")
    Path("other.yaml").write_text("something: else\n", "utf-8")
    Path("out").mkdir()
    for name in ("out/volume.h5", "copy.page"):
        Path(name).write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(64))
    before = {path: path.read_bytes() for path in Path().rglob("*.*") if path.is_file()}
    code, out, err = bikestab(*args)
    assert (code, out) == (2, "")
    assert words in err
    assert {path: path.read_bytes() for path in Path().rglob("*.*") if path.is_file()} == before


def test_an_output_is_replaced_by_the_next(bikestab):
    Path("a.yaml").write_text("bicycle: meijaard2007\nexpect: [{V1: 4.29, within: 1%}]\n", "utf-8")
    for _ in range(2):
        assert bikestab("check", "a.yaml", "--junit", "results.yaml")[0] == 0
        assert bikestab("eigen", "--bicycle", "meijaard2007", "--csv", "a.csv")[0] == 0


@pytest.mark.parametrize(
    "args",
    [
        ("vrange",), ("eigen",), ("bicycles", "sharp1971"), ("design",), ("design", "--free", "lam=0.1:0.2"),
        ("sensitivity",), ("compare", "sharp1971", "meijaard2007"), ("vrange", "--over", "delta=0:1:2"),
    ],
)  # fmt: skip
def test_every_command_takes_the_same_formats(bikestab, args):
    code, out, err = bikestab(*args, "-o", "x.gif")
    assert (code, out) == (2, "")
    assert "'x.gif' has no ending .png, .pdf or .svg" in err
    assert not Path("x.gif").exists()
