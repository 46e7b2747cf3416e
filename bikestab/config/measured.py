"""Head angle, trail and fork offset in a config → λ and σ, before anything else is read of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from pydantic_core import PydanticCustomError

from bikestab.bicycle import Bicycle
from bikestab.config.oneunit import all_of, in_words, one_unit
from bikestab.config.values import in_si, json_schema, mistake
from bikestab.config.variation import VARIED
from bikestab.errors import InputError, Mistakes, nearest
from bikestab.geometry import GIVEN, design_given
from bikestab.notation import MEASURED
from bikestab.units import quantity

_Key = tuple[str | int, ...]
_ONE = "allowed: one of head_angle, trail, lam, sigma and V"
_EXPECTED = ("V1", "V2", "within", "stable")
MEASURED_AXES = {"head_angle": "lam", "trail": "sigma"}


def in_lam_and_sigma(given: Any, found: Mistakes | None = None) -> Any:
    """A config's values with ``lam`` and ``sigma`` in place of MEASURED, in grid, slices and expectations.

    The mistakes of what contradicts each other, and of a trail where the wheelbase varies, are ``found``
    along with others, and their parts left as they are; without others they are raised.
    """
    if not isinstance(given, Mapping) or not isinstance(bicycle := given.get("bicycle"), Bicycle):
        return given
    config, mistakes = dict(given), Mistakes() if found is None else found
    axes = _named(config.get("grid"))
    if isinstance(grid := config.get("grid"), Mapping) and MEASURED.keys() & grid:
        config["grid"] = _grid(grid, bicycle, config.get("sweep"), mistakes)
    for name in ("slices", "expect"):
        if isinstance(entries := config.get(name), list):
            config[name] = [*entries]
            for i, entry in enumerate(entries):
                with _kept(mistakes, (name, i)):
                    planes = axes and name == "slices"
                    config[name][i] = (
                        _plane(entry, axes, (name, i)) if planes else _entry(entry, bicycle, (name, i))
                    )
    if found is None and mistakes.found:
        raise all_of([mistake(each.problem, each.hint, each.key) for each in mistakes.found])
    return config


@contextmanager
def _kept(mistakes: Mistakes, key: _Key) -> Iterator[None]:
    """Keep what a validator raises, at a key unless it has one."""
    try:
        yield
    except PydanticCustomError as error:
        mistakes.found += in_words(error.context, key)


def also_measured(schema: dict[str, Any]) -> None:
    """Add to the JSON Schema of a slice or an expectation what may stand in place of lam and sigma."""
    for name, meaning in MEASURED.items():
        schema["properties"][name] = {"description": meaning, **json_schema(GIVEN[name])}


def also_measured_axes(schema: dict[str, Any]) -> None:
    """The same to that of the grid."""
    schema["allOf"] = []
    for name, other in MEASURED_AXES.items():
        number = json_schema(GIVEN[name])
        ends = {"start": number, "stop": number, "num": {"type": "integer", "minimum": 2}}
        spaced = {"type": "object", "properties": ends, "required": [*ends]}
        chosen = {"values": {"type": "array", "items": number, "minItems": 2}}
        listed = {"type": "object", "properties": chosen, "required": ["values"]}
        kinds = [each | {"additionalProperties": False} for each in (spaced, listed)]
        schema["properties"][name] = {"description": MEASURED[name], "oneOf": kinds}
        schema["required"].remove(other)
        schema["allOf"].append({"oneOf": [{"required": [other]}, {"required": [name]}]})


def _named(grid: Any) -> tuple[str, ...]:
    """The names of a grid's axes where it has other ones than lam and sigma; none of what is no grid."""
    if not isinstance(grid, Mapping) or {"x", "y"}.isdisjoint(grid):
        return ()
    names = [grid[key].get("name") for key in ("x", "y") if isinstance(grid.get(key), Mapping)]
    return (*(name for name in names if isinstance(name, str)), "V")


def _plane(entry: Any, axes: tuple[str, ...], key: _Key) -> Any:
    """A slice of a grid with these axes, its value as a number."""
    if not isinstance(entry, Mapping):
        return entry
    numbers = {}
    for name, value in entry.items():
        if name not in axes:
            raise mistake(f"the grid has no axis {name!r}", nearest(str(name), axes), (*key, name))
        numbers[name] = value if name == "V" else in_si(value, VARIED.get(name, ""), (*key, name))
    return numbers


