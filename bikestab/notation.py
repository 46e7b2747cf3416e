"""The 25 parameters of Meijaard et al. (2007) and their reduction to the paper's two parts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bikestab.errors import InputError
from bikestab.limits import check_product, check_tilt, check_value, exceeds

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
OPTIONAL = {"g", "delta", "IByy", "IHyy"}
CHECKS = {"w": "positive", "g": "positive"} | {
    key: "non-negative" for key in MEIJAARD if key[0] in "mr" or (key[0] == "I" and not key.endswith("xz"))
}
PARTS = (("rear", ("mR", "mB")), ("front", ("mH", "mF")))


def two_parts(n: Mapping[str, float]) -> dict[str, Any]:
    """The paper's parameters of the two parts, as Bicycle takes them, from the 25 of four rigid bodies.

    InputError (with the key) for what no bodies can have.
    """
    for key, value in n.items():
        if key in CHECKS:
            check_value(key, value, CHECKS[key], MEIJAARD[key])
    check_tilt(n["lam"], ("lam",))
    for body in ("B", "H"):
        xz, xx, zz = (f"I{body}{axes}" for axes in ("xz", "xx", "zz"))
        check_product(xz, n[xz], xx, n[xx], zz, n[zz])
    for part, bodies in PARTS:
        if sum(n[m] for m in bodies) == 0:
            raise InputError(
                f"the {part} part has no mass", key=(bodies[1],), hint=f"allowed: {' + '.join(bodies)} > 0"
            )
    return {**reduced(n), "lam": n["lam"], "sigma": n["c"] / n["w"], "remarks": tuple(_body_remarks(n))}


def reduced(n: Mapping[str, Any]) -> dict[str, Any]:
    """The numbers of the two parts from those of the four bodies, by the parallel-axis theorem.

    Floats, or arrays that broadcast together.
    """
    # part 1 = rear wheel + body, part 2 = fork + front wheel: (mass, forward, up, Ixx, Izz, Ixz)
    m1, l1, h1, A1, B1, xz1 = _join(
        (n["mR"], 0.0, n["rR"], n["IRxx"], n["IRxx"], 0.0),
        (n["mB"], n["xB"], -n["zB"], n["IBxx"], n["IBzz"], n["IBxz"]),
    )
    m2, l2, h2, A2, B2, xz2 = _join(
        (n["mH"], n["xH"], -n["zH"], n["IHxx"], n["IHzz"], n["IHxz"]),
        (n["mF"], n["w"], n["rF"], n["IFxx"], n["IFxx"], 0.0),
    )
    return {
        "c": n["w"], "g": n.get("g", 9.81), "delta": n.get("delta", 0.0),
        "m1": m1, "l1": l1, "h1": h1, "A1": A1, "B1": B1, "D1": xz1, "C1": n["IRyy"], "R1": n["rR"],
        "m2": m2, "l2": l2, "h2": h2, "A2": A2, "B2": B2, "D2": -xz2, "C2": n["IFyy"], "R2": n["rF"],
    }  # fmt: skip


_Body = tuple[float, float, float, float, float, float]


def _join(a: _Body, b: _Body) -> _Body:
    """Two bodies as one: mass, centre of mass (forward, up) and central Ixx, Izz, Ixz (z down)."""
    m = a[0] + b[0]
    x, h = ((a[0] * a[i] + b[0] * b[i]) / m for i in (1, 2))
    xx, zz, xz = a[3] + b[3], a[4] + b[4], a[5] + b[5]
    for mass, dx, dh in ((a[0], a[1] - x, a[2] - h), (b[0], b[1] - x, b[2] - h)):
        xx += mass * dh * dh
        zz += mass * dx * dx
        xz += mass * dx * dh  # −∫ x z dm with z = −h
    return m, x, h, xx, zz, xz


def _body_remarks(n: Mapping[str, float]) -> list[str]:
    remarks = []
    for wheel, part in (("R", "rear"), ("F", "front")):
        xx, yy = n[f"I{wheel}xx"], n[f"I{wheel}yy"]
        if exceeds(yy, 2 * xx):
            remarks.append(f"no rigid {part} wheel has I{wheel}yy > 2 I{wheel}xx: {yy:g} > {2 * xx:g} kg m²")
    for body, label in (("B", "body"), ("H", "fork")):
        xx, zz, xz = n[f"I{body}xx"], n[f"I{body}zz"], n[f"I{body}xz"]
        if f"I{body}yy" not in n:
            continue
        yy = n[f"I{body}yy"]
        spread = math.hypot(xx - zz, 2 * xz)  # difference of the two principal moments in the plane
        if exceeds(yy, xx + zz) or exceeds(spread, yy):
            remarks.append(
                f"no rigid {label} has I{body}yy = {yy:g} with I{body}xx = {xx:g}, "
                f"I{body}zz = {zz:g}, I{body}xz = {xz:g} kg m²: "
                f"allowed {spread:.6g} ... {xx + zz:.6g}"
            )
    return remarks
