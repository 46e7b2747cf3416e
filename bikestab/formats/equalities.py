"""Text of lines ``key = value +/- standard deviation``, as BicycleParameters has it → numbers by key.

Blanks, order, blank lines and what follows a ``#`` are free. Several values behind commas are repeated
measurements: their mean counts, with the standard deviation of the mean of independent ones, as in
BicycleParameters. ``pi/10`` and the like are understood, and one header such as ``[bicycle]`` (INI).
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

from bikestab.errors import InputError
from bikestab.units import dimension_of, in_its_unit, shown, united

_KEY = re.compile(r"[A-Za-z_][\w.]*")
_PLUS_MINUS = re.compile(r"\+/-|\+-|±")
_FLOAT = re.compile(r"[-+]?(?:(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?|nan|inf)", re.ASCII | re.IGNORECASE)
_WHOLE = re.compile(r"[-+]?\d+", re.ASCII)
TEXTS = ("name", "source")  # which also stand in remarks, as bikestab writes them
_REMARK = re.compile(rf"# ({'|'.join(TEXTS)}): (\S.*)")
_EXAMPLE = "a line is 'key = value', or 'key = value +/- standard deviation'"


class Measured(NamedTuple):
    """A value as in the file (text where it is no number), its standard deviation, and its line."""

    value: float | str
    deviation: float
    line: int


@dataclass(frozen=True)
class Equalities:
    """The entries of such a text, by key, the name of its file, and what is told of the machine in TEXTS."""

    file: str
    entries: dict[str, Measured]
    texts: dict[str, str]

    def located(self, error: InputError) -> InputError:
        """The same error with this file, and the line of its key, in front."""

        def place(mistake: InputError) -> str:
            entry = self.entries.get(str(mistake.key[0])) if mistake.key else None
            return f"{self.file}, line {entry.line}" if entry else self.file

        return error.each(lambda mistake: mistake.at(place(mistake)))

    @property
    def values(self) -> dict[str, float | str]:
        """The values alone."""
        return {key: entry.value for key, entry in self.entries.items()}

    @property
    def deviations(self) -> dict[str, float]:
        """The standard deviations that are not zero."""
        return {key: entry.deviation for key, entry in self.entries.items() if entry.deviation}


def looks_like(text: str) -> bool:
    """Whether the first line that says something is such an entry."""
    for line in text.splitlines():
        if line.strip() and not line.lstrip().startswith(("#", "[", ";")):
            return _entry(line) is not None
    return False


def _entry(line: str) -> tuple[str, str] | None:
    """Key and value of a line; None where it is no such entry."""
    key, sign, value = (part.strip() for part in line.partition("#")[0].partition("="))
    return (key, value) if sign and _KEY.fullmatch(key) else None


def parse(text: str, file: str) -> Equalities:
    """The entries of a text; InputError names file, line and key."""
    entries: dict[str, Measured] = {}
    texts: dict[str, str] = {}
    for number, line in enumerate(text.splitlines(), 1):
        stripped = line.strip()
        if remark := _REMARK.fullmatch(stripped):
            texts.setdefault(remark[1], remark[2])
        if not stripped or stripped[0] in "#;" or re.fullmatch(r"\[\w+\]", stripped):
            continue
        place = f"{file}, line {number}"
        entry = _entry(line)
        if not entry:
            raise InputError(f"{shown(stripped)} has no '='", place=place, hint=_EXAMPLE)
        key, value = entry
        if key in TEXTS:
            texts[key] = value
            continue
        if key in entries:
            problem = f"given twice, first in line {entries[key].line}"
            raise InputError(problem, key=(key,), place=place, hint="keep one of them")
        try:
            entries[key] = Measured(*mean(value, key), number)
        except InputError as error:
            raise error.at(place) from None
    return Equalities(file, entries, texts)


def mean(text: str, key: str) -> tuple[float | str, float]:
    """The mean of values behind commas, and its standard deviation; InputError, with the key, for none."""
    parts = text.split(",")
    for before, after in pairwise(parts):
        if _one_number(before, after):
            problem = f"{shown(text.strip())} has a decimal comma, or several values without a blank between"
            hint = f"write {before.strip()}.{after.strip()}, or for the mean of two {before.strip()}, {after}"
            raise InputError(problem, key=(key,), hint=hint)
    pairs = [_measured(part, key) for part in parts]
    if len(pairs) == 1:
        return pairs[0]
    numbers = []
    for value, _ in pairs:
        if isinstance(value, str):
            raise InputError(f"{shown(value)} is not a number", key=(key,), hint=_EXAMPLE)
        numbers.append(value)
    deviation = math.sqrt(math.fsum(sd * sd for _, sd in pairs)) / len(pairs)
    return math.fsum(numbers) / len(numbers), deviation


def _one_number(before: str, after: str) -> bool:
    """Whether a comma between these is a decimal one: ``85,5``, ``85,5 +/- 0.5`` or ``85 +/- 0,5``."""
    first, second = _PLUS_MINUS.split(before), _PLUS_MINUS.split(after)
    digits = (
        _WHOLE.fullmatch(first[-1].lstrip())
        and second[0][:1].isdigit()
        and _WHOLE.fullmatch(second[0].rstrip())
    )
    return bool(digits) and min(len(first), len(second)) == 1


def _measured(text: str, key: str) -> tuple[float | str, float]:
    parts = [part.strip() for part in _PLUS_MINUS.split(text)]
    if len(parts) > 2:
        raise InputError(f"{shown(text)} has more than one ±", key=(key,), hint=_EXAMPLE)
    value = _number(parts[0])
    if len(parts) == 1:
        return (parts[0] if value is None else value), 0.0
    deviation = _number(parts[1])
    if value is None or deviation is None:
        both = united(parts)
        value, deviation = map(in_its_unit, both)
        if value is None or deviation is None or dimension_of(both[0]) != dimension_of(both[1]):
            raise InputError(f"{shown(text)} is not two numbers", key=(key,), hint=_EXAMPLE)
        parts = both
    if not (math.isfinite(value) and 0 <= deviation < math.inf):
        hint = "allowed: a finite number +/- a finite one that is not negative"
        raise InputError(f"{shown(text)} is not a measured value", key=(key,), hint=hint)
    return (value if _number(parts[0]) is not None else parts[0]), deviation


def _number(text: str) -> float | None:
    """A number, or a product or quotient of numbers and pi; None for anything else."""
    text = text.strip()
    result = -1.0 if text.startswith("-") else 1.0
    first, *rest = re.split("([*/])", text[1:] if text.startswith(("-", "+")) else text)
    for operator, factor in zip(("*", *rest[::2]), (first, *rest[1::2]), strict=True):
        factor = factor.strip()
        if factor != "pi" and not _FLOAT.fullmatch(factor):
            return None
        value = math.pi if factor == "pi" else float(factor)
        if operator == "/" and value == 0:
            return None
        result = result * value if operator == "*" else result / value
    return result
