"""The exceptions of the library; the command line turns them into messages and exit codes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager

KEPT = "what is finished is kept; the same command goes on from there"
NOT_KEPT = "no part of it was finished"
_LINES = 3  # of a message
_MOST = 160  # characters of such a line


class BikestabError(Exception):
    """Root of everything this library raises on purpose."""


class InputError(BikestabError):
    """Something the user gave cannot be used.

    ``key`` is the path of the offending value inside its document, e.g. ``("grid", "lam", "num")``;
    ``place`` says where the document is, e.g. ``"scan.yaml, line 7"``; ``hint`` says what is allowed.
    ``others`` are more mistakes that were found along with it.
    """

    others: tuple[InputError, ...] = ()

    def __init__(
        self, problem: str, *, key: Sequence[str | int] = (), hint: str = "", place: str = ""
    ) -> None:
        super().__init__(problem)
        self.problem, self.key, self.hint, self.place = problem, tuple(key), hint, place

    def at(self, place: str = "", *, under: Sequence[str | int] = ()) -> InputError:
        """The same mistake told of at ``place``, with its key ``under`` another.

        One that has a place already stays as it is: its key is a key of that document.
        """
        return self.each(
            lambda mistake: (
                mistake
                if mistake.place
                else InputError(mistake.problem, key=(*under, *mistake.key), hint=mistake.hint, place=place)
            )
        )

    @property
    def mistakes(self) -> tuple[InputError, ...]:
        """All of them, each alone."""
        alone = InputError(self.problem, key=self.key, hint=self.hint, place=self.place)
        return (alone, *self.others) if self.others else (self,)

    def each(self, change: Callable[[InputError], InputError]) -> InputError:
        """The same mistakes, each of them changed."""
        return together([change(mistake) for mistake in self.mistakes])

    def renamed(self, names: Mapping[str, str]) -> InputError:
        """The same mistakes with other names for some parts of their keys."""
        return self.each(
            lambda mistake: InputError(
                mistake.problem,
                key=[names.get(str(part), part) for part in mistake.key],
                hint=mistake.hint,
                place=mistake.place,
            )
        )

    def __str__(self) -> str:
        if self.others:
            return "\n".join(_packed(self.mistakes))
        return f"{self._head}\n{self.hint}" if self.hint else self._head

    @property
    def _head(self) -> str:
        return ": ".join(part for part in (self.place, dotted(self.key), self.problem) if part)


class Mistakes:
    """Mistakes that are found one after another and told of together."""

    def __init__(self) -> None:
        self.found: list[InputError] = []

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Keep what the block raises, and go on behind it."""
        try:
            yield
        except InputError as error:
            self.found += error.mistakes

    def tell(self) -> None:
        """Raise them as one InputError, if there are any."""
        if self.found:
            raise together(self.found)


def together(mistakes: Sequence[InputError]) -> InputError:
    """One error with all these mistakes, each without others; there is at least one."""
    first, *others = mistakes
    if not others:
        return first
    error = InputError(first.problem, key=first.key, hint=first.hint, place=first.place)
    error.others = tuple(others)
    return error


def _packed(mistakes: Sequence[InputError]) -> list[str]:
    """Three lines: a mistake each, and where the others are if there are more."""
    lines, file = [], ""
    for mistake in mistakes:
        here, _, _ = mistake.place.rpartition(", line ")
        head = mistake._head
        if here and here == file:  # which is named already
            head = head.removeprefix(f"{file}, ")
        file = here
        lines.append("; ".join(part for part in (head, mistake.hint) if part))
    if len(lines) <= _LINES:
        return lines
    shown = _LINES - 1
    more = [
        " ".join(part for part in (line.partition(": ")[0], dotted(mistake.key)) if part)
        for line, mistake in zip(lines[shown:], mistakes[shown:], strict=True)
    ]
    named = [name for i, name in enumerate(more) if len(", ".join(more[: i + 1])) < _MOST]
    rest = ", ..." if len(named) < len(more) else ""
    return [*lines[:shown], f"and {len(more)} more: {', '.join(named)}{rest}"]


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
    known = list(known)
    near = similar(word, {name: name for name in known})
    return f"did you mean {near!r}?" if near else f"known: {', '.join(known)}"


def similar(word: str, known: Mapping[str, str]) -> str:
    """What stands at the known word nearest to ``word``; empty where none is near."""
    import difflib  # only a mistake needs it

    folded = {name.casefold(): meant for name, meant in known.items()}
    match = difflib.get_close_matches(word.casefold(), folded, n=1, cutoff=0.6)
    return folded[match[0]] if match else ""
