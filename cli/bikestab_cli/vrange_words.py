"""Stable speeds in words and tables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from bikestab_cli.output import (
    DESIGN_HEAD,
    WIDTH,
    as_read,
    certain,
    design_columns,
    heading,
    heading_of_all,
    prose,
    table,
)
from bikestab_cli.several import Chosen, digits_of

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.design.spread import Spread
    from bikestab.model import Model
    from bikestab.region.answers import Answer

_HEAD = [*DESIGN_HEAD, "V1 [m/s]", "V2 [m/s]"]
_FEWER = 9  # digits behind the point where machines stand beside them
_DIGITS = 6  # of a value, or as many as tell it from the others
_FEWEST = 3  # where parameters have long names


class Found(NamedTuple):
    """A machine, its designs' stable speeds, and how far they are known where that is asked for.

    Or the ``problem`` why it has no designs, where it is one of several.
    """

    machine: Chosen
    answers: list[Answer]
    spreads: list[Spread]
    problem: str = ""


def told_one(found: Found, model: Model, single: bool) -> str:
    """The table of one machine, what is open in it, and what would help a ``single`` unstable design."""
    from bikestab_cli.spread_words import known_lines

    machine, answers, spreads, _ = found
    changed = f" ({machine.changes})" if machine.set else ""
    parts = [prose(heading(machine.bicycle, model) + changed) + "\n", table(_HEAD, _rows(answers, 12))]
    notes = [f"marginal at {_design(each)}: {each['reason']}" for each in answers if each["marginal"]]
    for answer, known in zip(answers, spreads, strict=False):
        lines = known_lines(known)
        notes += lines if single else [f"{_design(answer)}: {'; '.join(lines)}"]
    if single and answers[0]["nearest"]:
        notes.append("\n" + _advice(answers[0], machine.bicycle, model))
    return "\n".join([*parts, *map(prose, notes)])


def told_all(found: list[Found], model: Model) -> str:
    """One table of several machines, and what is open in it."""
    from bikestab_cli.spread_words import known_lines

    rows, notes = [], []
    for machine, answers, spreads, problem in found:
        lines = _rows(answers, _FEWER) or [["", "", "", problem.replace(" of its own", "\nof its own"), ""]]
        rows += [[machine.stacked if i == 0 else "", *line] for i, line in enumerate(lines)]
        open_ = [(answer, f"marginal: {answer['reason']}") for answer in answers if answer["marginal"]]
        known = [
            (answer, "; ".join(known_lines(each))) for answer, each in zip(answers, spreads, strict=False)
        ]
        notes += [f"{machine.words} at {_design(answer)}: {text}" for answer, text in (*open_, *known)]
        notes += [
            f"{machine.words}: {_short_advice(answer, machine.bicycle, model)}"
            for answer in answers
            if answer["nearest"]
        ]
    return "\n".join(
        [
            prose(heading_of_all([each.machine.bicycle for each in found], model, found[0].machine.set))
            + "\n",
            table(["machine", *_HEAD], rows, fold=0),
            *map(prose, notes),
        ]
    )


def told_over(
    machine: Chosen,
    points: Sequence[tuple[dict[str, float], Answer]],
    model: Model,
    spreads: Sequence[Spread],
) -> str:
    """The table of values of parameters: these, what else a frame is measured by, and the stable speeds."""
    from bikestab_cli.spread_words import known_lines

    from bikestab.variants import parameter_of

    named = [parameter_of(machine.bicycle, name) for name in points[0][0]]
    values = {name: [point[name] for point, _ in points] for name in points[0][0]}
    told_apart = max(_DIGITS, digits_of(values))
    places = [", ".join(f"{n} = {_value(n, x, told_apart)}" for n, x in point.items()) for point, _ in points]
    notes = [
        f"marginal at {place}: {answer['reason']}"
        for place, (_, answer) in zip(places, points, strict=True)
        if answer["marginal"]
    ]
    notes += [
        f"{place}: {'; '.join(known_lines(known))}" for place, known in zip(places, spreads, strict=False)
    ]
    units = [as_read(p.name, 0.0, p.unit)[1] for p in named]
    names = [p.name.replace("_per_V", "\n_per_V") for p in named]
    head = [f"{name}\n[{unit}]".removesuffix("\n[1]") for name, unit in zip(names, units, strict=True)]
    changed = f" ({machine.changes})" if machine.set else ""
    for digits in range(_FEWER, _FEWEST - 1, -1):
        told = table([*head, *_HEAD], _rows_over(points, digits, told_apart))
        if max(map(len, told.split("\n"))) <= WIDTH:
            break
    text = [prose(heading(machine.bicycle, model, points[0][0]) + changed) + "\n", told]
    return "\n".join([*text, *map(prose, notes)])


def _value(name: str, value: float, digits: int) -> str:
    return f"{as_read(name, value, '')[0]:.{digits}g}"


def _rows_over(
    points: Sequence[tuple[dict[str, float], Answer]], digits: int, told_apart: int
) -> list[list[str]]:
    rows = []
    for point, answer in points:
        values = [_value(name, value, told_apart) for name, value in point.items()]
        for row in _rows([answer], digits):
            narrow = (
                row if digits == _FEWER else [cell.replace("stable speed", "stable\nspeed") for cell in row]
            )
            rows.append([*values, *narrow])
            values = [""] * len(values)
    return rows


def _design(answer: Answer) -> str:
    return f"λ = {answer['lam']:.6g}, σ = {answer['sigma']:.6g}"


def _rows(answers: list[Answer], digits: int) -> list[list[str]]:
    rows = []
    for result in answers:
        design = design_columns(result)
        for interval in result["intervals"]:
            V1 = f"{certain(interval['V1'], interval['V1_error'], digits)}\n{interval['lower']}"
            V2 = interval["upper"]
            if interval["V2"] is not None:
                V2 = f"{certain(interval['V2'], interval['V2_error'], digits)}\n{V2}"
            rows.append([*design, V1, V2])
            design = [""] * len(design)
        if not result["intervals"]:
            rows.append([*design, "no stable speed", ""])
    return rows


class _Nearest(NamedTuple):
    """The nearest designs with a stable speed, rounded so that they can be typed in; empty or None: none.

    ``sigma`` are those above and below, and ``lam`` from where to where.
    """

    sigma: tuple[str, str]
    lam: tuple[str, str] | None


def _rounded(answer: Answer, bicycle: Bicycle, model: Model) -> _Nearest:
    from bikestab.family import Family
    from bikestab.region.nearest import rounded

    family = Family(bicycle, model)
    nearest: Any = answer["nearest"]  # read by computed keys
    lam, sigma = answer["lam"], answer["sigma"]

    def trail(key: str, way: int) -> str:
        there = nearest[key] is not None
        return rounded(lambda value: family.exact_table(lam, value), nearest[key], way) if there else ""

    def tilt(key: str, way: int) -> str:
        return rounded(lambda value: family.exact_table(value, sigma), nearest[key], way)

    tilts = None if nearest["lam_min"] is None else (tilt("lam_min", 1), tilt("lam_max", -1))
    return _Nearest((trail("sigma_min", 1), trail("sigma_max", -1)), tilts)


def _advice(answer: Answer, bicycle: Bicycle, model: Model) -> str:
    """What would help, and what was searched for it."""
    from bikestab.region.nearest import V_MAX, searched

    nearest: Any = answer["nearest"]
    lam_range, sigma_range = searched(answer["lam"], answer["sigma"])
    found = _rounded(answer, bicycle, model)
    trails = [
        f"σ = {text} {side} (trail {float(text) * bicycle.c:.4f} m)"
        if text
        else f"none {'searched ' if answer['sigma'] == end else ''}{side}"
        for text, side, end in zip(found.sigma, ("above", "below"), sigma_range[::-1], strict=True)
    ]
    angles = "none"
    if found.lam:
        angles = "λ = {} ... {} rad".format(*found.lam)
        angles += " (head angle {:.2f} ... {:.2f}°)".format(*(90 - math.degrees(float(x)) for x in found.lam))
        if limits := [f"{end:g}" for end in lam_range if end in (nearest["lam_min"], nearest["lam_max"])]:
            angles += f", at least: the search ends at {' and '.join(limits)}"
    lines = [
        f"nearest stable speed at this λ: {', '.join(trails)}",
        f"nearest stable speed at this σ: {angles}",
        f"searched: σ = {_span(sigma_range)}, λ = {_span(lam_range)} rad, V = 0 ... {V_MAX:g} m/s",
    ]
    if nearest["V"] is not None:
        lines.append(
            f"least unstable at {nearest['V']:.3f} m/s, where it grows at {nearest['growth_rate']:.4g} 1/s"
        )
    return "\n".join(lines)


def _short_advice(answer: Answer, bicycle: Bicycle, model: Model) -> str:
    """The same in a line."""
    nearest: Any = answer["nearest"]
    found = _rounded(answer, bicycle, model)
    trails = " or ".join(filter(None, found.sigma))
    helps = [f"σ = {trails} at this λ"] if trails else []
    helps += ["λ = {} ... {} rad at this σ".format(*found.lam)] if found.lam else []
    words = f"nearest stable: {', '.join(helps)}" if helps else "no λ or σ alone helps"
    return words if nearest["V"] is None else f"{words}; least unstable at {nearest['V']:.3f} m/s"


def _span(ends: tuple[float, float]) -> str:
    return f"{ends[0]:g} ... {ends[1]:g}"
