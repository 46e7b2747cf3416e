"""A rider apart from the bicycle: keys of the file → numbers named rider.m and so on → one more rigid body.

They go with the 25 parameters of Meijaard et al. (2007), whose body B is then the frame alone; axes and
origin are the same: x forward, z down, from the rear contact.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bikestab.errors import InputError
from bikestab.units import shown

RIDER: dict[str, str] = {
    "rider.m": "rider's mass [kg]",
    "rider.x": "rider's centre of mass, forward [m]",
    "rider.z": "rider's centre of mass, downward: negative [m]",
    "rider.Ixx": "rider's inertia, roll [kg m²]",
    "rider.Iyy": "rider's inertia, pitch; not in the equations [kg m²]",
    "rider.Izz": "rider's inertia, yaw [kg m²]",
    "rider.Ixz": "rider's product of inertia [kg m²]",
    "rider.inertia_mass": "mass at which the rider's inertia is as given, and with which it scales [kg]",
}
OPTIONAL = {"rider.Iyy", "rider.inertia_mass"}
INERTIAS = {"rider.Ixx", "rider.Izz", "rider.Ixz"}
CHECKS = dict.fromkeys(("rider.m", "rider.Ixx", "rider.Iyy", "rider.Izz"), "non-negative")
CHECKS |= {"rider.inertia_mass": "positive"}


def flattened(values: Mapping[Any, Any]) -> dict[Any, Any]:
    """The values with ``rider: {m: 75}`` as ``rider.m``, and ``scale_inertia`` as ``rider.inertia_mass``.

    InputError, with its key, for a rider that is none.
    """
    flat = {key: value for key, value in values.items() if key != "rider"}
    if "rider" not in values:
        return flat
    rider = values["rider"]
    if not isinstance(rider, Mapping):
        known = ", ".join(key.partition(".")[2] for key in RIDER)
        hint = f"allowed: keys with values: {known}, scale_inertia"
        raise InputError(f"{shown(rider)} is not keys with values", key=("rider",), hint=hint)
    inner = {f"rider.{key}": value for key, value in rider.items()}
    scales = inner.pop("rider.scale_inertia", False)
    if not isinstance(scales, bool):
        raise InputError(
            f"{shown(scales)} is neither true nor false", key=("rider.scale_inertia",),
            hint="true: the inertia changes in proportion to the mass",
        )  # fmt: skip
    if scales and "rider.m" in inner:
        inner.setdefault("rider.inertia_mass", inner["rider.m"])
    return flat | inner


def nested(numbers: Mapping[str, Any]) -> dict[str, Any]:
    """The numbers with those of the rider in a mapping of its own, as files have them."""
    rider = {key.partition(".")[2]: value for key, value in numbers.items() if key in RIDER}
    rest: dict[str, Any] = {key: value for key, value in numbers.items() if key not in RIDER}
    return rest | ({"rider": rider} if rider else {})


def rider_body(n: Mapping[str, Any]) -> tuple[Any, ...]:
    """Mass, centre of mass (forward, up) and central Ixx, Izz, Ixz of the rider; of any numbers."""
    xx, zz, xz = (n[f"rider.I{axes}"] for axes in ("xx", "zz", "xz"))
    if "rider.inertia_mass" in n:
        scale = n["rider.m"] / n["rider.inertia_mass"]
        xx, zz, xz = xx * scale, zz * scale, xz * scale
    return n["rider.m"], n["rider.x"], -n["rider.z"], xx, zz, xz


def left_behind(given: Mapping[str, float], changed: Mapping[str, Any]) -> str:
    """What to note where the rider's mass is ``changed`` and the inertia stays; empty if there is nothing."""
    if "rider.m" not in changed or "rider.inertia_mass" in given or INERTIAS & changed.keys():
        return ""
    return (
        f"the rider's mass alone changes from the file's {given['rider.m']:g} kg, the rider's inertia stays; "
        "with scale_inertia: true under rider it changes with the mass"
    )
