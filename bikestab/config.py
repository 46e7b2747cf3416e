"""What a scan's config is: its keys, the values they may have, and what follows from them."""

from __future__ import annotations

import hashlib
import math
from typing import Annotated, Any, Generic, Literal, TypeAlias, TypeVar

import numpy as np
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    PrivateAttr,
    Tag,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from bikestab.bicycle import PAPER, Bicycle, preset_names
from bikestab.errors import InputError
from bikestab.limits import check_tilt, check_trail
from bikestab.model import Floats, Model
from bikestab.notation import MEIJAARD
from bikestab.units import ANGLE, PURE, SPEED, quantity, shown

MOST_SPEED = 1e6  # m/s; more would overflow in hurwitz3
Axis = Literal["lam", "sigma", "V"]
AXES: tuple[Axis, Axis, Axis] = ("lam", "sigma", "V")
FieldName = Literal["stable", "violated", "growth_rate", "conditions"]


def _reads(units: dict[str, float], check: str = "") -> BeforeValidator:
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
        except InputError as error:
            raise _custom(error.problem, error.hint + words) from None
        if check.endswith("speed") and not 0 <= number <= MOST_SPEED:
            problem = "is a speed backwards" if number < 0 else "m/s is out of range"
            raise _custom(f"{number:g} {problem}", f"allowed: 0 ... {MOST_SPEED:g} m/s")
        if check == "not negative" and number < 0:
            raise _custom(f"{number:g} is negative", "allowed: 0 and above")
        if check == "positive" and number <= 0:
            raise _custom(f"{number:g} is not positive", "allowed: above 0")
        return number

    return BeforeValidator(validate)


def _schema(units: dict[str, float], *words: str) -> WithJsonSchema:
    text = {"type": "string", "pattern": rf"^\s*[-+.\d][-+.\deE]*\s*({'|'.join(units)})?\s*$"}
    return WithJsonSchema({"anyOf": [{"type": "number"}, text, *({"const": word} for word in words)]})


def _custom(problem: str, hint: str, key: tuple[str | int, ...] = ()) -> PydanticCustomError:
    return PydanticCustomError("bikestab", "{problem}", {"problem": problem, "hint": hint, "key": key})


Tilt: TypeAlias = Annotated[float, _reads(ANGLE, "tilt"), _schema(ANGLE)]
Trail: TypeAlias = Annotated[float, _reads(PURE, "trail")]
Speed: TypeAlias = Annotated[float, _reads(SPEED, "speed"), _schema(SPEED)]
UpperSpeed: TypeAlias = Annotated[float, _reads(SPEED, "upper speed"), _schema(SPEED, "unbounded")]
Within: TypeAlias = Annotated[float, _reads(SPEED, "positive"), _schema(SPEED)]
Damping: TypeAlias = Annotated[float, _reads(PURE, "not negative")]
T = TypeVar("T")


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True)


class Range(_Strict, Generic[T]):
    """Equally spaced values, both ends included."""

    start: T
    stop: T
    num: Annotated[int, Field(ge=2, strict=True, description="number of values")]

    @model_validator(mode="after")
    def _ordered(self) -> Range[T]:
        if not self.stop > self.start:  # type: ignore[operator]  # both are floats
            raise _custom(f"stop = {self.stop} is not above start = {self.start}", "allowed: start < stop")
        return self


class Values(_Strict, Generic[T]):
    """Values of one's own choice."""

    values: Annotated[list[T], Field(min_length=2)]

    @model_validator(mode="after")
    def _ordered(self) -> Values[T]:
        for a, b in zip(self.values, self.values[1:], strict=False):
            if not b > a:  # type: ignore[operator]  # both are floats
                raise _custom(f"{b} does not come after {a}", "allowed: values that increase")
        return self


def _tag(given: Any) -> str:
    return (
        "values" if isinstance(given, Values) or (isinstance(given, dict) and "values" in given) else "range"
    )


_BY_KEYS = Discriminator(_tag)
TiltAxis: TypeAlias = Annotated[
    Annotated[Range[Tilt], Tag("range")] | Annotated[Values[Tilt], Tag("values")], _BY_KEYS
]
TrailAxis: TypeAlias = Annotated[
    Annotated[Range[Trail], Tag("range")] | Annotated[Values[Trail], Tag("values")], _BY_KEYS
]
SpeedAxis: TypeAlias = Annotated[
    Annotated[Range[Speed], Tag("range")] | Annotated[Values[Speed], Tag("values")], _BY_KEYS
]


