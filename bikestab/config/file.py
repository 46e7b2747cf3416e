"""A scan's YAML file → ScanConfig; every mistake is one message with file, line, key and what is allowed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.correlation import with_known
from bikestab.config.mistakes import UNKNOWN, apart, translated
from bikestab.config.oneunit import bare_in_lists
from bikestab.config.scanconfig import ScanConfig
from bikestab.config.values import Strict
from bikestab.errors import InputError, Mistakes, dotted, together
from bikestab.files import folder_of
from bikestab.formats.kinds import expected
from bikestab.presets import preset_names
from bikestab.rider import flattened
from bikestab.texts import is_there
from bikestab.units import DAMPING, quantity, shown

Form = TypeVar("Form", bound=Strict)
_Key = tuple[str | int, ...]
_STAND_IN = "meijaard2007"  # for a bicycle that cannot be read, so that other mistakes are found


def load_config(path: str | Path, overrides: Sequence[str] = ()) -> ScanConfig:
    """Read a scan's YAML file, with ``key.path=value`` overrides (values in YAML) put over it.

    Raises InputError naming file, line, key, value and what is allowed.
    """
    with expected("config", path):
        return parse_config(read_document(path), overrides)


def parse_config(document: yamltext.Document, overrides: Sequence[str] = ()) -> ScanConfig:
    """The configuration in a parsed YAML document; see ``load_config``."""
    places: dict[_Key, str] = {}
    _check_once(overrides)
    for override in overrides:
        key, document = _override(document, override)
        places[key] = f"--set {override}"
    notes = tuple(bare_in_lists(document.data))
    return validated(document, places, ScanConfig).with_text(document.text, notes)


def bicycle_in(text: str, folder: str | Path) -> Bicycle:
    """The bicycle that a config's text gives, with its damping; a path starts from ``folder``.

    InputError for a text that gives none, and a path at which no regular file is.
    """
    data = _plain(yamltext.parse(text, "config").data)
    named = data.get("bicycle")
    if isinstance(named, str) and named not in preset_names() and not Path(folder, named).is_file():
        raise InputError("there is no such file", place=named)
    bicycle = _load_bicycle(named, folder)
    if not isinstance(bicycle, Bicycle):
        raise InputError("is no bicycle", key=("bicycle",))
    delta = data.get("delta")
    return bicycle if delta is None else bicycle.with_delta(quantity(delta, DAMPING))


def _check_once(overrides: Sequence[str]) -> None:
    """Refuse one that takes the place of what another one before it put in."""
    paths = [[part.strip() for part in override.partition("=")[0].split(".")] for override in overrides]
    for i, path in enumerate(paths):
        for before in paths[:i]:
            if before[: len(path)] == path:
                problem = f"{'.'.join(before)} is set already"
                raise InputError(problem, place=f"--set {overrides[i]}", hint="give one of them")


def read_document(path: str | Path) -> yamltext.Document:
    """The YAML document of a config; InputError if it is none, and for the name of a preset."""
    if str(path) in preset_names() and not is_there(path):
        hint = f"'bikestab init --bicycle {path}' writes a config of it"
        raise InputError("is a bicycle, not a scan's config", place=str(path), hint=hint)
    return yamltext.read(path)


def validated(document: yamltext.Document, places: dict[_Key, str], form: type[Form]) -> Form:
    """The document as ``form`` has it; ``places`` say which keys options brought. Raises InputError."""
    mistakes = Mistakes()
    try:
        data = _plain(document.data)
        for name in ("sweep", "ensemble"):
            if isinstance(data.get(name), dict) and isinstance(data[name].get("rider"), dict):
                data[name] = flattened(data[name])  # as --set sweep.rider.m=... builds it
        if form is ScanConfig:
            data.setdefault("output", f"out/{Path(document.file).stem}")
        typed = {key[0] for key in places}  # in a command, where paths start from the current folder
        folder = folder_of(document.file)
        if "bicycle" in data:
            named = places.get(("bicycle",), f"{document.file}, line {document.line(('bicycle',))}")
            with mistakes.kept(), _named(named):
                data["bicycle"] = _load_bicycle(data["bicycle"], "" if ("bicycle",) in places else folder)
        if mistakes.found:
            data["bicycle"] = Bicycle.preset(_STAND_IN)
            if isinstance(data.get("ensemble"), dict):
                data["ensemble"].pop("covariance", None)
        if "ensemble" in data:
            with mistakes.kept():
                data["ensemble"] = with_known(
                    data["ensemble"], data.get("bicycle"), "" if "ensemble" in typed else folder
                )
        try:
            config = form.model_validate(data, context=mistakes)
        except ValidationError as error:
            mistakes.found += apart(translated(error, form), mistakes.found)
        mistakes.tell()
        return config
    except InputError as error:
        by_line = sorted(error.mistakes, key=lambda each: (document.line(each.key), each.problem != UNKNOWN))
        raise document.located(together([_of_option(each, places) for each in by_line])) from None


@contextmanager
def _named(where: str) -> Iterator[None]:
    """Say of mistakes in another file where that one is named: it may be in any of many configs."""

    def there(error: InputError) -> InputError:
        if not error.place:
            return error
        link = "" if not error.hint else " " if error.hint.endswith("?") else "; "
        hint = f"{error.hint}{link}named in {where}"
        return InputError(error.problem, key=error.key, hint=hint, place=error.place)

    try:
        yield
    except InputError as error:
        raise error.each(there) from None


def _of_option(error: InputError, places: dict[_Key, str]) -> InputError:
    """The mistake with the option that brought it, if one did."""
    for key, place in places.items():
        if (*".".join(map(str, error.key)).split("."),)[: len(key)] == (*map(str, key),):
            return error.at(place)
    return error


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
                hint = f"it has {len(node)}, counted from 0" if node else "it is empty"
                raise InputError(f"{dotted(key)} has no item {part}", place=f"--set {override}", hint=hint)
        elif not isinstance(node, dict):
            problem, hint = f"{dotted(key)} has no keys", f"it is {shown(node)}; set it as a whole"
            raise InputError(problem, place=f"--set {override}", hint=hint)
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
