"""The exceptions of the library; the command line turns them into messages and exit codes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

KEPT = "what is finished is kept; the same command goes on from there"
NOT_KEPT = "no part of it was finished"


class BikestabError(Exception):
    """Root of everything this library raises on purpose."""


class InputError(BikestabError):
    """Something the user gave cannot be used.

    ``key`` is the path of the offending value inside its document, e.g. ``("grid", "lam", "num")``;
    ``place`` says where the document is, e.g. ``"scan.yaml, line 7"``; ``hint`` says what is allowed.
    """

    def __init__(
        self, problem: str, *, key: Sequence[str | int] = (), hint: str = "", place: str = ""
    ) -> None:
        super().__init__(problem)
        self.problem, self.key, self.hint, self.place = problem, tuple(key), hint, place

    def at(self, place: str = "", *, under: Sequence[str | int] = ()) -> InputError:
        """The same mistake told of at ``place``, with its key ``under`` another.

        One that has a place already stays as it is: its key is a key of that document.
        """
        if self.place:
            return self
        return InputError(self.problem, key=(*under, *self.key), hint=self.hint, place=place)

    def __str__(self) -> str:
        head = ": ".join(part for part in (self.place, dotted(self.key), self.problem) if part)
        return f"{head}\n{self.hint}" if self.hint else head


class ScanError(BikestabError):
    """The computation or its output could not be finished."""


class WorkersLost(ScanError):
    """Whoever computed is gone; the scan can go on from what is finished."""


def dotted(key: Sequence[str | int]) -> str:
    """``("slices", 0, "lam")`` → ``slices[0].lam``."""
    text = ""
    for part in key:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else part
    return text


def nearest(word: str, known: Iterable[str]) -> str:
    """A hint that names the known word nearest to ``word``, or all of them where none is near."""
    import difflib  # only a mistake needs it

    known = list(known)
    folded = {k.casefold(): k for k in known}
    match = difflib.get_close_matches(word.casefold(), folded, n=1, cutoff=0.6)
    if match:
        return f"did you mean {folded[match[0]]!r}?"
    return f"known: {', '.join(known)}"
