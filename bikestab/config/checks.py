"""A YAML file → what it expects of a machine, and what became of that, entry by entry."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from bikestab import yamltext
from bikestab.config.checkconfig import CheckConfig
from bikestab.config.expectations import Outcome, outcome_of
from bikestab.config.file import parse_config, read_document, validated
from bikestab.config.scanconfig import ScanConfig
from bikestab.errors import InputError, nearest, together
from bikestab.formats.kinds import expected

AnyConfig: TypeAlias = ScanConfig | CheckConfig


class Entry(NamedTuple):
    """An expectation by the line of its file: what became of it, or why it cannot be used."""

    line: int
    result: Outcome | InputError


def load_checked(path: str | Path) -> AnyConfig:
    """Read what ``bikestab check`` needs: a scan's YAML file, or one without a grid.

    Raises as ``load_config``.
    """
    with expected("config", path):
        return _parsed(read_document(path))


def checked(path: str | Path) -> tuple[AnyConfig, list[Entry]]:
    """The same, and each of its expectations; one that cannot be used hides no other.

    Raises as ``load_config``, also where there are none.
    """
    with expected("config", path):
        document = read_document(path)
        config, unusable = _without_unusable(document)
    number = len(config.expect) + len(unusable)
    if not number:
        raise InputError("has no expectations", hint="add 'expect:', see 'bikestab init'", place=str(path))
    usable = iter(config.expect)
    entries = []
    for i in range(number):
        try:
            result = unusable.get(i) or outcome_of(config, next(usable), ("expect", i))
        except InputError as error:
            result = document.located(error)
        entries.append(Entry(document.line(("expect", i)), result))
    return config, entries


def _without_unusable(document: yamltext.Document) -> tuple[AnyConfig, dict[int, InputError]]:
    """The config with the expectations that can be used, and why not by the numbers of the others."""
    try:
        return _parsed(document), {}
    except InputError as error:
        found: dict[int, list[InputError]] = {}
        for each in error.mistakes:
            if each.key[:1] != ("expect",) or len(each.key) < 2:
                raise
            found.setdefault(int(each.key[1]), []).append(each)
        entries = [entry for i, entry in enumerate(document.data["expect"]) if i not in found]
        try:
            config = _parsed(document.replaced(("expect",), entries))
        except InputError as more:
            raise together([*error.mistakes, *more.mistakes]) from None
        return config, {i: together(mistakes) for i, mistakes in found.items()}


def _parsed(document: yamltext.Document) -> AnyConfig:
    return parse_config(document) if _of_scan(document.data) else validated(document, {}, CheckConfig)


def _of_scan(data: dict[str, Any]) -> bool:
    """Whether it has keys that only a scan's config has, as they are or misspelt."""
    known = ScanConfig.model_fields
    more = known.keys() - CheckConfig.model_fields.keys()
    meant = {nearest(str(key), known) for key in data if key not in known}
    return bool(more & data.keys()) or any(f"did you mean {key!r}?" in meant for key in more)
