"""How wide texts are, in terminals and in pictures: in columns, each of one Latin letter."""

from __future__ import annotations

from itertools import accumulate


def columns(text: str) -> int:
    """How many columns a line takes: letters of East Asia two, accents apart none."""
    return len(text) if text.isascii() else sum(map(_wide, text))


def fitting(text: str, most: int) -> str:
    """As much of the start of a text as takes so many columns."""
    return text[:most] if text.isascii() else text[: sum(at <= most for at in accumulate(map(_wide, text)))]


def _wide(letter: str) -> int:
    from unicodedata import combining, east_asian_width  # most texts are of ASCII alone

    return 0 if combining(letter) else 1 + (east_asian_width(letter) in "WF")
