"""Reads the formulas of docs/theory.md, so that tests can compare them with the derivation."""

from __future__ import annotations

import re
from pathlib import Path

import sympy as sp

TEXT = (Path(__file__).parents[1] / "docs" / "theory.md").read_text("utf-8")

_WORDS = {
    "λ": "lam", "σ": "sigma", "δ": "delta", "θ": "theta", "χ": "chi", "ψ": "psi", "φ": "phi", "ε": "eps",
    "α": "alpha", "κ": "kappa", "−": "-", "²": "**2", "³": "**3", "⁴": "**4", "½": "(1/2)", "[": "(",
    "]": ")", "°": "o", "''": "_tt", "'": "_t",
}  # fmt: skip
_TOKEN = re.compile(r"\*\*\d+|[A-Za-z_]\w*|\d+|[-+/()]|\S")
_FUNCTIONS = {"sin", "cos", "tan"}


def blocks() -> dict[str, str]:
    """The code blocks that are marked as checked, by name."""
    return dict(re.findall(r"<!-- checked: (\w+) -->\n```text\n(.*?)```", TEXT, re.DOTALL))


def errors() -> list[tuple[str, str]]:
    """Scanned and repaired reading of each row of the table of errors that has formulas."""
    return re.findall(r"^\|[^|]*\| `([^`|]*)` \| `([^`|]*)` \|", TEXT, re.MULTILINE)


def formulas(block: str, known: dict[str, sp.Expr]) -> dict[str, sp.Expr]:
    """The right sides of a block by name; later ones may use earlier ones and what is known."""
    found: dict[str, sp.Expr] = {}
    joined: list[str] = []
    for item in re.split(r"\n|\s{2,}(?=\S+ *= )", block):
        if re.match(r"\s*\S+ *= ", item):
            joined.append(item)
        elif item.strip():
            joined[-1] += " " + item
    for item in joined:
        name, _, right = item.partition(" = ")
        found[_plain(name)] = expression(right, known | found)
    return found


def expression(text: str, known: dict[str, sp.Expr]) -> sp.Expr:
    """A formula as it is printed: a b is a product, sin²λ a square; unknown letters stay letters."""
    tokens: list[str] = []
    for token in _TOKEN.findall(_plain(text)):
        if tokens and (token[0].isalnum() or token == "(") and _ends_factor(tokens[-1]):
            tokens.append("*")
        tokens.append(token)
    names = {token for token in tokens if token[0].isalpha()} - _FUNCTIONS
    return sp.sympify("".join(tokens), {name: known.get(name, sp.Symbol(name)) for name in names})


def _ends_factor(token: str) -> bool:
    return token not in _FUNCTIONS and (token[-1].isalnum() or token[-1] in "_)")


def _plain(text: str) -> str:
    text = re.sub(r"(sin|cos|tan)²λ", r"\1(λ)²", text.strip())
    text = re.sub(r"(sin|cos|tan) (2?)λ", lambda m: f"{m[1]}({m[2] and '2 '}λ)", text)
    for sign, word in _WORDS.items():
        text = text.replace(sign, word)
    return text
