"""What ``bikestab certify`` prints of a proof."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from bikestab_cli.output import heading, prose

if TYPE_CHECKING:
    from bikestab.certify.proof import Proof


def told(proof: Proof) -> str:
    """The verdict, shares of the box, a point that is not stable, and what smaller cells would leave."""
    record = proof.record()
    lines = [heading(proof.bicycle, proof.box.model), *_answer(record, f", by {record['method']}")]
    if point := record["counterexample"]:
        where = f"λ = {point['lam']:.6g}, σ = {point['sigma']:.6g}, V = {point['V']:.6g} m/s"
        where += "".join(f", {name} = {value:.6g}" for name, value in point.get("set", {}).items())
        roots = "; ".join(_root(*root) for root in point["eigenvalues"] if root[1] >= 0)
        lines.append(f"not stable at {where}:\n  eigenvalues {roots} 1/s")
    if record["stopped"]:
        lines.append("stopped at the limit of --work: blocks that are open count as undecided")
    elif record["undecided"]:
        last = ", ".join(f"{100 * share:.3g}" for share in record["undecided_by_halving"][-3:])
        lines.append(
            f"undecided blocks from halving to halving: {last} %; twice as many --cells\n"
            f"  leave at most about {50 * record['undecided']:.3g} % if these are the cells with the\n"
            "  boundary in them or near it"
        )
    return "\n".join(lines)


def told_verified(record: Mapping[str, Any], checked: str) -> str:
    """What a certificate that holds proves, of which machine and box."""
    machine = ", ".join(f"{name} = {value:.6g}" for name, value in record["machine"].items())
    lines = [
        f"machine of {record['notation']}, {record['model']} model: {machine}",
        *_answer(record, ""),
    ]
    return "\n".join([f"{record['file']}: {checked}", *map(prose, lines)])


def _answer(record: Mapping[str, Any], how: str) -> list[str]:
    """The box, the verdict, with ``how`` it was found, and shares."""
    box = ", ".join(f"{name} {low:.6g} ... {high:.6g}" for name, (low, high) in record["box"].items())
    return [
        f"box: {box}",
        f"verdict: {record['verdict']}{how}",
        f"proved stable    {100 * record['proved_stable']:8.4f} %",
        f"proved unstable  {100 * record['proved_unstable']:8.4f} %",
        f"undecided        {100 * record['undecided']:8.4f} %",
    ]


def _root(real: float, imaginary: float) -> str:
    """An eigenvalue, or a pair of them, in the letters of the field."""
    return f"{real:.4g}" + (f" ± {imaginary:.4g} i" if imaginary else "")
