"""Principal axes: radii of gyration and angles of five bodies (Moore and Hubbard 2019) → the 25 and a rider.

The bodies are frame D, rider P, fork and handlebar H, and the wheels. ``kDaa`` and ``kDbb`` are the radii of
gyration about the principal axes in the plane of symmetry, the first of them turned by ``alphaD`` about y.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bikestab.formats.found import quantities

_FRAMES = {"D": "frame", "H": "fork and handlebar", "P": "rider"}
_WHEELS = {"R": "rear wheel", "F": "front wheel"}
PRINCIPAL: dict[str, str] = {
    "w": "wheelbase [m]",
    "c": "trail along the ground [m]",
    "lam": "steer axis tilt [rad]",
    "g": "acceleration due to gravity [m/s²]",
}
for _body, _name in {**_FRAMES, **_WHEELS}.items():
    PRINCIPAL |= {f"m{_body}": f"mass of the {_name} [kg]"}
    PRINCIPAL |= {f"k{_body}{axis}": f"radius of gyration of the {_name} [m]" for axis in ("aa", "yy")}
for _body, _name in _FRAMES.items():
    PRINCIPAL |= {f"x{_body}": f"centre of mass of the {_name}, forward [m]"}
    PRINCIPAL |= {f"z{_body}": f"centre of mass of the {_name}, downward: negative [m]"}
    PRINCIPAL |= {f"k{_body}bb": f"radius of gyration of the {_name} [m]"}
    PRINCIPAL |= {f"alpha{_body}": f"angle of the first principal axis of the {_name} [rad]"}
PRINCIPAL |= {f"r{_body}": f"radius of the {_name} [m]" for _body, _name in _WHEELS.items()}
IGNORED = {"lP", "wP"}  # length and width of a rider that is drawn


def converted(values: Mapping[Any, Any]) -> dict[str, float]:
    """The 25 parameters, with ``rider.m`` and so on of the rider; InputError, with its key, for a mistake."""
    n = quantities(values, PRINCIPAL, optional={"g"}, ignored=IGNORED)
    found: dict[str, float] = {
        key: n[key] for key in ("w", "c", "lam", "g", "rR", "mR", "rF", "mF") if key in n
    }
    for body in _WHEELS:
        found |= {f"I{body}{axes}": n[f"m{body}"] * n[f"k{body}{k}"] ** 2 for axes, k in _AXES}
    for body, name in (("D", "{}B"), ("H", "{}H"), ("P", "rider.{}")):
        found |= {name.format(letter): n[letter + body] for letter in "mxz"}
        inertia = name.format("I") if body == "P" else f"I{name[-1]}"
        found |= {inertia + axes: value for axes, value in _of_body(n, body).items()}
    return found


_AXES = (("xx", "aa"), ("yy", "yy"))


def _of_body(n: Mapping[str, float], body: str) -> dict[str, float]:
    aa, bb, yy = (n[f"m{body}"] * n[f"k{body}{axis}"] ** 2 for axis in ("aa", "bb", "yy"))
    return turned(aa, bb, yy, n[f"alpha{body}"])


def turned(aa: float, bb: float, yy: float, alpha: float) -> dict[str, float]:
    """A body's inertia about axes forward, across and down, from that about its principal axes.

    The first of these is turned by ``alpha`` [rad] about the axis across, from forward to up.
    """
    sin, cos = math.sin(alpha), math.cos(alpha)
    xx, zz = aa * cos * cos + bb * sin * sin, aa * sin * sin + bb * cos * cos
    return {"xx": xx, "yy": yy, "zz": zz, "xz": (bb - aa) * sin * cos}
