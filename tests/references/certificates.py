"""A proof's certificate, whole and with one thing changed, before the checker."""

from __future__ import annotations

import hashlib
import json
import math
import random
from collections import Counter
from typing import Any

from bikestab.certify import checker
from bikestab.certify.proof import Proof
from bikestab.certify.search import STABLE, UNSTABLE


def sealed(certificate: dict[str, Any]) -> dict[str, Any]:
    told = json.dumps({**certificate, "sha256": ""}, sort_keys=True)
    return {**certificate, "sha256": hashlib.sha256(told.encode()).hexdigest()}


def check_certificate(proof: Proof, rng: random.Random, counts: Counter[str], most: int) -> None:
    """Some blocks of the proof as a certificate, whole and with one thing changed."""
    certificate = json.loads(proof.certificate("1"))
    blocks = certificate["blocks"]
    if not blocks:
        return
    certificate = sealed({**certificate, "blocks": rng.sample(blocks, min(most, len(blocks)))})
    counts["certificates"] += 1
    try:
        checker.check(certificate)
    except checker.Refuted as error:
        counts["CERTIFICATES REFUSED"] += 1
        print("refused:", error, proof.bicycle, proof.edges, proof.varied, flush=True)
    block, verdict = certificate["blocks"][0]
    turned = {STABLE: UNSTABLE, UNSTABLE: STABLE}[verdict]
    for each in (one_changed(certificate, rng), sealed({**certificate, "blocks": [[block, turned]]})):
        try:
            checker.check(each)
            counts["CHANGED ONES TAKEN"] += 1
        except checker.Refuted:
            counts["changed ones refused"] += 1


def one_changed(certificate: dict[str, Any], rng: random.Random) -> dict[str, Any]:
    """The certificate with one of its numbers a little larger."""
    changed = json.loads(json.dumps(certificate))
    places: list[tuple[Any, Any]] = [(changed["machine"], name) for name in changed["machine"]]
    places += [(edges, i) for edges in changed["edges"] for i in range(len(edges))]
    places += [(ends, i) for block, _ in changed["blocks"] for ends in block for i in (0, 1)]
    places += [(block, 1) for block in changed["blocks"]]
    where, key = rng.choice(places)
    number = where[key]
    where[key] = (
        number + 1 if isinstance(number, int) else math.nextafter(float.fromhex(number), math.inf).hex()
    )
    return changed
