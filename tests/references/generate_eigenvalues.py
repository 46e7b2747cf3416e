"""Eigenvalues of the presets in 40-digit arithmetic: writes eigenvalues.json.

Nothing of bikestab is used; the polynomials are those of generate_speeds.py. Run
``python -m tests.references.generate_eigenvalues`` to write the file anew.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from mpmath import mp, mpf

from tests.references import generate_speeds as speeds

FILE = Path(__file__).with_name("eigenvalues.json")
V = (0, 0.5, 1, 2, 3, 4, 4.5, 5, 6, 7, 8, 10, 15, 20, 30, 50, 100, 1000)  # m/s
DESIGNS: dict[str, tuple[dict[str, float], list[tuple[float, float, float]]]] = {  # machine; (λ, σ, δ)
    "dikarev1981": (
        speeds.PAPER,
        [(0.2, 0.08, 0), (0.3, 0.1, 0), (0.05, 0.15, 0), (0.015, 0.1475, 0), (0.1, 0.08, 1)],
    ),
    "meijaard2007": (
        speeds.BENCHMARK,
        [(speeds.BENCHMARK["lam"], speeds.BENCHMARK["c"] / speeds.BENCHMARK["w"], delta) for delta in (0, 2)],
    ),
    "kooijman2011": (speeds.SKATES, [(speeds.SKATES["lam"], 0, 0)]),
    "sharp1971": (speeds.MOTORCYCLE, [(speeds.RAKE, speeds.TRAIL, delta) for delta in (0, speeds.DAMPER)]),
}


def cases() -> list[dict[str, Any]]:
    """The questions, without their answers."""
    return [
        {"name": name, "lam": lam, "sigma": sigma, "delta": delta}
        for name, (_, designs) in DESIGNS.items()
        for lam, sigma, delta in designs
    ]


def result(name: str, lam: float, sigma: float, delta: float) -> list[list[list[str]]]:
    """For each speed of V the four eigenvalues as [real, imaginary], in the order of numpy.sort_complex."""
    with mp.workdps(speeds.DIGITS):
        table = speeds.polynomial(DESIGNS[name][0], lam, sigma, delta, "refined")
        rows = []
        for speed in V:
            found = [mp.mpc(s) for s in speeds.eigenvalues(table, mpf(speed))]
            size = max(abs(s) for s in found)
            parts = [[_clean(x, size) for x in (s.real, s.imag)] for s in found]
            rows.append([[mp.nstr(x, 22) for x in pair] for pair in sorted(parts)])
        return rows


def _clean(x: Any, size: Any) -> Any:
    """Zero for what the companion matrix leaves of a zero."""
    return mpf(0) if abs(x) < size * mpf(10) ** (5 - speeds.DIGITS) else x


if __name__ == "__main__":
    answers = [case | {"eigenvalues": result(**case)} for case in cases()]
    lines = ",\n".join(json.dumps(answer) for answer in answers)
    FILE.write_text(f"[\n{lines}\n]\n", encoding="utf-8")
