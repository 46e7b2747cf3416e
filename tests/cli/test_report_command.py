"""The command that writes the page, and what it refuses."""

from pathlib import Path

import pytest

import bikestab as bs
from bikestab.report.page import save_page

SMALL = ["grid.lam.num=7", "grid.sigma.num=6", "grid.V.num=9", "slices=[]", "fields=[stable]"]
CONFIG = Path("configs/quick.yaml").absolute()


def small(more):
    """The small scan with something else in place of what it would set twice."""
    return [*(text for text in SMALL if not text.startswith(more.partition("=")[0] + ".")), more]


@pytest.fixture(scope="module")
def volume(tmp_path_factory):
    output = tmp_path_factory.mktemp("page") / "small"
    bs.scan(CONFIG, [*SMALL, f"output={output}"])
    return output


def test_a_page_is_written_and_told(bikestab, volume):
    code, out, _ = bikestab("report", volume)
    assert code == 0
    assert out.startswith("report.html: ")
    text = Path("report.html").read_text("utf-8")
    assert text.startswith("<!doctype html>")
    assert 'id="lam"' in text


def test_machines_done_are_told(volume, tmp_path):
    told = []
    with bs.open_volume(volume) as opened:
        save_page([opened] * 3, tmp_path / "page.html", lambda *done: told.append(done))
    assert told == [(0, 3), (2, 3), (3, 3)]


def test_a_scan_writes_one_beside_its_pictures(bikestab):
    sets = [part for text in (*SMALL, "output=here") for part in ("--set", text)]
    code, out, _ = bikestab("scan", CONFIG, *sets, "--report", "--json")
    assert code == 0
    assert '"report": "here/report.html"' in out
    assert Path("here/report.html").stat().st_size > 2_000_000


@pytest.mark.parametrize(
    ("more", "key", "words"),
    [
        ("grid.lam.num=1", "grid.lam", ""),
        ("grid.sigma={values: [0.1]}", "grid.sigma", "one value alone"),
        ("sweep={delta: {start: 0, stop: 1, num: 25}}", "sweep", "25 machines"),
    ],
)
def test_a_scan_that_can_have_no_page_does_not_begin(bikestab, more, key, words):
    sets = [part for text in (*small(more), "output=here") for part in ("--set", text)]
    code, out, err = bikestab("scan", CONFIG, *sets, "--report")
    assert (code, out) == (2, "")
    assert key in err
    assert words in err
    assert not Path("here").exists()


def test_other_grids_feedback_and_sweeps_are_refused_before_a_scan(bikestab):
    text = CONFIG.with_name("steer_assist.yaml")
    for option in ("--report", "--certify"):
        code, _, err = bikestab("scan", text, "--set", "output=here", option)
        assert code == 2
        assert f"the grid is over k_phidot and k_deltadot, and {option} takes lam and sigma" in err
    axes = "lam: {values: [0.2, 0.3]}, sigma: {values: [0, 0.1]}, V: {values: [0, 9]}"
    grid = f"grid={{{axes}}}"
    sets = ["--set", grid, "--set", "slices=[]", "--set", "output=here"]
    code, _, err = bikestab("scan", text, *sets, "--certify")
    assert code == 2
    assert "has feedback, which --certify does not know" in err
    sets = ["--set", "sweep={delta: [0, 1]}", "--set", "output=here"]
    code, _, err = bikestab("scan", CONFIG, *sets, "--certify")
    assert code == 2
    assert "--certify takes one machine" in err
    assert not Path("here").exists()


def test_what_cannot_be_a_page_is_refused(bikestab, volume, tmp_path):
    code, _, err = bikestab("report", "nowhere", "-o", "page.html")
    assert code == 2
    assert "nowhere: there is no such volume" in err
    x, y = ("{name: m1, start: 60, stop: 90, num: 3}", "{name: delta, start: 0, stop: 1, num: 3}")
    loads = f"grid={{x: {x}, y: {y}, V: {{start: 1, stop: 9, num: 3}}}}"
    output = f"output={tmp_path / 'loads'}"
    bs.scan(CONFIG, [loads, "slices=[]", "bicycle=meijaard2007", "expect=[]", output])
    code, _, err = bikestab("report", tmp_path / "loads", "-o", "page.html")
    assert code == 2
    assert "has a grid over m1 and delta" in err
    assert "a sweep of a few values of m1 and delta" in err
    bs.scan(CONFIG, [*small("grid.V={values: [5]}"), f"output={tmp_path / 'one'}"])
    code, _, err = bikestab("report", tmp_path / "one", "-o", "page.html")
    assert code == 2
    assert "has one value of V alone, and a page needs a range" in err
    assert "such as grid.V: {start: ..., stop: ..., num: ...}" in err
    assert not Path("page.html").exists()
