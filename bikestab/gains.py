"""Feedback: a steer torque −k q for roll angle, steer angle and their rates, constant or in proportion to V.

In the signs of Meijaard et al. (2007): roll φ to the right, steer δ to the right.
"""

from __future__ import annotations

_OF = {
    "k_phi": ("roll angle", "N m"),
    "k_phidot": ("roll rate", "N m s"),
    "k_delta": ("steer angle", "N m"),
    "k_deltadot": ("steer rate", "N m s"),
}
GAINS: dict[str, str] = {
    name: f"steer torque against the {what}, for each unit of it [{unit}]"
    for name, (what, unit) in _OF.items()
}
GAINS |= {
    f"{name}_V": f"{name} for each m/s of speed [{unit} s/m]" for name, (_, unit) in _OF.items()
}  # what of them is in proportion to V


def rate_and_power(name: str) -> tuple[bool, int, int]:
    """Of a gain: whether it is of the roll, the order of the derivative, and the power of V."""
    kind = name.removesuffix("_V")
    return kind.startswith("k_phi"), int(kind.endswith("dot")), int(kind != name)
