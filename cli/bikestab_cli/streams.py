"""What a terminal gets: no control characters of files, nothing that it cannot show, no line without end."""

from __future__ import annotations

import codecs
import io
import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO

import click
from bikestab_cli.messages import cut, folded

_HIDDEN = re.compile(  # controls but tab and newline, what changes the direction of text, halves of pairs
    "[\0-\b\v\f\x0e-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]|\r(?!\n)"
)
_SPELT = {
    "λ": "lam", "σ": "sigma", "δ": "delta", "κ": "kappa", "°": " deg", "−": "-", "–": "-", "…": "...",
    "±": "+-", "≤": "<=", "≥": ">=", "²": "^2", "³": "^3", "₁": "1", "₂": "2", "→": "->", "’": "'",
    "×": "x",
}  # fmt: skip


def visible(text: str) -> str:
    """With an escape such as ``\\u001b`` for each control character."""
    return _HIDDEN.sub(_escape, text)


def tell_error(message: str, hint: str = "") -> None:
    """One message on stderr, of at most three lines."""
    click.echo("\n".join(folded(visible(f"error: {message}"), hint)), err=True)


def _escape(match: re.Match[str]) -> str:
    return f"\\u{ord(match[0]):04x}"


def _spelt(error: UnicodeError) -> tuple[str, int]:
    """An error handler: characters that an encoding lacks in letters of ASCII."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = error.object[error.start : error.end]
    return "".join(_SPELT.get(c) or c.encode("ascii", "backslashreplace").decode() for c in text), error.end


codecs.register_error("bikestab", _spelt)


class Visible:
    """A text stream that shows what it is given, as far as its encoding goes, and hides none of it."""

    encoding = "utf-8"  # of what it takes: click would else write UTF-8 to a terminal of ASCII
    errors = "strict"

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream
        self.shows = (getattr(stream, "encoding", None) or "utf-8").lower()

    def write(self, text: str) -> int:
        return self.as_it_is(visible(text))

    def spelt(self, text: str) -> str:
        """The text in letters that the stream can show."""
        return (
            text if self.shows.startswith("utf") else text.encode(self.shows, "bikestab").decode(self.shows)
        )

    def as_it_is(self, text: str) -> int:
        """Write control characters too."""
        return self.stream.write(self.spelt(text))

    def __getattr__(self, name: str) -> Any:
        return getattr(self.stream, name)


class Messages(Visible):
    """The same for stderr: long lines are cut, and nobody need be listening."""

    def write(self, text: str) -> int:
        return super().write("\n".join(cut(line) for line in visible(text).split("\n")))

    def as_it_is(self, text: str) -> int:
        with suppress(OSError):
            return super().as_it_is(text)
        return len(text)

    def flush(self) -> None:
        with suppress(OSError):
            self.stream.flush()


@contextmanager
def visible_streams() -> Iterator[None]:
    """Let stdout and stderr be such streams, also where the caller closed them.

    What is written to a closed stdout fails; no file that is opened later takes the number of either.
    """
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDONLY)  # which takes the lowest number that is free
    before = sys.stdout, sys.stderr
    sys.stdout = Visible(before[0] or io.TextIOWrapper(io.FileIO(1, "w", closefd=False)))
    if sys.stderr is not None:
        sys.stderr = Messages(before[1])
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before
