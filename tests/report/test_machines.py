"""What goes over to the page: exact formulas of the table and of the motion."""

import json
import shlex
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import bikestab as bs
from bikestab.config.file import load_config
from bikestab.layout import bicycle_of
from bikestab.model import canonical_matrices, characteristic_table, in_powers
from bikestab.presets import preset_names
from bikestab.report.machines import command_options, machine_record
from bikestab.report.volumes import families

DESIGNS = [(0.0, 0.0), (0.2, 0.08), (0.31, 0.0784), (-0.3, -0.1), (1.2, 0.3)]


def value(formula, lam, sigma):
    """A formula in fractions, with the doubles that sine and cosine are."""
    sin, cos = Fraction(float(np.sin(lam))), Fraction(float(np.cos(lam)))
    total = Fraction(0)
    for i, j, k, first, rest in formula:
        total += (Fraction(first) + Fraction(rest)) * sin**i * cos**j * Fraction(sigma) ** k
    return float(total)


ASSISTED = load_config("configs/steer_assist.yaml").machine
GAINS = {
    "k_phi": 3.0, "k_phidot": -20.0, "k_delta": 1.5, "k_deltadot": 2.0,
    "k_phi_V": -0.4, "k_phidot_V": 1.1, "k_delta_V": 0.7, "k_deltadot_V": -0.3,
}  # fmt: skip
MACHINES = [
    *(bs.Bicycle.preset(name) for name in preset_names()),
    ASSISTED,
    ASSISTED.replaced(GAINS),
    ASSISTED.replaced({"k_phidot_per_V": -20.0, "k_delta_per_V": 3.0, "k_phi_V": 0.3}),
    bs.Bicycle.preset("dikarev1981").replaced(GAINS),
]


@pytest.mark.parametrize("bicycle", MACHINES, ids=lambda one: one.name)
@pytest.mark.parametrize("model", ["refined", "unrefined"])
def test_formulas_give_the_table(bicycle, model):
    record = machine_record(bicycle, model, {})
    for lam, sigma in DESIGNS:
        table = in_powers(characteristic_table(bicycle, lam, sigma, model=model))
        mine = np.array([[value(entry, lam, sigma) for entry in row] for row in record["table"]])
        assert mine == pytest.approx(table, rel=1e-12, abs=1e-12 * np.abs(table).max())


@pytest.mark.parametrize("name", preset_names())
def test_formulas_of_the_motion_are_the_matrices_of_the_benchmark_paper(name):
    bicycle = bs.Bicycle.preset(name)
    motion = machine_record(bicycle, "refined", {})["motion"]
    for lam, sigma in DESIGNS:
        mine = {
            key: np.array([[value(entry, lam, sigma) for entry in row] for row in matrix]) / bicycle.c
            for key, matrix in motion.items()
        }
        M, C1, K0, K2 = canonical_matrices(bicycle, lam, sigma)
        for key, right in zip(("M", "C1", "K0", "K2"), (M, C1, bicycle.g * K0, K2), strict=True):
            assert mine[key] == pytest.approx(right, rel=1e-12, abs=1e-12 * np.abs(right).max()), key
        assert mine["C0"] == pytest.approx(np.array([[0, 0], [0, bicycle.delta]]))


def at_speed(motion, kind, lam, sigma, V):
    """M, or the factors of rates (C) or angles (K) at a speed."""
    total = np.zeros((2, 2))
    for key, matrix in motion.items():
        if key[0] == kind:
            power = int(key[1:] or 0)
            total += V**power * np.array([[value(entry, lam, sigma) for entry in row] for row in matrix])
    return total


