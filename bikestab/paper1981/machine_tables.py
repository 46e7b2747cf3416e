"""The tables of the report about other machines: readings of the printed values, and a motorcycle."""

from __future__ import annotations

from bikestab.paper1981.any_machine import JudgedMachine, Judgement
from bikestab.paper1981.claims import FAILS, HOLDS, LIMITS, VERDICTS, Verdict
from bikestab.paper1981.motorcycle import Motorcycle
from bikestab.paper1981.readings import Counts, JudgedReading, Readings
from bikestab.paper1981.words import Tables, intervals, listed, number, table

_SIGNS = {HOLDS: "+", LIMITS: "±", FAILS: "−"}


def readings_tables(s: Readings) -> Tables:
    """How many readings give which verdict, and each reading."""
    counts = [
        [f"conclusion {key}", *(_count(count, verdict) for verdict in VERDICTS)]
        for key, count in s.counts.items()
    ]
    rows = [_reading(row) for row in s.readings]
    head = ["reading", "possible", "stable", "unbounded", "unbounded, wider box", "volume [rad m/s]"]
    firm = [key for key, count in s.counts.items() if sum(map(bool, count.all.values())) == 1]
    firm_forwards = [key for key, count in s.counts.items() if sum(map(bool, count.forwards.values())) == 1]
    stable = [row for row in s.readings if row.judged.everywhere.shares.some]
    exceptions = [row for row in stable if row.judged.everywhere.verdicts.finite_interval != FAILS]
    refuted = [row for row in stable if row.judged.forwards.verdicts.finite_interval != HOLDS]
    return {
        "counts": table(["", *VERDICTS], counts),
        "readings": table([*head, *s.counts], rows),
        "firm": listed(firm) or "none",
        "open": listed([key for key in s.counts if key not in firm]) or "none",
        "firm_forwards": listed(firm_forwards) or "none",
        "open_forwards": listed([key for key in s.counts if key not in firm_forwards]) or "none",
        "nowhere": "; ".join(_named(row) for row in s.readings if row not in stable) or "none",
        "exceptions": "; ".join(_named(row) for row in exceptions) or "none",
        "exceptions_forwards": "; ".join(_named(row) for row in refuted) or "none",
    }


def _named(row: JudgedReading) -> str:
    return row.reading + (" (possible)" if row.possible else "")


def _count(count: Counts, verdict: Verdict) -> str:
    """Of all readings, of the possible ones in brackets; the same for forks bent forwards."""
    return (
        f"{count.all[verdict]} ({count.possible[verdict]}) / "
        f"{count.forwards[verdict]} ({count.forwards_possible[verdict]})"
    )


def _reading(row: JudgedReading) -> list[str]:
    whole = row.judged.everywhere
    shares = (whole.shares.some, whole.shares.unbounded, whole.shares_wider_box.unbounded)
    return [
        row.reading, "yes" if row.possible else "no", *(number(share, "3p") for share in shares),
        number(row.judged.volume, ".4f"), *signs(row.judged),
    ]  # fmt: skip


def signs(judged: JudgedMachine) -> list[str]:
    """The four verdicts on all designs and on forks bent forwards."""
    sides = (_signs(side) for side in (judged.everywhere, judged.forwards))
    return [f"{whole} / {forwards}" for whole, forwards in zip(*sides, strict=True)]


def _signs(side: Judgement) -> list[str]:
    return [_SIGNS[verdict] if side.shares.some else "·" for verdict in vars(side.verdicts).values()]


def motorcycle_tables(m: Motorcycle) -> Tables:
    """The four verdicts on a motorcycle in two boxes."""
    head = ["box", "stable", "unbounded", "b ≥ 0", "stable of these", "unbounded of these"]
    rows = []
    for judged in (m.paper_box, m.wider_box):
        words = f"λ to {judged.box.lam[1]:g} rad, σ to {judged.box.sigma[1]:g}"
        whole, forwards = judged.everywhere.shares, judged.forwards.shares
        shares = (whole.some, whole.unbounded, judged.forwards_of_designs, forwards.some, forwards.unbounded)
        rows.append([words, *(number(share, "3p") for share in shares), *signs(judged)])
    return {
        "motorcycle": table([*head, "1", "2", "3", "4"], rows),
        "motorcycle_own": intervals(m.own.intervals),
        "motorcycle_bare": intervals(m.own.without_damper),
    }
