"""How far a long command is: one line on a terminal, now and then a line in a log."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from bikestab_cli.streams import visible

TERMINAL, LOG = 0.1, 30.0  # s between two reports


@contextmanager
def progress(
    name: str, quiet: bool, what: str = "points", at_once: bool = False
) -> Iterator[Callable[[int, int], None]]:
    """A function that takes the points done so far and all, and tells of them on stderr.

    On a terminal ``at_once`` shows the first report, which is else that of a command that may be done soon.
    """
    name = visible(name)
    terminal = sys.stderr is not None and sys.stderr.isatty()
    begin = last = time.monotonic()
    first, shown = -1, False

    def show(done: int, points: int) -> None:
        nonlocal begin, last, first, shown
        now = time.monotonic()
        if first < 0:
            begin = last = now
            first = done
            if done and not quiet:
                _tell(f"{name}: going on at {_percent(done, points)}\n")
        begun = at_once and terminal and not shown
        if quiet or (now - last < (TERMINAL if terminal else LOG) and not begun):
            return
        last, shown = now, True
        line = f"{name}: {_percent(done, points)} of {_short(points)} {what}"
        if done > first:
            rate = (done - first) / (now - begin)
            line += f", {_short(rate)} {what}/s, {_time((points - done) / rate)} left"
        # a line that is wrapped would not be written over
        _tell(f"\r{line[: _width() - 1]}\x1b[K" if terminal else f"{line}\n")

    try:
        yield show
    finally:
        if terminal and shown:
            _tell("\r\x1b[K")


def _tell(text: str) -> None:
    if sys.stderr is None:
        return
    with suppress(OSError):  # nobody may be listening any more, which is no reason to stop
        getattr(sys.stderr, "as_it_is", sys.stderr.write)(text)
        sys.stderr.flush()


def _width() -> int:
    try:
        return os.get_terminal_size(sys.stderr.fileno()).columns or 80
    except OSError:
        return 80


def _percent(done: int, points: int) -> str:
    return f"{100 * done // points} %"


def _short(number: float) -> str:
    for unit, size in (("G", 1e9), ("M", 1e6), ("k", 1e3)):
        if number >= size:
            return f"{number / size:.3g} {unit}"
    return f"{number:.0f}" if number >= 10 else f"{number:.2g}"


def _time(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
