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
FEEDBACK = "k_phidot: -50\nk_delta_V: 0.5\n"
APART = "mB = 72.0+/-2.0\nxB = 0.29\nyB = 0.0\nzB = -1.1\nIBxx = 8\nIBxz = -1.9\nIByy = 8.1\nIBzz = 2.4\n"
FILES = {
    "a.yaml": CONFIG.encode(), "c.yaml": OTHER.encode(), "v.h5": VOLUME,
    "b.yaml": preset_text("meijaard2007").encode(), "r.yaml": (preset_text("meijaard2007") + RIDER).encode(),
    "k.yaml": (preset_text("meijaard2007") + FEEDBACK).encode(), "rider.txt": APART.encode(),
}  # fmt: skip
WORDS = [
    "0.2", "0:0.3:4", "18deg", "1e999", "nan", "-0", "", " ", "9" * 5000, "1" + " " * 3000 + "x",
    "0:1:2:3", "0:1:9999999999", "a=b", "=", "delta=1", "x" * 500, "\x1b[2J", "λ", "\udc80", "none.yaml",
    ".", "meijaard2007", "out.csv", "out.xyz", "5", "5:1", "a/b", "n" * 300, "refined", "--", "-", "--help",
    "-h", "--lamb", "-x", KEPT + "/x", "--json", "--set", "-1", "0", "1,5", "36km/h", "1e-320",
]  # fmt: skip

