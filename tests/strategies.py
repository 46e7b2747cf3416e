"""Random machines that could exist, and designs, for hypothesis."""

from __future__ import annotations

import math
from typing import Any

from hypothesis import strategies as st

lams = st.floats(-0.2, 0.9)  # rad; the paper's box is 0 … 0.6
sigmas = st.floats(-0.1, 0.5)
speeds = st.floats(0.0, 50.0)  # m/s


def between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high)


@st.composite
def body(draw: Any, m: float, size: float) -> tuple[float, float, float]:
    """Ixx, Izz, Ixz of a rigid body of mass ``m`` and the radius of gyration ``size``."""
    xx, zz = (m * (size * draw(between(0.2, 1))) ** 2 for _ in range(2))
    return xx, zz, draw(between(-0.9, 0.9)) * math.sqrt(xx * zz)


@st.composite
def wheel(draw: Any, m: float) -> tuple[float, float, float]:
    """Radius, diametral and spin inertia of a wheel between a solid disc and a thin rim."""
    r = draw(between(0.15, 0.5))
    spin = m * r**2 * draw(between(0.5, 1))
    return r, 0.5 * spin * draw(between(1, 1.2)), spin


@st.composite
def meijaard_machines(draw: Any) -> dict[str, float]:
    """The 25 parameters of Meijaard et al. (2007), without gravity's choice: g = 9.81."""
    w, mR, mB = draw(between(0.7, 1.8)), draw(between(0.5, 15)), draw(between(10, 250))
    mH, mF = draw(between(0.5, 15)), draw(between(0.5, 15))
    n = {"w": w, "c": w * draw(sigmas), "lam": draw(lams), "g": 9.81, "mR": mR, "mB": mB, "mH": mH, "mF": mF}
    n |= {"xB": w * draw(between(0.1, 0.7)), "zB": -draw(between(0.3, 1.5))}
    n |= {"xH": w * draw(between(0.7, 1.2)), "zH": -draw(between(0.2, 1.0))}
    for name, m in (("R", mR), ("F", mF)):
        n["r" + name], n[f"I{name}xx"], n[f"I{name}yy"] = draw(wheel(m))
    for name, m, size in (("B", mB, 0.5), ("H", mH, 0.3)):
        n[f"I{name}xx"], n[f"I{name}zz"], n[f"I{name}xz"] = draw(body(m, size))
    return n


@st.composite
def paper_machines(draw: Any) -> dict[str, float]:
    """The paper's parameters with D1, D2 and two radii; δ is 0 for every other machine."""
    c, m1, m2 = draw(between(0.7, 1.8)), draw(between(10, 250)), draw(between(1, 30))
    n = {"c": c, "g": 9.81, "m1": m1, "m2": m2, "delta": draw(st.just(0.0) | between(1e-9, 5))}
    n |= {"l1": c * draw(between(0.1, 0.7)), "h1": draw(between(0.3, 1.5))}
    n |= {"l2": c * draw(between(0.7, 1.2)), "h2": draw(between(0.2, 1.0))}
    for i, m, size in (("1", m1, 0.5), ("2", m2, 0.35)):
        n["A" + i], n["B" + i], n["D" + i] = draw(body(m, size))
        n["R" + i], _, spin = draw(wheel(0.3 * m))
        n["C" + i] = min(spin, n["A" + i] + n["B" + i])
    return n


machines = paper_machines() | meijaard_machines()
