"""Some hundred damaged volumes and tiles; ``python -m tests.fuzz.volumes`` takes as many as are wanted."""

import os
import time

import pytest

from tests.fuzz import limits
from tests.fuzz.limits import alone
from tests.fuzz.volumes import ended, originals

PARTS = 4  # so that the cores share the cases
CASES = {"volumes": 32, "tiles": 10}  # of each part, in one process


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Undamaged volumes and tiles."""
    return originals(tmp_path_factory.mktemp("whole"))


@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize("kind", CASES)
def test_damage_ends_as_it_has_to(whole, kind, part):
    codes = ended(whole, kind, range(part * CASES[kind], (part + 1) * CASES[kind]))
    assert len(codes) == CASES[kind]
    assert set(codes) <= {0, 2, 3}


@pytest.mark.parametrize(
    ("case", "problem"),
    [
        (lambda: 1 / 0, "ZeroDivisionError"),
        (lambda: os._exit(7), "ended with 7"),
        (lambda: [time.monotonic() for _ in iter(int, 1)], "more than 1 s"),
    ],
)
def test_what_is_noticed(case, problem, monkeypatch):
    monkeypatch.setattr(limits, "SECONDS", 1)
    with pytest.raises(AssertionError, match=problem):
        alone(case)
