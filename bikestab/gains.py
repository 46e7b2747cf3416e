"""Feedback: a steer torque −k q for roll angle, steer angle and their rates, constant, ∝ V, or ∝ 1/V.

In the signs of Meijaard et al. (2007): roll φ to the right, steer δ to the right. What is in proportion to
1/V is infinite at rest.
"""

from __future__ import annotations

from collections.abc import Iterable

_OF = {
    "k_phi": ("roll angle", "N m"),
    "k_phidot": ("roll rate", "N m s"),
    "k_delta": ("steer angle", "N m"),
    "k_deltadot": ("steer rate", "N m s"),
}
_POWERS = {"_per_V": -1, "_V": 1}  # of the speed, by what a name ends in
GAINS: dict[str, str] = {
    name: f"steer torque against the {what}, for each unit of it [{unit}]"
    for name, (what, unit) in _OF.items()
}
GAINS |= {
    f"{name}_V": f"{name} for each m/s of speed [{unit} s/m]" for name, (_, unit) in _OF.items()
}  # what of them is in proportion to V
GAINS |= {
    f"{name}_per_V": f"{name} at 1 m/s of what is in proportion to 1/V [{unit} m/s]"
    for name, (_, unit) in _OF.items()
}


def rate_and_power(name: str) -> tuple[bool, int, int]:
    """Of a gain: whether it is of the roll, the order of the derivative, and the power of V."""
    power = next((power for end, power in _POWERS.items() if name.endswith(end)), 0)
    kind = name.removesuffix("_per_V").removesuffix("_V")
    return kind.startswith("k_phi"), int(kind.endswith("dot")), power


def infinite_at_rest(names: Iterable[str]) -> list[str]:
    """Those of the names that are gains in proportion to 1/V."""
    return [name for name in names if name in GAINS and rate_and_power(name)[2] < 0]
