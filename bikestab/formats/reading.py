"""A file of a bicycle in any known format → the parameters found in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from bikestab import yamltext
from bikestab.errors import InputError, nearest
from bikestab.formats import equalities
from bikestab.formats.extras import without_extras
from bikestab.formats.found import Found
from bikestab.texts import read_text

ENDINGS = (".yaml", ".yml", ".txt", ".ini")
WORDS = ("parameterization", "parameters", "rider", "description")  # beside ``values`` in a parameter set
Located: TypeAlias = Callable[[InputError], InputError]


def read(path: str | Path) -> Found:
    """The parameters in the file at ``path``; InputError names file, line, key and value."""
    text = read_text(path)
    file = str(path)
    return _from_equalities(text, file) if equalities.looks_like(text) else _from_yaml(text, file)


def _from_equalities(text: str, file: str) -> Found:
    found = equalities.parse(text, file)
    values, notes = _settled(found.values, found.located)
    deviations = {key: sd for key, sd in found.deviations.items() if key in values}
    return Found(values, found.located, deviations, notes=tuple(notes))


def _from_yaml(text: str, file: str) -> Found:
    data: Any = yamltext.plain(text)
    if data is None:
        document = yamltext.parse(text, file)
        data, located = document.data, document.located
    else:
        located = lambda error: yamltext.parse(text, file).located(error)  # noqa: E731  # parsed for its lines alone
    if isinstance(data.get("values"), dict):
        return _from_parameter_set(data, located)
    values, notes = _settled(data, located)
    return Found(values, located, notes=tuple(notes))


def _from_parameter_set(data: Any, located: Located) -> Found:
    """YAML as BicycleParameters writes a set of parameters: under ``values``, with words about it beside."""

    def inside(error: InputError) -> InputError:
        return located(error.at(under=("values",)))

    for key in data:
        if key not in ("values", *WORDS):
            raise located(
                InputError("unknown key", key=(str(key),), hint=nearest(str(key), ("values", *WORDS)))
            )
    values, notes = _settled(data["values"], inside)
    return Found(values, inside, notes=tuple(notes))


def _settled(values: Mapping[Any, Any], located: Located) -> tuple[dict[Any, Any], list[str]]:
    try:
        return without_extras(values)
    except InputError as error:
        raise located(error) from None
