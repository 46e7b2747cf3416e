"""Parts of a scan's config: its grid, the planes of its pictures, and what it expects."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Field, model_validator

from bikestab.config.measured import also_measured, also_measured_axes
from bikestab.config.values import (
    ABSENT,
    Speed,
    SpeedAxis,
    Strict,
    Tilt,
    TiltAxis,
    Trail,
    TrailAxis,
    UpperSpeed,
    Within,
    mistake,
)
from bikestab.fields import Axis
from bikestab.model import Floats


class Grid(Strict):
    """The values of λ, σ and V whose every combination is evaluated."""

    model_config = ConfigDict(json_schema_extra=also_measured_axes)

    lam: Annotated[TiltAxis, Field(description="tilt of the steering axis from the vertical [rad]")]
    sigma: Annotated[TrailAxis, Field(description="trail divided by the wheelbase [1]")]
    V: Annotated[SpeedAxis, Field(description="forward speed [m/s]")]

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of values of λ, σ and V."""
        return self.lam.size, self.sigma.size, self.V.size

    def values(self, name: Axis) -> Floats:
        """The values of one axis."""
        return getattr(self, name).points

    def ends(self, name: Axis) -> tuple[float, float]:
        """First and last value of one axis."""
        axis = getattr(self, name)
        return (axis.start, axis.stop) if hasattr(axis, "num") else (axis.values[0], axis.values[-1])


class Plane(Strict):
    """A picture across one axis, at one of its values."""

    model_config = ConfigDict(json_schema_extra=also_measured)

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
        return name, getattr(self, name)  # type: ignore[return-value]  # the fields are the axes


class Expectation(Strict):
    """What ``bikestab check`` compares: an interval of stable speeds, or none."""

    model_config = ConfigDict(json_schema_extra=also_measured)

    lam: Tilt | None = None
    sigma: Trail | None = None
    V1: Speed | None = None
    V2: UpperSpeed | None = None  # inf for "unbounded"
    within: Within = 0.001
    stable: Literal["never"] | None = None

    @model_validator(mode="after")
    def _something(self) -> Expectation:
        if (self.stable is None) == (self.V1 is None and self.V2 is None):
            raise mistake("expects nothing, or two things", "allowed: V1 and/or V2, or 'stable: never'")
        return self
