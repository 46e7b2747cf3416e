"""A design that BikeCAD saved, Java's properties as XML in mm and degrees → what is told of it.

It has the geometry of a frame, but no masses and no moments of inertia, so that it is no machine by itself.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from contextlib import suppress

from bikestab.errors import InputError
from bikestab.geometry import trail_from
from bikestab.notation import MEIJAARD, OPTIONAL

_ENTRY = re.compile(r'<entry\s+key="([^"]*)"\s*>([^<]*)</entry>')
_STACK_AND_REACH = 3  # of the ways in which the front of a frame is given
_GEOMETRY = {"w", "c", "lam", "rR", "rF"}
_WORDS = {"offset": "fork offset", "c": "trail", "w": "wheelbase"}


def refused(text: str, file: str) -> InputError:
    """What such a design has, what is missing, and what to type instead."""
    found = geometry(text)
    known = [f"{words} {1000 * found[key]:.6g} mm" for key, words in _WORDS.items() if key in found]
    typed = [f"--trail {1000 * found['c']:.6g}mm"] if "c" in found else []
    typed += [f"--set {key}={1000 * found[key]:.6g}mm" for key in ("w", "rF") if key in found]
    if "lam" in found:
        angle = f"{90 - math.degrees(found['lam']):.6g}"
        known.insert(0, f"head angle {angle}°")
        typed.insert(0, f"--head-angle {angle}deg")
    problem = "is a design of BikeCAD, not a bicycle with masses and moments of inertia"
    hint = f"missing: {' '.join(key for key in MEIJAARD if key not in _GEOMETRY | OPTIONAL)}"
    problem += f": {', '.join(known)}" if known else ""
    if typed:
        hint += f"\nwith those of another: bikestab vrange --bicycle NAME {' '.join(typed)}"
    return InputError(problem, place=file, hint=hint)


def geometry(text: str) -> dict[str, float]:
    """Tilt [rad], radii, fork offset, trail and wheelbase [m], as far as such a design has them, by key."""
    n = {}
    for key, value in _ENTRY.findall(text):
        with suppress(ValueError):
            n[key] = float(value)
    n = {key: value for key, value in n.items() if math.isfinite(value)}
    found = {
        name: n[key] / 2000
        for name, key in (("rR", "Wheel diameter rear"), ("rF", "Wheel diameter front"))
        if n.get(key, 0) > 0
    }
    if not 0 < n.get("Head angle", 0) < 180:
        return found
    found["lam"] = math.radians(90 - n["Head angle"])
    fork = n.get(f"FORK{n.get('Fork type', 0):.0f}R", n.get("Fork offset"))
    if fork is None:
        return found
    found["offset"] = fork / 1000
    if "rF" in found:
        found["c"] = float(trail_from(found["lam"], found["offset"], found["rF"]))
    if (wheelbase := _wheelbase(n)) is not None and {"rR", "rF"} <= found.keys():
        found["w"] = wheelbase / 1000
    return found


def _wheelbase(n: Mapping[str, float]) -> float | None:
    """In mm, of frames whose front is given by stack and reach and whose rear by the chain stays."""
    needed = {"Stack", "FCD textfield", "CS textfield", "BB textfield", "Top tube front center measure style"}
    if not needed | {"Wheel diameter rear", "Wheel diameter front"} <= n.keys():
        return None
    if n["Top tube front center measure style"] != _STACK_AND_REACH or n.get("CS measure style", 0) != 0:
        return None
    rear, front = n["Wheel diameter rear"] / 2, n["Wheel diameter front"] / 2
    # of the axles above the bottom bracket, whose drop is given, or with style 1 its height
    drop = rear - n["BB textfield"] if n.get("BB measure style", 0) == 1 else n["BB textfield"]
    angle = math.radians(n["Head angle"])
    fork = n.get(f"FORK{n.get('Fork type', 0):.0f}R", n.get("Fork offset", 0))
    # down the steering axis from the top of the head tube, then across it to the axle
    along = (n["Stack"] + fork * math.cos(angle) - (drop + front - rear)) / math.sin(angle)
    ahead = n["FCD textfield"] + along * math.cos(angle) + fork * math.sin(angle)
    behind = n["CS textfield"] ** 2 - drop**2
    return ahead + math.sqrt(behind) if behind > 0 else None
