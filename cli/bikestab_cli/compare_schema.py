"""The JSON Schema of what compare prints with --json."""

from __future__ import annotations

from bikestab_cli.proof_schema import PAIR
from bikestab_cli.shapes import (
    DESIGN,
    INTERVALS,
    MAYBE_KIND,
    MODEL,
    NULL,
    NUMBERS,
    TEXTS,
    answer,
    either,
    maybe,
    named,
    num,
    record,
    some,
    words,
)

_SIDE = record(
    "what is compared", name=words("as it was typed"), bicycle=words("its name"),
    model=MODEL, delta=num("steering damping [kg m²/s]"), intervals=INTERVALS,
    design=either(record("a design", **DESIGN), NULL, text="what is compared; null: it has none of its own"),
)  # fmt: skip
_CHANGE = record(
    "one quantity of both", what=words("which"), unit=words("its unit"), A=maybe("of A"), B=maybe("of B"),
    change=maybe("B - A"), percent=maybe("of A"), A_kind=MAYBE_KIND, B_kind=MAYBE_KIND,
    within={"type": ["boolean", "null"],
    "description": "whether it is within what is asked; null: not asked"},
)  # fmt: skip
_REGION = record(
    "the stable regions", box=named(PAIR, "the ends of λ, σ and V, or of other parameters of the grids"),
    designs=some({"type": "integer"}, "how many along λ and σ, or the others"),
    unit=words("of volumes: rad m/s, or the others' units"), A=num("volume of A's"), B=num("of B's"),
    difference=num("of the symmetric difference"),
    union=num("of the union"), share=num("the difference as a share of the union"),
    mean=num("distance of the stable speeds, on the mean of designs with any [m/s]"),
    within=_CHANGE["properties"]["within"],
)  # fmt: skip
WITHIN = either(NUMBERS, TEXTS, text="m/s, or text such as 1%")
COMPARE = answer(
    record(
        "the comparison of the first with one of the others, which is B",
        A={**_SIDE, "description": "the first that was typed"},
        B={**_SIDE, "description": "the other"},
        parameters=some(_CHANGE, "those that differ"),
        ends=some(_CHANGE, "of the stable speeds"),
        growth_rate=some(_CHANGE, "in their middle"),
        region=_REGION,
        within=either(WITHIN, NULL, text="what is asked"),
        holds={"type": ["boolean", "null"], "description": "whether all is within; null: nothing is asked"},
    )
)
