"""A scan asked for in Python does what the command does."""

import shutil
from pathlib import Path

import pytest
from bikestab_cli.main import cli
from click.testing import CliRunner

import bikestab as bs
from bikestab.config.file import load_config

SMALL = ["grid.lam.num=5", "grid.sigma.num=5", "grid.V.num=5"]


@pytest.fixture(autouse=True)
def configs(tmp_path, in_an_empty_folder):
    shutil.copytree(Path(__file__).parents[1] / "configs", tmp_path / "configs")


def test_same_files_as_the_command():
    done = bs.scan("configs/quick.yaml", [*SMALL, "output=out/here"])
    words = [word for override in SMALL for word in ("--set", override)]
    result = CliRunner().invoke(cli, ["scan", "configs/quick.yaml", *words, "--set", "output=out/there"])
    assert result.exit_code == 0
    assert [p.as_posix() for p in done.pictures] == ["out/here/region.png", "out/here/slice_lam_0.2.png"]
    for picture in done.pictures:
        assert picture.read_bytes() == Path("out/there", picture.name).read_bytes()
    with done.open() as here, bs.open_volume("out/there") as there:
        for name in ("stable", "violated", "growth_rate", "V1", "V2", "lower", "upper"):
            assert here.read(name).tobytes() == there.read(name).tobytes()
        assert done.stable_points == here.read("stable").sum()
    assert done.computed
    assert done.points == 125


def test_again_and_progress():
    seen = []
    config = load_config("configs/quick.yaml", [*SMALL, "slices=[]"])
    first = bs.scan(config, progress=lambda done, points: seen.append((done, points)))
    assert seen[-1] == (125, 125)
    again = bs.scan(config)
    assert (first.computed, again.computed) == (True, False)
    assert again.stable_points == first.stable_points
    assert bs.scan(config, force=True).computed


def test_mistakes_name_the_file():
    with pytest.raises(bs.InputError, match=r"configs/quick.yaml: grid.lam.num"):
        bs.scan("configs/quick.yaml", ["grid.lam.num=5000000000"])
    with pytest.raises(bs.InputError, match="there is no such file"):
        bs.scan("configs/quik.yaml")


def test_what_would_not_be_heeded_is_refused():
    config = load_config("configs/quick.yaml", SMALL)
    with pytest.raises(bs.InputError, match="overrides are for a file"):
        bs.scan(config, ["output=elsewhere"])
    with pytest.raises(bs.InputError, match="give one of them"):
        bs.scan(config, jobs=2, scheduler="local:2")


def test_what_is_not_drawn_is_a_warning(monkeypatch):
    monkeypatch.setattr("bikestab.pipeline.MOST_DRAWN", 1)
    with pytest.warns(UserWarning, match="pictures of 2 machines are not drawn"):
        done = bs.scan("configs/quick.yaml", [*SMALL, "sweep={delta: [0, 1]}"])
    assert done.pictures == ()
