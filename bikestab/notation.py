"""The 25 parameters of Meijaard et al. (2007) and their reduction to the paper's two parts."""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Iterable, Mapping
from functools import reduce
from typing import Any

from bikestab.errors import InputError, Mistakes
from bikestab.limits import check_product, check_tilt, check_value, exceeds, half_digit
from bikestab.rider import CHECKS as RIDER_CHECKS
from bikestab.rider import OPTIONAL as RIDER_OPTIONAL
from bikestab.rider import RIDER, rider_body

# Meijaard, Papadopoulos, Ruina and Schwab (2007), table 1; x forward, z down, origin at the rear contact.
MEIJAARD: dict[str, str] = {
    "w": "wheelbase [m]",
    "c": "trail along the ground [m]",
    "lam": "steer axis tilt [rad]",
    "g": "acceleration due to gravity [m/s²]",
    "delta": "viscous damping of the steering [kg m²/s]",
    "rR": "rear wheel radius [m]",
    "mR": "rear wheel mass [kg]",
    "IRxx": "rear wheel inertia about a diameter [kg m²]",
    "IRyy": "rear wheel spin inertia [kg m²]",
    "xB": "body centre of mass, forward [m]",
    "zB": "body centre of mass, downward: negative [m]",
    "mB": "body mass [kg]",
    "IBxx": "body inertia, roll [kg m²]",
    "IByy": "body inertia, pitch; not in the equations [kg m²]",
    "IBzz": "body inertia, yaw [kg m²]",
    "IBxz": "body product of inertia [kg m²]",
    "xH": "fork and handlebar centre of mass, forward [m]",
    "zH": "fork and handlebar centre of mass, downward: negative [m]",
    "mH": "fork and handlebar mass [kg]",
    "IHxx": "fork and handlebar inertia, roll [kg m²]",
    "IHyy": "fork and handlebar inertia, pitch; not in the equations [kg m²]",
    "IHzz": "fork and handlebar inertia, yaw [kg m²]",
    "IHxz": "fork and handlebar product of inertia [kg m²]",
    "rF": "front wheel radius [m]",
    "mF": "front wheel mass [kg]",
    "IFxx": "front wheel inertia about a diameter [kg m²]",
    "IFyy": "front wheel spin inertia [kg m²]",
}
MEASURED: dict[str, str] = {  # what builders measure, in either notation beside lam and the trail
    "head_angle": "head angle, 90° − tilt [rad]",
    "trail": "trail along the ground [m]",
    "offset": "fork offset, of the front axle ahead of the steering axis [m]",
}
OPTIONAL = {"g", "delta", "IByy", "IHyy", *RIDER_OPTIONAL}
CHECKS = {"w": "positive", "g": "positive"} | {
    key: "non-negative" for key in MEIJAARD if key[0] in "mr" or (key[0] == "I" and not key.endswith("xz"))
}
CHECKS |= RIDER_CHECKS
PARTS = (("rear", ("mR", "mB", "rider.m")), ("front", ("mH", "mF")))
_SAME = {"R1": "rR", "C1": "IRyy", "R2": "rF", "C2": "IFyy"}
INERTIAS = ("IB", "IH", "rider.I")  # of bodies that have a product of inertia


def superseded(values: Mapping[str, float], trail: str) -> set[str]:
    """The parameters in place of which others are among ``values``; ``trail`` is the key of the trail.

    An offset alone leaves the tilt; with a trail it fixes that.
    """
    gone = {"R1", "R2"} if "R" in values else set()
    if "head_angle" in values or ("offset" in values and not {"trail", trail}.isdisjoint(values)):
        gone.add("lam")
    if "trail" in values or "offset" in values:
        gone.add(trail)
    return gone - {*values}


def two_parts(n: Mapping[str, float]) -> dict[str, Any]:
    """The paper's parameters of the two parts, as Bicycle takes them, from the 25 of four rigid bodies.

    InputError (with the key) for what no bodies can have.
    """
    mistakes = Mistakes()
    for key, value in n.items():
        with mistakes.kept():
            if key in CHECKS or key in MEIJAARD:
                check_value(key, value, CHECKS.get(key, ""), MEIJAARD.get(key) or RIDER[key])
            if key == "lam":
                check_tilt(value, ("lam",))
    mistakes.tell()
    for inertia in INERTIAS:
        xz, xx, zz = (f"{inertia}{axes}" for axes in ("xz", "xx", "zz"))
        if xz in n:
            check_product(xz, n[xz], xx, n[xx], zz, n[zz])
    for part, bodies in PARTS:
        masses = [m for m in bodies if m in n]
        if sum(n[m] for m in masses) == 0:
            hint = f"allowed: {' + '.join(masses)} > 0"
            raise InputError(f"the {part} part has no mass", key=(bodies[1],), hint=hint)
    return {**reduced(n), "lam": n["lam"], "sigma": n["c"] / n["w"], "remarks": tuple(_body_remarks(n))}


