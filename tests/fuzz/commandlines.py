"""Command lines that mean something, and what one slip of the keyboard makes of them.

No command that may compute for long: a mesh takes seconds.
What is written goes to names that no file of a case has.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from bikestab.bicycle import preset_names, preset_text
from tests.fuzz.harness import KEPT, Case

VOLUME = (Path(__file__).parents[1] / "references" / "volumes" / "damped.h5").read_bytes()
CONFIG = """\
bicycle: dikarev1981
grid: {lam: {start: 0, stop: 0.3, num: 4}, sigma: {values: [0.01, 0.1]}, V: {start: 0, stop: 10, num: 5}}
expect: [{lam: 0.2, sigma: 0.08, V1: 4.056}]
"""
OTHER = """\
bicycle: meijaard2007
grid: {lam: {values: [0.2, 0.3]}, sigma: {values: [0.1, 0.2]}, V: {values: [30, 40]}}
expect: [{V1: 4.3, within: 1%}, {lam: 0.2, sigma: 0.08, stable: never}]
"""
RIDER = "rider: {m: 75, x: 0.3, z: -1, Ixx: 9, Izz: 2, Ixz: 0}\n"
FILES = {
    "a.yaml": CONFIG.encode(), "c.yaml": OTHER.encode(), "v.h5": VOLUME,
    "b.yaml": preset_text("meijaard2007").encode(), "r.yaml": (preset_text("meijaard2007") + RIDER).encode(),
}  # fmt: skip
WORDS = [
    "0.2", "0:0.3:4", "18deg", "1e999", "nan", "-0", "", " ", "9" * 5000, "1" + " " * 3000 + "x",
    "0:1:2:3", "0:1:9999999999", "a=b", "=", "delta=1", "x" * 500, "\x1b[2J", "λ", "\udc80", "none.yaml",
    ".", "meijaard2007", "out.csv", "out.xyz", "5", "5:1", "a/b", "n" * 300, "refined", "--", "-", "--help",
    "-h", "--lamb", "-x", KEPT + "/x", "--json", "--set", "-1", "0", "1,5", "36km/h", "1e-320",
]  # fmt: skip

BICYCLE = [*preset_names(), "b.yaml", "r.yaml"]
LAM, SIGMA, V = ["0.2", "0.1", "18deg", "0", "-0.3"], ["0.08", "0.1", "-0.02"], ["5", "4.2", "18km/h"]
EQUATIONS = {"--model": ["refined", "unrefined"], "--delta": ["0", "1", "0.5"], "--json": None}
MACHINE = {"--bicycle": BICYCLE, **EQUATIONS}
SETS = ["mB=60,85", "m1=60,75", "rider.m=60,100", "delta=0,1", "c=0.05", "h2=-1", "lam=0.2,0.3"]
SEVERAL = {**MACHINE, "--set": SETS}
FRAME = {"--head-angle": ["71deg", "68deg"], "--trail": ["55mm", "0.06"], "--offset": ["45mm", "0"]}
SD = {"--sd": ["m1=1", "lam=0.5deg", "sigma=0.001", "file", "mB=2", "delta=0.1"]}
OVER = [
    "mB=60:110:3",
    "offset=0:80mm:2",
    "delta=0:5:3",
    "lam=0:0.3:4",
    "m1=50:90:3",
    "rider.m=0:90:3",
    "g=9:10:2",
]
BETWEEN = ["mB=60:110", "offset=0:80mm", "delta=0:5", "lam=0:0.3", "m1=50:90", "trail=2cm:15cm", "xB=0.2:0.4"]
TOLERANCE = ["m1=80+-1", "mB=85+-2", "delta=0.5+-0.5", "lam=0.2+-0.1"]
AGAIN = {
    "--bicycle",
    "--set",
    "--over",
    "--free",
    "--sd",
    "--at",
    "--tolerance",
}  # may be given more than once
# command → what may stand at each place of its end, options → their values, None for a flag
COMMANDS: dict[str, tuple[list[list[str]], dict[str, list[str] | None]]] = {
    "vrange": ([], {
        "--lam": [*LAM, "0:0.3:4"], "--sigma": [*SIGMA, "0:0.1:3"], "--over": OVER, **SD, **SEVERAL,
    }),
    "eigen": ([], {
        "--lam": LAM, "--sigma": SIGMA, "--V": [*V, "0:10:5"], "--csv": ["out.csv"], "--shapes": None,
        "--push": ["roll_rate=0.5", "steer=1deg,roll=-0.1", "roll=0", "steer_rate=1e300", "yaw=1"],
        "--over": OVER, "--at": V, "--until": ["1", "20s", "0", "1e6"], "--locus": None, **SEVERAL,
    }),
    "design": ([], {
        "--lam": ["0:0.3", "10deg:25deg", "0.2"], "--sigma": ["0:0.2", "0.08"], "--V": ["5", "4:6"],
        "--stable": ["4:5", "5", "20:25"], "--V-max": ["10", "0"], "--csv": ["out.csv"], "--over": BETWEEN,
        "--free": BETWEEN, **SD, **SEVERAL,
    }),
    "sensitivity": ([], {
        "--lam": LAM, "--sigma": SIGMA, "--hold": ["trail", "offset", "sigma"], "--csv": ["out.csv"],
        **SD, **SEVERAL,
    }),
    "certify": ([["a.yaml"]], {
        "--lam": ["0.1:0.3", "0.2:0.2", "10deg:12deg"], "--sigma": ["0.05:0.1", "0.08:0.09"],
        "--V": ["3:6", "0:2", "5:5"], "--tolerance": TOLERANCE, "--cells": ["1", "2", "4"],
        "-o": ["out.json"], "-q": None, **MACHINE,
    }),
    "convert": ([BICYCLE], {
        "-o": ["out.json", "out.yaml", "out.ini", "out.txt"], "--force": None,
        "--notation": ["given", "paper", "meijaard2007"], "--rider": ["b.yaml", "none.txt"],
    }),
    "bicycles": ([BICYCLE], {"--json": None, "--lam": LAM, "--sigma": SIGMA, **FRAME}),
    "check": ([["a.yaml", "c.yaml"], ["c.yaml", "v.h5", "b.yaml"]], {"--junit": ["out.xml"], "--json": None}),
    "compare": ([[*BICYCLE, "a.yaml", "c.yaml", "v.h5"]] * 2, {
        "--within": ["1%", "0.05", "0", "1e9%"], "--lam": LAM, "--sigma": SIGMA, "--at": ["delta=1"],
        **FRAME, **EQUATIONS,
    }),
    "info": ([["v.h5"]], {"--json": None, "--config": None}),
    "export": ([["v.h5"]], {
        "--intervals": ["out.csv", "out.parquet"], "--at": ["delta=1"], "--quantiles": ["out.csv"],
    }),
    "report": ([["a.yaml", "b.yaml", "none.h5"]], {"-o": ["out.html", "out.xyz"]}),  # never one that is drawn
    "completion": ([["bash", "zsh", "fish"]], {}),
    "init": ([["out.yaml"]], {"--bicycle": BICYCLE, "--uncertain": None, "--force": None}),
    "schema": ([["config", "vrange", "eigen", "design", "compare", "check"]], {}),
}  # fmt: skip
# what a command hardly does without, in one of these ways
FRAMES: list[tuple[str, ...]] = [
    ("--lam", "--sigma"), ("--head-angle", "--trail"), ("--lam", "--offset"), ("--lam", "--trail"), (),
]  # fmt: skip
NEEDED: dict[str, list[tuple[str, ...]]] = {
    "vrange": FRAMES, "eigen": [*FRAMES, ("--over",), ("--push",)],
    "design": [(), ("--over", "--over"), ("--free", "--free", "--sd", "--stable")],
    "sensitivity": [("--lam", "--sigma"), ()],
    "certify": [("--lam", "--sigma", "--V"), ()], "export": [("--intervals",)],
}  # fmt: skip


@st.composite
def command_lines(draw: Any) -> Case:
    """A command with some of its options; one in four with a slip."""
    name = draw(st.sampled_from(sorted(COMMANDS)))
    last, options = COMMANDS[name]
    more = draw(st.lists(st.sampled_from(sorted(options)), max_size=3)) if options else []
    chosen: list[str] = []
    for option in [*draw(st.sampled_from(NEEDED.get(name, [()]))), *more]:
        chosen += [option] if option in AGAIN or option not in chosen else []
    args = [name]
    for option in chosen:
        values = (options | FRAME)[option]
        args += [option] if values is None else [option, draw(st.sampled_from(values))]
    if not (name == "certify" and len(args) > 1):
        args += [draw(st.sampled_from(pool)) for pool in last]
    if draw(st.integers(0, 3)) == 3:
        args = draw(_slipped(args))
    return Case(tuple(args), {file: FILES[file] for file in FILES if file in args})


@st.composite
def _slipped(draw: Any, args: list[str]) -> list[str]:
    at = draw(st.integers(min(1, len(args) - 1), len(args) - 1)) if draw(st.integers(0, 5)) < 5 else 0
    there = args[at]
    kind = draw(st.sampled_from(["replace", "replace", "drop", "double", "cut", "add"]))
    put = {
        "replace": [draw(st.sampled_from(WORDS))], "drop": [] if at else ["scam"], "double": [there, there],
        "cut": [there[: draw(st.integers(0, len(there)))]], "add": [there, draw(st.sampled_from(WORDS))],
    }[kind]  # fmt: skip
    return [*args[:at], *put, *args[at + 1 :]]
