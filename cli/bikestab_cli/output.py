"""How results are told: JSON, and columns of text."""

from __future__ import annotations

import math
import sys
from collections.abc import Collection, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING

import click
from bikestab_cli.streams import visible

from bikestab.files import to_stdout
from bikestab.widths import columns

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.records import Design

_LEAST = 8  # letters of a column of words
_LONG = 1e7  # numbers from there on are scientific
WIDTH = 80  # columns of a terminal, and of a column in print
DESIGN_HEAD = ["lam [rad]\nhead [°]", "sigma\ntrail [m]", "\noffset [m]"]


def print_json(value: object) -> None:
    """JSON on stdout; anything not finite has been turned into null or text before."""
    import json

    escaped = not getattr(sys.stdout, "shows", "utf-8").startswith("utf")
    click.echo(json.dumps(value, indent=2, ensure_ascii=escaped, allow_nan=False))


def as_read(name: str, value: float, unit: str) -> tuple[float, str]:
    """A parameter's value and unit as tables have them: a head angle in degrees, as beside every tilt."""
    return (math.degrees(value), "°") if name == "head_angle" else (value, unit)


def span_read(name: str, low: float, high: float, unit: str) -> str:
    """A range as it is read."""
    (low, shown), (high, _) = as_read(name, low, unit), as_read(name, high, unit)
    return f"{low:.6g} ... {high:.6g} {shown}".removesuffix(" 1")


def tell(text: str, *files: str | None) -> None:
    """Print what was found on stdout, or on stderr where one of the ``files`` goes to stdout."""
    click.echo(text, err=any(to_stdout(name) for name in files if name))


def tell_file(name: object, words: str = "") -> None:
    """Name a file that was written on stdout, or on stderr where the file itself went to stdout."""
    click.echo(f"{name}: {words}" if words else str(name), err=to_stdout(str(name)))


def table(head: Sequence[str], rows: Sequence[Sequence[str]], fold: int | None = None) -> str:
    """Columns of text, aligned to the right; the lines of a cell are stacked.

    The column ``fold`` is of words: aligned to the left, and wrapped to what the others leave of 80 columns.
    """
    cells = [[_as_shown(cell).split("\n") for cell in row] for row in (head, *rows)]
    widths = [max(columns(line) for row in cells for line in row[i]) for i in range(len(head))]
    if fold is not None:
        widths[fold] = min(
            widths[fold], max(WIDTH - sum(widths) - 2 * (len(head) - 1) + widths[fold], _LEAST)
        )
        for row in cells:
            row[fold] = [part for line in row[fold] for part in _wrapped(line, widths[fold])]
    lines = []
    for row in cells:
        for parts in zip_longest(*row, fillvalue=""):
            blanks = [" " * (w - columns(t)) for t, w in zip(parts, widths, strict=True)]
            shown = [
                t + b if i == fold else b + t for i, (t, b) in enumerate(zip(parts, blanks, strict=True))
            ]
            lines.append("  ".join(shown).rstrip())
    return "\n".join(lines)


def _as_shown(text: str) -> str:
    """The text as stdout will show it: its spelling for a terminal without these letters is longer."""
    return getattr(sys.stdout, "spelt", str)(visible(text))


def _wrapped(line: str, width: int, behind: str = " /", indent: str = "") -> list[str]:
    """A line in parts of at most ``width`` columns, broken after a letter ``behind``, else anywhere.

    All but the first are indented.
    """
    if columns(line) <= width:
        return [line]
    for letter in behind:
        line = line.replace(letter, letter + "\0")
    lines = [""]
    for word in line.split("\0"):
        part = word
        while columns(lines[-1] + part.rstrip()) > width:
            if lines[-1].strip():
                lines.append(indent)
                continue
            room = next(
                n for n in range(len(part), 0, -1) if n == 1 or columns(lines[-1] + part[:n]) <= width
            )
            lines[-1], part = lines[-1] + part[:room], part[room:]
            lines.append(indent)
        lines[-1] += part
    return [text.rstrip() for text in lines if text.strip()]


def prose(text: str) -> str:
    """Lines of words, each wrapped to 80 columns, and indented where it goes on; no number is cut off."""
    import re

    tied = re.sub(r" (?==|\.\.\.|m/s|m[²^]|rad|1/s|kg)|(?<==) |(?<=\.\.\.) ", "\xa0", _as_shown(text))
    lines = (part for line in tied.split("\n") for part in _wrapped(line, WIDTH, " ", "  "))
    return "\n".join(lines).replace("\xa0", " ")  # a space that does not break


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


def within(value: float, letters: int) -> str:
    """A number in at most so many letters, of six digits where there is room for them."""
    texts = (f"{value:z.{digits}g}" for digits in range(6, 0, -1))
    return next((text for text in texts if len(text) <= letters), f"{value:z.1g}")


def decimals(value: float, digits: int, least: float = 0.0) -> str:
    """A number with so many digits behind the point, or scientific where that is long or tells nothing of it.

    Below ``least`` it is zero.
    """
    size = abs(value)
    if size >= _LONG:
        return f"{value:.{digits}e}"
    return f"{value:.2e}" if least < size < 10.0 ** (1 - digits) else f"{value:z.{digits}f}"


def aligned(values: Sequence[float], letters: int) -> list[str]:
    """Numbers in at most so many letters: with one number of digits behind the point, up to six, if they can.

    They cannot where the largest of them would have fewer than four digits; then they are scientific.
    """
    if not any(values) or max(map(abs, values)) >= 1e-3:
        for digits in range(6, 2, -1):
            texts = [f"{value:z.{digits}f}" for value in values]
            if max(map(len, texts)) <= letters:
                return texts
    powers = [[f"{value:.{digits}e}" for digits in (2, 1, 0)] for value in values]
    return [
        next(text for text in texts if len(text) <= letters) if value else "0"
        for value, texts in zip(values, powers, strict=True)
    ]


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


def heading_of_all(bicycles: Sequence[Bicycle], model: str, varied: Collection[str] = ()) -> str:
    """What a table of several machines is of; damping where there is any, and it is not ``varied``."""
    deltas = [f"{each.delta:g}" for each in bicycles]
    if "delta" in varied or not any(each.delta for each in bicycles):
        return f"{model} model"
    if len({*deltas}) == 1:
        return f"{model} model, damping {deltas[0]} kg m²/s"
    return f"{model} model, damping in this order {', '.join(deltas)} kg m²/s"


def count(number: int, what: str) -> str:
    """``1 point``, ``2 points``."""
    return f"{number} {what}{'' if number == 1 else 's'}"
