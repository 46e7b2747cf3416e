"""The JSON Schema of a bicycle whose parameters stand in a config."""

from __future__ import annotations

from bikestab.bicycle import PAPER
from bikestab.config.values import json_schema
from bikestab.gains import GAINS
from bikestab.notation import MEASURED, MEIJAARD
from bikestab.rider import RIDER
from bikestab.units import units_in

_RIDER = {
    "type": "object",
    "description": "the rider as a body apart from B, in the notation with w",
    "properties": {
        key.partition(".")[2]: {"description": text, **json_schema(units_in(text))}
        for key, text in RIDER.items()
    }
    | {"scale_inertia": {"type": "boolean", "description": "the inertia changes in proportion to m"}},
    "additionalProperties": False,
}
IN_PLACE = {
    "type": "object",
    "properties": {
        key: {"description": text, **json_schema(units_in(text))}
        for key, text in {**PAPER, **MEIJAARD, **MEASURED, **GAINS}.items()
    }
    | {"name": {"type": "string"}, "source": {"type": "string"}, "rider": _RIDER},
    "additionalProperties": False,
}
