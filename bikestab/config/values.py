"""The values a config is made of: numbers with units and limits, ranges and lists of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Annotated, Any, Generic, TypeAlias, TypeVar

import numpy as np
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    RootModel,
    Tag,
    WithJsonSchema,
    model_validator,
)

from bikestab.config.oneunit import all_of as all_of
from bikestab.config.oneunit import mistake as mistake
from bikestab.config.oneunit import one_unit
from bikestab.errors import InputError
from bikestab.limits import check_speed, check_tilt, check_trail
from bikestab.model import Floats
from bikestab.units import ANGLE, DAMPING, PURE, SPEED, Units, quantity, units_in

ABSENT: Any = None  # a key that may be missing, while null would be no number


def _reads(units: Units, check: str = "") -> BeforeValidator:
    return BeforeValidator(reader(units, check))


def reader(units: Units, check: str = "") -> Callable[[object], float]:
    """What makes a number of a value, in SI units; it raises a mistake for what is none, or fails a check."""

    def validate(value: object) -> float:
        words = ", or unbounded" if check == "upper speed" else ""
        if words and value == "unbounded":
            return math.inf
        try:
            number = quantity(value, units)
            if check == "tilt":
                check_tilt(number, ())
            if check == "trail":
                check_trail(number, ())
            if check.endswith("speed"):
                check_speed(number, ())
        except InputError as error:
            raise mistake(error.problem, error.hint + words) from None
        if check == "not negative" and number < 0:
            raise mistake(f"{number:g} is negative", "allowed: 0 and above")
        if check == "positive" and number <= 0:
            raise mistake(f"{number:g} is not positive", "allowed: above 0")
        if check == "share" and not 0 < number < 1:
            raise mistake(f"{number:g} is no share of the samples", "allowed: between 0 and 1, both excluded")
        return number + 0.0  # of −0 that makes 0

    return validate


def json_schema(units: Units, *words: str) -> dict[str, Any]:
    """The JSON Schema of a number with or without one of these units, or one of the ``words``."""
    text = {"type": "string", "pattern": rf"^\s*[-+.\d][-+.\deE]*(\s*({'|'.join(units)}))?\s*$"}
    return {"anyOf": [{"type": "number"}, text, *({"const": word} for word in words)]}


def _schema(units: Units, *words: str) -> WithJsonSchema:
    return WithJsonSchema(json_schema(units, *words))


_ANY_UNIT = {"type": "string", "pattern": r"^\s*[-+.\d][-+.\deE]*\s*([^-+.\d\s].*)?$"}


def in_si(value: Any, meaning: str, key: tuple[str | int, ...]) -> Any:
    """The same with every text that stands for a number of the unit in ``meaning`` as that number."""
    if isinstance(value, dict):
        return {
            name: [in_si(x, meaning, (*key, name, i)) for i, x in enumerate(inner)]
            if name == "lognormal" and isinstance(inner, list)  # of which the second is the logarithm's
            else in_si(inner, meaning, (*key, name))
            for name, inner in one_unit(value).items()
        }
    if isinstance(value, (list, tuple)):
        return [in_si(inner, meaning, (*key, i)) for i, inner in enumerate(value)]
    if not isinstance(value, str):
        return value
    try:
        return quantity(value, units_in(meaning))
    except InputError as error:
        raise mistake(error.problem, error.hint, key) from None


Tilt: TypeAlias = Annotated[float, _reads(ANGLE, "tilt"), _schema(ANGLE)]
Trail: TypeAlias = Annotated[float, _reads(PURE, "trail")]
Speed: TypeAlias = Annotated[float, _reads(SPEED, "speed"), _schema(SPEED)]
UpperSpeed: TypeAlias = Annotated[float, _reads(SPEED, "upper speed"), _schema(SPEED, "unbounded")]
Damping: TypeAlias = Annotated[float, _reads(DAMPING, "not negative"), _schema(DAMPING)]
Number: TypeAlias = Annotated[float, _reads(PURE), WithJsonSchema({"anyOf": [{"type": "number"}, _ANY_UNIT]})]
Share: TypeAlias = Annotated[
    float, _reads(PURE, "share"), Field(json_schema_extra={"exclusiveMinimum": 0, "exclusiveMaximum": 1})
]
T = TypeVar("T")


class Strict(BaseModel):
    """Keys with values that do not change, and no others."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True, defer_build=True)


