"""Standard deviations of parameters → how far stable speeds are known: by the linear rule, and by sampling.

The linear rule, the root of the summed squares of dV/dp times the deviation of p, holds where V is nearly
linear within the deviations and every machine within them is stable somewhere. Sampled machines tell.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, TypedDict

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.design.sensitivity import Hold, Sensitivity, sensitivity
from bikestab.draws import correlation_matrix, drawn
from bikestab.errors import InputError, nearest
from bikestab.limits import MOST, MOST_TRAIL
from bikestab.machines import Machines
from bikestab.model import Floats, characteristic_table
from bikestab.speeds import intervals_of

SAMPLES = 20_000
SHARE = 0.90  # of the machines that have such an end lie between ``low`` and ``high``
_STEEPEST = 1.5  # rad; the equations know no tilt beyond
_TILTS = ("lam", "head_angle")
_AGREE = 0.1  # of the standard deviation
_CERTAIN = 0.999  # share of machines that are stable somewhere, above which the others do not count


class End(TypedDict):
    """A stable interval's end [m/s]: its own, its deviation by the linear rule, and of the sampled machines.

    ``low``, ``median`` and ``high`` are quantiles over the machines that are stable somewhere, inf where that
    many are without an upper limit; ``sampled`` is the standard deviation over those with a finite end. None
    where there is none.
    """

    own: float | None
    linear: float | None
    sampled: float | None
    low: float | None
    median: float | None
    high: float | None


class Spread(TypedDict):
    """How the widest stable interval of a machine spreads within standard deviations of its parameters.

    Shares of ``samples``, the drawn machines that can exist; ``refused`` others were drawn that cannot, as
    with a negative mass. ``reasons`` say why the linear rule is wrong, and are empty where it is right.
    """

    deviations: dict[str, float]
    samples: int
    refused: int
    exists: float
    unbounded: float
    V1: End
    V2: End
    reasons: list[str]


def spread(
    found: Sensitivity,
    deviations: Mapping[str, float],
    correlations: Mapping[tuple[str, str], float] | None = None,
    *,
    samples: int = SAMPLES,
    seed: int = 0,
) -> Spread:
    """The spread of a design's widest stable interval; normal distributions around the machine as it is.

    ``deviations`` are of parameters of its notation, ``lam``, ``sigma`` or ``trail`` among them, in their
    units; what is ``correlations`` of pairs not given is independent. The same each time for one ``seed``.
    InputError, with the key ``sd``, for what the machine does not have, and for contradicting correlations.
    """
    _check(found, deviations)
    correlations = correlations or {}
    names = list(deviations)
    draws = drawn(found.values, names, deviations, correlations, samples, seed)
    V1, V2, refused = _sampled(found, draws)
    some = np.isfinite(V1)
    widest = _widest(found)
    linear = [_linear(found, which, widest, deviations, correlations) for which in (0, 1)]
    own = [None if widest is None else float(V[widest]) for V in (found.intervals.V1, found.intervals.V2)]
    ends = [_end(o, s, V[some]) for o, s, V in zip(own, linear, (V1, V2), strict=True)]
    number = max(len(V1), 1)
    result: Spread = {
        "deviations": dict(deviations),
        "samples": len(V1),
        "refused": refused,
        "exists": float(np.count_nonzero(some) / number),
        "unbounded": float(np.count_nonzero(np.isinf(V2)) / number),
        "V1": ends[0],
        "V2": ends[1],
        "reasons": [],
    }
    result["reasons"] = _reasons(result)
    return result


def _as_measured(found: Sensitivity, deviations: Mapping[str, float]) -> Sensitivity:
    """The same with that held of which the deviations are, however a frame may be changed."""
    own: Hold = "trail" if found.bicycle.bodies is not None else "sigma"
    hold: Hold = "offset" if "offset" in deviations else own
    if hold == found.hold:
        return found
    return sensitivity(found.bicycle, found.lam, found.sigma, hold=hold, model=found.model)


def own_spread(found: Sensitivity, *, of_file: bool, given: Mapping[str, float]) -> Spread | None:
    """The spread by the deviations of the bicycle's file, if they are asked for, and by those ``given``.

    None where there are none. Correlations are those of the file. One that is given stands in place of the
    file's: of the trail or of the tilt, under any of its names. Whatever ``found.hold`` is, what was measured
    is the trail (σ in the paper's notation), or the offset where that is uncertain; it stays with others.
    """
    bicycle = found.bicycle
    known = {name: sd for name, sd in bicycle.deviations.items() if sd > 0} if of_file else {}
    for names in (_trails(bicycle), _TILTS):
        if any(name in names for name in given):
            known = {name: sd for name, sd in known.items() if name not in names}
    deviations = {**known, **given}
    return spread(_as_measured(found, deviations), deviations, bicycle.correlations) if deviations else None


def plain(result: Spread) -> dict[str, Any]:
    """The spread as JSON can hold it: None where an end is infinite."""

    def finite(end: Any) -> dict[str, float | None]:
        return {name: None if x is None or math.isinf(x) else x for name, x in end.items()}

    return {**result, "V1": finite(result["V1"]), "V2": finite(result["V2"])}


def _check(found: Sensitivity, deviations: Mapping[str, float]) -> None:
    known = list(found.values)
    for name, deviation in deviations.items():
        if name not in known:
            raise InputError(f"there is no parameter {name!r}", key=("sd",), hint=nearest(name, known))
        if not 0 <= deviation <= MOST:
            hint = f"allowed: from 0 to {MOST:g}"
            problem = f"{name}={deviation:g} is no standard deviation"
            raise InputError(problem, key=("sd",), hint=hint)
    for names, what in ((_trails(found.bicycle), "trail"), (_TILTS, "tilt")):
        both = [name for name in deviations if name in names]
        if len(both) > 1:
            problem = f"{both[0]} and {both[1]} are both the {what}"
            raise InputError(problem, key=("sd",), hint="give one of them")
    if not deviations:
        raise InputError("no standard deviation is given", key=("sd",), hint="for example mB=1.5")


def _trails(bicycle: Bicycle) -> tuple[str, ...]:
    return ("sigma", "trail", "offset", *(("c",) if bicycle.bodies is not None else ()))


def _sampled(found: Sensitivity, draws: Mapping[str, Floats]) -> tuple[Floats, Floats, int]:
    """The ends (sample,) of each machine's widest interval, NaN without one; and how many are no machine."""
    bicycle = found.bicycle
    front = {*_TILTS, *_trails(bicycle)}
    others = {name: values for name, values in draws.items() if name not in front}
    number = len(next(iter(draws.values())))
    machines, good = Machines.tried(bicycle, others or {"g": np.full(number, bicycle.g)})
    lam, sigma = _designs(found, draws, machines)
    with np.errstate(invalid="ignore"):
        good &= (np.abs(lam) < _STEEPEST) & (np.abs(sigma) <= MOST_TRAIL)
    lam, sigma = np.where(good, lam, found.lam), np.where(good, sigma, found.sigma)
    with np.errstate(all="ignore"):  # of what is no machine
        table = characteristic_table(machines, lam[:, np.newaxis], sigma[:, np.newaxis], model=found.model)
    intervals = intervals_of(table[..., 0][..., good])
    width = np.where(np.isnan(intervals.V1), -np.inf, intervals.V2 - intervals.V1)
    chosen = np.argmax(width, axis=-1)[:, np.newaxis]
    V1, V2 = (np.take_along_axis(V, chosen, axis=-1)[:, 0] for V in (intervals.V1, intervals.V2))
    return V1, V2, int(np.count_nonzero(~good))


def _designs(found: Sensitivity, draws: Mapping[str, Floats], machines: Machines) -> tuple[Floats, Floats]:
    """Tilt and σ (sample,) of drawn machines: what is held stays, and the trail itself may vary."""
    number = machines.number
    c, R2 = (np.broadcast_to(x, (number, 1))[:, 0] for x in (machines.c, machines.R2))
    lam = draws.get("lam", np.array(found.lam))
    if "head_angle" in draws:
        lam = lam + (found.values["head_angle"] - draws["head_angle"])
    lam = np.broadcast_to(lam, number)
    with np.errstate(all="ignore"):
        if found.hold == "offset":
            sigma = (R2 * np.sin(lam) - found.values["offset"]) / (c * np.cos(lam))
        else:
            sigma = found.values["trail"] / c if found.hold == "trail" else np.full(number, found.sigma)
        for name in _trails(found.bicycle):
            if name in draws:
                by = {"sigma": np.array(1.0), "offset": -c * np.cos(lam)}.get(name, c)
                sigma = sigma + (draws[name] - found.values[name]) / by
    return lam, sigma


def _widest(found: Sensitivity) -> int | None:
    number = int(found.intervals.number)
    if not number:
        return None
    return int(np.argmax((found.intervals.V2 - found.intervals.V1)[:number]))


def _linear(
    found: Sensitivity, which: int, widest: int | None, deviations: Mapping[str, float],
    correlations: Mapping[tuple[str, str], float],
) -> float | None:  # fmt: skip
    """The standard deviation by the linear rule, correlations included; None where there is no derivative."""
    if widest is None:
        return None
    slopes = (found.dV1, found.dV2)[which]
    names = list(deviations)
    parts = np.array([slopes[name][widest] * deviations[name] for name in names])
    variance = parts @ correlation_matrix(names, correlations) @ parts
    return math.sqrt(variance) if math.isfinite(variance) else None


def _end(own: float | None, linear: float | None, values: Floats) -> End:
    finite = values[np.isfinite(values)]
    quantiles: list[float | None] = [None, None, None]
    if len(values):
        shares = [(1 - SHARE) / 2, 0.5, (1 + SHARE) / 2]
        quantiles = [float(q) for q in np.quantile(values, shares, method="inverted_cdf")]
    return {
        "own": own, "linear": linear, "sampled": float(finite.std()) if len(finite) > 1 else None,
        "low": quantiles[0], "median": quantiles[1], "high": quantiles[2],
    }  # fmt: skip


def _reasons(result: Spread) -> list[str]:
    """Why the linear rule does not hold, one clause each."""
    reasons = []
    if result["exists"] < _CERTAIN:
        reasons.append(f"{1 - result['exists']:.1%} of the machines have no stable speed")
    V2 = result["V2"]["own"]
    if V2 is not None and math.isinf(V2) and result["unbounded"] < result["exists"]:
        share = 1 - result["unbounded"] / result["exists"]
        reasons.append(f"{share:.1%} of those that are stable somewhere have an upper limit")
    elif V2 is not None and math.isfinite(V2) and result["unbounded"] > 0:
        reasons.append(f"{result['unbounded']:.1%} of the machines have no upper limit")
    for name, end in (("V1", result["V1"]), ("V2", result["V2"])):
        if end["linear"] and end["sampled"] and abs(end["sampled"] / end["linear"] - 1) > _AGREE:
            ratio = end["sampled"] / end["linear"]
            reasons.append(
                f"{name} is not linear within them: sampled, its deviation is {ratio:.2g} times as large"
            )
    return reasons
