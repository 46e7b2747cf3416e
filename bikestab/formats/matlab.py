"""Assignments of a MATLAB script, such as ``Iframe = [0.1 0.3 0.4];`` → numbers by name.

Arithmetic is worked out, with names that were assigned before: numbers (``1e-3`` and ``1d-3``), ``pi``, + − *
/ ^ and their elementwise spellings, parentheses, sin, cos, tan, asin, acos, atan, sqrt; one row in brackets
times a factor. Nothing else of the language is understood, and nothing is run.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from bikestab.errors import InputError
from bikestab.units import shown

Value: TypeAlias = float | tuple[float, ...] | str
_ASSIGNED = re.compile(r"([A-Za-z]\w*)\s*=(?!=)\s*(.*)", re.DOTALL)
_ROW = re.compile(r"(?:(.*\S)\s*\*\s*)?\[([^\[\]]*)\](?:\s*\*\s*(\S.*))?", re.DOTALL)
_TOKEN = re.compile(r"(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?|[A-Za-z]\w*|[-+*/^()]|\s+", re.ASCII)
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sqrt")
}
_OPERATORS: dict[type[ast.AST], Callable[..., float]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.Pow: operator.pow, ast.USub: operator.neg, ast.UAdd: operator.pos,
}  # fmt: skip
_LONGEST = 500  # of an expression


@dataclass(frozen=True)
class Script:
    """What is assigned, by name, with the line of the last assignment, and the name of the file.

    A value that could not be worked out is the text of it: it matters only if it is asked for.
    """

    file: str
    values: dict[str, Value]
    lines: dict[str, int]

    def located(self, error: InputError) -> InputError:
        """The same error with this file, and the line of its key, in front."""

        def place(mistake: InputError) -> str:
            line = self.lines.get(str(mistake.key[0])) if mistake.key else None
            return f"{self.file}, line {line}" if line else self.file

        return error.each(lambda mistake: mistake.at(place(mistake)))


def parse(text: str, file: str) -> Script:
    """What a script assigns; InputError names the file and the line of what is no assignment."""
    values: dict[str, Value] = {}
    lines: dict[str, int] = {}
    for number, statement in _statements(text):
        match = _ASSIGNED.fullmatch(statement)
        if not match:
            hint = "allowed: NAME = VALUE; write the values that the script works out"
            raise InputError(
                f"{shown(statement)} is no assignment", place=f"{file}, line {number}", hint=hint
            )
        name, expression = match.groups()
        values[name], lines[name] = _value(expression, values), number
    return Script(file, values, lines)


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Line and text of each statement, without its remarks."""
    for number, line in enumerate(text.splitlines(), 1):
        quoted, depth, start = False, 0, 0
        for i, sign in enumerate(f"{line};"):
            quoted ^= sign == "'"
            depth += 0 if quoted else (sign in "[(") - (sign in "])")
            ends = sign == "%" or (sign in ";," and depth <= 0)
            if (ends and not quoted) or i == len(line):
                if statement := line[start:i].strip():
                    yield number, statement
                start = i + 1
                if sign == "%":
                    break


def _value(text: str, known: Mapping[str, Value]) -> Value:
    """The number, row of numbers or quoted text; the text as it is where it cannot be worked out."""
    if len(text) > 1 and text[0] == text[-1] == "'":
        return text[1:-1]
    plain = re.sub(r"\.([*/^])", r"\1", text)
    try:
        if match := _ROW.fullmatch(plain):
            before, row, after = match.groups()
            factor = math.prod(_number(part, known) for part in (before, after) if part)
            return tuple(factor * _number(part, known) for part in re.split(r"\s*,\s*|\s+", row.strip()))
        return _number(plain, known)
    except (ValueError, ArithmeticError, SyntaxError, RecursionError, MemoryError):
        return text


def _number(text: str, known: Mapping[str, Value]) -> float:
    """The value of an expression; ValueError, ArithmeticError or SyntaxError where it has none."""
    tokens = _TOKEN.findall(text)
    if "".join(tokens) != text or len(text) > _LONGEST:
        raise ValueError(text)
    written = "".join(_in_python(token) for token in tokens).strip()
    value = _worked_out(ast.parse(written, mode="eval").body, known)
    if not isinstance(value, float) or not math.isfinite(value):
        raise ValueError(text)
    return value


def _in_python(token: str) -> str:
    """The token in Python, where a name has a prefix: it may be a word of that language."""
    if token[0].isalpha():
        return f"_{token}"
    return "**" if token == "^" else re.sub("[dD]", "e", token)


def _worked_out(node: ast.AST, known: Mapping[str, Value]) -> float:
    match node:
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.Name(id="_pi"):
            return math.pi
        case ast.Name(id=name) if isinstance(value := known.get(name[1:]), float):
            return value
        case ast.UnaryOp(op=op, operand=a):
            return _OPERATORS[type(op)](_worked_out(a, known))
        case ast.BinOp(op=ast.Pow(), right=ast.BinOp(op=ast.Pow())):
            raise ValueError("MATLAB reads it from the left")
        case ast.BinOp(op=op, left=a, right=b) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_worked_out(a, known), _worked_out(b, known))
        case ast.Call(func=ast.Name(id=name), args=[a]) if name[1:] in _FUNCTIONS:
            return _FUNCTIONS[name[1:]](_worked_out(a, known))
    raise ValueError(node)
