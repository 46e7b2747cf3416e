"""The pictures in docs/images show what the library draws today."""

import importlib.util
import json
from pathlib import Path

import pytest
from PIL import Image

FOLDER = Path(__file__).parents[1] / "docs" / "images"


@pytest.fixture(scope="module")
def draw():
    spec = importlib.util.spec_from_file_location("draw", FOLDER / "draw.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_pictures_are_current(draw):
    """If this fails: python docs/images/draw.py, and look at the pictures."""
    names = set()
    for name, figure in draw.figures():
        names.add(name)
        with Image.open(FOLDER / name) as picture:
            held = json.loads(picture.text["contents"])
            assert picture.size == pytest.approx(draw.DPI * figure.get_size_inches(), abs=1), name
        now = json.loads(json.dumps(draw.contents(figure)))
        assert now["words"] == held["words"], name
        assert len(now["shown"]) == len(held["shown"]), name
        for new, old in zip(now["shown"], held["shown"], strict=True):
            words = [item for item in old if isinstance(item, str)]
            assert [item for item in new if isinstance(item, str)] == words, name
            assert new[len(words) :] == pytest.approx(old[len(words) :], rel=0.02, abs=0.01), (name, words)
    assert names == {path.name for path in FOLDER.glob("*.png")}


def test_pictures_are_small():
    assert sum(path.stat().st_size for path in FOLDER.glob("*.png")) < 500_000
