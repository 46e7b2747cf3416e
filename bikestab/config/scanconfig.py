"""What a scan's config is: its keys, the values they may have, and what follows from them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, Any

import numpy as np
from pydantic import Field, PrivateAttr, ValidationInfo, model_validator

from bikestab.bicycle import Bicycle
from bikestab.config.checkconfig import (
    Drawn,
    Equations,
    Expectations,
    Fast,
    Machine,
    OwnDamping,
    Slices,
    Sweep,
    Title,
)
from bikestab.config.meaning import drawn_around, yaml_text
from bikestab.config.measured import in_lam_and_sigma
from bikestab.config.members import (
    Member,
    SweptAxis,
    check_designs,
    check_family,
    check_names,
    check_samples,
    doubts_of,
    members,
    swept_axes,
)
from bikestab.config.parts import AnyGrid, Fields
from bikestab.config.parts import Expectation as Expectation
from bikestab.config.parts import Plane as Plane
from bikestab.config.values import (
    Strict,
    all_of,
    mistake,
)
from bikestab.errors import InputError, Mistakes, nearest
from bikestab.family import Family
from bikestab.fields import AXES
from bikestab.identity import identity
from bikestab.model import Floats
from bikestab.plausible import design_doubts
from bikestab.rider import left_behind


class ScanConfig(Strict):
    """What ``bikestab scan`` computes and where it puts the result."""

    title: Title = ""
    bicycle: Machine
    model: Equations = "refined"
    delta: OwnDamping = None
    grid: AnyGrid
    fields: Fields = [
        "stable",
        "violated",
        "growth_rate",
    ]
    fast: Fast = False
    sweep: Sweep = {}
    ensemble: Drawn = None
    slices: Slices = []
    output: Annotated[str, Field(strict=True, min_length=1, description="folder, from the current directory")]
    expect: Expectations = []
    _text: str = PrivateAttr("")
    _notes: tuple[str, ...] = PrivateAttr(())

    @model_validator(mode="before")
    @classmethod
    def _measured(cls, given: Any, info: ValidationInfo) -> Any:
        return in_lam_and_sigma(given, info.context)

    @model_validator(mode="after")
    def _consistent(self, info: ValidationInfo) -> ScanConfig:
        if info.context and info.context.found:  # what is wrong with it may be known already
            return self
        mistakes = Mistakes()
        for i, plane in enumerate(self.slices):
            with mistakes.kept():
                self._check_slice(plane, ("slices", i))
        if mistakes.found:
            raise all_of([mistake(each.problem, each.hint, each.key) for each in mistakes.found])
        try:
            check_family(self.bicycle, self.grid)
            check_names(
                self.bicycle, self.grid.names, self.sweep, self.ensemble, own_delta=self.delta is not None
            )
            check_designs(self.members, self.grid)
            check_samples(self.members, self.ensemble, self.grid)
        except InputError as error:
            raise mistake(error.problem, error.hint, error.key) from None
        return self

    def _check_slice(self, plane: Plane, key: tuple[str | int, ...]) -> None:
        """Raise InputError for a plane that the grid does not have, or that would be a line."""
        name, value = plane.fixed
        if name not in self.grid.names:
            hint = nearest(name, self.grid.names)
            raise InputError(f"the grid has no axis {name!r}", key=(*key, name), hint=hint)
        first, last = self.grid.ends(name)
        if not first <= value <= last:
            hint = f"allowed: {first:g} ... {last:g}"
            raise InputError(f"{value:g} is outside the grid", key=(*key, name), hint=hint)
        for other in self.grid.names:
            if other != name and self.grid.size(other) == 1:
                problem = f"a picture needs a range of {other}, and the grid has one value"
                hint = f"leave it out, or give more values in grid.{self.grid.key(other)}"
                raise InputError(problem, key=key, hint=hint)

    @property
    def machine(self) -> Bicycle:
        """The bicycle with the damping that is used."""
        return self.bicycle.with_delta(self.delta)

    def family(self, member: int | None = 0) -> Family:
        """The family that the grid has of a member of the sweep, or for None of the machine itself."""
        x, y, _ = self.grid.names
        return Family(self.machine if member is None else self.members[member].bicycle, self.model, x, y)

    @cached_property
    def kept(self) -> tuple[list[str], Floats]:
        """What a volume keeps of each machine: the parameters' names, and a row of each, NaN for None."""
        kept = [self.family(i).kept for i in range(len(self.members))]
        names = list(dict.fromkeys(name for numbers in kept for name in numbers))  # a zero gain is left out
        return names, np.array([[numbers.get(name, 0.0) for name in names] for numbers in kept], float)

    @property
    def compiled(self) -> bool:
        """Whether there is what the compiled kernel computes, growth rates or an ensemble, and it shall."""
        return self.fast and ("growth_rate" in self.fields or self.ensemble is not None)

    @property
    def heading(self) -> str:
        """The title, or else one that names the bicycle."""
        return self.title or f"{self.machine.name}: region of stable motion"

    @property
    def axes(self) -> list[SweptAxis]:
        """The axes of the sweep, as in the config."""
        return swept_axes(self.bicycle, self.sweep)

    @cached_property
    def members(self) -> list[Member]:
        """The machines of the sweep, the last axis fastest; without one, ``machine`` alone."""
        return members(self.machine, self.sweep)

    @cached_property
    def warnings(self) -> list[str]:
        """What no rigid bodies on the ground can have, of the machines that are computed."""
        doubts = []
        if self.grid.names == AXES:
            lam, sigma = (min(self.grid.ends(name), key=abs) for name in ("lam", "sigma"))
            doubts = [f"grid: {text}" for text in design_doubts(lam, sigma, self.bicycle.c)]
        if not self.sweep and not self.ensemble:
            return [*doubts, *self.machine.warnings]
        return [*doubts, *doubts_of(self.members, self.ensemble)]

    @cached_property
    def notes(self) -> list[str]:
        """What lists have without units, was left out of a file, or is not scaled with a rider's mass."""
        drawn = self.ensemble.parameters if self.ensemble else {}
        note = left_behind(self.bicycle.given, {**self.sweep, **drawn})
        return [*self._notes, *self.bicycle.notes, *([note] if note else [])]

    @property
    def text(self) -> str:
        """The YAML text that it was read from, with overrides in it, or else one that gives it."""
        return self._text or yaml_text(
            self.bicycle, self.model_dump(exclude_defaults=True, exclude={"bicycle"})
        )

    def with_text(self, text: str, notes: tuple[str, ...] = ()) -> ScanConfig:
        """A copy that was read from this YAML text, of which there are ``notes``."""
        config = self.model_copy()
        config._text, config._notes = text, notes
        return config

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> ScanConfig:
        """A copy; with other values it is checked anew, and its text is its own."""
        if not update:
            return super().model_copy(deep=deep)
        return ScanConfig(**{name: getattr(self, name) for name in self.model_fields_set} | {**update})

    @cached_property
    def sha256(self) -> str:
        """The SHA-256 of what is computed: title, texts, slices, output and what is expected do not count."""
        names, rows = self.kept
        named = () if self.grid.names == AXES else (*self.grid.names[:2], *names)
        drawn = None
        if self.ensemble:
            drawn = {**self.ensemble.meaning, "around": drawn_around(self.machine)}
        return identity(
            self.model, rows, [self.grid.values(name) for name in self.grid.names],
            self.fields, {axis.name: axis.values for axis in self.axes}, drawn, named,
            fast=self.compiled,
        )  # fmt: skip
