"""Numbers with units as options take them: one, a range, or the ends of one."""

from __future__ import annotations

from typing import Any

import click
from bikestab_cli.parameters import MOST_VALUES, ends_of, is_list

from bikestab.errors import InputError
from bikestab.units import ANGLE, LENGTH, PURE, SPEED, Units, quantity, shown

Ends = tuple[float, float]
_SET = {"lam", "head_angle", "trail", "offset", "delta"}  # what --set takes of every bicycle


class Quantity(click.ParamType):
    """A number with or without a unit."""

    takes = "one value"

    def __init__(self, name: str, units: Units) -> None:
        self.name, self.units = name, units

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        try:
            number = quantity(value, self.units)
        except InputError as error:
            if is_list(value, self.units) and not error.hint.startswith("write "):  # no decimal comma
                self.fail(f"{shown(value)} is a list, where {self._instead(value, param, ctx)}", param, ctx)
            self.fail(f"{error.problem}; {error.hint}", param, ctx)
        return number

    def _instead(self, values: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """What is taken in place of a list, and which option takes it."""
        first, *_, last = (part.strip() for part in values.split(","))
        examples = {"START:STOP": f", e.g. {first}:{last}", "START:STOP:NUM": f", e.g. {first}:{last}:5"}
        words = f"{self.takes} is taken{examples.get(self.takes.rpartition(' ')[2], '')}"
        options = {each.name: each.opts[0] for each in ctx.command.params} if ctx else {}
        if param and options.get("changes") == "--set" and param.name in _SET:
            words += f"; --set takes several: --set {param.name}={values}"
        return words


class QuantityRange(Quantity):
    """One such number, or START:STOP:NUM."""

    takes = "one value or START:STOP:NUM"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[float]:
        if isinstance(value, list):
            return value
        parts = str(value).split(":")
        if len(parts) == 1:
            return [super().convert(value, param, ctx)]
        if len(parts) != 3:
            self.fail(f"{value!r} is neither a number nor START:STOP:NUM, e.g. 0.05:0.3:6", param, ctx)
        start, stop = (super(QuantityRange, self).convert(part, param, ctx) for part in ends_of(parts[:2]))
        if parts[2].strip() == "1" and start == stop:
            return [start]
        if not parts[2].strip().isdecimal() or not 2 <= int(parts[2]) <= MOST_VALUES:
            self.fail(
                f"{parts[2]!r} in {value!r} is not a number of values from 2 to {MOST_VALUES}", param, ctx
            )
        num = int(parts[2])
        return [start + (stop - start) * i / (num - 1) for i in range(num - 1)] + [stop]


class QuantityEnds(Quantity):
    """START:STOP, or one number that is both."""

    takes = "one value or START:STOP"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Ends:
        if isinstance(value, tuple):
            return value
        parts = str(value).split(":")
        if len(parts) > 2:
            self.fail(f"{value!r} is neither a number nor START:STOP", param, ctx)
        start, stop = (
            super(QuantityEnds, self).convert(part, param, ctx) for part in ends_of([parts[0], parts[-1]])
        )
        return start, stop


_KINDS: tuple[tuple[str, Units], ...] = (
    ("angle", ANGLE), ("number", PURE), ("speed", SPEED), ("length", LENGTH),
)  # fmt: skip
ANGLE_VALUE, TRAIL_VALUE, SPEED_VALUE, LENGTH_VALUE = (Quantity(*kind) for kind in _KINDS)
ANGLES, TRAILS, SPEEDS, LENGTHS = (QuantityRange(*kind) for kind in _KINDS)
ANGLE_ENDS, TRAIL_ENDS, SPEED_ENDS, LENGTH_ENDS = (QuantityEnds(*kind) for kind in _KINDS)
