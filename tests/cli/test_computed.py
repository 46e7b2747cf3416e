"""The bicycle of a volume is that of its config: notation, uncertainties and name."""

from pathlib import Path

import pytest

import bikestab as bs
from bikestab.computed import computed_bicycle

GRID = "{lam: {values: [0.1, 0.3]}, sigma: {values: [0.05, 0.08]}, V: {values: [3, 5]}}"
PRESET = bs.Bicycle.preset("meijaard2007")


def scanned(bicycle, more=""):
    Path("scan.yaml").write_text(f"bicycle: {bicycle}\ngrid: {GRID}\noutput: out\n{more}", "utf-8")
    bs.scan("scan.yaml")
    return "out"


@pytest.fixture(autouse=True)
def in_a_folder(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)


def measured():
    Path("mine.txt").write_text(
        "\n".join(f"{key} = {value!r} +/- 0.01" for key, value in PRESET.given.items() if key != "lam")
        + f"\nlam = {PRESET.given['lam']!r}\n"
    )
    return "mine.txt"


def test_a_preset_and_its_damping():
    found = computed_bicycle(scanned("meijaard2007", "delta: 1.5 N m s\n"))
    assert found == PRESET.with_delta(1.5)
    assert found.given == {**PRESET.given, "delta": 1.5}
    assert found.replaced({"c": 0.07}) == PRESET.replaced({"c": 0.07, "delta": 1.5})


def test_parameters_in_place():
    text = ", ".join(f"{key}: {value!r}" for key, value in PRESET.replaced({"mB": 81}).given.items())
    found = computed_bicycle(scanned(f"{{name: mine, {text}}}"))
    assert (found.name, found.given) == ("mine", PRESET.replaced({"mB": 81}).given)


def test_a_sweep_s_is_that_of_the_config():
    assert computed_bicycle(scanned("meijaard2007", "sweep: {mB: [60, 100]}\n")).given["mB"] == 85


def test_a_file_while_it_is_there_and_the_same(monkeypatch, tmp_path):
    out = scanned(measured())
    found = computed_bicycle(out)
    assert (found.name, found.given) == ("mine", PRESET.given)
    assert found.deviations["mB"] == 0.01
    Path("mine.txt").write_text(Path("mine.txt").read_text().replace("mB = 85", "mB = 84"))
    changed = computed_bicycle(out)
    Path("mine.txt").unlink()
    lost = computed_bicycle(out)
    for one in (changed, lost):
        assert one.name == "mine (two parts)"
        assert "only the two parts are known" in one.notes[0]
        assert (one.bodies, one.numbers()) == (None, PRESET.numbers())


def test_commands_take_it(bikestab, tmp_path):
    scanned("meijaard2007")
    for command in (
        ["vrange", "--set", "mB=60"], ["vrange", "--set", "c=0.07"], ["sensitivity"],
    ):  # fmt: skip
        words = [command[0], "--bicycle"]
        there = bikestab(*words, "out", *command[1:])
        assert there == bikestab(*words, "meijaard2007", *command[1:])
    assert bikestab("convert", "out/volume.h5") == bikestab("convert", "meijaard2007")
    assert bikestab("bicycles", "out", "-o", "a.png")[0] == 0
    code, _, err = bikestab("init", "x.yaml", "--bicycle", "out/volume.h5")
    assert (code, "bikestab convert writes its bicycle" in err) == (2, True)