def _of_parameters(entry: Mapping[str, Any], others: list[Any], key: _Key) -> dict[str, Any]:
    """An expectation of a machine with other parameters, each as a number."""
    for name in others:
        if name not in VARIED:
            raise mistake("unknown key", nearest(str(name), [*_EXPECTED, *VARIED]), (*key, name))
    return {
        name: value if name in _EXPECTED else in_si(value, VARIED[name], (*key, name))
        for name, value in entry.items()
    }


def _grid(grid: Mapping[str, Any], bicycle: Bicycle, sweep: Any, mistakes: Mistakes) -> dict[str, Any]:
    """The grid's axes, those that cannot be converted as they are."""
    axes: dict[str, Any] = {}
    for name, axis in grid.items():
        axes[name] = axis
        with _kept(mistakes, ("grid", name)):
            if name in MEASURED:
                _check_axis(name, grid, bicycle, sweep)
                converted = _axis(axis, name, bicycle)
                del axes[name]
                axes[MEASURED_AXES[name]] = converted
    return axes


def _check_axis(name: str, grid: Mapping[str, Any], bicycle: Bicycle, sweep: Any) -> None:
    """Raise the mistake of an axis that no grid has, or not beside what else there is."""
    if name == "offset":
        raise mistake("the grid has tilt and trail", "give head_angle and trail", ("grid", name))
    if (other := MEASURED_AXES[name]) in grid:
        raise mistake(f"{other} is given as well", "give one of them", ("grid", name))
    wheelbase = "w" if bicycle.bodies else "c"
    if name == "trail" and isinstance(sweep, Mapping) and wheelbase in sweep:
        raise mistake(f"the sweep has the wheelbase, {wheelbase}", "give grid.sigma", ("grid", name))


def _axis(axis: Any, name: str, bicycle: Bicycle) -> Any:
    """Values of an axis in lam or sigma, ascending; what is no axis as it is."""

    def converted(value: Any, key: _Key) -> float:
        try:
            design = design_given({name: quantity(value, GIVEN[name])}, bicycle.c, bicycle.R2)
        except InputError as error:
            raise mistake(error.problem, error.hint, ("grid", name, *key)) from None
        return float(design[name == "trail"])

    if not isinstance(axis, Mapping):
        return axis
    turned = name == "head_angle"  # the steepest is the least tilted
    axis = one_unit(axis)
    found = dict(axis)
    ends = {end: converted(axis[end], (end,)) for end in ("start", "stop") if end in axis}
    if ends:
        found |= {{"start": "stop", "stop": "start"}[end] if turned else end: x for end, x in ends.items()}
    if isinstance(values := axis.get("values"), list):
        numbers = [converted(value, ("values", i)) for i, value in enumerate(values)]
        found["values"] = numbers[::-1] if turned else numbers
    return found


def _entry(entry: Any, bicycle: Bicycle, key: _Key) -> Any:
    """A slice or an expectation with lam and sigma, which its MEASURED and these give."""
    if not isinstance(entry, Mapping):
        return entry
    if key[0] == "expect" and (others := [name for name in entry if name not in {*GIVEN, *_EXPECTED}]):
        return _of_parameters(entry, others, key)
    if key[0] == "slices" and (strange := [name for name in entry if name not in {*GIVEN, "V"}]):
        raise mistake("unknown key", nearest(str(strange[0]), [*GIVEN, "V"]), (*key, strange[0]))
    if not MEASURED.keys() & entry:
        return entry
    typed = {name: value for name, value in entry.items() if name in GIVEN and value is not None}
    if key[0] == "slices" and len(entry) != 1:
        raise mistake("a slice fixes one axis", _ONE, key)
    if key[0] == "slices" and "offset" in entry:
        raise mistake(
            "a slice fixes one axis", "allowed: head_angle, trail, lam, sigma or V", (*key, "offset")
        )
    numbers = {}
    try:
        for name, value in typed.items():
            numbers[name] = quantity(value, GIVEN[name], key=(name,))
        own = (None, None) if key[0] == "slices" else (bicycle.lam, bicycle.sigma)
        lam, sigma = design_given(numbers, bicycle.c, bicycle.R2, own)
    except InputError as error:
        raise mistake(error.problem, error.hint, (*key, *error.key)) from None
    rest = {name: value for name, value in entry.items() if name not in GIVEN}
    return rest | {name: float(x) for name, x in (("lam", lam), ("sigma", sigma)) if x is not None}
