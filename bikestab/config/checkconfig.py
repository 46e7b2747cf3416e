"""What of a config is no part of its grid: the machine, and what is asked and expected of it."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, Field, ValidationInfo, WithJsonSchema, model_validator

from bikestab.bicycle import Bicycle
from bikestab.config.inplace import IN_PLACE
from bikestab.config.measured import in_lam_and_sigma
from bikestab.config.members import check_names
from bikestab.config.parts import Expectation, Fields, Plane
from bikestab.config.values import Damping, NumberAxis, Strict, mistake
from bikestab.config.variation import SWEPT, Ensemble, with_units
from bikestab.errors import InputError
from bikestab.fields import AXES
from bikestab.model import Model
from bikestab.presets import preset_names
from bikestab.units import shown


def _bicycle(value: object) -> Bicycle:
    if isinstance(value, Bicycle):
        return value
    raise mistake(f"{shown(value)} is no bicycle", "allowed: a preset, a path to a YAML file, or parameters")


Title: TypeAlias = Annotated[
    str, Field(strict=True, description="printed on the pictures and stored in the volume")
]
Machine: TypeAlias = Annotated[
    Bicycle,
    BeforeValidator(_bicycle),
    WithJsonSchema({"anyOf": [{"type": "string", "examples": preset_names()}, IN_PLACE]}),
    Field(description="a preset, a path to a file from this file's folder, or the parameters in place"),
]
Equations: TypeAlias = Annotated[Model, Field(description="refined, or unrefined as before the 1981 paper")]
OwnDamping: TypeAlias = Annotated[
    Damping | None, Field(description="steering damping instead of the bicycle's own [kg m²/s]")
]
Fast: TypeAlias = Annotated[
    bool,
    Field(strict=True, description="growth_rate and ensembles by the compiled kernel"),
]
Sweep: TypeAlias = Annotated[
    dict[str, NumberAxis],
    BeforeValidator(lambda given: with_units(given, "sweep")),
    Field(
        description="axes over parameters of the bicycle, in its notation",
        json_schema_extra={"propertyNames": {"enum": SWEPT}},
    ),
]
Drawn: TypeAlias = Annotated[
    Ensemble | None, Field(description="parameters drawn at random, for probabilities of stability")
]
Slices: TypeAlias = Annotated[list[Plane], Field(description="pictures across one axis")]
Expectations: TypeAlias = Annotated[list[Expectation], Field(description="what 'bikestab check' compares")]


class CheckConfig(Strict):
    """A config without a grid, of which ``bikestab check`` needs the machine and what is expected."""

    title: Title = ""
    bicycle: Machine
    model: Equations = "refined"
    delta: OwnDamping = None
    fields: Fields = ["stable"]
    fast: Fast = False
    sweep: Sweep = {}
    ensemble: Drawn = None
    slices: Slices = []
    output: Annotated[str, Field(strict=True, min_length=1)] = "out"
    expect: Expectations = []

    @model_validator(mode="before")
    @classmethod
    def _measured(cls, given: Any, info: ValidationInfo) -> Any:
        return in_lam_and_sigma(given, info.context)

    @model_validator(mode="after")
    def _known(self, info: ValidationInfo) -> CheckConfig:
        if info.context and info.context.found:  # what is wrong with it may be known already
            return self
        try:
            check_names(self.bicycle, AXES, self.sweep, self.ensemble, own_delta=self.delta is not None)
        except InputError as error:
            raise mistake(error.problem, error.hint, error.key) from None
        return self

    @property
    def machine(self) -> Bicycle:
        """The bicycle with the damping that is used."""
        return self.bicycle.with_delta(self.delta)
