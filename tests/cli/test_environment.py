"""Terminals, encodings, limits and settings of all kinds: a result or one message, never a traceback."""

import json
import os
import resource
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import pytest
from bikestab_cli.main import LEAST_MEMORY
from bikestab_cli.messages import LONGEST, cut
from bikestab_cli.streams import Messages, Visible, visible

CONFIGS = Path(__file__).parents[2] / "configs"
BIKESTAB = shutil.which("bikestab", path=str(Path(sys.executable).parent)) or shutil.which("bikestab")
OWN = ("vrange", "--bicycle", "meijaard2007")
PICTURE = ("bicycles", "meijaard2007", "-o", "a.png")

pytestmark = pytest.mark.skipif(os.name != "posix", reason="limits and descriptors of POSIX")


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run(*args, extra=None, **options):
    environment = {**os.environ, **(extra or {})}
    return subprocess.run([BIKESTAB, *args], capture_output=True, env=environment, timeout=60, **options)


def assert_one_message(done, code):
    text = done.stderr.decode("utf-8", "replace")
    assert done.returncode == code, text
    assert text.startswith("error: ")
    assert len(text.splitlines()) <= 3
    assert max(map(len, text.splitlines())) <= LONGEST
    assert "Traceback" not in text


# --- terminals


@pytest.mark.parametrize("encoding", ["latin-1", "ascii", "cp437", "utf-8"])
def test_encodings(encoding):
    for args in (("vrange", "--help"), ("bicycles",), ("vrange", "--lam", "0.1", "--sigma", "0.08")):
        done = run(*args, extra={"PYTHONIOENCODING": encoding})
        assert done.returncode == 0
        out, err = (text.decode(encoding) for text in (done.stdout, done.stderr))
        assert "Traceback" not in err
        if args[-1] == "--help":
            words = {"utf-8": "−0.2 ≤ λ ≤ 0.6", "cp437": "-0.2 ≤ lam ≤ 0.6"}
            assert words.get(encoding, "-0.2 <= lam <= 0.6") in " ".join(out.split())
    done = run("bicycles", "--json", extra={"PYTHONIOENCODING": encoding})
    assert json.loads(done.stdout.decode(encoding)) == json.loads(run("bicycles", "--json").stdout)


def test_letters_that_an_encoding_lacks(tmp_path):
    with (tmp_path / "a").open("w", encoding="ascii") as file:
        stream = Visible(file)
        assert stream.encoding == "utf-8"
        stream.write("λ ≤ 2°, é 日 \U0001f6b2")
    assert (tmp_path / "a").read_text() == "lam <= 2 deg, \\xe9 \\u65e5 \\U0001f6b2"


def test_control_characters_are_seen():
    assert visible("a\x1b[2J\a\x7f\x9b1m\u202eb\udc80\r\n\tc\rd") == (
        "a\\u001b[2J\\u0007\\u007f\\u009b1m\\u202eb\\udc80\r\n\tc\\u000dd"
    )
    assert visible("λ = 18° …\n") == "λ = 18° …\n"


def test_long_lines_lose_their_middle(tmp_path):
    assert cut("a" * LONGEST) == "a" * LONGEST
    line = cut("begin" + "a" * 10_000 + "end")
    assert len(line) <= LONGEST
    assert (line[:5], line[-3:], "..." in line) == ("begin", "end", True)
    with (tmp_path / "a").open("w") as file:
        Messages(file).write("b" * 1000 + "\nshort\n")
    assert [len(line) for line in (tmp_path / "a").read_text().splitlines()] == [LONGEST - 1, 5]


@pytest.mark.parametrize(
    "text",
    [
        'name: "\\e[2Jbad"\n', '"\\e]0;title\\a": 1\n', "m1: '" + "9" * 100_000 + "'\n", "? [1]\n: 2\n",
        'source: "' + "long " * 10_000 + '"\nm1: 1e999\n', "'" + "k" * 10_000 + "': 1\n",
    ],
)  # fmt: skip
def test_what_files_hold_does_not_reach_the_terminal_raw(bikestab, text):
    Path("a.yaml").write_text(text)
    for args in (("vrange", "--bicycle", "a.yaml"), ("scan", "a.yaml"), ("check", "a.yaml")):
        code, out, err = bikestab(*args)
        assert (code, out) == (2, "")
        assert len(err.splitlines()) <= 3
        assert max(map(len, err.splitlines())) <= LONGEST
        assert not {"\x1b", "\a"} & set(err)


