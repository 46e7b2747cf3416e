"""Titles of pictures and names in them: texts of any length, wrapped and cut."""

from __future__ import annotations

import re
import textwrap
from itertools import accumulate, takewhile
from typing import Any
from unicodedata import east_asian_width

from matplotlib import font_manager
from matplotlib.axes import Axes

from bikestab.plot.letters import FONT

_ON_AN_INCH = 11.5  # of size 10 on an inch, on the mean
_ROWS = 2
_NAME = 40
ROW = 26  # columns of a name beside axes
_KEPT = "\N{NO-BREAK SPACE}"


def short(name: str) -> str:
    """A name on one line, without its middle where it is long."""
    name = " ".join(name.split())
    if columns(name) <= _NAME:
        return name
    return f"{_first(name, _NAME // 2 - 1)}…{_first(name[::-1], _NAME // 2 - 1)[::-1]}"


def in_rows(name: str) -> str:
    """The same beside axes, in two rows where it is long: of whole words, if these are about half of it."""
    name = short(name)
    if columns(name) <= ROW:
        return name
    first = _first(name, ROW)
    cut = max(first.rfind(gap) for gap in (" ", "_", "-", "…", "/")) + 1
    first = first[:cut] if columns(name[cut:]) <= ROW else first
    return f"{first.rstrip()}\n{name[len(first) :].lstrip()}"


def columns(text: str) -> int:
    """How wide a text is in letters; those of East Asia are two."""
    return sum(_wide(letter) for letter in text)


def _wide(letter: str) -> int:
    return 1 + (not letter.isascii() and east_asian_width(letter) in "WF")


def _first(text: str, most: int) -> str:
    """As much of a text as fits so many columns."""
    return text[: sum(at <= most for at in accumulate(map(_wide, text)))]


def set_title(ax: Axes, *lines: str, panels: int = 1, **options: Any) -> None:
    """Give axes, one of so many ``panels`` side by side, a title of lines, wrapped and cut after two rows.

    Words that fit a row are whole, quantities are not parted from value and unit, a minus is no hyphen.
    """
    figure: Any = ax.figure
    rows = [row for line in lines for row in _rows(line, int(_ON_AN_INCH * figure.get_figwidth() / panels))]
    ax.set_title("\n".join(rows), parse_math=False, **{"fontsize": 10, **options})


def _rows(line: str, width: int) -> list[str]:
    line = re.sub(r"(?<![\w.)])-(?=\d)", "−", " ".join(line.split()))
    line = re.sub(
        r" = |(?<=\d) (?=[a-z])|(?<=[a-z]) (?=[a-z]+²)", lambda gap: gap[0].replace(" ", _KEPT), line
    )
    line = re.sub(r"\([^()]{1,30}\)", lambda words: words[0].replace(" ", _KEPT), line)
    words = line.split(" ")
    line = " ".join(word if len(word) <= width else word.replace(_KEPT, " ") for word in words)
    rows = _wrapped(line, width, max_lines=_ROWS, placeholder=" …")
    if len(_wrapped(line, width)) == len(rows):  # nothing is cut: rows about as long as each other
        least = max([1, *(len(word) for word in line.split(" ") if len(word) <= width)])
        narrower = (_wrapped(line, less) for less in range(width, least - 1, -1))
        *_, rows = takewhile(lambda wrapped: len(wrapped) == len(rows), narrower)
    return [row.replace(_KEPT, " ") for row in rows] or [""]


def _wrapped(line: str, width: int, **options: Any) -> list[str]:
    """Rows of whole words, unless one is wider."""
    return textwrap.wrap(line, width, break_on_hyphens=False, **options)


def text_width(text: str, size: float) -> float:
    """The width of a line of text [inches] in letters of so many points."""
    font = font_manager.get_font(font_manager.findfont(FONT))
    font.set_size(size, 72)
    font.set_text(text)
    return float(font.get_width_height()[0]) / 64 / 72
