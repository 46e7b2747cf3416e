"""A file of a bicycle in any known format → the parameters found in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

from bikestab import yamltext
from bikestab.errors import InputError, nearest
from bikestab.formats import equalities, measured
from bikestab.formats.extras import without_extras
from bikestab.formats.found import Found
from bikestab.formats.kinds import expected, is_bikecad, is_jbike6
from bikestab.rider import flattened
from bikestab.texts import read_text

WORDS = ("parameterization", "parameters", "rider", "description")  # beside ``values`` in a parameter set
_EXAMPLE = "'mB = 85'; see 'bikestab bicycles meijaard2007'"
_OF_RIDER = {"mB": "rider.m", "xB": "rider.x", "zB": "rider.z"}
_OF_RIDER |= {f"IB{axes}": f"rider.I{axes}" for axes in ("xx", "yy", "zz", "xz")}
Located: TypeAlias = Callable[[InputError], InputError]


def read(path: str | Path) -> Found:
    """The parameters in the file at ``path``; InputError names file, line, key and value."""
    text = read_text(path)
    file = str(path)
    if is_bikecad(text[:1000].encode()):
        from bikestab.formats import bikecad  # readers are loaded for what they read

        raise bikecad.refused(text, file)
    if is_jbike6(text):
        from bikestab.formats import jbike6

        return jbike6.read(text, file)
    return _from_equalities(text, file) if equalities.looks_like(text) else _from_yaml(text, file)


def read_rider(path: str | Path) -> Found:
    """The rider in a file of BicycleParameters, named ``rider.m`` and so on; its keys there are B's."""
    with expected("rider", path):
        found = equalities.parse(read_text(path), str(path))
        values, notes = _settled(found.values, found.located, found.deviations)
        names = {key: _OF_RIDER[key] for key in values if key in _OF_RIDER}
        for key in values:
            if key not in names:
                hint = f"known: {', '.join(_OF_RIDER)}"
                raise found.located(InputError("is no parameter of a rider", key=(key,), hint=hint))
        if not names:
            hint = f"a rider's file has {', '.join(_OF_RIDER)}"
            raise InputError("holds no parameter of a rider", place=str(path), hint=hint)
    keys = {ours: theirs for theirs, ours in names.items()}

    def located(error: InputError) -> InputError:
        return found.located(error.renamed(keys))

    deviations = {names[key]: sd for key, sd in found.deviations.items() if key in names}
    return Found({names[key]: values[key] for key in names}, located, deviations, notes=tuple(notes))


def _from_equalities(text: str, file: str) -> Found:
    found = equalities.parse(text, file)
    if measured.looks_like(found.entries):
        try:
            reduced = measured.reduce(found.entries)
        except InputError as error:
            raise found.located(error) from None
        values = reduced.values | found.texts
        return Found(values, found.located, reduced.deviations, reduced.correlations)
    values, notes = _settled(found.values, found.located, found.deviations)
    deviations = {key: sd for key, sd in found.deviations.items() if key in values}
    return Found(values | found.texts, found.located, deviations, notes=tuple(notes))


def _from_yaml(text: str, file: str) -> Found:
    data: Any = yamltext.plain(text)
    if data is None:
        document = yamltext.parse(text, file, _EXAMPLE)
        data, located = document.data, document.located
    else:
        located = lambda error: yamltext.parse(text, file, _EXAMPLE).located(error)  # noqa: E731  # parsed for its lines alone
    if isinstance(data.get("values"), dict):
        return _from_parameter_set(data, located)
    return _of_mapping(data, located)


def _from_parameter_set(data: Any, located: Located) -> Found:
    """YAML as BicycleParameters writes a set of parameters: under ``values``, with words about it beside."""

    def inside(error: InputError) -> InputError:
        return located(error.at(under=("values",)))

    for key in data:
        if key not in ("values", *WORDS):
            raise located(
                InputError("unknown key", key=(str(key),), hint=nearest(str(key), ("values", *WORDS)))
            )
    return _of_mapping(data["values"], inside)


def _of_mapping(data: Mapping[Any, Any], located: Located) -> Found:
    """The values, of which text such as ``85 +/- 0.5`` has a standard deviation."""
    try:
        values, deviations = _measured(data)
        if isinstance(rider := data.get("rider"), Mapping):
            values["rider"], inner = _measured(rider, "rider.")
            deviations |= inner
    except InputError as error:
        raise located(error) from None
    values, notes = _settled(values, located, deviations)
    if not deviations:
        return Found(values, located, notes=tuple(notes))
    try:
        values = flattened(values)  # scale_inertia has the mass alone, which is without uncertainty by now
    except InputError as error:
        raise located(error) from None
    return Found(values, located, {k: sd for k, sd in deviations.items() if k in values}, notes=tuple(notes))


def _measured(values: Mapping[Any, Any], prefix: str = "") -> tuple[dict[Any, Any], dict[str, float]]:
    """The values, and the standard deviations that are not zero of those that are such text."""
    found, deviations = dict(values), {}
    for key, value in values.items():
        if _uncertain(value) and key not in ("name", "source"):
            found[key], deviations[f"{prefix}{key}"] = equalities.mean(value, f"{prefix}{key}")
    return found, {key: sd for key, sd in deviations.items() if sd}


def _uncertain(value: Any) -> bool:
    return isinstance(value, str) and any(sign in value for sign in ("+/-", "±", "+-"))


def _settled(
    values: Mapping[Any, Any], located: Located, deviations: Mapping[str, float]
) -> tuple[dict[Any, Any], list[str]]:
    """The parameters alone, and notes on what else there was."""
    if values.keys() >= {"ie33", "l4"}:
        from bikestab.formats import moore2012

        return _converted(moore2012, values, located, deviations, ["from axes along the steering axis"])
    try:
        kept, notes = without_extras(values)
    except InputError as error:
        raise located(error) from None
    if values and not kept:
        problem = f"has no parameter of a bicycle: {', '.join(map(str, values))}"
        raise located(InputError(problem, hint="'bikestab bicycles meijaard2007' prints a file of one"))
    if kept.keys() >= {"kHaa", "alphaH"}:
        from bikestab.formats import principal

        notes.append("from principal axes; its body P is the rider")
        return _converted(principal, kept, located, deviations, notes)
    return kept, notes


def _converted(
    notation: ModuleType, values: Mapping[Any, Any], located: Located, deviations: Mapping[str, float],
    notes: list[str],
) -> tuple[dict[Any, Any], list[str]]:  # fmt: skip
    """The parameters from those of another notation, and the notes, with one on what cannot be carried."""
    try:
        found = notation.converted(values)
    except InputError as error:
        raise located(error) from None
    if lost := [key for key in deviations if key in values and key not in found]:
        notes.append(f"not carried to other axes, left out: the uncertainties of {', '.join(lost)}")
    return found, notes
