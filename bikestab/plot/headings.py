"""Titles of pictures: texts of any length and script, wrapped, cut, in fonts that have their letters."""

from __future__ import annotations

import textwrap
from typing import Any

from matplotlib import font_manager
from matplotlib.axes import Axes

_WIDTH = 85  # letters of size 10 across a picture
_ROWS = 2
_NAME = 40
_MISSING = "\N{REPLACEMENT CHARACTER}"
_FONT = "DejaVu Sans"  # which comes with matplotlib


def short(name: str) -> str:
    """A name on one line, without its middle where it is long."""
    name = " ".join(name.split())
    half = _NAME // 2 - 1
    return name if len(name) <= _NAME else f"{name[:half]}…{name[-half:]}"


def set_title(ax: Axes, *lines: str, **options: Any) -> None:
    """Give a picture the title of these lines, each of which is wrapped, and cut after two rows."""
    rows = [row for line in lines for row in _rows(line)]
    text, fonts = _drawable("\n".join(rows))
    options = {"fontsize": 10, **options}
    ax.set_title(text, parse_math=False, fontfamily=fonts, **options)


def _rows(line: str) -> list[str]:
    return textwrap.wrap(line, _WIDTH, max_lines=_ROWS, placeholder=" …") or [""]


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
