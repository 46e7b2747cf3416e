"""What pictures of several designs say of what does not vary, and of what is uncertain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

_PAPER = {"lam": "λ = {:.4g} rad", "sigma": "σ = {:.4g}"}
_WORKSHOP = {
    "head_angle_deg": "head angle {:.4g}°",
    "trail": "trail {:.4g} m",
    "offset": "fork offset {:.4g} m",
}
_OWN = {"head_angle_deg": "head angle", "trail": "trail"}


def held_words(machines: Sequence[Sequence[Mapping[str, Any]]], axis: str, own: bool) -> str:
    """What all designs have in common, in the words of the ``axis``; two say what they are.

    Of machines with their ``own`` designs also what each keeps.
    """
    words: list[str] = []
    kept: list[str] = []
    for key, text in (_PAPER if axis in _PAPER else _WORKSHOP).items():
        values = [np.array([answer.get(key, np.nan) for answer in answers]) for answers in machines]
        if key == axis or len(words + kept) == 2 or not all(len(x) for x in values):
            continue
        if _same(np.concatenate(values)):
            words.append(text.format(values[0][0] + 0.0))
        elif own and key in _OWN and all(map(_same, values)):
            kept.append(_OWN[key])
    return ", ".join([*words, *([f"each its own {' and '.join(kept)}"] if kept else [])])


def share_words(machines: Sequence[Sequence[Mapping[str, Any]]]) -> str:
    """How many of the machines drawn at random are stable at some speed, where not all are."""
    shares = [answer["spread"]["exists"] for answers in machines for answer in answers if "spread" in answer]
    least, most = min(shares), max(shares)
    if f"{least:.0%}" == "100%":
        return ""
    span = (
        f"{100 * least:.0f}"
        if round(100 * least) == round(100 * most)
        else f"{100 * least:.0f} to {100 * most:.0f}"
    )
    return f"{span} % are stable at some speed"


def _same(values: Any) -> bool:
    return bool(np.ptp(values) <= 1e-9 * np.abs(values).max(initial=1e-6))


def kind_words(machines: Sequence[Sequence[Mapping[str, Any]]], end: str) -> str:
    """What all the ``lower`` or ``upper`` ends are, in brackets; nothing where they differ."""
    kinds = {i[end] for answers in machines for answer in answers for i in answer["intervals"]} - {
        "unbounded"
    }
    return f" ({kinds.pop()})" if len(kinds) == 1 else ""
