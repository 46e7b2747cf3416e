"""How results are told: JSON, and columns of text."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from bikestab.files import to_stdout

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.records import Design

DESIGN_HEAD = ["lam [rad]", "head [°]", "sigma", "trail [m]", "offset [m]"]


def print_json(value: object) -> None:
    """JSON on stdout; anything not finite has been turned into null or text before."""
    import json

    escaped = not getattr(sys.stdout, "shows", "utf-8").startswith("utf")
    click.echo(json.dumps(value, indent=2, ensure_ascii=escaped, allow_nan=False))


def tell_file(name: object, words: str = "") -> None:
    """Name a file that was written on stdout, or on stderr where the file itself went to stdout."""
    click.echo(f"{name}: {words}" if words else str(name), err=to_stdout(str(name)))


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Columns of text, aligned to the right."""
    widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    lines = ("  ".join(cell.rjust(w) for cell, w in zip(row, widths, strict=True)) for row in (head, *rows))
    return "\n".join(line.rstrip() for line in lines)


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


def design_columns(design: Design) -> list[str]:
    """λ, head angle, σ, trail and fork offset as they stand in every table."""
    return [
        f"{design['lam']:.6g}",
        f"{design['head_angle_deg']:.3f}",
        f"{design['sigma']:.6g}",
        f"{design['trail']:.4f}",
        f"{design['offset']:z.4f}",
    ]


def heading(bicycle: Bicycle, model: str) -> str:
    """What every table is of."""
    context = click.get_current_context(silent=True)
    default = context and context.get_parameter_source("bicycle_name") == click.core.ParameterSource.DEFAULT
    whose = " (the paper's bicycle, as no --bicycle is given)" if default else ""
    return f"{bicycle.name}, {model} model, damping {bicycle.delta:g} kg m²/s{whose}"


def count(number: int, what: str) -> str:
    """``1 point``, ``2 points``."""
    return f"{number} {what}{'' if number == 1 else 's'}"
