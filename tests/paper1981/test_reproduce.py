"""The report: every number in it is in its data, and its files are complete."""

import json
import math
import re

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.model import characteristic_table
from bikestab.paper1981 import reproduce as module
from bikestab.paper1981.box import LAM, SIGMA, V
from bikestab.paper1981.plot_sections import ARROW, oriented
from bikestab.paper1981.report import key_number, rendered
from bikestab.region.section import Section, edge_curves
from bikestab.routh import CONDITIONS, stable
from tests.small import TINY, study

# what is no number of the study: formulas, names such as V1 or C2°, references and years, links, units
NOT_NUMBERS = [
    r"(?m)^    .*$", r"\]\([^)]*\)",
    r"\((?:1981|2007)\)", r"\((?:1\.2|1\.4|2\.2)\)", r"\bfigure 3\b", r"## Figure 3",
    r"1/s\b", r"1/V", r"rad m/s", r"(?:Conclusion|conclusion) [1-4]", r"[pVcAabBCDRmlhαΔ]_?\d°?(?:/c)?",
]  # fmt: skip
NUMBER = re.compile(r"(?<![\w.^])[−-]?\d+(?:\.\d+)?(?:e[−-]?\d+)?")


@pytest.fixture(scope="module")
def text():
    return rendered(study())


def values(data):
    """Every number in the data, also those within its texts and keys."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield from values(key)
            yield from values(value)
    elif isinstance(data, list | tuple):
        for value in data:
            yield from values(value)
    elif isinstance(data, str):
        yield from (float(found.replace("−", "-")) for found in re.findall(r"[−-]?\d+(?:\.\d+)?", data))
    elif isinstance(data, int | float) and not isinstance(data, bool):
        yield float(data)


def test_every_number_is_in_the_data(text):
    assert foreign(text) == []
    assert len(NUMBER.findall(text)) > 500


def test_a_foreign_number_is_noticed(text):
    assert foreign(f"{text} It is 3.9172 m/s, or 61.87 %.") == ["3.9172", "61.87"]


def foreign(text):
    """The numbers of a text that are no rounding of any in the data."""
    known = np.array(sorted({abs(value) for value in values(study())}))
    known = np.concatenate([known, 100 * known])  # percent
    for pattern in NOT_NUMBERS:
        text = re.sub(pattern, " ", text)
    found = []
    for number in NUMBER.findall(text):
        digits = number.replace("−", "-").lstrip("-")
        mantissa, _, power = digits.partition("e")
        half = 0.5001 * 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))
        if np.abs(known - float(digits)).min() > half:
            found.append(number)
    return found


def test_the_report_is_complete(text):
    for part in study()["conclusions"].values():
        assert f"**Verdict: {part['verdict']}.**" in text
        assert part["claim"] in text
    for name in module.FIGURES:
        assert f"]({name})" in text
    assert "{" not in text
    assert "None" not in text
    assert not re.search(r"\b(nan|inf)\b", text)
    tables = [line for line in text.splitlines() if line.startswith("|")]
    assert len(tables) > 60
    for anchor in re.findall(r"\]\(#([\w-]+)\)", text):
        headings = {h.strip("# ").lower().replace(" ", "-") for h in text.splitlines() if h.startswith("#")}
        assert anchor in headings


def test_the_data_are_finite_json():
    def check(value):
        if isinstance(value, dict):
            for part in value.values():
                check(part)
        elif isinstance(value, list | tuple):
            for part in value:
                check(part)
        else:
            assert value is None or isinstance(value, str | bool | int | float), type(value)
            assert not isinstance(value, float) or math.isfinite(value)

    check(study())
    assert json.loads(json.dumps(study(), allow_nan=False))["bikestab"]


def test_key_numbers():
    assert [bool(re.search(r"\d", key_number(study(), str(n)))) for n in (1, 2, 3, 4)] == [True] * 4


@pytest.mark.parametrize("fixed", ["lam", "sigma"])
@pytest.mark.parametrize("name", ["hurwitz3", "p0"])
def test_ticks_are_on_the_stable_side(fixed, name):
    """Beside the points of each oriented curve: stable at its left, not at its right."""
    value = {"lam": 0.2, "sigma": 0.12}[fixed]
    section = Section(Family(Bicycle.preset("dikarev1981")), fixed, value)
    ends = {"lam": LAM, "sigma": SIGMA, "V": V}
    width, height = (ends[axis][1] for axis in section.axes)
    for x, y in edge_curves(section, name, np.linspace(0, width, 161), np.linspace(0, height, 161)):
        for points in ((x, y), (x[::-1], y[::-1])):
            a, b = oriented(section, CONDITIONS, *points)
            along = np.diff(a) / width, np.diff(b) / height
            length = np.maximum(np.hypot(*along), 1e-12)
            middle = 0.5 * (a[1:] + a[:-1]), 0.5 * (b[1:] + b[:-1])
            normal = -1e-3 * width * along[1] / length, 1e-3 * height * along[0] / length
            left, right = (
                stable(*section.table_and_speed(middle[0] + s * normal[0], middle[1] + s * normal[1]))
                for s in (1, -1)
            )
            assert left.mean() > 0.9
            assert right.mean() < 0.1


def test_the_arrow_points_into_the_region():
    start, tip = ARROW
    for (lam, sigma, speed), expected in ((start, False), (tip, True)):
        table = characteristic_table(Bicycle.preset("dikarev1981"), lam, sigma)
        assert bool(stable(table, speed)) is expected
    assert start[:2] == tip[:2]  # the arrow's head is drawn for a vertical one


@pytest.fixture
def quick_figures(monkeypatch):
    """The figures are looked at by people; here they only have to be written."""
    monkeypatch.setattr(module, "study", lambda bicycle, size, progress: study())
    monkeypatch.setattr(module, "_figures", lambda data, size: ((name, Figure()) for name in module.FIGURES))


def test_files(tmp_path, quick_figures):
    data = module.reproduce(tmp_path / "a" / "b", size=TINY)
    names = {path.name for path in (tmp_path / "a" / "b").iterdir()}
    assert names == {*module.FIGURES, "report.json", "report.md"}
    written = json.loads((tmp_path / "a" / "b" / "report.json").read_text("utf-8"))
    assert written == json.loads(json.dumps(data))


def test_no_report_without_the_rest(tmp_path, quick_figures, monkeypatch):
    def full(figure, path):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module, "save", full)
    with pytest.raises(Exception, match="No space left"):
        module.reproduce(tmp_path, size=TINY)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_a_file(tmp_path):
    (tmp_path / "here").touch()
    with pytest.raises(InputError, match="cannot be written"):
        module.reproduce(tmp_path / "here")


def test_figures_are_drawn():
    found = dict(module._figures(study(), TINY))
    assert set(found) == set(module.FIGURES)
    left, right = found["figure3.png"].axes[:2]
    assert len(left.lines) > 12
    assert len(right.lines) > 12
    words = [t.get_text() for t in found["refinement.png"].findobj(Text)]
    assert "no stable motion in this box" in words
