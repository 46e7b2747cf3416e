"""What the values of a config mean: what samples are drawn around, and a YAML text that gives them again."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.rider import nested
from bikestab.yamltext import dumped

OUT_OF_EQUATIONS = {"IByy", "IHyy", "rider.Iyy"}


def drawn_around(bicycle: Bicycle) -> dict[str, Any]:
    """What samples of a bicycle's parameters are drawn around: its numbers in its own notation."""
    numbers = {"g": bicycle.g, "delta": bicycle.delta, **bicycle.given}
    return {name: np.array(value) for name, value in numbers.items() if name not in OUT_OF_EQUATIONS}


def yaml_text(bicycle: Bicycle, values: Mapping[str, Any]) -> str:
    """A YAML text of a bicycle's parameters in place and of a config's other ``values``, to the last bit."""
    texts = {"name": bicycle.name, "source": bicycle.source}
    parameters = {**{key: text for key, text in texts.items() if text}, **nested(bicycle.given)}
    return dumped({"bicycle": parameters, **{key: _spelt(value) for key, value in values.items()}})


def _spelt(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _spelt(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_spelt(inner) for inner in value]
    return "unbounded" if value == inf else value
