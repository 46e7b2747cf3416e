"""Parts of a scan's config: its grid, the planes of its pictures, and what it expects."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    AfterValidator,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    WithJsonSchema,
    model_validator,
)

from bikestab.config.measured import also_measured, also_measured_axes
from bikestab.config.oneunit import one_unit
from bikestab.config.tolerance import Within
from bikestab.config.values import (
    ABSENT,
    BY_KEYS,
    Number,
    Range,
    Speed,
    SpeedAxis,
    Strict,
    Tilt,
    TiltAxis,
    Trail,
    TrailAxis,
    UpperSpeed,
    Values,
    in_si,
    json_schema,
    mistake,
)
from bikestab.config.variation import VARIED
from bikestab.errors import nearest
from bikestab.fields import AXES, GRADIENTS, Axes, Axis, askable
from bikestab.model import Floats
from bikestab.units import shown, units_in

Name: TypeAlias = Annotated[str, Field(strict=True, description="a parameter of the bicycle")]


class NamedRange(Range[Number]):
    """Equally spaced values of a parameter, both ends included."""

    name: Name


class NamedValues(Values[Number]):
    """Chosen values of a parameter."""

    name: Name


NamedAxis: TypeAlias = Annotated[
    Annotated[NamedRange, Tag("range")] | Annotated[NamedValues, Tag("values")], BY_KEYS
]


def _with_units(axis: str) -> BeforeValidator:
    """Values of a parameter's axis with numbers for texts with units."""

    def validate(given: Any) -> Any:
        name = given.get("name") if isinstance(given, dict) else None
        if not isinstance(name, str):
            return given
        if name not in VARIED:
            raise mistake(f"there is no parameter {name!r}", nearest(name, VARIED), ("grid", axis, "name"))
        plain = ("name", "num")
        return {
            key: value if key in plain else in_si(value, VARIED[name], ("grid", axis, key))
            for key, value in one_unit(given).items()
        }

    return BeforeValidator(validate)


class _Axes(Strict):
    """What every grid can tell."""

    V: Annotated[SpeedAxis, Field(description="forward speed [m/s]")]

    @property
    def names(self) -> Axes:
        """What its axes are called."""
        return AXES

    def key(self, name: Axis) -> str:
        """The key of one axis in the config."""
        return name

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of values of each axis."""
        n, m, k = (self.size(name) for name in self.names)
        return n, m, k

    def size(self, name: Axis) -> int:
        """How many values an axis has."""
        return int(getattr(self, self.key(name)).size)

    def values(self, name: Axis) -> Floats:
        """The values of one axis."""
        return getattr(self, self.key(name)).points

    def ends(self, name: Axis) -> tuple[float, float]:
        """First and last value of one axis."""
        axis = getattr(self, self.key(name))
        return (axis.start, axis.stop) if hasattr(axis, "num") else (axis.values[0], axis.values[-1])


class Grid(_Axes):
    """The values of λ, σ and V whose every combination is evaluated."""

    model_config = ConfigDict(json_schema_extra=also_measured_axes)

    lam: Annotated[TiltAxis, Field(description="tilt of the steering axis from the vertical [rad]")]
    sigma: Annotated[TrailAxis, Field(description="trail divided by the wheelbase [1]")]


class FamilyGrid(_Axes):
    """The same of any two parameters in place of λ and σ."""

    x: Annotated[NamedAxis, _with_units("x"), Field(description="values of a parameter")]
    y: Annotated[NamedAxis, _with_units("y"), Field(description="values of another one")]

    @property
    def names(self) -> Axes:
        """What its axes are called."""
        return self.x.name, self.y.name, "V"

    def key(self, name: Axis) -> str:
        """The key of one axis in the config."""
        return {self.x.name: "x", self.y.name: "y"}.get(name, name)


GRIDS = TILT_AND_TRAIL, TWO_PARAMETERS = "tilt and trail", "two parameters"


def _which(given: Any) -> str:
    family = isinstance(given, FamilyGrid) or (isinstance(given, dict) and not {"x", "y"}.isdisjoint(given))
    return TWO_PARAMETERS if family else TILT_AND_TRAIL


AnyGrid: TypeAlias = Annotated[
    Annotated[Grid, Tag(TILT_AND_TRAIL)] | Annotated[FamilyGrid, Tag(TWO_PARAMETERS)], Discriminator(_which)
]


def _plane_schema(schema: dict[str, Any]) -> None:
    also_measured(schema)
    for name, meaning in VARIED.items():
        if name not in schema["properties"]:
            schema["properties"][name] = {"description": meaning, **json_schema(units_in(meaning))}
    schema["additionalProperties"] = False


class Plane(Strict):
    """A picture across one axis, at one of its values; of a grid of other parameters one of these."""

    model_config = ConfigDict(json_schema_extra=_plane_schema, extra="allow")
    __pydantic_extra__: dict[str, Number]

    lam: Tilt = ABSENT
    sigma: Trail = ABSENT
    V: Speed = ABSENT

    @model_validator(mode="after")
    def _one(self) -> Plane:
        if len(self.model_fields_set) != 1:
            raise mistake("a slice fixes one axis", "allowed: one of {lam: ...}, {sigma: ...}, {V: ...}")
        return self

    @property
    def fixed(self) -> tuple[Axis, float]:
        """The axis and its value."""
        (name,) = self.model_fields_set
        return name, getattr(self, name)


class Expectation(Strict):
    """What ``bikestab check`` compares: an interval of stable speeds, or none.

    Of the design λ and σ, or of the machine in which any other parameters have the values that are given.
    """

    model_config = ConfigDict(json_schema_extra=_plane_schema, extra="allow")
    __pydantic_extra__: dict[str, Number]

    lam: Tilt | None = None
    sigma: Trail | None = None
    V1: Speed | None = None
    V2: UpperSpeed | None = None  # inf for "unbounded"
    within: Within = 0.001  # m/s, or per cent of V1 and V2: "1%"
    stable: Literal["never"] | None = None

    @model_validator(mode="after")
    def _something(self) -> Expectation:
        if (self.stable is None) == (self.V1 is None and self.V2 is None):
            raise mistake("expects nothing, or two things", "allowed: V1 and/or V2, or 'stable: never'")
        return self

    @property
    def values(self) -> dict[str, float]:
        """The parameters that have other values than the bicycle's, SI."""
        given = {"lam": self.lam, "sigma": self.sigma, **(self.model_extra or {})}
        return {name: value for name, value in given.items() if value is not None}


def _field(value: object) -> str:
    if isinstance(value, str) and value in askable():
        return str(value)
    hint = nearest(value, askable()) if isinstance(value, str) else f"known: {', '.join(askable())}"
    raise mistake(f"{shown(value)} is not known", hint)


FieldName: TypeAlias = Annotated[
    str, BeforeValidator(_field), WithJsonSchema({"type": "string", "enum": askable()})
]
Fields: TypeAlias = Annotated[
    list[FieldName],
    Field(min_length=1, description="what the volume holds"),
    AfterValidator(lambda given: ["stable", *given] if {*given} == {GRADIENTS} else given),
]
