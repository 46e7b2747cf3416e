"""What is told of the progress, by a clock that the test turns."""

import io
import sys
from contextlib import suppress

import pytest
from bikestab_cli import progress as module
from bikestab_cli.progress import progress


class Terminal(io.StringIO):
    """A stderr that is, or is not, a terminal."""

    def __init__(self, terminal):
        super().__init__()
        self.isatty = lambda: terminal


@pytest.fixture
def told(monkeypatch):
    """Report at times [s] so many points of 10 000, and give what was told."""

    def run(*reports, terminal=False, quiet=False, points=10_000, **more):
        err, now = Terminal(terminal), [100.0]
        monkeypatch.setattr(sys, "stderr", err)
        monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
        with progress("a.yaml", quiet, **more) as show:
            for time, done in reports:
                now[0] = 100.0 + time
                show(done, points)
        return err.getvalue()

    return run


def test_a_log_gets_a_line_every_half_minute(told):
    text = told((0, 0), (10, 100), (29.9, 290), (30, 300), (31, 310), (59, 590), (61, 610), (1000, 10_000))
    assert text.splitlines() == [
        "a.yaml: 3 % of 10 k points, 10 points/s, 16:10 left",
        "a.yaml: 6 % of 10 k points, 10 points/s, 15:39 left",
        "a.yaml: 100 % of 10 k points, 10 points/s, 0:00 left",
    ]


def test_a_short_scan_says_nothing(told):
    assert told((0, 0), (5, 10_000)) == ""
    assert told((0, 0), (0.05, 10_000), terminal=True) == ""


def test_what_has_few_long_parts_tells_on_a_terminal_that_it_has_begun(told):
    text = told((0, 0), (0.05, 1), terminal=True, points=3, what="machines", at_once=True)
    assert text == "\ra.yaml: 0 % of 3 machines\x1b[K\r\x1b[K"
    assert told((0, 0), (5, 1), at_once=True) == ""
    assert told((0, 0), (5, 1), at_once=True, terminal=True, quiet=True) == ""


def test_a_terminal_has_one_line_that_is_wiped_in_the_end(told):
    text = told((0, 0), (0.0625, 10), (0.125, 1000), (0.1875, 2000), (0.25, 3000), terminal=True)
    assert text == (
        "\ra.yaml: 10 % of 10 k points, 8 k points/s, 0:01 left\x1b[K"
        "\ra.yaml: 30 % of 10 k points, 12 k points/s, 0:01 left\x1b[K"
        "\r\x1b[K"
    )


def test_what_was_kept_counts_for_the_share_and_not_for_the_speed(told):
    text = told((0, 5000), (40, 6000), (80, 9000))
    assert text.splitlines() == [
        "a.yaml: going on at 50 %",
        "a.yaml: 60 % of 10 k points, 25 points/s, 2:40 left",
        "a.yaml: 90 % of 10 k points, 50 points/s, 0:20 left",
    ]


@pytest.mark.parametrize("terminal", [False, True])
def test_quiet(told, terminal):
    assert told((0, 5000), (40, 6000), (80, 9000), terminal=terminal, quiet=True) == ""


def test_before_the_first_tile_there_is_no_speed(told):
    assert told((0, 0), (40, 0)) == "a.yaml: 0 % of 10 k points\n"


def test_large_numbers(told):
    assert told((0, 0), (100, 4_000_000_000), points=10**12) == (
        "a.yaml: 0 % of 1e+03 G points, 40 M points/s, 6:55:00 left\n"
    )


def test_the_line_is_wiped_after_an_error_too(monkeypatch):
    err = Terminal(True)
    monkeypatch.setattr(sys, "stderr", err)
    monkeypatch.setattr(module, "TERMINAL", 0.0)
    with suppress(KeyboardInterrupt), progress("a.yaml", False) as show:
        show(0, 10)
        show(5, 10)
        raise KeyboardInterrupt
    assert err.getvalue().endswith("\r\x1b[K")
