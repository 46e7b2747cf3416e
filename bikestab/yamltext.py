"""YAML documents that remember on which line each of their values stands."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bikestab.errors import InputError
from bikestab.texts import read_text
from bikestab.units import shown

_PLAIN = re.compile(  # one entry of what ``plain`` reads
    r"""(?:\#.*)?\n  # a comment, or nothing
    | (?P<key>(?!(?i:null|true|false):)[A-Za-z]\w*):[ ]+
      (?: (?: (?P<number>-?\d{1,15}(?P<point>\.\d{1,15})?)
            | (?P<word>\d{1,15}deg|[a-z]+\d+)) (?:[ ]+\#.*)?\n
        | >-\n (?P<lines>(?:[ ]{2}\S.*\n)+) )""",
    re.ASCII | re.VERBOSE,
)


@dataclass(frozen=True)
class Document:
    """A parsed YAML mapping, its text and its file name."""

    file: str
    text: str
    data: Any  # ruamel's CommentedMap: a dict that also knows its lines

    def line(self, key: Sequence[str | int]) -> int:
        """The line (from 1) of the value at ``key``, or of the nearest parent that exists."""
        node, line = self.data, 1
        for part in key:
            try:
                if isinstance(node, dict):  # a key may be a number or a date in YAML
                    part = next(key for key in node if str(key) == str(part))
                position = node.lc.data[part]
                node = node[part]
            except (AttributeError, KeyError, IndexError, TypeError, StopIteration):
                break
            line = position[0] + 1
        return line

    def located(self, error: InputError) -> InputError:
        """The same error with this file and the line of its key in front."""
        return error.at(f"{self.file}, line {self.line(error.key)}")


def read(path: str | Path) -> Document:
    """Read and parse the YAML file at ``path``; InputError if it cannot be read or is no mapping."""
    return parse(read_text(path), str(path))


def parse(text: str, file: str) -> Document:
    """Parse YAML ``text``; ``file`` is the name used in messages."""
    from ruamel.yaml import YAML
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    try:
        data = YAML().load(text)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"{file}, line {mark.line + 1}, column {mark.column + 1}" if mark else file
        problem = " ".join(str(error.problem or error.context).split())
        raise InputError(f"not valid YAML: {problem}", place=place) from None
    except YAMLError as error:
        problem = " ".join(str(error).split())[:120]
        raise InputError(f"not valid YAML: {problem}", place=file) from None
    except RecursionError:
        raise InputError("is nested too deeply", place=file) from None
    except ValueError as error:  # such as a number that Python does not read
        problem = " ".join(str(error).split(";")[0].split())
        raise InputError(f"not valid YAML: {problem[:120]}", place=file) from None
    except (AttributeError, KeyError, TypeError, AssertionError, IndexError) as error:
        # ruamel's own, on '!!bool maybe', merges of themselves and the like; it has no line for them
        problem = f"something in it cannot be built ({type(error).__name__}: {shown(str(error))})"
        raise InputError(f"not valid YAML: {problem}", place=file) from None
    if not isinstance(data, dict):
        found = (
            "an empty document" if data is None else "a list" if isinstance(data, list)
            else "text" if isinstance(data, str) else shown(data)
        )  # fmt: skip
        raise InputError(
            f"holds {found}, not keys with values",
            place=file,
            hint="a valid file has lines such as 'bicycle: dikarev1981'; see 'bikestab init'",
        )
    return Document(file, text, data)


def plain(text: str) -> dict[str, int | float | str] | None:
    """The mapping in YAML that is plainly one, such as the presets; None where it takes ``parse`` to know.

    Plain are comments, ``key: 1.5``, ``key: 18deg``, ``key: word1`` and ``key: >-`` with lines below it. The
    result is that of ``parse``, without the time to import and run ruamel, a fifth of vrange's.
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
