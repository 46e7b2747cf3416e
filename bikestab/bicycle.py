"""A bicycle or motorcycle: the paper's parameters, their checks, and the other notations.

Part 1 is the rear wheel, frame and rider; part 2 the fork, handlebar and front wheel
(Dikarev, Dikareva and Fufaev 1981, section 1).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

from bikestab import yamltext
from bikestab.errors import InputError, Mistakes, nearest
from bikestab.gains import GAINS
from bikestab.keyed import keyed
from bikestab.limits import check_product, check_tilt, check_trail, check_value
from bikestab.notation import MEIJAARD, of_bodies, of_values, superseded, two_parts
from bikestab.plausible import warnings_of
from bikestab.presets import preset_names, preset_text
from bikestab.rider import RIDER, left_behind
from bikestab.texts import is_there
from bikestab.units import quantity, units_in

_OWN = {"lam": check_tilt, "sigma": check_trail}  # a design of its own, which not every machine has


def _parameter(unit: str, meaning: str, check: str = "", **default: Any) -> Any:
    return field(metadata={"unit": unit, "meaning": meaning, "check": check}, **default)


def _beside(**default: Any) -> Any:
    return field(init=False, repr=False, compare=False, **default)


@dataclass(frozen=True, kw_only=True)
class Bicycle:
    """The parameters of one machine; all SI, angles in radians.

    Raises InputError (with the parameter's name as key) for what the equations cannot use.
    ``warnings`` names what no rigid body can have; such values are still computed with. From a file with
    uncertainties ``deviations`` has the standard deviations of the ``given`` parameters, and ``correlations``
    those of pairs of them; ``notes`` says what of the file was left out.

    >>> import bikestab as bs
    >>> bike = bs.Bicycle.preset("meijaard2007")
    >>> bike.c, round(bike.replaced({"mB": 100}).m1, 3), bike.warnings
    (1.02, 102.0, ())
    """

    c: float = _parameter("m", "wheelbase", "positive")
    m1: float = _parameter("kg", "mass of the rear part with rider", "positive")
    l1: float = _parameter("m", "rear centre of mass ahead of the rear contact")
    h1: float = _parameter("m", "rear centre of mass above the ground")
    A1: float = _parameter("kg m²", "rear central inertia, horizontal axis", "non-negative")
    B1: float = _parameter("kg m²", "rear central inertia, axis in the wheel plane", "non-negative")
    D1: float = _parameter("kg m²", "rear central product of inertia", default=0.0)
    C1: float = _parameter("kg m²", "rear wheel spin inertia", "non-negative")
    R1: float = _parameter("m", "rear wheel radius; 0 = a skate", "non-negative")
    m2: float = _parameter("kg", "mass of the front part", "positive")
    l2: float = _parameter("m", "front centre of mass ahead of the rear contact")
    h2: float = _parameter("m", "front centre of mass above the ground")
    A2: float = _parameter("kg m²", "front central inertia, horizontal axis", "non-negative")
    B2: float = _parameter("kg m²", "front central inertia, axis in the wheel plane", "non-negative")
    D2: float = _parameter("kg m²", "front central product of inertia", default=0.0)
    C2: float = _parameter("kg m²", "front wheel spin inertia", "non-negative")
    R2: float = _parameter("m", "front wheel radius; 0 = a skate", "non-negative")
    g: float = _parameter("m/s²", "acceleration due to gravity", "positive", default=9.81)
    delta: float = _parameter("kg m²/s", "viscous damping of the steering", "non-negative", default=0.0)
    lam: float | None = _parameter("rad", "own steering-axis tilt", default=None)
    sigma: float | None = _parameter("1", "own trail divided by the wheelbase", default=None)
    name: str = "bicycle"
    source: str = ""
    gains: tuple[tuple[str, float], ...] = ()  # of a steer torque by feedback, by the names of GAINS
    remarks: tuple[str, ...] = ()  # warnings about the bodies these parameters were reduced from
    bodies: Mapping[str, float] | None = _beside(default=None)
    deviations: Mapping[str, float] = _beside(default_factory=dict)
    correlations: Mapping[tuple[str, str], float] = _beside(default_factory=dict)
    notes: tuple[str, ...] = _beside(default=())
    shape: ClassVar[tuple[int, ...]] = ()  # of each parameter, as in machines.Machines

    def __post_init__(self) -> None:
        mistakes = Mistakes()
        for name, gain in self.gains:
            with mistakes.kept():
                check_value(name, gain, "", GAINS[name])
        for p in parameters():
            value = getattr(self, p.name)
            if value is None and p.name in _OWN:
                continue
            with mistakes.kept():
                number = quantity(value, units_in(PAPER[p.name]), key=(p.name,))
                check_value(p.name, number, p.metadata["check"], PAPER[p.name])
                if p.name in _OWN:
                    _OWN[p.name](number, (p.name,))
                object.__setattr__(self, p.name, number)
        mistakes.tell()
        for i, A, B, C, D, R in (
            ("1", self.A1, self.B1, self.C1, self.D1, self.R1),
            ("2", self.A2, self.B2, self.C2, self.D2, self.R2),
        ):
            check_product(f"D{i}", D, f"A{i}", A, f"B{i}", B)
            if R == 0 and C > 0:
                raise InputError(
                    f"R{i} = 0 (a skate) cannot spin, but C{i} = {C:g}",
                    key=(f"R{i}",),
                    hint=f"allowed: R{i} > 0, or C{i} = 0",
                )

    @property
    def warnings(self) -> tuple[str, ...]:
        """What no rigid bodies on the ground can have, one sentence each."""
        return warnings_of(self)

    def numbers(self) -> dict[str, float | None]:
        """The parameters by name, as plain numbers."""
        return {**{p.name: getattr(self, p.name) for p in parameters()}, **dict(self.gains)}

    @property
    def notation(self) -> dict[str, str]:
        """The parameters of the notation the bicycle was given in, with meaning and unit of each."""
        own = PAPER if self.bodies is None else MEIJAARD
        rider = RIDER if self.bodies is not None and "rider.m" in self.bodies else {}
        return {**own, **rider, **GAINS}

    @property
    def given(self) -> dict[str, float]:
        """The numbers in that notation."""
        if self.bodies is not None:
            return dict(self.bodies)
        return {name: value for name, value in self.numbers().items() if value is not None}

    def replaced(self, values: Mapping[str, float]) -> Bicycle:
        """A copy with other values of some parameters in its notation; InputError names the parameter.

        ``sigma`` stands for the trail in any.
        """
        if self.bodies and "sigma" in values:
            if "trail" in values:
                problem = "sigma and trail are both given"
                raise InputError(problem, key=("sigma",), hint="give one of them")
            wheelbase = values.get("w", self.c)
            own = {name: value for name, value in values.items() if name != "sigma"}
            try:
                return self.replaced({**own, "trail": values["sigma"] * wheelbase})
            except InputError as error:
                raise error.renamed({"trail": "sigma"}) from None
        gone = superseded(values, "c" if self.bodies else "sigma") | values.keys()
        kept = {k: v for k, v in self.given.items() if k not in gone}
        try:
            bicycle = Bicycle.from_mapping({**kept, **values, "source": self.source}, name=self.name)
        except InputError as error:
            raise of_values(error, values) from None
        deviations = {k: sd for k, sd in self.deviations.items() if k not in gone}
        correlations = {pair: r for pair, r in self.correlations.items() if not {*pair} & gone}
        note = left_behind(self.given, values)
        notes = (*self.notes, note) if note and note not in self.notes else self.notes
        return bicycle.measured(deviations, correlations, notes)

    def measured(
        self, deviations: Mapping[str, float], correlations: Mapping[tuple[str, str], float],
        notes: tuple[str, ...] = (),
    ) -> Bicycle:  # fmt: skip
        """A copy with standard deviations of its ``given`` parameters, and correlations of pairs of them."""
        copy = dataclasses.replace(self)
        known = {"deviations": dict(deviations), "correlations": dict(correlations), "notes": notes}
        vars(copy).update(known, bodies=self.bodies)  # a frozen dataclass has no other way
        return copy

    def named(self, name: str) -> Bicycle:
        """A copy with another name."""
        copy = self.measured(self.deviations, self.correlations, self.notes)
        vars(copy)["name"] = name
        return copy

    def with_delta(self, delta: float | None) -> Bicycle:
        """Return a copy with the damping ``delta``, or the same for None."""
        return self if delta is None else self.replaced({"delta": delta})

    @classmethod
    def from_mapping(cls, values: Mapping[Any, Any], *, name: str = "bicycle") -> Bicycle:
        """A bicycle from keys in the paper's notation or the 25 parameters of Meijaard et al. (2007).

        The two are told apart by their keys: only the latter has ``w``. ``R`` stands for equal
        ``R1`` and ``R2``; two of ``head_angle``, ``trail`` and ``offset`` may stand for tilt and trail.
        ``rider``, a mapping, is one body more than the 25's. InputError names the key.
        """
        meijaard, numbers, texts = keyed(values, PAPER, name)
        name, source = texts["name"], texts["source"]
        gains = tuple((key, float(numbers[key])) for key in GAINS if numbers.get(key))
        if not meijaard:
            own = {key: value for key, value in numbers.items() if key not in GAINS}
            return cls(**own, name=name, source=source, gains=gains)  # type: ignore[arg-type]  # the keys were checked
        try:
            bicycle = cls(**two_parts(numbers), name=name, source=source, gains=gains)
        except InputError as error:
            raise of_bodies(error, numbers) from None
        object.__setattr__(bicycle, "bodies", numbers)
        return bicycle

    @classmethod
    def from_file(cls, path: str | Path) -> Bicycle:
        """A bicycle from a file that ``bikestab.formats`` reads; InputError names file, line and key."""
        from bikestab.formats.carried import carried
        from bikestab.formats.kinds import expected  # what comes with the package needs no reader
        from bikestab.formats.reading import read

        with expected("bicycle", path):
            found = read(path)
            try:
                bicycle = cls.from_mapping(found.values, name=Path(path).stem)
                found = carried(found, lambda values: cls.from_mapping(values).given)
            except InputError as error:
                raise found.located(error) from None
        return bicycle.measured(found.deviations, found.correlations, found.notes)

    @classmethod
    def preset(cls, name: str) -> Bicycle:
        """One of the bicycles that come with the package; see ``preset_names``."""
        if name not in preset_names():
            hint = f"{nearest(name, preset_names())} (see 'bikestab bicycles')"
            raise InputError(f"there is no bicycle {name!r}", hint=hint)
        return cls.from_mapping(yamltext.plain(preset_text(name)) or {}, name=name)

    @classmethod
    def load(cls, name_or_path: str, folder: str | Path = "") -> Bicycle:
        """A preset by its name, or else the bicycle in a file; its path starts from ``folder``."""
        looks_like_path = "/" in name_or_path or "." in name_or_path
        path = Path(folder, name_or_path)
        if name_or_path not in preset_names() and (looks_like_path or is_there(path)):
            return cls.from_file(path)
        return cls.preset(name_or_path)


def parameters() -> list[dataclasses.Field[Any]]:
    """The numeric fields of Bicycle, with ``unit``, ``meaning`` and ``check`` in their metadata."""
    return [f for f in dataclasses.fields(Bicycle) if f.metadata]


# The paper's notation: what may stand in a file, with unit and meaning.
PAPER: dict[str, str] = {f.name: f"{f.metadata['meaning']} [{f.metadata['unit']}]" for f in parameters()}
PAPER |= {"R": "radius of both wheels [m]", "trail": "own trail along the ground [m]"}
