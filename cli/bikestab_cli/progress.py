"""How far a long command is: one line on a terminal, now and then a line in a log."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import click

TERMINAL, LOG = 0.1, 30.0  # s between two reports


@contextmanager
def progress(name: str, quiet: bool) -> Iterator[Callable[[int, int], None]]:
    """A function that takes the points done so far and all, and tells of them on stderr."""
    terminal = sys.stderr.isatty()
    begin = last = time.monotonic()
    first = -1

    def show(done: int, points: int) -> None:
        nonlocal begin, last, first
        now = time.monotonic()
        if first < 0:
            begin, first = now, done
            if done and not quiet:
                click.echo(f"{name}: going on at {_percent(done, points)}", err=True)
        if not quiet and now - last >= (TERMINAL if terminal else LOG):
            last = now
            line = f"{name}: {_percent(done, points)} of {_short(points)} points"
            if done > first:
                rate = (done - first) / (now - begin)
                line += f", {_short(rate)} points/s, {_time((points - done) / rate)} left"
            click.echo(f"\r{line}\x1b[K" if terminal else line, nl=not terminal, err=True)

    try:
        yield show
    finally:
        if terminal and not quiet and last > begin:
            click.echo("\r\x1b[K", nl=False, err=True)


def _percent(done: int, points: int) -> str:
    return f"{100 * done // points} %"


def _short(number: float) -> str:
    for unit, size in (("G", 1e9), ("M", 1e6), ("k", 1e3)):
        if number >= size:
            return f"{number / size:.3g} {unit}"
    return f"{number:.0f}"


def _time(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
