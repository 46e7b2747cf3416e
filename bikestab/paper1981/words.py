"""Numbers, intervals and tables in the words of the report."""

from __future__ import annotations

import string
from collections.abc import Sequence
from typing import Any, Protocol

from bikestab.paper1981.one_design import Interval

Tables = dict[str, str]  # Markdown by the name that the texts have for it


class Ends(Protocol):
    """V1 and V2 [m/s] of an interval; without an upper limit V2 is None, without speeds both."""

    @property
    def V1(self) -> float | None: ...
    @property
    def V2(self) -> float | None: ...


class Words(string.Formatter):
    """Formats numbers with a true minus, ``3p`` as percent with three significant digits, None as –."""

    def format_field(self, value: Any, format_spec: str) -> str:
        if value is None:
            return "–"
        if isinstance(value, str):
            return value
        if format_spec.endswith("p"):
            return f"{100 * value:.{format_spec[:-1]}g} %".replace("-", "−")
        return format(value, format_spec).replace("-", "−")

    def get_field(self, field_name: str, args: Any, kwargs: Any) -> Any:
        """As usual, but what is inside of nothing is nothing: a report without it still reads."""
        try:
            return super().get_field(field_name, args, kwargs)
        except (IndexError, TypeError):
            return None, field_name
        except AttributeError as error:
            if error.obj is not None:
                raise
            return None, field_name


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def number(value: float | None, spec: str) -> str:
    """One number in the format of ``Words``."""
    return Words().format_field(value, spec)


def listed(values: Sequence[Any]) -> str:
    """Values with commas between them."""
    return ", ".join(value if isinstance(value, str) else f"{value:g}" for value in values)


def from_delta(delta: float | None) -> str:
    """From which δ on, or never."""
    return "never" if delta is None else f"{delta:.3g}"


def ranges(found: Sequence[Sequence[float]]) -> str:
    """Ranges of λ or σ."""
    joined: list[list[str]] = []
    for low, high in ([f"{end:.6g}" for end in ends] for ends in found):
        if joined and joined[-1][1] == low:  # the gap between is too narrow to print
            joined[-1][1] = high
        else:
            joined.append([low, high])
    return ", ".join(" … ".join(ends) for ends in joined) or "none"


def interval(V1: float | None, lower: str | None, V2: float | None, upper: str | None) -> str:
    """One interval with the names of its ends."""
    end = "unbounded" if V2 is None else f"{number(V2, '.4f')} ({upper})"
    return f"{number(V1, '.4f')} ({lower}) … {end}"


def intervals(found: Sequence[Interval], between: str = "; ") -> str:
    """All intervals of a design."""
    return between.join(interval(i.V1, i.lower, i.V2, i.upper) for i in found) or "none"


def short_interval(ends: Ends) -> str:
    """One interval without names."""
    if ends.V1 is None:
        return "none"
    return f"{number(ends.V1, '.3f')} … {'unbounded' if ends.V2 is None else number(ends.V2, '.3f')}"


def complex_number(value: Sequence[float]) -> str:
    """An eigenvalue [real, imaginary]."""
    real, imaginary = value
    sign = "+" if imaginary > 0 else "−"
    return number(real, ".4g") + (f" {sign} {abs(imaginary):.4g} i" if imaginary else "")