BICYCLE = [*preset_names(), "b.yaml", "r.yaml", "k.yaml"]
LAM, SIGMA, V = ["0.2", "0.1", "18deg", "0", "-0.3"], ["0.08", "0.1", "-0.02"], ["5", "4.2", "18km/h"]
EQUATIONS = {"--model": ["refined", "unrefined"], "--delta": ["0", "1", "0.5"], "--json": None}
MACHINE = {"--bicycle": BICYCLE, **EQUATIONS}
SETS = [
    "mB=60,85", "m1=60,75", "rider.m=60,100", "delta=0,1", "c=0.05", "h2=-1", "lam=0.2,0.3",
    "k_phidot=-50,0", "k_phi=1e9", "k_delta_V=-2", "k_deltadot=-1e3",
]  # fmt: skip
RIDDEN = {"--rider": ["rider.txt", "b.yaml", "none.txt"]}
SEVERAL = {**MACHINE, "--set": SETS, **RIDDEN}
PICTURE = ["out.svg", "out.png", "out.xyz"]
FRAME = {"--head-angle": ["71deg", "68deg"], "--trail": ["55mm", "0.06"], "--offset": ["45mm", "0"]}
SD = {"--sd": ["m1=1", "lam=0.5deg", "sigma=0.001", "file", "mB=2", "delta=0.1", "k_phi=1"]}
OVER = [
    "mB=60:110:3", "offset=0:80mm:2", "delta=0:5:3", "lam=0:0.3:4", "m1=50:90:3", "rider.m=0:90:3",
    "g=9:10:2", "k_phidot=-50:0:3", "k_phi_V=-5:5:3", "k_deltadot=-5:5:4",
]  # fmt: skip
BETWEEN = [
    "mB=60:110", "offset=0:80mm", "delta=0:5", "lam=0:0.3", "m1=50:90", "trail=2cm:15cm", "xB=0.2:0.4",
    "k_phidot=-50:0", "k_delta=0:10",
]  # fmt: skip
TOLERANCE = ["m1=80+-1", "mB=85+-2", "delta=0.5+-0.5", "lam=0.2+-0.1", "k_phi=0+-1"]
# may be given more than once
AGAIN = {"--bicycle", "--set", "--over", "--free", "--sd", "--at", "--tolerance"}
# command → what may stand at each place of its end, options → their values, None for a flag
COMMANDS: dict[str, tuple[list[list[str]], dict[str, list[str] | None]]] = {
    "vrange": ([], {
        "--lam": [*LAM, "0:0.3:4"], "--sigma": [*SIGMA, "0:0.1:3"], **FRAME,
        "--head-angle": ["71deg", "68deg:74deg:3"], "--trail": ["55mm", "40mm:80mm:3"], "--over": OVER,
        "-o": PICTURE, **SD, **SEVERAL,
    }),
    "eigen": ([], {
        "--lam": LAM, "--sigma": SIGMA, **FRAME, "--V": [*V, "0:10:5"], "--csv": ["out.csv"],
        "--shapes": None,
        "--push": ["roll_rate=0.5", "steer=1deg,roll=-0.1", "roll=0", "steer_rate=1e300", "yaw=1"],
        "--over": OVER, "--at": V, "--until": ["1", "20s", "0", "1e6"], "--locus": None,
        "-o": PICTURE, **SEVERAL,
    }),
    "design": ([], {
        "--lam": ["0:0.3", "10deg:25deg", "0.2"], "--sigma": ["0:0.2", "0.08"], "--V": ["5", "4:6"],
        "--stable": ["4:5", "5", "20:25"], "--V-max": ["10", "0"], "--csv": ["out.csv"], "--over": BETWEEN,
        "--free": BETWEEN, "--head-angle": ["68deg:74deg", "71deg"], "--trail": ["40mm:80mm"],
        "--offset": ["0:80mm"], "-o": PICTURE, "--certified": None, "--certificate": ["out.json"],
        **SD, **SEVERAL,
    }),
    "sensitivity": ([], {
        "--lam": LAM, "--sigma": SIGMA, "--hold": ["trail", "offset", "sigma"], "--csv": ["out.csv"],
        "--of": ["speeds", "growth", "sigma_min"], "-o": PICTURE, **FRAME, **SD, **SEVERAL,
    }),
    "certify": ([["a.yaml"]], {
        "--lam": ["0.1:0.3", "0.2:0.2", "10deg:12deg"], "--sigma": ["0.05:0.1", "0.08:0.09"],
        "--V": ["3:6", "0:2", "5:5"], "--tolerance": TOLERANCE, "--cells": ["1", "2", "4"],
        "--head-angle": ["71deg", "71deg:73deg"], "--trail": ["50mm:60mm"], "--offset": ["0:80mm"],
        "--jobs": ["1", "2", "0"], "--work": ["1", "50", "0"], "-o": ["out.json"], "-q": None,
        "--verify": ["a.yaml", "none.json"], **MACHINE,
    }),
    "convert": ([BICYCLE], {
        "-o": ["out.json", "out.yaml", "out.ini", "out.txt"], "--force": None,
        "--notation": ["given", "paper", "meijaard2007"], **RIDDEN,
    }),
    "bicycles": ([BICYCLE], {"--json": None, "--lam": LAM, "--sigma": SIGMA, "-o": PICTURE, **FRAME}),
    "check": ([["a.yaml", "c.yaml"], ["c.yaml", "v.h5", "b.yaml"]], {"--junit": ["out.xml"], "--json": None}),
    "compare": ([[*BICYCLE, "a.yaml", "c.yaml", "v.h5"]] * 2, {
        "--within": ["1%", "0.05", "0", "1e9%"], "--lam": LAM, "--sigma": SIGMA, "--at": ["delta=1"],
        "-o": PICTURE, **FRAME, **RIDDEN, **EQUATIONS,
    }),
    "info": ([["v.h5"]], {"--json": None, "--config": None}),
    "export": ([["v.h5"]], {
        "--intervals": ["out.csv", "out.parquet"], "--at": ["delta=1"], "--quantiles": ["out.csv"],
        "--skeleton": ["out.csv", "out.parquet"], "--cells": ["4", "0"], "--scale": ["1,1,1", "1,0,1"],
    }),
    "report": ([["a.yaml", "b.yaml", "none.h5"]], {  # never one that is drawn
        "-o": ["out.html", "out.xyz"], "--quiet": None,
    }),
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
    "design": [(), ("--over", "--over"), ("--free", "--free", "--sd", "--stable"), ("--certified",)],
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
        values = options[option]
        args += [option] if values is None else [option, draw(st.sampled_from(values))]
    if not (name == "certify" and ("--lam" in args or draw(st.booleans()))):  # a config, or a box
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
