"""A scan's YAML file → ScanConfig; every mistake is one message with file, line, key and what is allowed."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.correlation import with_known
from bikestab.config.expectations import Outcome, outcomes
from bikestab.config.parts import GRIDS
from bikestab.config.scanconfig import CheckConfig, Expectation, Plane, ScanConfig
from bikestab.config.values import Strict
from bikestab.config.variation import Distribution, Ensemble
from bikestab.errors import InputError, dotted, nearest
from bikestab.fields import AXES
from bikestab.formats.kinds import expected
from bikestab.notation import MEASURED
from bikestab.presets import preset_names
from bikestab.rider import flattened
from bikestab.texts import is_there
from bikestab.units import shown

Form = TypeVar("Form", bound=Strict)


def load_config(path: str | Path, overrides: Sequence[str] = ()) -> ScanConfig:
    """Read a scan's YAML file, with ``key.path=value`` overrides (values in YAML) put over it.

    Raises InputError naming file, line, key, value and what is allowed.
    """
    with expected("config", path):
        return parse_config(_read(path), overrides)


def load_checked(path: str | Path) -> ScanConfig | CheckConfig:
    """Read what ``bikestab check`` needs: a scan's YAML file, or one without a grid.

    Raises as ``load_config``.
    """
    with expected("config", path):
        return _for_check(_read(path))


def checked(path: str | Path) -> tuple[ScanConfig | CheckConfig, list[Outcome], list[int]]:
    """The same, what became of its expectations, and on which lines these are.

    Raises as ``load_config``, also where there are none.
    """
    with expected("config", path):
        document = _read(path)
        config = _for_check(document)
    try:
        found = outcomes(config)
    except InputError as error:
        raise document.located(error) if error.key else error.at(document.file) from None
    return config, found, [document.line(("expect", i)) for i in range(len(found))]


def _for_check(document: yamltext.Document) -> ScanConfig | CheckConfig:
    if document.data.keys() <= CheckConfig.model_fields.keys():
        return _parsed(document, {}, CheckConfig)
    return parse_config(document)


def parse_config(document: yamltext.Document, overrides: Sequence[str] = ()) -> ScanConfig:
    """The configuration in a parsed YAML document; see ``load_config``."""
    places = {}
    for override in overrides:
        key, document = _override(document, override)
        places[key] = f"--set {override}"
    return _parsed(document, places, ScanConfig).with_text(document.text)


def _read(path: str | Path) -> yamltext.Document:
    if str(path) in preset_names() and not is_there(path):
        hint = f"'bikestab init --bicycle {path}' writes a config of it"
        raise InputError("is a bicycle, not a scan's config", place=str(path), hint=hint)
    return yamltext.read(path)


def _parsed(document: yamltext.Document, places: dict[tuple[str | int, ...], str], form: type[Form]) -> Form:
    try:
        data = _plain(document.data)
        for name in ("sweep", "ensemble"):
            if isinstance(data.get(name), dict) and isinstance(data[name].get("rider"), dict):
                data[name] = flattened(data[name])  # as --set sweep.rider.m=... builds it
        if form is ScanConfig:
            data.setdefault("output", f"out/{Path(document.file).stem}")
        if "bicycle" in data:
            typed = ("bicycle",) in places  # in a command, where paths start from the current folder
            data["bicycle"] = _load_bicycle(data["bicycle"], "" if typed else Path(document.file).parent)
        typed = ("ensemble",) in {key[:1] for key in places}
        folder = "" if typed else Path(document.file).parent
        if "ensemble" in data:
            data["ensemble"] = with_known(data["ensemble"], data.get("bicycle"), folder)
        try:
            return form.model_validate(data)
        except ValidationError as error:
            raise _translated(error) from None
    except InputError as error:
        for key, place in places.items():
            if (*".".join(map(str, error.key)).split("."),)[: len(key)] == (*map(str, key),):
                raise error.at(place) from None
        raise document.located(error) from None


def config_schema() -> dict[str, Any]:
    """The JSON Schema of a scan's YAML file."""
    schema = ScanConfig.model_json_schema()
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    schema["required"].remove("output")
    return schema


def _load_bicycle(value: object, folder: str | Path) -> object:
    try:
        if isinstance(value, str):
            return Bicycle.load(value, folder)
        if isinstance(value, dict):
            return Bicycle.from_mapping(value)
    except InputError as error:
        raise error.at(under=("bicycle",)) from None
    return value


