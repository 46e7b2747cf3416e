"""The JSON Schema of proofs: what ``certify`` prints, and ``design --certified``."""

from __future__ import annotations

from bikestab_cli.shapes import (
    FILES,
    MODEL,
    NUMBERS,
    either,
    flag,
    maybe,
    named,
    num,
    record,
    some,
    whole,
    words,
)

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
_PROOF = record(
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
    files=FILES,
)  # fmt: skip
_SAME = ("model", "box", "cells", "verdict", "proved_stable", "proved_unstable", "undecided")
_VERIFIED = {
    "notation": {"enum": ["two parts", "four bodies"], "description": "of the machine's numbers"},
    "machine": named(NUMBERS, "its numbers, in SI units, without those that vary"),
    "blocks": whole("of cells that are proved together"),
    **{name: _PROOF["properties"][name] for name in _SAME},
}
CERTIFY = either(
    _PROOF,
    record(
        "with --verify", tuple(_VERIFIED),
        file=words("with --verify, which prints what follows: the certificate"),
        holds=flag("whether it does"), reason=words("why not; all else is then left out"), **_VERIFIED,
    ),
    text="a proof, or what is verified",
)  # fmt: skip
