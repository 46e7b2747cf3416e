"""Files of bicycles in every format that is read, damaged, under every command that reads them."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from bikestab.bicycle import Bicycle, preset_names, preset_text
from bikestab.formats.principal import PRINCIPAL
from bikestab.formats.writing import written
from tests.fuzz.damage import damaged
from tests.fuzz.harness import Case

RIDER = "mB = 72.0+/-2.0\nxB = 0.29\nyB = 0.0\nzB = -1.1\nIBxx = 8\nIBxz = -1.9\nIByy = 8.1\nIBzz = 2.4\n"
APART = "rider: {m: 75, x: 0.35, z: -1.1, Ixx: 9.6, Izz: 2.2, Ixz: -1.0, scale_inertia: true}\n"
MEASURED = Path(__file__).parents[1] / "references" / "browser_measured.txt"
OWN = ("--bicycle", "b")
COMMANDS = [
    ("vrange", *OWN), ("vrange", "--lam", "0.2", "--sigma", "0.1", *OWN), ("vrange", "--sd", "file", *OWN),
    ("eigen", "--lam", "0.3", "--sigma", "0.08", *OWN), ("sensitivity", "--hold", "offset", *OWN),
    ("convert", "b"), ("convert", "b", "-o", "out.json"), ("convert", "b", "-o", "out.ini"),
    ("convert", "b", "--notation", "paper", "-o", "out.txt"), ("convert", "meijaard2007", "--rider", "b"),
    ("init", "out.yaml", "--uncertain", *OWN), ("bicycles", "b"),
    ("certify", "--lam", "0.3", "--sigma", "0.08", "--V", "5:5", *OWN),
]  # fmt: skip


@cache
def texts() -> list[bytes]:
    """A sound file of each kind."""
    bicycle = Bicycle.preset("meijaard2007")
    numbers, words = bicycle.given, {"name": "a", "source": "b"}
    deviations = {"mB": 0.5, "xH": 1e-3}
    flat = "".join(f"{key}: {value}\n" for key, value in numbers.items())
    principal = "".join(f"  {key}: {0.6 if key[0] != 'z' else -0.6}\n" for key in PRINCIPAL)
    made = [written(ending, numbers, deviations, words) for ending in (".yaml", ".json", ".ini", ".txt")]
    made += [preset_text(name) for name in preset_names()]
    made += ["values:\n" + "".join(f"  {line}\n" for line in flat.splitlines()), flat + APART, RIDER]
    made += [f"parameterization: Moore2019\nvalues:\n{principal}", MEASURED.read_text("utf-8")]
    return [text.encode() for text in made]


@st.composite
def damaged_bicycles(draw: Any) -> Case:
    """One of them, damaged."""
    whole = texts()[draw(st.integers(0, len(texts()) - 1))]
    return Case(draw(st.sampled_from(COMMANDS)), {"b": draw(damaged(whole))})