def _translated(error: ValidationError) -> InputError:
    """The one mistake to tell of first: a misspelt key explains the missing one."""
    errors = sorted(error.errors(), key=lambda e: e["type"] != "extra_forbidden")
    first = errors[0]
    key, context, kind, family = first["loc"], first.get("ctx", {}), first["type"], False
    if key[:1] == ("grid",) and len(key) > 1 and key[1] in GRIDS:
        family, key = key[1] == GRIDS[1], (key[0], *key[2:])  # without the tag of the grids' union
    tag = key[2] if key[:1] in (("grid",), ("sweep",)) and len(key) > 2 else ""
    if tag:
        key = key[:2] + key[3:]  # without the tag of the axis' union
    if kind == "bikestab":
        return InputError(context["problem"], key=context["key"] or key, hint=context["hint"])
    if kind == "extra_forbidden":
        known = ["values"] if tag == "values" else _known(key[:-1], family)
        return InputError("unknown key", key=key, hint=nearest(str(key[-1]), known))
    if kind == "missing":
        return InputError("missing", key=key, hint=f"needed here: {', '.join(_known(key[:-1], family))}")
    if kind == "literal_error":
        words = context["expected"].replace(" or ", ", ").replace("'", "").split(", ")
        return InputError(f"{shown(first['input'])} is not known", key=key, hint=_near(first["input"], words))
    what = {
        "int_type": "a whole number",
        "int_from_float": "a whole number",
        "string_type": "text",
        "list_type": "a list",
        "model_type": "keys with values",
        "model_attributes_type": "keys with values",
        "dict_type": "keys with values",
        "greater_than_equal": f"at least {context.get('ge')}",
        "less_than_equal": f"at most {context.get('le')}",
        "too_short": f"a list of at least {context.get('min_length')}",
        "string_too_short": "text that is not empty",
    }.get(kind, first["msg"])
    hint = (
        f"keys here: {', '.join(_known(key, family))}" if what == "keys with values" else f"allowed: {what}"
    )
    if kind == "list_type" and tag == "list":
        hint += " of values, or {start: ..., stop: ..., num: ...}"
    return InputError(f"{shown(first['input'])} is not {what}", key=key, hint=hint)


def _near(value: object, words: Sequence[str]) -> str:
    return nearest(value, words) if isinstance(value, str) else f"known: {', '.join(words)}"


def _known(key: tuple[str | int, ...], family: bool) -> list[str]:
    """The keys that may stand at a place of the document."""
    if not key:
        return list(ScanConfig.model_fields)
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
    model = Plane if key[0] == "slices" else Expectation
    return [*model.model_fields, *MEASURED]


def _override(document: yamltext.Document, override: str) -> tuple[tuple[str | int, ...], yamltext.Document]:
    """Put ``key.path=value`` in; its path, or the part down to the first new key, and the new document."""
    name, equals, text = override.partition("=")
    path = [part.strip() for part in name.split(".")]
    if not equals or not all(path):
        raise InputError(
            f"{override!r} is not key=value", place="--set", hint="for example --set grid.lam.num=31"
        )
    value = yamltext.parse(f"value: {text}", f"--set {override}").data["value"]
    key: list[str | int] = []
    node: Any = document.data
    made = len(path)
    for i, part in enumerate(path):
        step: str | int = part
        if isinstance(node, list):
            with suppress(ValueError):
                step = int(part)
            if not isinstance(step, int) or not -len(node) <= step < len(node):
                raise InputError(f"{dotted(key)} has no item {part}", place=f"--set {override}")
        elif not isinstance(node, dict):
            raise InputError(f"{dotted(key)} has no keys", place=f"--set {override}")
        key.append(step)
        if isinstance(node, dict) and step not in node:
            made, node = min(made, i + 1), {}
        else:
            node = node[step]
    return tuple(key[:made]), document.replaced(key, value)


def _plain(node: Any, key: tuple[str | int, ...] = ()) -> Any:
    """The YAML tree as plain dicts and lists, with text keys."""
    if isinstance(node, dict):
        return {str(k): _plain(value, (*key, str(k))) for k, value in node.items()}
    if isinstance(node, list):
        return [_plain(value, (*key, i)) for i, value in enumerate(node)]
    if isinstance(node, str) and ("\0" in node or node != node.encode(errors="ignore").decode()):
        raise InputError(f"{shown(node)} has characters that no file can hold", key=key)
    return node
