"""The parameters of one machine → text in one of the formats that are read, to the last bit."""

from __future__ import annotations

import json
from collections.abc import Mapping

from bikestab.errors import InputError, nearest
from bikestab.rider import nested
from bikestab.yamltext import flow

ENDINGS = (".yaml", ".yml", ".json", ".ini", ".txt")


def written(
    ending: str, numbers: Mapping[str, float], deviations: Mapping[str, float], texts: Mapping[str, str]
) -> str:
    """Text of the format that has this ending; ``texts`` are the name and the source.

    YAML and JSON give a number with an uncertainty as text, ``"85.0 +/- 0.5"``. The lines of ``.ini`` and
    ``.txt`` are those of BicycleParameters, whose own reader takes them; there texts are remarks of a line.
    InputError for another ending.
    """
    texts = {key: text for key, text in texts.items() if text}
    if ending in (".yaml", ".yml", ".json"):
        values = {key: _with(number, deviations.get(key, 0.0)) for key, number in numbers.items()}
        data = texts | nested(values)
        if ending == ".json":
            return json.dumps(data, indent=2, ensure_ascii=False) + "\n"
        return "".join(f"{key}: {flow(value)}\n" for key, value in data.items())
    if ending not in ENDINGS:
        if not ending:
            raise InputError("has no ending that tells the format", hint=f"allowed: {', '.join(ENDINGS)}")
        raise InputError(f"{ending} is no format that can be written", hint=nearest(ending, ENDINGS))
    lines = [f"# {key}: {' '.join(text.split())}" for key, text in texts.items()]
    lines += ["[bicycle]"] if ending == ".ini" else []
    for key, number in numbers.items():
        deviation = f" +/- {deviations[key]!r}" if key in deviations else ""
        lines.append(f"{key} = {number!r}{deviation}")
    return "\n".join(lines) + "\n"


def _with(number: float, deviation: float) -> float | str:
    return f"{number!r} +/- {deviation!r}" if deviation else number
