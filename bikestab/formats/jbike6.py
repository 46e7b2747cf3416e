"""A bicycle that JBike6 saved, a MATLAB script of assignments → the 25 parameters and a rider.

There x points forward and y up. Wheels have diameters. Bodies have principal moments ``[I11 I22 Izz]``: two
about axes in the plane of symmetry, the first turned by alpha from x towards y, and one about that across.
Centres of mass are given by x and y from the rear contact, or at the front by u and v from the foot of the
steering axis, v up along it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from bikestab.errors import InputError
from bikestab.formats.found import Found
from bikestab.formats.matlab import Script, Value, parse
from bikestab.formats.principal import turned
from bikestab.notation import joined
from bikestab.units import shown

GRAVITY = 9.80665  # m/s²: the program's own; files of bicycles have none
_REAR, _FRONT = ("frame", "rack"), ("fork", "basket")
_AXES = ("xx", "yy", "zz", "xz")
_DEGREES = math.pi / 180
_SAME = 1e-9  # relative, of a wheel's two moments
_NAMES = {"mR": "mrearwheel", "mB": "mframe", "mH": "mfork", "mF": "mfrontwheel", "rider.m": "mrider"}
_THEIRS = {
    "w": "wheelbase", "c": "trail", "lam": "head_angle", "g": "gravity",
    "rR": "Drearwheel", "rF": "Dfrontwheel", **_NAMES,
    **{f"{m.replace('m', 'I')}{axes}": f"I{name[1:]}" for m, name in _NAMES.items() for axes in _AXES},
}  # fmt: skip


class Body(NamedTuple):
    """Mass, centre of mass (forward, up) and central inertia about axes forward, across and down."""

    mass: float
    x: float
    h: float
    xx: float
    yy: float
    zz: float
    xz: float


def read(text: str, file: str) -> Found:
    """The bicycle in such a script; InputError with file, line and key."""
    script = parse(text, file)

    def located(error: InputError) -> InputError:
        return script.located(error.renamed(_THEIRS))

    try:
        values, notes = _read(script)
    except InputError as error:
        raise located(error) from None
    return Found(values, located, notes=tuple(notes))


def _read(script: Script) -> tuple[dict[str, float | str], list[str]]:
    """The parameters and the name, by key, and notes."""
    tilt, unit, notes = _tilt(script)
    n = {name: _number(script, name) for name in ("wheelbase", "trail")}
    found: dict[str, float | str] = {"w": n["wheelbase"], "c": n["trail"], "lam": tilt}
    found["g"] = _number(script, "gravity", GRAVITY)
    if "gravity" not in script.values:
        notes.append(f"gravity is JBike6's own, {GRAVITY} m/s²")
    for letter, wheel in (("R", "rearwheel"), ("F", "frontwheel")):
        found |= {f"r{letter}": _number(script, f"D{wheel}") / 2, f"m{letter}": _number(script, f"m{wheel}")}
        I11, I22, Izz = _moments(script, wheel)
        if not math.isclose(I11, I22, rel_tol=_SAME):
            problem = f"a wheel has one moment about all its diameters, not {I11:.9g} and {I22:.9g} kg m²"
            raise InputError(problem, key=(f"I{wheel}",), hint="give the same twice")
        found |= {f"I{letter}xx": I11, f"I{letter}yy": Izz}
    foot = n["wheelbase"] + n["trail"]
    for letter, names in (("B", _REAR), ("H", _FRONT)):
        bodies = [_body(script, name, unit, tilt, foot) for name in names]
        found |= _keys("{}" + letter, f"I{letter}", _as_one([b for b in bodies if b.mass] or bodies[:1]))
        if len([b for b in bodies if b.mass]) > 1:
            notes.append(f"{' and '.join(names)} are joined as {letter}")
    rider = _body(script, "rider", unit, tilt, foot)
    if rider.mass:
        found |= _keys("rider.{}", "rider.I", rider)
    if isinstance(name := script.values.get("name"), str) and name.strip():
        found["name"] = name
    return found, notes


def _tilt(script: Script) -> tuple[float, float, list[str]]:
    """The tilt [rad], how much rad the file's unit of angles is, and a note where that is to be told.

    ``angle_units`` is 1 for radians and 2 for degrees, but may be what the program shows and not what the
    file has. A head angle above π can be in degrees alone, and one below is none of a bicycle in degrees.
    """
    key = "head_angle" if "head_angle" in script.values else "lambda"
    if key not in script.values:
        raise InputError("is missing", key=("head_angle",), hint="a bicycle of JBike6 has a head_angle")
    angle = _number(script, key)
    in_degrees = abs(angle) > (math.pi if key == "head_angle" else math.pi / 2)
    units = script.values.get("angle_units")
    unit = _DEGREES if in_degrees else 1.0
    notes = ["angles are in degrees"] if in_degrees else []
    if units == 1.0 and in_degrees:
        problem = f"{angle:g} is no angle in radians, which angle_units = 1 says it is"
        raise InputError(problem, key=(key,), hint="write it in radians, or leave angle_units out")
    if units == 2.0 and not in_degrees:
        notes.append("angles are in radians, as angle_units = 2 tells what JBike6 shows")
    if key == "lambda":
        return angle * unit, unit, notes
    return ((90 - angle) * _DEGREES if in_degrees else math.pi / 2 - angle), unit, notes


def _number(script: Script, name: str, default: float | None = None) -> float:
    value: Value | None = script.values.get(name, default)
    if value is None:
        hint = (
            "a bicycle of JBike6 has wheelbase, trail, head_angle, D, m and I of both wheels, and its bodies"
        )
        raise InputError("is missing", key=(name,), hint=hint)
    if not isinstance(value, float):
        hint = "allowed: a number, or arithmetic with numbers, pi and names that were assigned before"
        raise InputError(f"{shown(value)} is not a number", key=(name,), hint=hint)
    return value


def _moments(script: Script, name: str) -> tuple[float, float, float]:
    value = script.values.get(f"I{name}", (0.0, 0.0, 0.0))
    if not isinstance(value, tuple) or len(value) != 3:
        hint = "allowed: three numbers in brackets, [I11 I22 Izz]"
        raise InputError(f"{shown(value)} is not three moments", key=(f"I{name}",), hint=hint)
    return value[0], value[1], value[2]


def _body(script: Script, name: str, unit: float, tilt: float, foot: float) -> Body:
    """A frame or rider; one that is not there has no mass."""
    mass = _number(script, f"m{name}", None if name in ("frame", "fork") else 0.0)
    if mass < 0:
        raise InputError(f"{mass:g} kg is negative", key=(f"m{name}",), hint="allowed: 0 and above")
    missing = None if mass else 0.0  # where there is no body nobody asks where it is
    if name in _FRONT:
        u, v = (_number(script, f"{axis}cm{name}", missing) for axis in "uv")
        sin, cos = math.sin(tilt), math.cos(tilt)
        x, h = foot + u * cos - v * sin, u * sin + v * cos
    else:
        x, h = (_number(script, f"{axis}cm{name}", missing) for axis in "xy")
    I11, I22, Izz = _moments(script, name)
    inertia = turned(I11, I22, Izz, unit * _number(script, f"alphaI{name}", 0.0))
    return Body(mass, x, h, **inertia)


def _as_one(bodies: list[Body]) -> Body:
    """Rigid bodies as one, by the parallel-axis theorem."""
    if len(bodies) == 1:
        return bodies[0]
    mass, x, h, xx, zz, xz = joined(*((b.mass, b.x, b.h, b.xx, b.zz, b.xz) for b in bodies))
    # what is added about the axis across is the sum of what is added about the two others
    yy = sum(b.yy + (xx + zz) / len(bodies) - b.xx - b.zz for b in bodies)
    return Body(mass, x, h, xx, yy, zz, xz)


def _keys(body: str, inertia: str, b: Body) -> dict[str, float]:
    place = {body.format("m"): b.mass, body.format("x"): b.x, body.format("z"): -b.h}
    return place | {f"{inertia}{axes}": getattr(b, axes) for axes in _AXES}
