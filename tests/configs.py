"""A small config as YAML, and what becomes of it or of a bad one."""

from pathlib import Path

import pytest

from bikestab.config.file import load_config
from bikestab.errors import InputError

GOOD = """\
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 4}
  sigma: {start: 0, stop: 0.15, num: 5}
  V: {start: 0, stop: 10, num: 6}
"""
PAPER = """\
bicycle:
  name: mine
  R: 0.35
  c: 1.04
  g: 9.8
  m1: 80
  l1: 0.4
  h1: 0.9
  A1: 3.3
  B1: 6.7
  C1: 0.5
  m2: 2.7
  l2: 0.9
  h2: 0.5
  A2: 0.036
  B2: 0.22
  C2: 0.5
"""
IN_PLACE = PAPER + GOOD.split("\n", 1)[1]


def load(text, *overrides):
    """The config of a YAML text, written to scan.yaml in the current folder."""
    Path("scan.yaml").write_bytes(text if isinstance(text, bytes) else text.encode())
    return load_config("scan.yaml", overrides)


def message(text, *overrides):
    """What is said of a bad one."""
    with pytest.raises(InputError) as caught:
        load(text, *overrides)
    return str(caught.value)


def change(old, new):
    """GOOD with one text replaced by another."""
    assert old in GOOD
    return GOOD.replace(old, new, 1)


GRID_V = "{start: 0, stop: 10, num: 6}"
