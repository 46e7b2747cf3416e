"""What --json prints: a JSON Schema for each command, from which docs/json.md is made."""

from __future__ import annotations

from typing import Any

Schema = dict[str, Any]


def num(text: str) -> Schema:
    return {"type": "number", "description": text}


def maybe(text: str) -> Schema:
    return {"type": ["number", "null"], "description": text}


def whole(text: str) -> Schema:
    return {"type": "integer", "minimum": 0, "description": text}


def words(text: str) -> Schema:
    return {"type": "string", "description": text}


def flag(text: str) -> Schema:
    return {"type": "boolean", "description": text}


def some(items: Schema, text: str) -> Schema:
    return {"type": "array", "items": items, "description": text}


def either(*kinds: Schema, text: str) -> Schema:
    return {"anyOf": list(kinds), "description": text}


def named(values: Schema, text: str) -> Schema:
    return {"type": "object", "additionalProperties": values, "description": text}


def record(text: str, optional: tuple[str, ...] = (), /, **properties: Schema) -> Schema:
    """An object with these keys and no others."""
    return {
        "type": "object", "description": text, "properties": properties, "additionalProperties": False,
        "required": [name for name in properties if name not in optional],
    }  # fmt: skip


NUMBERS = {"type": "number"}
TEXTS = {"type": "string"}
NULL = {"type": "null"}
KIND = {"enum": ["weave", "capsize", "rest", "unbounded"], "description": "what happens at this end"}
MAYBE_KIND = {"enum": [*KIND["enum"], "none", None], "description": "what happens at this end, if anything"}
DESIGN = {
    "lam": num("tilt λ [rad]"), "sigma": num("trail divided by the wheelbase"),
    "head_angle_deg": num("head angle [°]"), "trail": num("trail along the ground [m]"),
    "offset": num("fork offset b [m]"),
}  # fmt: skip
ENDS = {
    "V1": num("lower end [m/s]"), "V2": maybe("upper end [m/s]; null: unbounded"),
    "lower": KIND, "upper": KIND,
    "V1_error": maybe("bound: the true end is within it [m/s]"), "V2_error": maybe("the same for V2"),
}  # fmt: skip
INTERVAL = record("an interval of stable speeds", **ENDS)
INTERVALS = some(INTERVAL, "all of them, ascending; empty: no stable speed")
VERDICT = {
    "marginal": flag("whether rounding leaves open how many intervals there are, or how one ends"),
    "reason": words("why, where it does"),
}  # fmt: skip
WHOSE = {
    "bicycle": words("its bicycle, where there are several or something is set"),
    "set": named(NUMBERS, "what --set gives it, in SI units"),
}  # fmt: skip
OVER = named(NUMBERS, "the values of --over, in SI units")
OPTIONAL = ("bicycle", "set", "reason")
MODEL = {"enum": ["refined", "unrefined"], "description": "the paper's equations, or those before them"}
FILES = named(
    TEXTS, "files that were written, by what they are: certificate, csv, junit, picture; left out without any"
)


def answer(result: Schema, **head: Schema) -> Schema:
    """The shape of all: what is common to the results, the results, and the files that were written."""
    shape = record("what one command prints", ("files",), **head, results=some(result, "an entry for each"))
    shape["properties"]["files"] = FILES
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **shape}


def of_machines(text: str, optional: tuple[str, ...] = (), /, **properties: Schema) -> Schema:
    """The shape of answers about machines."""
    one_or_all = "one, or a list of those that differ"
    return answer(
        record(text, (*OPTIONAL, *optional), **WHOSE, **properties),
        bicycle=either(TEXTS, some(TEXTS, "several"), text=f"the bicycle: {one_or_all}"),
        model=MODEL,
        delta=either(NUMBERS, some(NUMBERS, "several"), text=f"steering damping [kg m²/s]: {one_or_all}"),
    )


def or_problems(schema: Schema, *others: str) -> Schema:
    """The shape of answers about machines of which some may have no design; ``others`` are null then too."""
    results = schema["properties"]["results"]
    nothing = {name: {**NULL, "description": "there is none"} for name in (*DESIGN, *others)}
    problem = record(
        "one of several machines that has no design", **WHOSE, **nothing,
        intervals={**some({}, "empty"), "maxItems": 0}, error=words("why, and what to do"),
    )  # fmt: skip
    either_ = {**results, "items": either(results["items"], problem, text=results["items"]["description"])}
    return {**schema, "properties": {**schema["properties"], "results": either_}}
