"""Titles of pictures: texts of any length and script, wrapped, cut, in fonts that have their letters."""

from __future__ import annotations

import re
import textwrap
from itertools import takewhile
from typing import Any

from matplotlib import font_manager
from matplotlib.axes import Axes

_ON_AN_INCH = 11.5  # of size 10 on an inch, on the mean
_ROWS = 2
_NAME = 40
_MISSING = "\N{REPLACEMENT CHARACTER}"
_KEPT = "\N{NO-BREAK SPACE}"
_FONT = "DejaVu Sans"  # which comes with matplotlib


def short(name: str) -> str:
    """A name on one line, without its middle where it is long."""
    name = " ".join(name.split())
    half = _NAME // 2 - 1
    return name if len(name) <= _NAME else f"{name[:half]}…{name[-half:]}"


def set_title(ax: Axes, *lines: str, panels: int = 1, **options: Any) -> None:
    """Give axes, one of so many ``panels`` side by side, a title of lines, wrapped and cut after two rows.

    Words that fit a row are whole, quantities are not parted from value and unit, a minus is no hyphen.
    """
    figure: Any = ax.figure
    rows = [row for line in lines for row in _rows(line, int(_ON_AN_INCH * figure.get_figwidth() / panels))]
    text, fonts = _drawable("\n".join(rows))
    options = {"fontsize": 10, **options}
    ax.set_title(text, parse_math=False, fontfamily=fonts, **options)


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
    font = font_manager.get_font(font_manager.findfont(_FONT))
    font.set_size(size, 72)
    font.set_text(text)
    return float(font.get_width_height()[0]) / 64 / 72


def _drawable(text: str) -> tuple[str, list[str]]:
    """The text, and the fonts in which it is drawn; a letter that no font has becomes one that says so."""
    fonts = [_FONT]
    missing = {c for c in text if c != "\n"} - _letters(font_manager.findfont(_FONT), text)
    for entry in font_manager.fontManager.ttflist if missing else ():
        if entry.name not in fonts and (has := missing & _letters(entry.fname, "".join(missing))):
            fonts.append(entry.name)
            missing -= has
    return "".join(_MISSING if c in missing else c for c in text), fonts


def _letters(file: str, text: str) -> set[str]:
    """Those letters of the text that a font has."""
    try:
        font = font_manager.get_font(file)
        return {c for c in text if c.isprintable() and font.get_char_index(ord(c))}
    except (OSError, RuntimeError):  # a file that is no font, or is no more
        return set()
