"""Hostile cases for hypothesis: configs by their schema, damaged files, ``commandlines``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from bikestab.bicycle import PAPER, preset_names
from bikestab.config.scanconfig import ScanConfig
from bikestab.fields import AXES, askable
from bikestab.gains import GAINS
from bikestab.notation import MEIJAARD
from bikestab.yamltext import copied, dumped
from tests.fuzz.bicycles import damaged_bicycles
from tests.fuzz.certificates import damaged_certificates
from tests.fuzz.commandlines import command_lines
from tests.fuzz.damage import damaged
from tests.fuzz.harness import Case
from tests.fuzz.outputs import outputs

CONFIGS = Path(__file__).parents[2] / "configs"
SEEDS = [path.read_bytes() for path in sorted(CONFIGS.glob("*.yaml"))]
NASTY = [
    None, True, False, 0, -1, 1, 2, 10**30, -(10**400), 1e-320, 1e308, float("inf"), float("nan"), "", " ",
    "1", "1e999", "18deg", "1 furlong", "0x", "9" * 300, "\0", "a\nb", "\x1b[2J", "λ", "\U0001f6b2", "../x",
    "/", ".", "never", "unbounded", [], {}, [[]], [{}], {"": ""}, {"values": []}, {"start": 0}, [1, 2],
    ["a"], {"a": {"b": {"c": [1]}}}, "*a", "<<", "~",
]  # fmt: skip
nasty = st.sampled_from(NASTY)
numbers = st.floats(-20, 20) | st.integers(-5, 60) | st.floats() | nasty
axes = st.one_of(
    st.fixed_dictionaries({"start": numbers, "stop": numbers, "num": st.integers(-1, 5) | nasty}),
    st.fixed_dictionaries({"values": st.lists(numbers, max_size=4)}),
    nasty,
)
parameters = st.dictionaries(
    st.sampled_from([*PAPER, *MEIJAARD, *GAINS, "name", "source", "rider", "x"]), numbers, max_size=30
)
varied = st.sampled_from(
    [
        *PAPER,
        *MEIJAARD,
        *GAINS,
        "rider.m",
        "trail",
        "offset",
        "correlation",
        "samples",
        "seed",
        "quantiles",
        "x",
    ]
)
other_axes = st.dictionaries(
    st.sampled_from([*AXES, *PAPER, "mB", "zB", "head_angle", "trail", "x", "y"]), axes, max_size=4
)
planes = st.dictionaries(st.sampled_from([*AXES, "x"]), numbers, max_size=2)
expected = st.sampled_from(["lam", "sigma", "V1", "V2", "within", "stable"])
KEYS: dict[str, st.SearchStrategy[Any]] = {
    "title": st.text(max_size=30) | nasty,
    "bicycle": st.sampled_from(preset_names()) | parameters | nasty,
    "model": st.sampled_from(["refined", "unrefined"]) | nasty,
    "delta": numbers,
    "grid": st.fixed_dictionaries(dict.fromkeys(AXES, axes)) | other_axes | nasty,
    "fields": st.lists(st.sampled_from(askable()) | nasty, max_size=4) | nasty,
    "fast": st.booleans() | nasty,
    "sweep": st.dictionaries(varied, axes | st.lists(numbers, max_size=3), max_size=3) | nasty,
    "ensemble": st.dictionaries(
        varied, st.fixed_dictionaries({"normal": st.lists(numbers, max_size=3)}) | numbers, max_size=4
    ) | nasty,
    "slices": st.lists(planes | nasty, max_size=3) | nasty,
    "output": st.just("out") | st.sampled_from(["", "a/b", "kept.csv", "n" * 300, "a\0b"]),
    "expect": st.lists(st.dictionaries(expected, numbers, max_size=5) | nasty, max_size=3) | nasty,
}  # fmt: skip
GOOD: dict[str, Any] = {
    "grid": {
        "lam": {"start": 0, "stop": 0.3, "num": 4},
        "sigma": {"values": [0.01, 0.1]},
        "V": {"start": 0, "stop": "36km/h", "num": 5},
    },
    "expect": [{"lam": 0.2, "sigma": 0.08, "V1": 4.056}, {"lam": 0.1, "sigma": 0.08, "stable": "never"}],
}
OPTIONS = [
    ("--json",), ("--quiet",), ("--force",), ("--certify",), ("--report",), ("--set", "fast=true"),
    ("--set", "grid.V.num=3"), ("--set", "bicycle=sharp1971"), ("--set", "slices=[{V: 5}]"),
    ("--set", "x.y=[}"),
]  # fmt: skip
assert set(KEYS) == set(ScanConfig.model_fields)


@st.composite
def _configs(draw: Any, *, wild: bool) -> bytes:
    """Values that are good, bad or missing, and more keys than there are; few of these unless ``wild``."""
    data: dict[str, Any] = copied(GOOD) | {"bicycle": draw(st.sampled_from(preset_names())), "output": "out"}
    for key in draw(st.lists(st.sampled_from(sorted(KEYS)), max_size=3 if wild else 1)):
        data[key] = draw(KEYS[key])
    if isinstance(data["grid"], dict) and draw(st.booleans()):  # one place deep in it
        axis = data["grid"].get(draw(st.sampled_from(AXES)))
        if isinstance(axis, dict):
            place = draw(
                st.sampled_from(["start", "stop", "num", "values"] if wild else sorted(axis, key=str))
            )
            axis[place] = draw(
                numbers if wild else st.integers(2, 7) if place != "values" else st.just([0.1, 0.3])
            )
    for key in draw(st.lists(st.sampled_from(sorted(data)), max_size=1)) if wild else []:
        del data[key]
    if wild and draw(st.integers(0, 9)) == 0:
        data[draw(st.text(max_size=8))] = draw(nasty)
    return dumped(data).encode("utf-8", "replace")


@st.composite
def configs(draw: Any) -> Case:
    """A config, checked."""
    return Case(("check", "a.yaml"), {"a.yaml": draw(_configs(wild=True))})


@st.composite
def scans(draw: Any) -> Case:
    """A config, scanned: with pictures, and perhaps proofs or a page."""
    options = draw(st.lists(st.sampled_from(OPTIONS), max_size=2))
    args = ("scan", "a.yaml", "--jobs", "1", *(part for option in options for part in option))
    return Case(args, {"a.yaml": draw(_configs(wild=draw(st.integers(0, 3)) == 0))})


@st.composite
def damaged_configs(draw: Any) -> Case:
    """One of the configs that come with the project, damaged."""
    return Case(("check", "a.yaml"), {"a.yaml": draw(damaged(draw(st.sampled_from(SEEDS))))})


KINDS: dict[str, st.SearchStrategy[Case]] = {
    "configs": configs(),
    "scans": scans(),
    "damaged configs": damaged_configs(),
    "damaged bicycles": damaged_bicycles(),
    "damaged certificates": damaged_certificates(),
    "command lines": command_lines(),
    "outputs": outputs(),
}
