"""What is drawn, searched and exported, of machines and scans that mean something, many at an edge."""

from __future__ import annotations

import tempfile
from functools import cache
from typing import Any

from hypothesis import strategies as st

from bikestab.bicycle import preset_names
from bikestab.config.file import parse_config
from bikestab.scan.run import run_scan
from bikestab.yamltext import dumped, parse
from tests.fuzz.harness import Case
from tests.strategies import machines

ENDS = {"lam": ["0", "0.2", "0.3", "-0.2", "1.2"], "sigma": ["0", "0.1", "0.05", "-0.1", "0.5"],
        "V": ["0", "5", "10", "3", "40"]}  # fmt: skip
FRAME = {"head-angle": ["90deg", "80deg", "75deg", "-5deg"], "trail": ["70mm", "0.05", "0", "-2in"]}
DRAWN = ["out.png", "out.png", "out.svg", "out.svg", "out.pdf", "out.pdf", "out", "out.xyz", "a/out.png"]
EXPORTED = {
    "--mesh": ["out.ply", "out.stl", "out.vtp", "out.vtu", "out.xyz"],
    "--skeleton": ["out.csv", "out.csv", "out.parquet", "out.ply"], "--intervals": ["out.csv", "out.parquet"],
}  # fmt: skip
SPREAD = [  # what the config has, and how one machine of it is named
    ({}, []), ({}, []), ({"sweep": {"delta": [0, 1]}}, ["--at", "delta=1"]),
    ({"ensemble": {"m2": {"normal": [9, 1]}, "samples": 3, "seed": 1}}, ["--probability"]),
    ({"sweep": {"m1": [60, 80]}, "ensemble": {"h1": {"uniform": [0.9, 1.1]}, "samples": 2, "seed": 2}},
     ["--at", "m1=60"]),
]  # fmt: skip
REPORTED = [  # boxes with little or no surface, which takes seconds else
    {"lam": {"values": lam}, "sigma": {"values": [0.1, 0.2]}, "V": {"values": V}}
    for lam in ([0.2], [0.2, 0.3]) for V in ([5.0], [30.0, 40.0])
]  # fmt: skip
VIEWS = [
    ["--V", "0:10:5"], ["--V", "3:40:2"], ["--V", "0:0:1"], ["--V", "5"], ["--V", "10:3:4"], ["--locus"],
    ["--shapes"], ["--push", "roll_rate=0.5"], ["--push", "steer=1,roll=0", "--at", "0"],
    ["--over", "delta=0:5:5"],
]  # fmt: skip
OVER = [
    ["--over", "delta=0:5:5"],
    ["--lam", "0:0.3:5"],
    ["--trail", "0:10cm:5"],
    ["--over", "m1=50:90:3"],
    [],
]
MORE = [["--at", "m1=70"], ["--at", "x=1"], ["--probability"]]


@cache
def volume_of(text: str) -> bytes:
    """The volume of a config."""
    with tempfile.TemporaryDirectory() as folder:
        config = parse_config(parse(text.replace("OUT", folder), "a.yaml"))
        return run_scan(config, jobs=1).path.read_bytes()


@st.composite
def _of_volumes(draw: Any) -> Case:
    """A command for a small scan in some box, perhaps of one value along an axis."""
    grid = {}
    for name, ends in ENDS.items():
        fewest = draw(st.sampled_from([1, 2, 2, 2]))
        values = draw(st.lists(st.sampled_from(ends), min_size=fewest, max_size=3, unique=True))
        grid[name] = {"values": sorted(map(float, values))}
    spread, options = draw(st.sampled_from(SPREAD))
    machine = "dikarev1981" if spread else draw(st.sampled_from(preset_names()) | machines)
    volume = volume_of(dumped({"bicycle": machine, "grid": grid, "output": "OUT", **spread}))
    if draw(st.booleans()):
        axis = draw(st.sampled_from([*ENDS, *FRAME]))
        value = draw(st.sampled_from({**ENDS, **FRAME}[axis]))
        args = ["slice", "v.h5", f"--{axis}={value}", "-o", draw(st.sampled_from(DRAWN))]
    else:
        kind = draw(st.sampled_from(sorted(EXPORTED)))
        args = ["export", "v.h5", kind, draw(st.sampled_from(EXPORTED[kind])), "--cells", "10"]
        args += draw(st.sampled_from([[], [], [], ["--scale", "50,100,1"], ["--scale", "0,1,1"]]))
        options = options if "--at" in options else []
    args += options if draw(st.integers(0, 4)) else draw(st.sampled_from(MORE))
    return Case(tuple(args), {"v.h5": volume})


@st.composite
def _of_machines(draw: Any) -> Case:
    command = draw(st.sampled_from(["eigen", "design", "sensitivity", "bicycles", "vrange", "compare"]))
    files = {}
    if draw(st.booleans()):
        files["b.yaml"] = dumped(draw(machines)).encode()
    machine = "b.yaml" if files else draw(st.sampled_from(preset_names()))
    args = [command, machine] if command in ("bicycles", "compare") else [command, "--bicycle", machine]
    pairs = {axis: draw(st.sampled_from(ends)) for axis, ends in ENDS.items()}
    if command == "design":
        for axis, one in pairs.items():
            low, high = sorted((one, draw(st.sampled_from(ENDS[axis]))), key=float)
            args.append(f"--{axis}={low}:{high}")
        args += ["--csv", "out.csv"] if draw(st.integers(0, 3)) else ["-o", draw(st.sampled_from(DRAWN))]
        if draw(st.booleans()):
            args += ["--stable", draw(st.sampled_from(["4:5", "5", "0:3", "20:25", "6:5"]))]
    else:
        own = files or machine == "dikarev1981" or not draw(st.integers(0, 3))
        args += (
            [f"--{axis}={pairs[axis]}" for axis in ("lam", "sigma")] if own and command != "vrange" else []
        )
        args += draw(st.sampled_from({"eigen": VIEWS, "vrange": OVER}.get(command, [[]])))
        args += [draw(st.sampled_from(preset_names()))] if command == "compare" else []
        args += ["-o", draw(st.sampled_from(DRAWN))]
    if command != "bicycles":
        args += draw(st.sampled_from([[], [], ["--delta", "1"], ["--model", "unrefined"], ["--json"]]))
    return Case(tuple(args), files)


@st.composite
def _reports(draw: Any) -> Case:
    volume = volume_of(
        dumped({"bicycle": "meijaard2007", "grid": draw(st.sampled_from(REPORTED)), "output": "OUT"})
    )
    return Case(
        ("report", *["v.h5"] * draw(st.integers(1, 2)), "-o", draw(st.sampled_from(["out.html", "a/b"]))),
        {"v.h5": volume},
    )


def outputs() -> st.SearchStrategy[Case]:
    """Pictures, designs, meshes, tables and pages."""
    return _of_volumes() | _of_volumes() | _of_machines() | _of_machines() | _reports()
