"""Axes of a single value: the same numbers as in a larger grid, and no pictures of what has no extent."""

from pathlib import Path

import numpy as np
import pytest

from bikestab import yamltext
from bikestab.config.file import parse_config
from bikestab.errors import InputError
from bikestab.export.volumes import export_intervals, export_mesh, export_skeleton
from bikestab.fields import AXES
from bikestab.pipeline import drawing, write_pictures
from bikestab.plot.slices import draw_slice
from bikestab.scan.run import run_scan
from bikestab.volume import Volume

VALUES = {"lam": [0.1, 0.2, 0.31], "sigma": [0.05, 0.08, 0.12], "V": [1, 4.5, 7]}


def pictures_of(config, path):
    with drawing(config) as pictures:
        return [picture.name for picture in write_pictures(config, path, pictures(), pytest.fail)]


def volume(single, slices=""):
    grid = {name: values[1:2] if name in single else values for name, values in VALUES.items()}
    text = yamltext.dumped({"bicycle": "meijaard2007", "grid": {k: {"values": v} for k, v in grid.items()}})
    config = parse_config(yamltext.parse(text + "fields: [stable, growth_rate]\n" + slices, "a.yaml"))
    return config, run_scan(config, force=True).path


@pytest.fixture(autouse=True)
def _here(in_an_empty_folder):
    pass


@pytest.mark.parametrize("single", [("lam",), ("sigma",), ("V",), AXES])
def test_the_numbers_of_a_larger_grid(single):
    with Volume(volume(())[1]) as large:
        at = tuple(slice(1, 2) if name in single else slice(None) for name in AXES)
        expected = {name: large.read(name)[at] for name in ("stable", "growth_rate")}
        ends = large.read("V1")[at[:2]]
    config, path = volume(single)
    assert pictures_of(config, path) == []
    with Volume(path) as opened:
        for name, values in expected.items():
            assert np.array_equal(opened.read(name), values)
        assert np.array_equal(opened.read("V1"), ends[..., : opened.read("V1").shape[-1]], equal_nan=True)
        assert export_intervals(opened, ["a.csv"]).intervals == int((opened.read("upper") > 0).sum())
        with pytest.raises(InputError, match=f"has one value of {single[0]} alone, and a mesh needs a range"):
            export_mesh(opened, ["a.ply"])
        if single[0] != "V":
            with pytest.raises(InputError, match="and the skeleton needs a range"):
                export_skeleton(opened, ["s.csv"])
        other = "sigma" if single[0] == "lam" else "lam"
        with pytest.raises(InputError, match=f"one value of {single[0]} alone, and a picture needs"):
            draw_slice(opened, other, VALUES[other][1])
    assert not Path("a.ply").exists()


def test_pictures_across_the_single_value():
    config, path = volume(("V",), "slices: [{V: 4.5}]\n")
    assert pictures_of(config, path) == ["slice_V_4.5.png"]
    with pytest.raises(InputError, match=r"slices\[0\]: a picture needs a range of V"):
        volume(("V",), "slices: [{lam: 0.2}]\n")
