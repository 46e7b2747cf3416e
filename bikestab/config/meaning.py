"""What values mean, however they were spelt: a hash of them, and a YAML text that gives them again."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from math import inf
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from bikestab.bicycle import Bicycle
from bikestab.yamltext import dumped

OUT_OF_EQUATIONS = {"IByy", "IHyy"}


def digest(values: Mapping[str, Any]) -> str:
    """The SHA-256 of values: mappings, lists, text, whole numbers, and arrays of double precision.

    Equal doubles give equal hashes, −0 and 0 too, and the order of a mapping's keys does not count.
    """
    text = json.dumps(values, sort_keys=True, default=_digest_of_array)
    return hashlib.sha256(text.encode()).hexdigest()


def _digest_of_array(values: ArrayLike) -> str:
    doubles = np.asarray(values, "<f8") + 0.0  # of −0 that makes 0
    return f"{doubles.shape} {hashlib.sha256(doubles.tobytes()).hexdigest()}"


def drawn_around(bicycle: Bicycle) -> dict[str, Any]:
    """What samples of a bicycle's parameters are drawn around: its numbers in its own notation."""
    numbers = {"g": bicycle.g, "delta": bicycle.delta, **bicycle.given}
    return {name: np.array(value) for name, value in numbers.items() if name not in OUT_OF_EQUATIONS}


def yaml_text(bicycle: Bicycle, values: Mapping[str, Any]) -> str:
    """A YAML text of a bicycle's parameters in place and of a config's other ``values``, to the last bit."""
    texts = {"name": bicycle.name, "source": bicycle.source}
    parameters = {**{key: text for key, text in texts.items() if text}, **bicycle.given}
    return dumped({"bicycle": parameters, **{key: _spelt(value) for key, value in values.items()}})


def _spelt(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _spelt(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_spelt(inner) for inner in value]
    return "unbounded" if value == inf else value
