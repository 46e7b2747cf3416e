"""What eigen tells: of all machines, and of one of them at one speed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from bikestab_cli.several import Chosen


class Answer(NamedTuple):
    """What is told of machines: words, and of each with a design its results; rows of a table, and a picture.

    ``ranges`` of a parameter are those of every machine, and None where no parameter varies.
    """

    text: str
    results: list[list[dict[str, Any]]]
    rows: Callable[[], tuple[Any, Any]]
    draw: Callable[[], Any]
    ranges: list[list[dict[str, Any]]] | None = None


class Shown(NamedTuple):
    """A machine at one speed: what was found, its records, words, and a table's columns and rows.

    ``ranges`` are of a parameter that varies.
    """

    machine: Chosen
    found: Any
    results: list[dict[str, Any]]
    text: str
    columns: Any
    blocks: Callable[[], Iterator[Any]]
    ranges: list[dict[str, Any]] = []  # noqa: RUF012  # nothing is added to it
