"""The JSON Schema of proofs: what ``certify`` prints, and ``design --certified``."""

from __future__ import annotations

from bikestab_cli.shapes import MODEL, NUMBERS, flag, maybe, named, num, record, some, words

PAIR = {"type": "array", "items": NUMBERS, "minItems": 2, "maxItems": 2}
LARGEST = record(
    "with --certified: the largest box that is proved stable; all else but searched is then null or empty",
    factor=num("of the sides"),
    sides=named(NUMBERS, "half sides for a factor of 1, by lam [rad], sigma, V [m/s] and parameter"),
    box=named(PAIR, "its ends, which are exact"), verdict={"const": "stable"}, method=words("of the proof"),
    cells=some({"type": "integer"}, "along each axis"),
    beyond=maybe("the smallest factor without a proof; null: none up to 100"),
    no_machine={"type": ["string", "null"], "description": "what no machine has at the ends of that"},
    unstable_from=maybe("the smallest factor at which a corner is known that is not stable"),
    unstable={"type": ["object", "null"], "description": "that corner and its growth_rate [1/s]"},
)  # fmt: skip
CERTIFY = record(
    "a proof; one object without results", ("files",), bicycle=words("its name"), model=MODEL,
    delta=num("steering damping [kg m²/s]"), box=named(PAIR, "the ends of what varies"),
    cells=some({"type": "integer"}, "along each"),
    method={"enum": ["Bernstein coefficients", "centred form"], "description": "how it was proved"},
    verdict={"enum": ["stable", "unstable", "mixed", "undecided"], "description": "of the whole box"},
    proved_stable=num("fraction of the box"), proved_unstable=num("fraction"),
    undecided=num("fraction"),
    undecided_by_halving=some(
        num("share"), "of the cells before each halving of blocks, and at the end"
    ),
    stopped=flag("at the limit of --work"),
    counterexample={"type": ["object", "null"], "description": "a point that is not as the rest"},
)  # fmt: skip