def test_names_and_titles_that_are_shown():
    text = run("bicycles", "meijaard2007").stdout.decode()
    Path("a.yaml").write_text(text.replace("name: meijaard2007", 'name: "a\\e]0;b\\a\\u202e"'))
    done = run("vrange", "--bicycle", "a.yaml")
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.startswith(rb"a\u001b]0;b\u0007\u202e, refined model")


@pytest.mark.parametrize(
    "args", [("vrange", "--lam", "x" * 100_000), ("x" * 10_000,), ("scan", "a\n" * 1000)]
)
def test_long_arguments(args):
    assert_one_message(run(*args), 2)


# --- descriptors


def shell(command):
    return subprocess.run(["bash", "-c", command, BIKESTAB], capture_output=True, timeout=60)


@pytest.mark.parametrize("where", ["2>&-", "2>/dev/full", "2>&- <&-"])
def test_results_come_where_nobody_hears_the_warnings(where):
    if "full" in where and not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    done = shell(f'"$0" vrange --lam 0.2 --sigma 0.08 {where}')
    assert done.returncode == 0
    assert b"4.0556194421" in done.stdout


def test_a_stdout_that_takes_nothing():
    assert_one_message(shell('"$0" vrange --bicycle meijaard2007 >&-'), 3)


def test_no_file_becomes_stderr():
    """Where 2 is free, the first file that is opened gets it, and then what is told."""
    done = shell('"$0" eigen --lam 0.2 --sigma 0.08 --csv a.csv 2>&- >&-; cat a.csv')
    assert done.stdout.startswith(b"V,branch,name,re,im\n")
    assert b"warning" not in done.stdout


def test_warnings_of_packages_are_not_told(bikestab, monkeypatch):
    def told(*_):
        warnings.warn("of numpy", RuntimeWarning, stacklevel=1)
        return "a table"

    monkeypatch.setattr("bikestab_cli.vrange.told_one", told)
    with warnings.catch_warnings(record=True) as caught:
        warnings.resetwarnings()  # as outside of tests
        assert bikestab("vrange", "--bicycle", "meijaard2007") == (0, "a table\n", "")
    assert not caught


# --- limits


@pytest.mark.parametrize("size", [100 << 20, LEAST_MEMORY - 1])
def test_little_memory(size):
    done = run(*OWN, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size)))
    assert_one_message(done, 3)
    assert b"not enough memory: needs 512 MB of address space" in done.stderr


def test_memory_that_is_enough():
    size = LEAST_MEMORY
    done = run(*PICTURE, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size)))
    assert (done.returncode, done.stdout) == (0, b"a.png\n")


def test_a_file_that_may_not_grow():
    Path("a.png").write_bytes(b"old")
    done = run(*PICTURE, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000)))
    assert_one_message(done, 3)
    assert Path("a.png").read_bytes() == b"old"


def test_a_folder_that_was_removed(tmp_path):
    gone = tmp_path / "gone"
    gone.mkdir()
    os.chdir(gone)
    gone.rmdir()
    done = run("eigen", "--bicycle", "meijaard2007", "--csv", "a.csv")
    assert_one_message(done, 3)
    assert b"the current folder was removed" in done.stderr


@pytest.mark.parametrize(
    "args",
    [
        ("vrange", "--bicycle", "{}"), ("scan", "{}"), ("check", "{}"), ("info", "{}"), ("init", "{}"),
        ("slice", "{}", "--lam", "0.2"), ("eigen", "--csv", "{}"), ("export", "{}", "--mesh", "a.ply"),
        ("reproduce", "--quick", "-o", "{}/out"), ("certify", "--verify", "{}"), ("convert", "{}"),
        ("convert", "meijaard2007", "--rider", "{}"), ("convert", "meijaard2007", "-o", "{}.json"),
        ("bicycles", "meijaard2007", "-o", "{}.png"), ("sensitivity", "--bicycle", "{}"),
        ("scan", str(CONFIGS / "meijaard2007.yaml"), "--set", "output={}"),
        ("init", "a.yaml", "--bicycle", "{}"), ("check", "{}", "--junit", "{}"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("kind", ["loop", "long", "below a file"])
def test_names_that_lead_nowhere(bikestab, args, kind):
    name = {"loop": "./loop", "long": "./" + "n" * 300, "below a file": "file/a"}[kind]
    for ending in ("", ".json", ".png"):
        Path(f"loop{ending}").symlink_to(f"loop{ending}")
    Path("file").touch()
    code, out, err = bikestab(*(arg.format(name) for arg in args))
    assert (code, out) == (2, "")
    assert err.startswith("error: ")
    assert name[2:22] in err
    assert len(err.splitlines()) <= 3
    assert max(map(len, err.splitlines())) <= LONGEST