def of_bodies(error: InputError, n: Mapping[str, float]) -> InputError:
    """Mistakes in the parameters of the two parts, told of as of the 25 in ``n`` that they come from."""

    def told(mistake: InputError) -> InputError:
        key = str(mistake.key[0]) if mistake.key else ""
        if key in n or not key or mistake.place:
            return mistake
        if key == "sigma" or key in _SAME:
            problem, hint = (
                re.sub(r"\b[CR][12]\b", lambda found: _SAME[found[0]], text)
                for text in (mistake.problem, mistake.hint)
            )
            return InputError(problem, key=(_SAME.get(key, "c"),), hint=hint)
        part, bodies = PARTS["12".index(key[-1])]
        most = max((name for name in n if _body(name) in bodies), key=lambda name: abs(n[name]))
        problem = f"{n[most]:g} is too much: the {part} part's {key} = {mistake.problem}"
        return InputError(problem, key=(most,), hint=mistake.hint)

    return error.each(told)


def of_values(error: InputError, values: Mapping[str, float]) -> InputError:
    """Mistakes told of as of the ``values`` that were put in; what else a machine has was right before."""

    def told(mistake: InputError) -> InputError:
        key = str(mistake.key[0]) if mistake.key else ""
        if not key or key in values or mistake.place:
            return mistake
        if "R" in values and key in ("R1", "R2"):
            return InputError(mistake.problem, key=("R",), hint=mistake.hint)
        names = [*values]
        given = ", ".join(f"{name} = {value:g}" for name, value in values.items())
        problem = f"with {given}: {mistake.problem}"
        if key not in ("lam", "sigma", "c"):
            one = f"{values[names[0]]:g} does" if len(names) == 1 else f"{given} do"
            problem = f"{one} not go with {key}: {mistake.problem}"
        return InputError(problem, key=(names[0],), hint=mistake.hint)

    return error.each(told)


def _body(name: str) -> str:
    """The mass of the body that a parameter is of."""
    return "rider.m" if name.startswith("rider.") else f"m{name[1:2]}"


def reduced(n: Mapping[str, Any]) -> dict[str, Any]:
    """The numbers of the two parts from those of the bodies, by the parallel-axis theorem.

    Floats, or arrays that broadcast together.
    """
    # part 1 = rear wheel + body (+ rider), part 2 = fork + front wheel: (mass, forward, up, Ixx, Izz, Ixz)
    m1, l1, h1, A1, B1, xz1 = joined(
        (n["mR"], 0.0, n["rR"], n["IRxx"], n["IRxx"], 0.0),
        (n["mB"], n["xB"], -n["zB"], n["IBxx"], n["IBzz"], n["IBxz"]),
        *([rider_body(n)] if "rider.m" in n else []),
    )
    m2, l2, h2, A2, B2, xz2 = joined(
        (n["mH"], n["xH"], -n["zH"], n["IHxx"], n["IHzz"], n["IHxz"]),
        (n["mF"], n["w"], n["rF"], n["IFxx"], n["IFxx"], 0.0),
    )
    return {
        "c": n["w"], "g": n.get("g", 9.81), "delta": n.get("delta", 0.0),
        "m1": m1, "l1": l1, "h1": h1, "A1": A1, "B1": B1, "D1": xz1, "C1": n["IRyy"], "R1": n["rR"],
        "m2": m2, "l2": l2, "h2": h2, "A2": A2, "B2": B2, "D2": -xz2, "C2": n["IFyy"], "R2": n["rF"],
    }  # fmt: skip


def joined(*bodies: tuple[Any, ...]) -> tuple[Any, ...]:
    """Bodies as one: mass, centre of mass (forward, up) and central Ixx, Izz, Ixz (z down)."""
    m = _total(body[0] for body in bodies)
    x, h = (_total(body[0] * body[i] for body in bodies) / m for i in (1, 2))
    xx, zz, xz = (_total(body[i] for body in bodies) for i in (3, 4, 5))
    for mass, ahead, up, *_ in bodies:
        dx, dh = ahead - x, up - h
        xx = xx + mass * dh * dh  # not in place: they may broadcast
        zz = zz + mass * dx * dx
        xz = xz + mass * dx * dh  # −∫ x z dm with z = −h
    return m, x, h, xx, zz, xz


def _total(terms: Iterable[Any]) -> Any:
    """Their sum from the left, of anything that can be added."""
    return reduce(operator.add, terms)


def _body_remarks(n: Mapping[str, float]) -> list[str]:
    remarks = []
    for wheel, part in (("R", "rear"), ("F", "front")):
        xx, yy = n[f"I{wheel}xx"], n[f"I{wheel}yy"]
        if exceeds(yy - half_digit(yy), 2 * (xx + half_digit(xx))):
            remarks.append(f"no rigid {part} wheel has I{wheel}yy > 2 I{wheel}xx: {yy:g} > {2 * xx:g} kg m²")
    for inertia, label in zip(INERTIAS, ("body", "fork", "rider"), strict=True):
        if f"{inertia}yy" not in n:
            continue
        xx, yy, zz, xz = (n[inertia + axes] for axes in ("xx", "yy", "zz", "xz"))
        spread = math.hypot(xx - zz, 2 * xz)  # difference of the two principal moments in the plane
        slack = half_digit(yy) + half_digit(xx) + half_digit(zz)
        if exceeds(yy, xx + zz + slack) or exceeds(spread, yy + slack + 2 * half_digit(xz)):
            remarks.append(
                f"no rigid {label} has {inertia}yy = {yy:g} with {inertia}xx = {xx:g}, "
                f"{inertia}zz = {zz:g}, {inertia}xz = {xz:g} kg m²: "
                f"allowed {spread:.6g} ... {xx + zz:.6g}; "
                f"{inertia}yy itself does not matter here, the others do"
            )
    return remarks
