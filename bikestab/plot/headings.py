"""Titles of pictures and names in them: texts of any length, wrapped and cut."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import takewhile
from typing import Any

from matplotlib import font_manager
from matplotlib.axes import Axes
from matplotlib.text import Annotation

from bikestab.plot.letters import FONT
from bikestab.widths import columns, fitting

_ON_AN_INCH = 11.5  # of size 10 on an inch, on the mean
_LEFT = 0.7  # inches of numbers and a label to the left of axes
_ROWS = 2
_NAME = 40
ROW = 26  # columns of a name beside axes
_KEPT = "\N{NO-BREAK SPACE}"


def short(name: str) -> str:
    """A name on one line, without its middle where it is long."""
    name = " ".join(name.split())
    if columns(name) <= _NAME:
        return name
    return f"{fitting(name, _NAME // 2 - 1)}…{fitting(name[::-1], _NAME // 2 - 1)[::-1]}"


def in_rows(name: str) -> str:
    """The same beside axes, in two rows where it is long: of whole words, if these are about half of it."""
    name = short(name)
    if columns(name) <= ROW:
        return name
    first = fitting(name, ROW)
    cut = max(first.rfind(gap) for gap in (" ", "_", "-", "…", "/")) + 1
    first = first[:cut] if columns(name[cut:]) <= ROW else first
    return f"{first.rstrip()}\n{name[len(first) :].lstrip()}"


def set_title(ax: Axes, *lines: str, panels: int = 1, **options: Any) -> None:
    """Give axes, one of so many ``panels`` side by side, a title of lines, wrapped and cut after two rows.

    Words that fit a row are whole, quantities are not parted from value and unit, a minus is no hyphen.
    """
    figure: Any = ax.figure
    inches = figure.get_figwidth() / panels - max(0.0, _named_beside(ax) - _LEFT)
    rows = [row for line in lines for row in rows_of(line, inches)]
    ax.set_title("\n".join(rows), parse_math=False, **{"fontsize": 10, **options})


def _named_beside(ax: Axes) -> float:
    """How far names reach to the right of axes [inches]: a title is over the middle of these."""
    widths = [
        text_width(line, float(text.get_fontsize()))
        for text in ax.texts
        if isinstance(text, Annotation) and text.anncoords == "axes fraction" and text.xyann[0] > 1
        for line in text.get_text().split("\n")
    ]
    return max(widths, default=0.0)


def rows_of(line: str, inches: float) -> list[str]:
    """A line of a title in one or two rows of so many inches, as ``set_title`` has them."""
    width = int(_ON_AN_INCH * inches)
    line = re.sub(r"(?<![\w.)])-(?=\d)", "−", " ".join(line.split()))
    line = re.sub(
        r" = |(?<=\d) (?=[a-z])|(?<=[a-z]) (?=[a-z]+²)", lambda gap: gap[0].replace(" ", _KEPT), line
    )
    line = re.sub(r"\([^()]{1,30}\)", lambda words: words[0].replace(" ", _KEPT), line)
    words = [
        part for word in line.split(" ") for part in ([word] if columns(word) <= width else word.split(_KEPT))
    ]
    rows = _wrapped(words, width)
    if len(rows) <= _ROWS:  # nothing is cut: rows about as long as each other
        least = max([1, *(columns(word) for word in words if columns(word) <= width)])
        narrower = (_wrapped(words, less) for less in range(width, least - 1, -1))
        *_, rows = takewhile(lambda wrapped: len(wrapped) == len(rows), narrower)
    else:
        rows = [*rows[: _ROWS - 1], _cut(rows[_ROWS - 1], width)]
    return [row.replace(_KEPT, " ") for row in rows]


def _wrapped(words: Sequence[str], width: int) -> list[str]:
    """Rows of whole words, unless one is wider."""
    rows = [""]
    for word in words:
        rest = f"{rows[-1]} {word}" if rows[-1] else word
        if columns(word) <= width < columns(rest):
            rows.append(word)
            continue
        while columns(rest) > width:
            rows[-1] = fitting(rest, width) or rest[0]
            rest = rest[len(rows[-1]) :]
            rows.append("")
        rows[-1] = rest
    return [row.strip() for row in rows if row.strip()] or [""]


def _cut(row: str, width: int) -> str:
    """A row that others follow, with … in place of its last words where there is no room for it."""
    while columns(row) > width - 2:
        row = row.rpartition(" ")[0] or fitting(row, width - 2)
    return f"{row} …"


def text_width(text: str, size: float) -> float:
    """The width of a line of text [inches] in letters of so many points."""
    font = font_manager.get_font(font_manager.findfont(FONT))
    font.set_size(size, 72)
    font.set_text(text)
    return float(font.get_width_height()[0]) / 64 / 72
