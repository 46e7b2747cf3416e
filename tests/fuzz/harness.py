"""One hostile case: a command in a folder of its own, and whether it ended as every command has to."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

from bikestab_cli.main import main
from bikestab_cli.messages import LONGEST
from bikestab_cli.streams import visible

SECONDS = 10.0  # of processor time
KEPT = "kept.csv"
KEPT_TEXT = "what was there before\n"


class Hang(BaseException):
    """A case took more than ``SECONDS`` of processor time."""


@dataclass(frozen=True)
class Case:
    """A command line, and the files that are there for it."""

    args: tuple[str, ...]
    files: dict[str, bytes] = field(default_factory=dict)


def judged(case: Case) -> tuple[int, str]:
    """The exit code of a case and what it told; AssertionError where it is none of those allowed."""
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        Path(KEPT).write_text(KEPT_TEXT)
        for name, content in case.files.items():
            Path(name).write_bytes(content)
        code, out, err = run(case.args)
        assert code in (0, 1, 2, 3), (code, err)
        assert "a mistake of bikestab itself" not in err, err
        assert "please report" not in err, err
        assert "Traceback" not in out + err, err
        _check_messages(
            code, err, len(case.args) if case.args[:1] == ("check",) else 1
        )  # it tells of each file
        assert Path(KEPT).read_text() == KEPT_TEXT, "a file was lost"
        for name, content in case.files.items():
            assert Path(name).read_bytes() == content, f"{name} was lost"
        left = [path.name for path in Path().rglob("*") if path.name.startswith(".") or ".part" in path.name]
        assert not left, left
    return code, err


def run(args: tuple[str, ...]) -> tuple[int, str, str]:
    """Exit code, stdout and stderr of a command in this process; Hang after ``SECONDS``."""
    out, err = io.StringIO(), io.StringIO()
    before, sys.argv = sys.argv, ["bikestab", *args]
    code = 0
    try:
        with (
            limited(SECONDS),
            contextlib.redirect_stdout(out),
            contextlib.redirect_stderr(err),
            warnings.catch_warnings(action="error"),  # numpy's too
        ):
            main()
    except SystemExit as end:
        code = int(end.code or 0)
    finally:
        sys.argv = before
    return code, out.getvalue(), err.getvalue()


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise Hang where the block takes more processor time."""

    def stop(*_: object) -> None:
        raise Hang(f"more than {seconds:g} s")

    handler = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, handler)


def _check_messages(code: int, err: str, most: int) -> None:
    lines = [line for line in err.splitlines() if not line.startswith(("warning: ", "note: "))]
    assert visible(err) == err, err
    assert all(len(line) <= LONGEST for line in lines), err
    if code >= 2:
        assert lines, "no message"
        assert lines[0].startswith("error: "), err
        begins = [i for i, line in enumerate(lines) if line.startswith("error: ")]
        assert len(begins) <= most, err
        assert all(end - begin <= 3 for begin, end in pairwise([*begins, len(lines)])), err


def told(problem: BaseException, case: Case) -> str:
    """A case that failed, for the one who mends it."""
    files = "".join(f"\n  {name}: {content[:400]!r}" for name, content in case.files.items())
    return f"{type(problem).__name__}: {str(problem)[:400]}\n  args: {case.args!r}{files}"


Judge = Callable[[Case], tuple[int, str]]
assert os.name == "posix", "its clock is one of POSIX"
