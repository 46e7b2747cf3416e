"""How a message stays short: wrapped to few lines, and without the middle of paths and the end of lists."""

from __future__ import annotations

import re

LONGEST = 200  # characters of a line on stderr
LINES = 3  # of a message
_WORDS = (72, 48, 24)  # characters of a path or a quoted text, less and less
_WORD = re.compile(r"('[^']*'|\S+)")
_LIST = re.compile(r"[^\s,;]+(?:, [^\s,;]+){4,}")
_KEPT = 3  # of a list, at least


def folded(text: str, hint: str = "") -> list[str]:
    """A message in at most three lines, all but the first indented; wrapped while there is room."""
    given = [*text.split("\n"), *([hint] if hint else [])][:LINES]
    lines: list[str] = []
    for i, line in enumerate(given):
        left = len(given) - i - 1
        lines += _wrapped(f"  {line}" if i else line, LINES - len(lines) - left)
    return lines


def cut(line: str, most: int = LONGEST) -> str:
    """The line with at most so many characters.

    Long paths and quoted texts lose their middle, then lists their end, and, if need be, the line its middle.
    """
    for longest in _WORDS:
        if len(line) > most:
            line = _with_shorter(line, longest, most)
            line = _with_fewer(line, most)
    return _around(line, most, " ... ")


def _wrapped(line: str, number: int) -> list[str]:
    """The line in at most so many, which end at blanks."""
    if len(line) <= LONGEST:
        return [line]
    import textwrap

    style = textwrap.TextWrapper(
        LONGEST, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )
    line = _with_shorter(line, LONGEST - 60, LONGEST)  # so that something stands beside each
    for room in (len(line), number * (LONGEST - 30), number * LONGEST // 2):
        parts = [cut(part) for part in style.wrap(cut(line, room))]
        if len(parts) <= number:
            return parts
    return [cut(line)]


def _with_shorter(line: str, longest: int, most: int) -> str:
    """The line with words of at most so many characters, or as many more as there is room for."""
    words = _WORD.split(line)
    long = [len(word) for word in words if len(word) > longest]
    room = max(longest, (most - len(line) + sum(long)) // max(len(long), 1))
    return "".join(_around(word, room, "...") for word in words)


def _around(text: str, most: int, mark: str) -> str:
    """The text, or both of its ends with a mark between."""
    half = (most - len(mark)) // 2
    return text if len(text) <= most else f"{text[:half]}{mark}{text[-half:]}"


def _with_fewer(line: str, most: int) -> str:
    """The line with the first words of its longest list, or as it is where hardly any would be left."""
    found = max(_LIST.finditer(line), key=lambda match: len(match[0]), default=None)
    if found is None or len(line) <= most:
        return line
    words = found[0].split(", ")
    length = len(line)
    for kept in range(len(words) - 1, _KEPT - 1, -1):
        length -= len(words[kept]) + len(", ")
        more = f" and {len(words) - kept} more"
        if length + len(more) <= most:
            return line[: found.start()] + ", ".join(words[:kept]) + more + line[found.end() :]
    return line
