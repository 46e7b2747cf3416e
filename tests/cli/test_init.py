"""bikestab init: which bicycle the config names, and its uncertainties."""

import os
from pathlib import Path

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.config.file import load_config
from bikestab.presets import preset_names, preset_text


@pytest.mark.parametrize(
    "given", ["mine.yaml", "./mine.yaml", "deep/../mine.yaml", "{here}/mine.yaml", "./sharp1971"]
)
def test_init_names_the_same_bicycle_from_everywhere(bikestab, monkeypatch, given):
    """Not the one of that name beside the config, nor a preset, nor what is in the current folder later."""
    here = Path.cwd()
    Path("deep").mkdir()
    Path("other").mkdir()
    for path, mass in ((given.format(here=here), 91), ("deep/mine.yaml", 92), ("other/mine.yaml", 93)):
        Path(path).write_text(preset_text("meijaard2007").replace("mB: 85", f"mB: {mass}"), "utf-8")
    assert bikestab("init", "deep/a.yaml", "--bicycle", given.format(here=here))[0] == 0
    assert bikestab("init", "b.yaml", "--bicycle", given.format(here=here))[0] == 0
    for folder in (here, here / "deep", here / "other"):
        monkeypatch.chdir(folder)
        assert load_config(here / "deep/a.yaml").machine.m1 == 93
        assert load_config(os.path.relpath(here / "b.yaml")).machine.m1 == 93
    moved = here / "other/b.yaml"
    moved.write_text((here / "b.yaml").read_text())
    monkeypatch.chdir(here)
    if given != "./sharp1971":  # a path from the config's folder, never from the current one
        assert load_config(moved).machine.m1 == 95


@pytest.mark.parametrize("name", preset_names())
def test_what_a_config_expects_holds_once_uncommented(bikestab, name):
    """Of the chosen bicycle's own design where it has one; and no more than it is."""
    assert bikestab("init", "mine.yaml", "--bicycle", name)[0] == 0
    text = Path("mine.yaml").read_text("utf-8")
    start = text.index("# expect:")
    Path("mine.yaml").write_text(
        text[:start] + text[start:].replace("# expect", "expect").replace("#   -", "  -"), "utf-8"
    )
    code, out, err = bikestab("check", "mine.yaml")
    assert (code, err, out.count("holds")) == (0, "", 1)
    assert f"this is what {name} has now" in text
    Path("mine.yaml").write_text(Path("mine.yaml").read_text("utf-8").replace("V1: ", "V1: 1"), "utf-8")
    assert bikestab("check", "mine.yaml")[0] == 1


def test_init_with_uncertainties(bikestab):
    lines = [
        f"{name} = {value!r}+/-{abs(value) / 100!r}\n"
        for name, value in Bicycle.preset("meijaard2007").given.items()
    ]
    Path("measured.txt").write_text("".join(lines))
    code, _, err = bikestab("init", "mine.yaml", "--bicycle", "measured.txt", "--uncertain")
    assert (code, err) == (0, "")
    config = load_config("mine.yaml")
    drawn = {name: one.normal for name, one in config.ensemble.parameters.items()}
    fixed = {"IByy", "IHyy"}  # which are in no equation
    assert drawn == {k: (v, abs(v) / 100) for k, v in config.bicycle.given.items() if k not in fixed}
    code, out, err = bikestab("init", "b.yaml", "--bicycle", "meijaard2007", "--uncertain")
    assert (code, out) == (2, "")
    assert "the bicycle 'meijaard2007' has no uncertainties to draw" in err


def test_uncertain_radii_of_both_wheels(bikestab):
    numbers = Bicycle.preset("dikarev1981").numbers()
    lines = [f"{k}: {v}\n" for k, v in numbers.items() if v is not None and k not in ("R1", "R2")]
    Path("radii.yaml").write_text("".join(lines) + 'R: "0.35 +/- 0.01"\n', "utf-8")
    assert bikestab("init", "mine.yaml", "--bicycle", "radii.yaml", "--uncertain")[0] == 0
    config = load_config("mine.yaml")
    assert {k: v.normal for k, v in config.ensemble.parameters.items()} == dict.fromkeys(
        ("R1", "R2"), (0.35, 0.01)
    )
    assert config.ensemble.pairs == {("R1", "R2"): pytest.approx(1)}
    radii = config.ensemble.drawn
    np.testing.assert_allclose(radii["R1"], radii["R2"], rtol=1e-12)
    code, text, err = bikestab("convert", "radii.yaml")
    assert (code, text.count("0.35 +/- 0.01")) == (0, 2)
    assert "note: correlations of the uncertainties cannot be written; left out\n" in err


def test_a_missing_folder_is_made(bikestab):
    assert bikestab("init", "sub/deep/mine.yaml") == (
        0, "sub/deep/mine.yaml; now 'bikestab scan sub/deep/mine.yaml'\n", "",
    )  # fmt: skip
    assert load_config("sub/deep/mine.yaml").machine.name == "dikarev1981"
    Path("file").write_text("")
    code, out, err = bikestab("init", "file/mine.yaml")
    assert (code, out) == (2, "")
    assert err.startswith("error: file/mine.yaml: cannot be written")
    code, _, err = bikestab("init", "other/mine.yaml", "--bicycle", "none.yaml")
    assert code == 2
    assert not Path("other").exists()