@pytest.mark.parametrize("bicycle", MACHINES, ids=lambda one: one.name)
def test_the_motion_has_the_eigenvalues_of_the_table(bicycle):
    motion = machine_record(bicycle, "refined", {})["motion"]
    for lam, sigma in ((0.2, 0.08), (0.31, 0.0784), (1.2, 0.3)):
        for V in (0.5, 5.0, 20.0):
            M, C, K = (at_speed(motion, kind, lam, sigma, V) for kind in "MCK")
            lower = [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]
            A = np.block([[np.zeros((2, 2)), np.eye(2)], lower])
            mine = np.poly(np.linalg.eigvals(A))
            right = np.poly(bs.eigenvalues(bicycle, V, lam=lam, sigma=sigma))
            assert mine == pytest.approx(right.real, rel=1e-8, abs=1e-8 * np.abs(right).max())


def test_the_command_of_a_preset_names_it_and_its_damping():
    bicycle = bs.Bicycle.preset("meijaard2007")
    assert command_options(bicycle, "refined", {}) == "--bicycle meijaard2007"
    assert (
        command_options(bicycle.with_delta(1.5), "unrefined", {})
        == "--bicycle meijaard2007 --delta 1.5 --model unrefined"
    )
    assert command_options(bicycle.replaced({"k_phidot": -20.0}), "refined", {}) == (
        "--bicycle meijaard2007 --set k_phidot=-20.0"
    )
    swept = {"mB": 60.0, "delta": 1.5}
    loaded = bicycle_of(bicycle.replaced(swept).numbers(), "meijaard2007")
    assert command_options(loaded, "refined", swept) == "--bicycle meijaard2007 --set mB=60.0 --delta 1.5"


def test_a_machine_that_is_no_preset_is_told_by_its_numbers():
    """One of a preset's name too: whoever changes a preset in a config may leave its name."""
    machine = bs.Bicycle.preset("dikarev1981").replaced({"m1": 81.0, "k_phi": 2.0, "delta": 0.5})
    words = command_options(machine, "refined", {}).split()
    assert words[:2] == ["--bicycle", "dikarev1981"]
    given = dict(word.split("=") for word in words if "=" in word)
    given["delta"] = words[words.index("--delta") + 1]
    right = {name: value for name, value in machine.numbers().items() if name not in ("lam", "sigma")}
    assert {name: float(value) for name, value in given.items()} == right


def test_a_copied_command_gives_the_page_s_numbers_in_a_shell(tmp_path, monkeypatch):
    """Of a machine out of a file, in a folder whose name a shell would take for two."""
    monkeypatch.chdir(tmp_path)
    lines = [f"{key} = {value}" for key, value in bs.Bicycle.preset("meijaard2007").given.items()]
    Path("my bike.txt").write_text("\n".join([*lines, "k_phidot = -3.25"]).replace("mB = 85.0", "mB = 81.1"))
    grid = (
        "{lam: {start: 0, stop: 0.5, num: 3}, sigma: {start: 0, stop: 0.2, num: 3}, V: {values: [1, 5, 9]}}"
    )
    text = (
        f"bicycle: my bike.txt\ngrid: {grid}\nsweep: {{mB: [70.3, 81.1], delta: [0, 0.7]}}\noutput: my out\n"
    )
    Path("scan.yaml").write_text(text)
    bs.scan("scan.yaml")
    with bs.open_volume("my out") as volume:
        machines = [(family.bicycle, swept) for family, swept in families(volume)]
    for bicycle, swept in machines[1:4:2]:
        options = command_options(bicycle, "refined", swept)
        assert "my" not in options  # nor any path: whoever has the page has no files
        line = f"{shlex.quote(sys.executable)} -m bikestab vrange {options}"
        line += " --lam=0.31 --sigma=0.07 --json"
        done = subprocess.run(["sh", "-c", line], capture_output=True, text=True, check=True)
        found = json.loads(done.stdout)
        right = bs.stable_intervals(bicycle, lam=0.31, sigma=0.07)
        assert [[each["V1"], each["V2"]] for each in found["results"][0]["intervals"]] == [
            [V1, V2] for V1, V2 in zip(right.V1, right.V2, strict=True)
        ]
        assert "warning" not in done.stderr
