"""What pydantic finds wrong in a config → mistakes with key, value and what is allowed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from bikestab.config.measured import MEASURED_AXES
from bikestab.config.oneunit import in_words
from bikestab.config.parts import GRIDS
from bikestab.config.scanconfig import Expectation, Plane
from bikestab.config.values import Strict
from bikestab.config.variation import Distribution, Ensemble
from bikestab.errors import InputError, nearest
from bikestab.fields import AXES
from bikestab.notation import MEASURED
from bikestab.units import shown

UNKNOWN, _MISSING = "unknown key", "missing"
_Key = tuple[str | int, ...]
_EXAMPLES = {
    "bicycle": "for example 'bicycle: meijaard2007'; see 'bikestab bicycles'",
    "grid": "for example 'grid: {lam: {start: 0, stop: 0.3, num: 31}, ...}'; see 'bikestab init'",
}
_WHAT = {
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "string_type": "text",
    "bool_type": "true or false",
    "list_type": "a list",
    "model_type": "keys with values",
    "model_attributes_type": "keys with values",
    "dict_type": "keys with values",
    "string_too_short": "text that is not empty",
}


def translated(error: ValidationError, form: type[Strict]) -> list[InputError]:
    """All mistakes that can be told of; what a misspelt key is likely to mean is not missing."""
    found = [mistake for each in error.errors() for mistake in _mistakes(each, form)]
    meant = {
        (*mistake.key[:-1], name)
        for mistake in found
        if mistake.problem == UNKNOWN
        for name in _meant(mistake, form)
    }
    return [mistake for mistake in found if mistake.problem != _MISSING or mistake.key not in meant]


def _meant(mistake: InputError, form: type[Strict]) -> Iterable[str]:
    """The keys that an unknown one may stand for."""
    name = str(mistake.key[-1])
    near = [key for key in _known(mistake.key[:-1], False, form) if repr(key) in mistake.hint]
    axes = MEASURED_AXES | {"offset": "sigma"}
    return [axes.get(key, key) for key in (name, *near)]


def _mistakes(each: ErrorDetails, form: type[Strict]) -> list[InputError]:
    key, context, kind, family = each["loc"], each.get("ctx", {}), each["type"], False
    if key[:1] == ("grid",) and len(key) > 1 and key[1] in GRIDS:
        family, key = key[1] == GRIDS[1], (key[0], *key[2:])  # without the tag of the grids' union
    tag = key[2] if key[:1] in (("grid",), ("sweep",)) and len(key) > 2 else ""
    if tag:
        key = key[:2] + key[3:]  # without the tag of the axis' union
    if kind == "bikestab":
        return in_words(context, key)
    return [_told(each, key, str(tag), family, form)]


def _told(each: ErrorDetails, key: _Key, tag: str, family: bool, form: type[Strict]) -> InputError:
    """One of pydantic's own in words."""
    kind, context, value = each["type"], each.get("ctx", {}), each["input"]
    if kind == "extra_forbidden":
        known = ["values"] if tag == "values" else _known(key[:-1], family, form)
        return InputError(UNKNOWN, key=key, hint=nearest(str(key[-1]), known))
    if kind == "missing":
        hint = f"needed here: {', '.join(_known(key[:-1], family, form))}"
        return InputError(_MISSING, key=key, hint=_EXAMPLES.get(".".join(map(str, key)), hint))
    if kind == "literal_error":
        words = context["expected"].replace(" or ", ", ").replace("'", "").split(", ")
        return InputError(f"{shown(value)} is not known", key=key, hint=_near(value, words))
    limits = {
        "greater_than_equal": f"at least {context.get('ge')}",
        "less_than_equal": f"at most {context.get('le')}",
        "too_short": f"a list of at least {context.get('min_length')}",
    }
    what = (_WHAT | limits).get(kind, each["msg"])
    hint = f"allowed: {what}"
    if what == "keys with values":
        hint = f"keys here: {', '.join(_known(key, family, form))}"
    if kind == "list_type" and tag == "list":
        hint += " of values, or {start: ..., stop: ..., num: ...}"
    return InputError(f"{shown(value)} is not {what}", key=key, hint=hint)


def _near(value: object, words: Sequence[str]) -> str:
    return nearest(value, words) if isinstance(value, str) else f"known: {', '.join(words)}"


def _known(key: _Key, family: bool, form: type[Strict]) -> list[str]:
    """The keys that may stand at a place of the document."""
    if not key:
        return list(form.model_fields)
    if key[0] == "grid":
        values = ["start", "stop", "num", "values"]
        if family:
            return ["x", "y", "V"] if len(key) == 1 else ["name", *values]
        return [*AXES, "head_angle", "trail"] if len(key) == 1 else values
    if key[0] == "sweep":
        return ["parameters of the bicycle"] if len(key) == 1 else ["start", "stop", "num", "values"]
    if key == ("ensemble",):
        return ["parameters of the bicycle", *Ensemble.model_fields, "covariance"]
    if key[0] == "ensemble":
        return list(Distribution.model_fields)
    model: type[Strict] = Plane if key[0] == "slices" else Expectation
    return [*model.model_fields, *MEASURED]


def apart(mistakes: Sequence[InputError], earlier: Sequence[InputError]) -> list[InputError]:
    """Those whose keys neither hold nor are in that of an earlier one, which they may only follow from."""

    def within(a: Any, b: Any) -> bool:
        return a[: len(b)] == b or b[: len(a)] == a

    return [each for each in mistakes if not any(within(each.key, one.key) for one in earlier)]