class Grid(_Strict):
    """The values of λ, σ and V whose every combination is evaluated."""

    lam: Annotated[TiltAxis, Field(description="tilt of the steering axis from the vertical [rad]")]
    sigma: Annotated[TrailAxis, Field(description="trail divided by the wheelbase [1]")]
    V: Annotated[SpeedAxis, Field(description="forward speed [m/s]")]

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of values of λ, σ and V."""
        return tuple(  # type: ignore[return-value]  # three axes, three numbers
            axis.num if isinstance(axis, Range) else len(axis.values)
            for axis in (self.lam, self.sigma, self.V)
        )

    def values(self, name: Axis) -> Floats:
        """The values of one axis."""
        axis = getattr(self, name)
        if isinstance(axis, Range):
            return np.linspace(axis.start, axis.stop, axis.num)
        return np.array(axis.values)

    def ends(self, name: Axis) -> tuple[float, float]:
        """First and last value of one axis."""
        axis = getattr(self, name)
        return (axis.start, axis.stop) if isinstance(axis, Range) else (axis.values[0], axis.values[-1])


_ABSENT: Any = None  # a key that may be missing, while null would be no number


class Plane(_Strict):
    """A picture across one axis, at one of its values."""

    lam: Tilt = _ABSENT
    sigma: Trail = _ABSENT
    V: Speed = _ABSENT

    @model_validator(mode="after")
    def _one(self) -> Plane:
        if len(self.model_fields_set) != 1:
            raise _custom("a slice fixes one axis", "allowed: one of {lam: ...}, {sigma: ...}, {V: ...}")
        return self

    @property
    def fixed(self) -> tuple[Axis, float]:
        """The axis and its value."""
        (name,) = self.model_fields_set
        return name, getattr(self, name)  # type: ignore[return-value]  # the fields are the axes


class Expectation(_Strict):
    """What ``bikestab check`` compares: an interval of stable speeds, or none."""

    lam: Tilt | None = None
    sigma: Trail | None = None
    V1: Speed | None = None
    V2: UpperSpeed | None = None  # inf for "unbounded"
    within: Within = 0.001
    stable: Literal["never"] | None = None

    @model_validator(mode="after")
    def _something(self) -> Expectation:
        if (self.stable is None) == (self.V1 is None and self.V2 is None):
            raise _custom("expects nothing, or two things", "allowed: V1 and/or V2, or 'stable: never'")
        return self


def _bicycle(value: object) -> Bicycle:
    if isinstance(value, Bicycle):
        return value
    raise _custom(f"{shown(value)} is no bicycle", "allowed: a preset, a path to a YAML file, or parameters")


_PARAMETERS = {
    "type": "object",
    "properties": {
        key: {"description": text, "type": ["number", "string"] if key == "lam" else "number"}
        for key, text in {**PAPER, **MEIJAARD}.items()
    }
    | {"name": {"type": "string"}, "source": {"type": "string"}},
    "additionalProperties": False,
}


class ScanConfig(_Strict):
    """What ``bikestab scan`` computes and where it puts the result."""

    title: Annotated[
        str, Field(strict=True, description="printed on the pictures and stored in the volume")
    ] = ""
    bicycle: Annotated[
        Bicycle,
        BeforeValidator(_bicycle),
        WithJsonSchema({"anyOf": [{"type": "string", "examples": preset_names()}, _PARAMETERS]}),
        Field(description="a preset, a path to a file from this file's folder, or the parameters in place"),
    ]
    model: Annotated[Model, Field(description="refined, or unrefined as before the 1981 paper")] = "refined"
    delta: Annotated[
        Damping | None, Field(description="steering damping instead of the bicycle's own [kg m²/s]")
    ] = None
    grid: Grid
    fields: Annotated[list[FieldName], Field(min_length=1, description="what the volume holds")] = [
        "stable",
        "violated",
        "growth_rate",
    ]
    slices: Annotated[list[Plane], Field(description="pictures across one axis")] = []
    output: Annotated[str, Field(strict=True, min_length=1, description="folder, from the current directory")]
    expect: Annotated[list[Expectation], Field(description="what 'bikestab check' compares")] = []
    _text: str = PrivateAttr("")

    @model_validator(mode="after")
    def _consistent(self) -> ScanConfig:
        for i, plane in enumerate(self.slices):
            name, value = plane.fixed
            first, last = self.grid.ends(name)
            if not first <= value <= last:
                hint = f"allowed: {first:g} ... {last:g}"
                raise _custom(f"{value:g} is outside the grid", hint, ("slices", i, name))
        return self

    @property
    def machine(self) -> Bicycle:
        """The bicycle with the damping that is used."""
        return self.bicycle.with_delta(self.delta)

    @property
    def text(self) -> str:
        """The YAML text, with overrides in it."""
        return self._text

    def with_text(self, text: str) -> ScanConfig:
        """A copy that was read from this YAML text."""
        config = self.model_copy()
        config._text = text
        return config

    @property
    def sha256(self) -> str:
        """The SHA-256 of the YAML text."""
        return hashlib.sha256(self.text.encode()).hexdigest()
