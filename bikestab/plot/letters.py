"""Pictures in fonts that have the letters of their texts."""

from __future__ import annotations

from matplotlib import font_manager
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import FixedFormatter

FONT = "DejaVu Sans"  # which comes with matplotlib
_MISSING = "\N{REPLACEMENT CHARACTER}"


def make_drawable(figure: Figure) -> None:
    """Give each text fonts that have its letters; one that no font has becomes one that says so."""
    axes = [axis for ax in figure.axes for axis in (ax.xaxis, ax.yaxis)]
    found = ((axis, axis.get_major_formatter()) for axis in axes)
    named = [(axis, formatter) for axis, formatter in found if isinstance(formatter, FixedFormatter)]
    texts = [text for text in figure.findobj(Text) if isinstance(text, Text)]
    names = [name for _, formatter in named for name in formatter.seq]
    used = "".join([*(text.get_text() for text in texts), *names])
    missing = set(used) - {"\n"} - _letters(font_manager.findfont(FONT), used)
    if not missing:
        return
    fonts = [FONT]
    for entry in font_manager.fontManager.ttflist:
        if entry.name not in fonts and (has := missing & _letters(entry.fname, "".join(missing))):
            fonts.append(entry.name)
            missing -= has
    none = str.maketrans(dict.fromkeys(missing, _MISSING))
    for axis, formatter in named:
        formatter.seq = [name.translate(none) for name in formatter.seq]
        texts += axis.get_ticklabels()
    for text in texts:
        text.set_text(text.get_text().translate(none))
        text.set_fontfamily(fonts)


def _letters(file: str, text: str) -> set[str]:
    """Those letters of the text that a font has."""
    try:
        font = font_manager.get_font(file)
        return {c for c in set(text) if c.isprintable() and font.get_char_index(ord(c))}
    except (OSError, RuntimeError):  # a file that is no font, or is no more
        return set()
