"""Titles of any length and script."""

import warnings

import pytest
from matplotlib.figure import Figure
from wcwidth import wcswidth

from bikestab.plot.files import save
from bikestab.plot.headings import _ON_AN_INCH, rows_of, set_title, short


def rows_in(line, columns):
    """What fits so many columns; those of an inch are the module's own."""
    return rows_of(line, (columns + 0.5) / _ON_AN_INCH)


def drawn(tmp_path, *lines):
    figure = Figure(figsize=(7.4, 5.2), layout="constrained")
    ax = figure.add_subplot()
    set_title(ax, *lines)
    with warnings.catch_warnings(action="error"):
        save(figure, tmp_path / "a.png")
        save(figure, tmp_path / "a.pdf")
    return ax.get_title()


def test_short_titles_stay():
    assert short("meijaard2007") == "meijaard2007"
    assert 39 <= len(short("long " * 1000)) <= 40


def test_rows(tmp_path):
    title = drawn(tmp_path, "word " * 1000, "second")
    assert [len(row) <= 85 for row in title.split("\n")] == [True] * 3
    assert title.split("\n")[1].endswith(" …")
    assert title.endswith("\nsecond")
    assert drawn(tmp_path, "", "second") == "\nsecond"
    assert len(drawn(tmp_path, "a" * 1000).split("\n")) <= 2


@pytest.mark.parametrize("text", ["$x$", "a $\\frac{1", "$$", "100 % \\alpha_{", "50 $ and 60 $"])
def test_dollars_are_no_formulas(tmp_path, text):
    assert drawn(tmp_path, text) == text


def test_any_script(tmp_path):
    assert drawn(tmp_path, "Велосипед λ = 18°") == "Велосипед λ = 18°"
    title = drawn(tmp_path, "a\x07b 日本 \U0001f6b2 \u202e\udc80 \U0010ffff c")
    assert title.startswith("a\N{REPLACEMENT CHARACTER}b ")
    assert title.endswith("\N{REPLACEMENT CHARACTER} c")


def test_words_that_fit_a_row_stay_whole():
    name = "meijaard2007_with_child_and_two_bags_90"
    assert short(name) == name
    rows = rows_in(f"{name}: eigenvalues at 5 m/s", 60)
    assert rows == [f"{name}:", "eigenvalues at 5 m/s"]
    assert rows_in("a (head angle 72.0000000 degrees) b", 30) == ["a (head angle", "72.0000000 degrees) b"]
    assert rows_in("one two-three four", 12) == ["one", "two-three …"]
    assert rows_in("a" * 100, 60) == ["a" * 50] * 2


@pytest.mark.parametrize("columns", range(8, 60, 7))
@pytest.mark.parametrize(
    "name", ["自転車の安定性を調べるための標準的な二輪車モデル", "自転車 " * 9, "ae\u0301" * 30]
)
def test_rows_are_as_wide_as_letters_are(name, columns):
    rows = rows_in(f"{name}: eigenvalues at 5 m/s", columns)
    assert len(rows) <= 2
    assert max(map(wcswidth, rows)) <= columns
    told = "".join(rows).removesuffix(" …").replace(" ", "")
    assert f"{name}: eigenvalues at 5 m/s".replace(" ", "").startswith(told)