def increasing(values: list[float]) -> list[float]:
    """The values; raises the mistake of those that do not increase."""
    for a, b in pairwise(values):
        if not b > a:
            raise mistake(f"{b} does not come after {a}", "allowed: values that increase")
    return values


class Range(Strict, Generic[T]):
    """Equally spaced values, both ends included."""

    start: T
    stop: T
    num: Annotated[int, Field(ge=2, strict=True, description="number of values")]

    _units = model_validator(mode="before")(one_unit)

    @model_validator(mode="after")
    def _ordered(self) -> Range[T]:
        if not self.stop > self.start:  # type: ignore[operator]  # both are floats
            raise mistake(f"stop = {self.stop} is not above start = {self.start}", "allowed: start < stop")
        return self

    @property
    def size(self) -> int:
        """How many values there are."""
        return self.num

    @property
    def points(self) -> Floats:
        """The values."""
        return np.linspace(self.start, self.stop, self.num)  # type: ignore[call-overload]  # of floats


class Values(Strict, Generic[T]):
    """Values of one's own choice."""

    values: Annotated[list[T], Field(min_length=1)]

    _units = model_validator(mode="before")(one_unit)

    @model_validator(mode="after")
    def _ordered(self) -> Values[T]:
        increasing(self.values)  # type: ignore[arg-type]  # of floats
        return self

    @property
    def size(self) -> int:
        """How many values there are."""
        return len(self.values)

    @property
    def points(self) -> Floats:
        """The values."""
        return np.array(self.values, dtype=float)


class Listed(RootModel[Annotated[list[Number], Field(min_length=1)]]):
    """The same as a list alone."""

    model_config = ConfigDict(frozen=True)

    @model_validator(mode="after")
    def _ordered(self) -> Listed:
        increasing(self.root)
        return self

    @property
    def size(self) -> int:
        """How many values there are."""
        return len(self.root)

    @property
    def points(self) -> Floats:
        """The values."""
        return np.array(self.root, dtype=float)


class TiltRange(Range[Tilt]):
    """Equally spaced tilts, both ends included."""


class TiltValues(Values[Tilt]):
    """Chosen tilts."""


class TrailRange(Range[Trail]):
    """Equally spaced trails, both ends included."""


class TrailValues(Values[Trail]):
    """Chosen trails."""


class SpeedRange(Range[Speed]):
    """Equally spaced speeds, both ends included."""


class SpeedValues(Values[Speed]):
    """Chosen speeds."""


class NumberRange(Range[Number]):
    """Equally spaced numbers, both ends included."""


class NumberValues(Values[Number]):
    """Chosen numbers."""


def _tag(given: Any) -> str:
    chosen = isinstance(given, Values) or (isinstance(given, dict) and "values" in given)
    return "values" if chosen else "range"


def _tag_or_list(given: Any) -> str:
    return _tag(given) if isinstance(given, (dict, Range, Values)) else "list"


BY_KEYS = Discriminator(_tag)
TiltAxis: TypeAlias = Annotated[
    Annotated[TiltRange, Tag("range")] | Annotated[TiltValues, Tag("values")], BY_KEYS
]
TrailAxis: TypeAlias = Annotated[
    Annotated[TrailRange, Tag("range")] | Annotated[TrailValues, Tag("values")], BY_KEYS
]
SpeedAxis: TypeAlias = Annotated[
    Annotated[SpeedRange, Tag("range")] | Annotated[SpeedValues, Tag("values")], BY_KEYS
]
NumberAxis: TypeAlias = Annotated[
    Annotated[NumberRange, Tag("range")]
    | Annotated[NumberValues, Tag("values")]
    | Annotated[Listed, Tag("list")],
    Discriminator(_tag_or_list),
]
