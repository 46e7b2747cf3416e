"""``python -m tests.fuzz [--cases N] [--seed S] [KIND ...]``: how many hostile cases end as they have to.

Cases that do not are told, the simplest that hypothesis finds of each, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter

from hypothesis import HealthCheck, Phase, given, seed, settings

from tests.fuzz.cases import KINDS
from tests.fuzz.harness import Case, judged, told


def main() -> int:
    """Run the kinds that are asked for, or all."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("kinds", nargs="*", default=list(KINDS), metavar="KIND", help=", ".join(KINDS))
    parser.add_argument("--cases", type=int, default=5000, help="of each kind")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    return max(_run(kind, options.cases, options.seed) for kind in options.kinds)


def _run(kind: str, cases: int, number: int) -> int:
    codes: Counter[int] = Counter()
    last: list[Case] = []
    longest = 0.0, ""

    @settings(
        max_examples=cases, deadline=None, database=None, suppress_health_check=list(HealthCheck),
        phases=(Phase.generate, Phase.shrink), report_multiple_bugs=False,
    )  # fmt: skip
    @seed(number)
    @given(KINDS[kind])
    def check(case: Case) -> None:
        nonlocal longest
        last[:] = [case]
        begin = time.process_time()
        codes[judged(case)[0]] += 1
        longest = max(longest, (time.process_time() - begin, " ".join(case.args)))

    begin = time.perf_counter()
    failed = ""
    try:
        check()
    except BaseException as problem:  # a Hang too
        if isinstance(problem, KeyboardInterrupt):
            raise
        failed = told(problem, last[0])
    counts = ", ".join(f"{codes[code]} ended with {code}" for code in sorted(codes))
    seconds = time.perf_counter() - begin
    print(f"{kind}: {codes.total()} cases in {seconds:.0f} s: {counts}")  # noqa: T201
    print(f"  the longest {longest[0]:.1f} s: {longest[1][:200]!a}", flush=True)  # noqa: T201
    if failed:
        print(failed)  # noqa: T201
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
