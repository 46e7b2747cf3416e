"""YAML 1.2 → a tree of nodes that know their places, in time and memory proportional to the text.

PyYAML's events, from libyaml in C, are put together here: its own loaders follow YAML 1.1, take the last of
two equal keys, and let aliases stand for any number of values.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NoReturn

from bikestab.errors import InputError
from bikestab.units import no_double, shown

MOST_DEPTH = 32
MOST_VALUES = 200_000  # of a text, those behind aliases counted each time
MOST_DIGITS = 400  # of a number; none that is longer has a double

Children = dict[str, "Node"] | list["Node"] | None
_TAG = "tag:yaml.org,2002:"
_INTEGER = re.compile(r"[-+]?\d+|0o[0-7]+|0x[\da-fA-F]+", re.ASCII)
_FLOAT = re.compile(
    r"[-+]?(?:\.\d+|\d+(?:\.\d*)?)(?:[eE][-+]?\d+)?|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)", re.ASCII
)
_WORDS = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL"), None),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_KINDS: dict[str, tuple[type, ...]] = {
    "int": (int,), "float": (float, int), "bool": (bool,), "null": (type(None),), "str": (str,),
}  # fmt: skip


@dataclass(slots=True)
class Node:
    """A value, the line (from 1) of its entry, where its text starts and ends, and what is in it."""

    data: Any
    line: int
    start: int
    end: int
    children: Children = None
    size: int = 1  # in values
    flow: bool = False  # in brackets
    alias: bool = False


def compose(text: str, file: str) -> Node:
    """The root of the one document in ``text``; InputError names file and line."""
    import yaml

    loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        return _Composer(yaml.parse(text, Loader=loader), file).document()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        problem = " ".join(str(error.problem or error.context).split())
        if text[mark.index : mark.index + 1] == "\t":
            problem += ": a tab, where YAML has blanks"
        place = f"{file}, line {mark.line + 1}, column {mark.column + 1}"
        if mark.line > text.count("\n"):  # behind the end
            place = f"{file}, line {mark.line}"
        raise InputError(f"not valid YAML: {problem}", place=place) from None
    except yaml.reader.ReaderError as error:
        line = text.encode()[: error.position].count(b"\n") + 1
        code = ord(error.character) if isinstance(error.character, str) else error.character
        problem = f"not valid YAML: unacceptable character #x{code:04x}"
        raise InputError(problem, place=f"{file}, line {line}") from None
    except UnicodeEncodeError as error:  # of a command line
        problem = f"{shown(text[error.start : error.end])} is a character that no file can hold"
        raise InputError(problem, place=file) from None


def resolved(text: str) -> Any:
    """What plain text stands for in YAML 1.2: a number, true, false, null, or itself.

    A number that no double holds stays as it is typed, so that it can be told of. Raises ValueError for one
    of too many digits.
    """
    if text in _WORDS:
        return _WORDS[text]
    if text[0] not in "-+.0123456789":
        return text
    whole = _INTEGER.fullmatch(text)
    if (whole or _FLOAT.fullmatch(text)) and len(text) > MOST_DIGITS:
        raise ValueError(f"a number of {len(text)} characters")
    if whole:
        return int(text, 0) if text[:2] in ("0o", "0x") else int(text)
    if _FLOAT.fullmatch(text) and not (text[-1] not in "fFnN" and no_double(text)):
        return float(text.lower().replace(".inf", "inf").replace(".nan", "nan"))
    return text


class _Composer:
    """Puts the events of one document together."""

    def __init__(self, events: Iterator[Any], file: str) -> None:
        self._events, self._file = events, file
        self._anchors: dict[str, Node | None] = {}  # None while it is being read
        self._values = 0

    def document(self) -> Node:
        next(self._events)  # the stream's start
        event = next(self._events)
        root = Node(None, 1, 0, 0)
        if _is(event, "DocumentStart"):
            root = self._node(next(self._events), 0)
            next(self._events)  # its end
            event = next(self._events)
        if not _is(event, "StreamEnd"):
            self._refuse(event, "not valid YAML: a second document begins here")
        return root

    def _node(self, event: Any, depth: int) -> Node:
        if depth > MOST_DEPTH:
            self._refuse(event, f"is nested too deeply; allowed: {MOST_DEPTH} levels")
        if _is(event, "Alias"):
            return self._alias(event)
        if event.anchor:
            self._anchors[event.anchor] = None
        if _is(event, "Scalar"):
            node = self._made(event, self._scalar(event))
        elif _is(event, "SequenceStart"):
            self._check_tag(event, "seq")
            node = self._sequence(event, depth)
        else:
            self._check_tag(event, "map")
            node = self._mapping(event, depth)
        if event.anchor:
            self._anchors[event.anchor] = node
        return node

    def _made(self, event: Any, data: Any, size: int = 1) -> Node:
        self._values += size
        if self._values > MOST_VALUES:
            self._refuse(event, f"more than {MOST_VALUES} values, those behind aliases counted each time")
        start, end = event.start_mark, event.end_mark
        return Node(data, start.line + 1, start.index, end.index, size=size)

    def _alias(self, event: Any) -> Node:
        node = self._anchors.get(event.anchor, self)
        if node is None:
            self._refuse(event, f"*{event.anchor} stands in what it is an alias of")
        if not isinstance(node, Node):
            self._refuse(event, f"not valid YAML: there is no anchor &{event.anchor} before *{event.anchor}")
        alias = self._made(event, node.data, node.size)
        alias.children, alias.alias = node.children, True
        return alias

    def _sequence(self, event: Any, depth: int) -> Node:
        node = self._made(event, [])
        items: list[Node] = []
        while not _is(event := next(self._events), "SequenceEnd"):
            items.append(self._node(event, depth + 1))
        node.children, node.data = items, [item.data for item in items]
        return _closed(node, event, items)

    def _mapping(self, event: Any, depth: int) -> Node:
        node = self._made(event, {})
        entries: dict[str, Node] = {}
        merged: list[Node] = []
        while not _is(event := next(self._events), "MappingEnd"):
            key = self._key(event)
            if key in entries:
                self._refuse(event, f"not valid YAML: found duplicate key {shown(key)}")
            value = self._node(next(self._events), depth + 1)
            value.line = event.start_mark.line + 1
            if key == "<<" and _is(event, "Scalar") and event.implicit[0]:
                merged += self._merged(event, value)
            else:
                entries[key] = value
        ends = [*entries.values(), *merged]
        for other in merged:
            entries = {**other.children, **entries}  # type: ignore[dict-item]  # mappings have dicts
        node.children, node.data = entries, {key: entry.data for key, entry in entries.items()}
        return _closed(node, event, ends)

    def _key(self, event: Any) -> str:
        """Text, or a pair of names in brackets as text."""
        if _is(event, "Scalar"):
            return str(event.value)
        names: list[str] = []
        if _is(event, "SequenceStart") and not event.anchor and event.tag is None:
            while _is(inner := next(self._events), "Scalar") and len(names) < 2:
                names.append(str(inner.value))
            if len(names) < 2 or not _is(inner, "SequenceEnd"):
                names = []
        if not names:
            self._refuse(event, "a key is text, and no list, mapping or alias")
        return f"[{names[0]}, {names[1]}]"

    def _merged(self, event: Any, value: Node) -> list[Node]:
        """The mappings behind ``<<``, the one that counts most first."""
        each = value.children if isinstance(value.children, list) else [value]
        if not all(isinstance(one.children, dict) for one in each):
            self._refuse(event, "<< stands for the keys of a mapping, or of a list of mappings")
        return list(each)

    def _scalar(self, event: Any) -> Any:
        text: str = event.value
        tag: str | None = event.tag
        if (tag is None and not event.implicit[0]) or tag == "!":
            return text
        try:
            data = resolved(text)
        except ValueError as error:
            self._refuse(event, f"not valid YAML: {error}; allowed: up to {MOST_DIGITS}")
        if tag is None:
            return data
        kind = tag.removeprefix(_TAG)
        if kind not in _KINDS:
            self._refuse(event, f"the tag {_spelt(tag)} is not known; allowed: !!{', !!'.join(_KINDS)}")
        if kind == "str":
            return text
        if not isinstance(data, _KINDS[kind]) or (kind != "bool" and isinstance(data, bool)):
            self._refuse(event, f"{shown(text)} is no !!{kind}")
        return float(text) if kind == "float" and isinstance(data, int) else data

    def _check_tag(self, event: Any, kind: str) -> None:
        if event.tag not in (None, "!", _TAG + kind):
            self._refuse(event, f"the tag {_spelt(event.tag)} is not known; allowed here: !!{kind}")

    def _refuse(self, event: Any, problem: str) -> NoReturn:
        mark = event.start_mark
        raise InputError(problem, place=f"{self._file}, line {mark.line + 1}, column {mark.column + 1}")


def _spelt(tag: str) -> str:
    return shown("!!" + tag.removeprefix(_TAG) if tag.startswith(_TAG) else tag)


def _is(event: Any, kind: str) -> bool:
    return type(event).__name__ == kind + "Event"


def _closed(node: Node, event: Any, inner: list[Node]) -> Node:
    """With its size and end: that of a bracket, or of the last value in it."""
    node.flow = event.end_mark.index > event.start_mark.index
    node.end = event.end_mark.index if node.flow or not inner else max(one.end for one in inner)
    node.size += sum(one.size for one in inner)
    return node
