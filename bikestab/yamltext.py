"""YAML documents that remember on which line each of their values stands; and values as YAML."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from bikestab.errors import InputError
from bikestab.texts import read_text
from bikestab.units import shown
from bikestab.yamlnodes import Node, compose, resolved

_PLAIN = re.compile(  # one entry of what ``plain`` reads
    r"""(?:\#.*)?\n  # a comment, or nothing
    | (?P<key>(?!(?i:null|true|false):)[A-Za-z]\w*):[ ]+
      (?: (?: (?P<number>-?\d{1,15}(?P<point>\.\d{1,15})?)
            | (?P<word>-?\d{1,15}(?:\.\d{1,15})?(?:deg|mm|cm|m|in|kg|g|lb)|[a-z]+\d+)) (?:[ ]+\#.*)?\n
        | >-\n (?P<lines>(?:[ ]{2}\S.*\n)+) )""",
    re.ASCII | re.VERBOSE,
)
_OF_CONFIGS = "'bicycle: dikarev1981'; see 'bikestab init'"
_BARE = re.compile(r"[A-Za-z_][\w./-]*", re.ASCII)  # needs no quotes, unless it is null, true or false
_ESCAPED = re.compile(r"[^ -~\u00a0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]|[\u2028\u2029]")

KeyPath: TypeAlias = Sequence[str | int]


@dataclass(frozen=True)
class Document:
    """A parsed YAML mapping, its text and its file name."""

    file: str
    text: str
    data: dict[str, Any]
    root: Node = field(repr=False, compare=False)

    def line(self, key: KeyPath) -> int:
        """The line (from 1) of the value at ``key``, or of the nearest parent that exists."""
        nodes = _way(self.root, key)
        return nodes[-1].line if nodes else 1

    def located(self, error: InputError) -> InputError:
        """The same error with this file and the line of its key in front."""
        return error.each(lambda mistake: mistake.at(f"{self.file}, line {self.line(mistake.key)}"))

    def replaced(self, key: KeyPath, value: Any) -> Document:
        """With another value at ``key``, whose parents are there as far as they are lists.

        The rest of the text stays as it is, comments too, wherever the value can be put into it.
        """
        data: Any = copied(self.data)
        node = data
        for part in key[:-1]:
            node = node.setdefault(part, {}) if isinstance(node, dict) else node[part]
        node[key[-1]] = value
        try:
            document = parse(self._with(key, data), self.file)
            if document.data == data:
                return document
        except InputError:  # what was an anchor is one no more, say
            pass
        return parse(dumped(data), self.file)

    def _with(self, key: KeyPath, data: Any) -> str:
        """The text with what ``data`` has at ``key``, or at the nearest parent that can be replaced."""
        nodes = _way(self.root, key)
        shared = next((i for i, node in enumerate(nodes, 1) if node.alias), len(nodes))
        if not nodes and not self.root.flow:
            return f"{self.text.rstrip()}\n{flow(key[0])}: {flow(data[key[0]])}\n"
        for part in key[:shared]:
            data = data[part]
        node = nodes[shared - 1] if nodes else self.root
        gap = " " if node.start == node.end else ""
        return f"{self.text[: node.start]}{gap}{flow(data)}{self.text[node.end :]}"


def read(path: str | Path) -> Document:
    """Read and parse the YAML file at ``path``; InputError if it cannot be read or is no mapping."""
    return parse(read_text(path), str(path))


def parse(text: str, file: str, example: str = _OF_CONFIGS) -> Document:
    """Parse YAML ``text``; ``file`` its name in messages, ``example`` the advice where it is no mapping."""
    root = compose(text, file)
    if not isinstance(root.data, dict):
        found = (
            "an empty document" if root.data is None else "a list" if isinstance(root.data, list)
            else "text" if isinstance(root.data, str) else shown(root.data)
        )  # fmt: skip
        raise InputError(
            f"holds {found}, not keys with values",
            place=file,
            hint=f"a valid file has lines such as {example}",
        )
    return Document(file, text, root.data, root)


def copied(data: Any) -> Any:
    """Lists and mappings anew, none of them in two places."""
    if isinstance(data, dict):
        return {key: copied(value) for key, value in data.items()}
    return [copied(value) for value in data] if isinstance(data, list) else data


def dumped(data: Mapping[str, Any]) -> str:
    """YAML that gives these values again, to the last bit: a line for each key, and for the keys in it."""
    lines = []
    for key, value in data.items():
        if isinstance(value, dict) and value:
            lines += [f"{flow(key)}:", *(f"  {flow(inner)}: {flow(each)}" for inner, each in value.items())]
        else:
            lines.append(f"{flow(key)}: {flow(value)}")
    return "".join(line + "\n" for line in lines)


def flow(value: Any) -> str:
    """A value as YAML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{flow(key)}: {flow(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(flow, value)) + "]"
    if isinstance(value, str):
        if _BARE.fullmatch(value) and resolved(value) == value:
            return value
        return _ESCAPED.sub(lambda match: f"\\U{ord(match[0]):08x}", json.dumps(value, ensure_ascii=False))
    if isinstance(value, float) and not abs(value) < float("inf"):
        return ".nan" if value != value else ".inf" if value > 0 else "-.inf"
    return json.dumps(value)


def _way(node: Node, key: KeyPath) -> list[Node]:
    """The nodes at ``key``, from the first one in the document to the last that is there."""
    nodes: list[Node] = []
    for i, part in enumerate(key):
        try:
            if isinstance(node.children, dict):
                if str(part) not in node.children and "." in str(part):  # rider.m may stand under rider
                    return nodes + _way(node, [*str(part).split("."), *key[i + 1 :]])
                node = node.children[str(part)]
            elif node.children and isinstance(part, int):
                node = node.children[part]
            else:
                break
        except (KeyError, IndexError):
            break
        nodes.append(node)
    return nodes


def plain(text: str) -> dict[str, int | float | str] | None:
    """The mapping in YAML that is plainly one, such as the presets; None where it takes ``parse`` to know.

    Plain are comments, ``key: 1.5``, ``key: 18deg``, ``key: 55mm``, ``key: word1`` and ``key: >-`` with lines
    below it. The result is that of ``parse``, without the time to import a reader, a fifth of vrange's.
    """
    values: dict[str, int | float | str] = {}
    end = 0
    while end < len(text):
        entry = _PLAIN.match(text, end)
        if not entry or entry["key"] in values:
            return None
        end = entry.end()
        if entry["number"]:
            values[entry["key"]] = float(entry["number"]) if entry["point"] else int(entry["number"])
        elif entry["key"]:
            values[entry["key"]] = entry["word"] or entry["lines"][2:-1].replace("\n  ", " ")
    return values if text.replace("\n", "").isprintable() else None  # YAML refuses control characters
