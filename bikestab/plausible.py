"""Numbers that no bicycle has, and the mistake that they are likely to be → sentences."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from bikestab.limits import half_digit, part_warnings

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle

LONGEST, HEAVIEST, HEAVIEST_FRONT = 10.0, 2000.0, 200.0  # m, kg: several times what real machines have
_FRONT = {"mR", "mF", "mH", "m2"}  # wheels and fork
_MILLIMETRES = 300.0  # a longest length from here on is no bicycle's in centimetres
_CENTIMETRES = 75.0  # a wheelbase below this is none in centimetres, but one in inches
_STRONGEST = 100.0  # m/s², several times what any planet has


def warnings_of(bicycle: Bicycle) -> tuple[str, ...]:
    """What no rigid bodies on the ground can have, one sentence each.

    Where numbers were likely typed in other units that alone is said, since it explains all else. The last
    printed digit of an inertia may be rounded: that is no reason for doubt.
    """
    if mistakes := _other_units(bicycle.given, bicycle.notation):
        return mistakes
    b, n = bicycle, bicycle.given
    names = (("A1", "B1", "C1"), ("A2", "B2", "C2"))
    if b.bodies:
        names = (("IRxx", "IRxx", "IRyy"), ("IFxx", "IFxx", "IFyy"))
    rear, front = ((half_digit(n[A]), half_digit(n[B]), half_digit(n[C])) for A, B, C in names)
    parts = (
        part_warnings("1", "rear", b.A1, b.B1, b.C1, b.m1, b.R1, b.h1, -b.l1, rear),
        part_warnings("2", "front", b.A2, b.B2, b.C2, b.m2, b.R2, b.h2, b.c - b.l2, front),
    )
    found = (*b.remarks, *parts[0], *parts[1], *_geometry(b))
    if not b.bodies:
        return found
    hint = "; z points down, so that zB and zH are negative"
    return tuple(text + hint if "below the ground" in text else text for text in found)


def design_doubts(lam: float | None, sigma: float | None, wheelbase: float) -> list[str]:
    """The likely mistake in a tilt [rad] beyond half a right angle, or a trail beyond the wheelbase [m]."""
    doubts = []
    if lam is not None and math.pi / 4 < lam < math.pi / 2:
        degrees = math.degrees(lam)
        doubts.append(
            f"λ = {degrees:.6g}° is a head angle of {90 - degrees:.6g}°: lam is the tilt from the vertical; "
            f"for a head angle of {degrees:.6g}° give lam = {90 - degrees:.6g}deg, or head_angle"
        )
    if sigma is not None and abs(sigma) > 1:
        trail = sigma * wheelbase
        doubts.append(
            f"a trail of {trail:.6g} m is longer than the wheelbase of {wheelbase:.6g} m"
            + (f": millimetres are written {trail:.6g}mm" if abs(trail) > LONGEST else "")
        )
    return doubts


def deviation_doubts(bicycle: Bicycle, deviations: Mapping[str, float]) -> list[str]:
    """The likely mistake in standard deviations [m, kg] that are larger than the length or mass itself."""
    doubts = []
    for name, deviation in deviations.items():
        unit = bicycle.notation.get(name, "").rpartition("[")[2].rstrip("]")
        value = bicycle.given.get(name)
        if unit not in ("m", "kg") or not value or deviation <= abs(value):
            continue
        text = f"the standard deviation {name} = {deviation:g} {unit} is larger than "
        text += f"{name} = {value:g} {unit} itself"
        if deviation >= 1:
            written = f"millimetres are written {deviation:g}mm"
            text += f": {written if unit == 'm' else f'grams are written {deviation:g}g'}"
        doubts.append(text)
    return doubts


def _other_units(given: Mapping[str, float], notation: Mapping[str, str]) -> tuple[str, ...]:
    """The likely mistakes of lengths not in metres and masses not in kilograms."""
    unit = {key: meaning.rpartition("[")[2] for key, meaning in notation.items()}
    lengths = {k: v for k, v in given.items() if unit.get(k) == "m]" and abs(v) > LONGEST}
    masses = {
        k: v
        for k, v in given.items()
        if unit.get(k) == "kg]" and v > (HEAVIEST_FRONT if k in _FRONT else HEAVIEST)
    }
    short, words = "mm", "millimetres"
    trail, wheelbase = ("c", "w") if "w" in given else ("trail", "c")
    alone = trail in lengths and wheelbase not in lengths  # no trail is a few decimetres
    if max(map(abs, lengths.values()), default=0) < _MILLIMETRES and not alone:
        short, words = "cm", "centimetres"
        if lengths.get(wheelbase, _CENTIMETRES) < _CENTIMETRES:
            short, words = "in", "inches"
    found = ((lengths, "m", short, words), (masses, "kg", "g", "grams"))
    mistakes = [
        f"{_listed(values, si)}: no bicycle has that; {words} are written {_first(values):g}{unit}"
        for values, si, unit, words in found
        if values
    ]
    if (g := given.get("g", 0.0)) > _STRONGEST:
        mistakes.append(f"g = {g:g} m/s²: no planet has that; it is about 9.81 m/s² here")
    return tuple(mistakes)


def _first(values: Mapping[str, float]) -> float:
    return next(iter(values.values()))


def _listed(values: Mapping[str, float], unit: str) -> str:
    first = ", ".join(f"{key} = {value:g} {unit}" for key, value in list(values.items())[:2])
    return first + (f" and {len(values) - 2} more" if len(values) > 2 else "")


def _geometry(b: Bicycle) -> list[str]:
    doubts = design_doubts(b.lam, b.sigma, b.c)
    if (centre := (b.m1 * b.l1 + b.m2 * b.l2) / (b.m1 + b.m2)) < 0:
        doubts.append(
            f"the centre of mass is {-centre:.4g} m behind the rear contact, so that the machine falls over "
            "backwards; x points ahead from there"
        )
    if b.c**2 * (1 + 1e-9) < 4 * b.R1 * b.R2:  # circles on the ground whose contacts are c apart
        doubts.append(
            f"the wheels overlap: radii of {b.R1:g} and {b.R2:g} m need a wheelbase of "
            f"{2 * math.sqrt(b.R1 * b.R2):.4g} m, not {b.c:g} m; are they diameters?"
        )
    return doubts
