"""How results are told: JSON, and columns of text."""

from __future__ import annotations

import math
import sys
from collections.abc import Collection, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, Any

import click

from bikestab.files import to_stdout

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.records import Design

_LEAST = 8  # letters of a column of words
WIDTH = 80  # columns of a terminal, and of a column in print
DESIGN_HEAD = ["lam [rad]\nhead [°]", "sigma\ntrail [m]", "\noffset [m]"]


def print_json(value: object) -> None:
    """JSON on stdout; anything not finite has been turned into null or text before."""
    import json

    escaped = not getattr(sys.stdout, "shows", "utf-8").startswith("utf")
    click.echo(json.dumps(value, indent=2, ensure_ascii=escaped, allow_nan=False))


def tell_file(name: object, words: str = "") -> None:
    """Name a file that was written on stdout, or on stderr where the file itself went to stdout."""
    click.echo(f"{name}: {words}" if words else str(name), err=to_stdout(str(name)))


def table(head: Sequence[str], rows: Sequence[Sequence[str]], fold: int | None = None) -> str:
    """Columns of text, aligned to the right; the lines of a cell are stacked.

    The column ``fold`` is of words: aligned to the left, and wrapped to what the others leave of 80 columns.
    """
    cells = [[cell.split("\n") for cell in row] for row in (head, *rows)]
    widths = [max(len(line) for row in cells for line in row[i]) for i in range(len(head))]
    if fold is not None:
        widths[fold] = min(
            widths[fold], max(WIDTH - sum(widths) - 2 * (len(head) - 1) + widths[fold], _LEAST)
        )
        for row in cells:
            row[fold] = [part for line in row[fold] for part in _wrapped(line, widths[fold])]
    lines = []
    for row in cells:
        for parts in zip_longest(*row, fillvalue=""):
            shown = [
                t.ljust(w) if i == fold else t.rjust(w)
                for i, (t, w) in enumerate(zip(parts, widths, strict=True))
            ]
            lines.append("  ".join(shown).rstrip())
    return "\n".join(lines)


def _wrapped(line: str, width: int) -> list[str]:
    """A line in parts of at most ``width`` letters, broken behind blanks and slashes where there are some."""
    lines = [""]
    for word in line.replace("/", "/\0").replace(" ", " \0").split("\0") if len(line) > width else [line]:
        part = word
        while len(lines[-1] + part.rstrip()) > width:
            if not lines[-1]:
                lines[-1], part = part[:width], part[width:]
            lines.append("")
        lines[-1] += part
    return [text.rstrip() for text in lines]


def prose(text: str) -> str:
    """Lines of words, each wrapped to 80 columns, and indented where it goes on; no number is cut off."""
    import re
    import textwrap

    tied = re.sub(r" (?==|\.\.\.|m/s|rad|1/s|kg)|(?<==) |(?<=\.\.\.) ", "\N{NO-BREAK SPACE}", text)
    style: Any = {"subsequent_indent": "  ", "break_long_words": False, "break_on_hyphens": False}
    lines = (line if len(line) <= WIDTH else textwrap.fill(line, WIDTH, **style) for line in tied.split("\n"))
    return "\n".join(lines).replace("\N{NO-BREAK SPACE}", " ")


def certain(value: float, error: float | None, most: int = 12, style: str = "f") -> str:
    """A number with the digits that it has wherever it is within ``error``; at most ``most`` of them.

    These are digits behind the point, or in the style ``g`` all of them.
    """
    if error == 0:
        return f"{value:.{most}{style}}"
    if error is not None:
        low, high = math.nextafter(value - error, -math.inf), math.nextafter(value + error, math.inf)
        for digits in range(most, -1, -1):
            text = f"{low:.{digits}{style}}"
            if text == f"{high:.{digits}{style}}":
                return text
    return f"about {value:.6g}"


def letter_of(number: int) -> str:
    """A, B, ..., Z, AA, AB, ...: what stands for the machine of this number, from 0, in a table."""
    return (letter_of(number // 26 - 1) if number >= 26 else "") + chr(ord("A") + number % 26)


def within(value: float, letters: int) -> str:
    """A number in at most so many letters, of six digits where there is room for them."""
    texts = (f"{value:.{digits}g}" for digits in range(6, 0, -1))
    return next((text for text in texts if len(text) <= letters), f"{value:.1g}")


def design_columns(design: Design) -> list[str]:
    """λ and σ, and below them head angle, trail and fork offset, as they stand in every table."""
    return [
        f"{within(design['lam'], 9)}\n{design['head_angle_deg']:.3f}",
        f"{within(design['sigma'], 9)}\n{design['trail']:.4f}",
        f"\n{design['offset']:z.4f}",
    ]


def heading(bicycle: Bicycle, model: str, varied: Collection[str] = ()) -> str:
    """What every table is of; the damping only where it is not ``varied``."""
    context = click.get_current_context(silent=True)
    default = context and context.get_parameter_source("bicycle_name") == click.core.ParameterSource.DEFAULT
    whose = " (no --bicycle: the paper's)" if default else ""
    gains = "".join(f", {name} = {gain:g}" for name, gain in bicycle.gains if name not in varied)
    damping = "" if "delta" in varied else f", damping {bicycle.delta:g} kg m²/s"
    return f"{bicycle.name}, {model} model{damping}{gains}{whose}"


def count(number: int, what: str) -> str:
    """``1 point``, ``2 points``."""
    return f"{number} {what}{'' if number == 1 else 's'}"
