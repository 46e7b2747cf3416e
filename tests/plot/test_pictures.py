"""The pictures of a scan, as a function of its config and its volume."""

import pytest

from bikestab import pipeline, yamltext
from bikestab.config.file import parse_config
from bikestab.plot import region
from bikestab.scan.run import run_scan

CONFIG = """\
bicycle: meijaard2007
grid:
  lam: {start: 0.1, stop: 0.5, num: 4}
  sigma: {start: 0.03, stop: 0.13, num: 4}
  V: {start: 0, stop: 9, num: 4}
sweep: {delta: [0, 2]}
slices: [{lam: 0.2}]
output: OUT
"""


def draw(config, path, tell):
    with pipeline.drawing(config) as pictures:
        return pipeline.write_pictures(config, path, pictures(), tell)


@pytest.fixture
def scan(tmp_path):
    config = parse_config(yamltext.parse(CONFIG.replace("OUT", str(tmp_path)), "a.yaml"))
    return config, run_scan(config).path


def test_of_each_machine(scan, tmp_path):
    told = []
    drawn = draw(*scan, told.append)
    assert told == []
    assert [path.name for path in drawn] == [
        f"{kind}_delta_{value}.png" for value in (0, 2) for kind in ("region", "slice_lam_0.2")
    ]
    assert set(drawn) == set(tmp_path.glob("*.png"))


def test_what_is_not_drawn_is_told(scan, monkeypatch):
    def broken(volume):
        raise ValueError("no such luck")

    told = []
    monkeypatch.setattr(region, "draw_region", broken)
    assert len(draw(*scan, told.append)) == 2
    assert [words.split(" (")[1] for words in told] == ["ValueError: no such luck); please report this"] * 2
    monkeypatch.setattr(pipeline, "MOST_DRAWN", 1)
    told.clear()
    assert draw(*scan, told.append) == []
    assert told[0].startswith("note: pictures of 2 machines are not drawn")
