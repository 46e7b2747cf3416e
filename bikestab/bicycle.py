"""A bicycle or motorcycle: the paper's parameters, their checks, and the other notations.

Part 1 is the rear wheel, frame and rider; part 2 the fork, handlebar and front wheel
(Dikarev, Dikareva and Fufaev 1981, section 1).
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bikestab import yamltext
from bikestab.errors import InputError, nearest
from bikestab.units import ANGLE, PURE, quantity, shown

MOST_TRAIL = 100.0  # of σ
MOST = 1e9  # of every parameter, in its SI unit; more would overflow in products of conditions
_PRESETS = Path(__file__).parent / "presets"  # importlib.resources costs vrange a tenth of its start


def _parameter(unit: str, meaning: str, check: str = "", **default: Any) -> Any:
    return field(metadata={"unit": unit, "meaning": meaning, "check": check}, **default)


@dataclass(frozen=True, kw_only=True)
class Bicycle:
    """The parameters of one machine; all SI, angles in radians.

    Raises InputError (with the parameter's name as key) for what the equations cannot use.
    ``warnings`` names what no rigid body can have; such values are still computed with.
    """

    c: float = _parameter("m", "wheelbase", "positive")
    m1: float = _parameter("kg", "mass of the rear part with rider", "positive")
    l1: float = _parameter("m", "rear centre of mass ahead of the rear contact")
    h1: float = _parameter("m", "rear centre of mass above the ground")
    A1: float = _parameter("kg m²", "rear central inertia, horizontal axis", "non-negative")
    B1: float = _parameter("kg m²", "rear central inertia, axis in the wheel plane", "non-negative")
    D1: float = _parameter("kg m²", "rear central product of inertia", default=0.0)
    C1: float = _parameter("kg m²", "rear wheel spin inertia", "non-negative")
    R1: float = _parameter("m", "rear wheel radius; 0 = a skate", "non-negative")
    m2: float = _parameter("kg", "mass of the front part", "positive")
    l2: float = _parameter("m", "front centre of mass ahead of the rear contact")
    h2: float = _parameter("m", "front centre of mass above the ground")
    A2: float = _parameter("kg m²", "front central inertia, horizontal axis", "non-negative")
    B2: float = _parameter("kg m²", "front central inertia, axis in the wheel plane", "non-negative")
    D2: float = _parameter("kg m²", "front central product of inertia", default=0.0)
    C2: float = _parameter("kg m²", "front wheel spin inertia", "non-negative")
    R2: float = _parameter("m", "front wheel radius; 0 = a skate", "non-negative")
    g: float = _parameter("m/s²", "acceleration due to gravity", "positive", default=9.81)
    delta: float = _parameter("kg m²/s", "viscous damping of the steering", "non-negative", default=0.0)
    lam: float | None = _parameter("rad", "own steering-axis tilt", default=None)
    sigma: float | None = _parameter("1", "own trail divided by the wheelbase", default=None)
    name: str = "bicycle"
    source: str = ""
    remarks: tuple[str, ...] = ()  # warnings about the bodies these parameters were reduced from

    def __post_init__(self) -> None:
        for p in parameters():
            value = getattr(self, p.name)
            if value is None and p.name in ("lam", "sigma"):
                continue
            number = quantity(value, ANGLE if p.name == "lam" else PURE, key=(p.name,))
            _check(p.name, number, p.metadata["check"])
            object.__setattr__(self, p.name, number)
        if self.lam is not None:
            check_tilt(self.lam, ("lam",))
        if self.sigma is not None:
            check_trail(self.sigma, ("sigma",))
        for i, A, B, C, D, R in (
            ("1", self.A1, self.B1, self.C1, self.D1, self.R1),
            ("2", self.A2, self.B2, self.C2, self.D2, self.R2),
        ):
            _check_product(f"D{i}", D, f"A{i}", A, f"B{i}", B)
            if R == 0 and C > 0:
                raise InputError(
                    f"R{i} = 0 (a skate) cannot spin, but C{i} = {C:g}",
                    key=(f"R{i}",),
                    hint=f"allowed: R{i} > 0, or C{i} = 0",
                )

    @property
    def warnings(self) -> tuple[str, ...]:
        """What no rigid bodies on the ground can have, one sentence each."""
        found = list(self.remarks)
        for i, part, A, B, C, m, R, h in (
            ("1", "rear", self.A1, self.B1, self.C1, self.m1, self.R1, self.h1),
            ("2", "front", self.A2, self.B2, self.C2, self.m2, self.R2, self.h2),
        ):
            if _exceeds(C, A + B):
                found.append(
                    f"no rigid {part} part has A{i} + B{i} < C{i}: {A:g} + {B:g} = {A + B:g} < {C:g} kg m²"
                )
            if _exceeds(C, m * R**2):
                found.append(
                    f"no wheel within the {part} part has C{i} > m{i} R{i}²: {C:g} > {m * R**2:g} kg m²"
                )
            if h < 0:
                found.append(f"the {part} centre of mass is below the ground: h{i} = {h:g} m")
        return tuple(found)

    def numbers(self) -> dict[str, float | None]:
        """The parameters by name, as plain numbers."""
        return {p.name: getattr(self, p.name) for p in parameters()}

    def with_delta(self, delta: float | None) -> Bicycle:
        """Return a copy with the damping ``delta``, or the same for None."""
        return self if delta is None else dataclasses.replace(self, delta=delta)

    @classmethod
    def from_mapping(cls, values: Mapping[Any, Any], *, name: str = "bicycle") -> Bicycle:
        """A bicycle from keys in the paper's notation or the 25 parameters of Meijaard et al. (2007).

        The two are told apart by their keys: only the latter has ``w``. ``R`` stands for equal
        ``R1`` and ``R2``; ``trail`` [m] may stand for ``sigma``. InputError names the key.
        """
        values = dict(values)
        texts: dict[str, str] = {"name": name, "source": ""}
        for key in texts:
            if (text := values.pop(key, None)) is not None:
                if not isinstance(text, str):
                    raise InputError(f"{shown(text)} is not text", key=(key,))
                texts[key] = str(text)  # YAML readers give subclasses
        notation = MEIJAARD if _is_meijaard(values) else PAPER
        for key in values:
            if key not in notation:
                other = " (a key of the other notation)" if key in {**MEIJAARD, **PAPER} else ""
                raise InputError(
                    f"unknown parameter{other}",
                    key=(str(key),),
                    hint=nearest(str(key), [*notation, "name", "source"]),
                )
        numbers = {
            key: quantity(value, ANGLE if key == "lam" else PURE, key=(key,)) for key, value in values.items()
        }
        if notation is MEIJAARD:
            return _from_meijaard(numbers, texts)
        return _from_paper(numbers, texts)

    @classmethod
    def from_file(cls, path: str | Path) -> Bicycle:
        """A bicycle from a YAML file of such keys; InputError names file, line and key."""
        return from_document(yamltext.read(path), Path(path).stem)

    @classmethod
    def preset(cls, name: str) -> Bicycle:
        """One of the bicycles that come with the package; see ``preset_names``."""
        if name not in preset_names():
            raise InputError(
                f"there is no bicycle {name!r}",
                hint=f"{nearest(name, preset_names())} (see 'bikestab bicycles')",
            )
        return from_document(yamltext.parse(preset_text(name), f"preset {name}"), name)

    @classmethod
    def load(cls, name_or_path: str) -> Bicycle:
        """A preset by its name, or else the bicycle in a file."""
        looks_like_path = "/" in name_or_path or name_or_path.endswith((".yaml", ".yml"))
        if name_or_path not in preset_names() and (looks_like_path or Path(name_or_path).is_file()):
            return cls.from_file(name_or_path)
        return cls.preset(name_or_path)


def from_document(document: yamltext.Document, name: str) -> Bicycle:
    """The bicycle in a parsed YAML document; InputError names file, line and key."""
    try:
        return Bicycle.from_mapping(document.data, name=name)
    except InputError as error:
        raise document.located(error) from None


def parameters() -> list[dataclasses.Field[Any]]:
    """The numeric fields of Bicycle, with ``unit``, ``meaning`` and ``check`` in their metadata."""
    return [f for f in dataclasses.fields(Bicycle) if f.metadata]


def preset_names() -> list[str]:
    """The names of the bicycles that come with the package."""
    return sorted(path.stem for path in _PRESETS.glob("*.yaml"))


def preset_text(name: str) -> str:
    """The commented YAML text of a preset."""
    return (_PRESETS / f"{name}.yaml").read_text("utf-8")


def check_tilt(lam: float, key: tuple[str | int, ...]) -> None:
    """Raise InputError unless the steering axis meets the ground: |λ| < π/2."""
    if not abs(lam) < math.pi / 2:
        raise InputError(
            f"a steering axis tilted by {lam:g} rad does not meet the ground",
            key=key,
            hint="allowed: between -90deg and 90deg, both excluded; degrees are written 18deg",
        )


def check_trail(sigma: float, key: tuple[str | int, ...]) -> None:
    """Raise InputError for a trail beyond all sense, which would overflow in the conditions."""
    if not abs(sigma) <= MOST_TRAIL:
        raise InputError(
            f"a trail of {sigma:g} wheelbases is out of range",
            key=key,
            hint=f"allowed: -{MOST_TRAIL:g} ... {MOST_TRAIL:g}; sigma = trail / wheelbase",
        )


# The paper's notation: what may stand in a file, with unit and meaning.
PAPER: dict[str, str] = {f.name: f"{f.metadata['meaning']} [{f.metadata['unit']}]" for f in parameters()}
PAPER |= {"R": "radius of both wheels [m]", "trail": "own trail along the ground [m]"}

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
_OPTIONAL = {"g", "delta", "IByy", "IHyy", "D1", "D2", "lam", "sigma", "trail"}
_POSITIVE = {"w", "g"}


def _is_meijaard(values: Mapping[Any, Any]) -> bool:
    only = [key for key in values if key in MEIJAARD and key not in PAPER]
    other = [key for key in values if key in PAPER and key not in MEIJAARD]
    return len(only) > len(other)


def _from_paper(n: dict[str, float], texts: dict[str, str]) -> Bicycle:
    if "R" in n:
        for key in ("R1", "R2"):
            if key in n:
                raise InputError("R and " + key + " are both given", key=(key,), hint="give R, or R1 and R2")
        n["R1"] = n["R2"] = n.pop("R")
    if "trail" in n:
        if "sigma" in n:
            raise InputError("trail and sigma are both given", key=("trail",), hint="give one of them")
        trail = n.pop("trail")
        n["sigma"] = trail / n["c"] if n.get("c", 0) > 0 else 0.0
    required = [p.name for p in parameters() if p.name not in _OPTIONAL]
    _require(n, required, "R" if "R1" not in n and "R2" not in n else "")
    return Bicycle(**n, **texts)  # type: ignore[arg-type]  # the keys were checked against PAPER


def _from_meijaard(n: dict[str, float], texts: dict[str, str]) -> Bicycle:
    """Reduce the four rigid bodies to the two parts by the parallel-axis theorem."""
    _require(n, [key for key in MEIJAARD if key not in _OPTIONAL or key == "lam"])
    for key, value in n.items():
        if key in _POSITIVE:
            _check(key, value, "positive")
        elif key[0] in "mr" or (key[0] == "I" and not key.endswith("xz")):
            _check(key, value, "non-negative")
    check_tilt(n["lam"], ("lam",))
    for body in ("B", "H"):
        xz, xx, zz = (f"I{body}{axes}" for axes in ("xz", "xx", "zz"))
        _check_product(xz, n[xz], xx, n[xx], zz, n[zz])
    for part, bodies in (("rear", ("mR", "mB")), ("front", ("mH", "mF"))):
        if sum(n[m] for m in bodies) == 0:
            raise InputError(
                f"the {part} part has no mass", key=(bodies[1],), hint=f"allowed: {' + '.join(bodies)} > 0"
            )
    # part 1 = rear wheel + body, part 2 = fork + front wheel: (mass, forward, up, Ixx, Izz, Ixz)
    m1, l1, h1, A1, B1, xz1 = _join(
        (n["mR"], 0.0, n["rR"], n["IRxx"], n["IRxx"], 0.0),
        (n["mB"], n["xB"], -n["zB"], n["IBxx"], n["IBzz"], n["IBxz"]),
    )
    m2, l2, h2, A2, B2, xz2 = _join(
        (n["mH"], n["xH"], -n["zH"], n["IHxx"], n["IHzz"], n["IHxz"]),
        (n["mF"], n["w"], n["rF"], n["IFxx"], n["IFxx"], 0.0),
    )
    return Bicycle(
        c=n["w"], g=n.get("g", 9.81), delta=n.get("delta", 0.0),
        m1=m1, l1=l1, h1=h1, A1=A1, B1=B1, D1=xz1, C1=n["IRyy"], R1=n["rR"],
        m2=m2, l2=l2, h2=h2, A2=A2, B2=B2, D2=-xz2, C2=n["IFyy"], R2=n["rF"],
        lam=n["lam"], sigma=n["c"] / n["w"], remarks=tuple(_body_remarks(n)),
        name=texts["name"], source=texts["source"],
    )  # fmt: skip


_Body = tuple[float, float, float, float, float, float]


def _join(a: _Body, b: _Body) -> _Body:
    """Two bodies as one: mass, centre of mass (forward, up) and central Ixx, Izz, Ixz (z down)."""
    m = a[0] + b[0]
    x, h = ((a[0] * a[i] + b[0] * b[i]) / m for i in (1, 2))
    xx, zz, xz = a[3] + b[3], a[4] + b[4], a[5] + b[5]
    for mass, dx, dh in ((a[0], a[1] - x, a[2] - h), (b[0], b[1] - x, b[2] - h)):
        xx += mass * dh**2
        zz += mass * dx**2
        xz += mass * dx * dh  # −∫ x z dm with z = −h
    return m, x, h, xx, zz, xz


def _body_remarks(n: Mapping[str, float]) -> list[str]:
    remarks = []
    for wheel, part in (("R", "rear"), ("F", "front")):
        xx, yy = n[f"I{wheel}xx"], n[f"I{wheel}yy"]
        if _exceeds(yy, 2 * xx):
            remarks.append(f"no rigid {part} wheel has I{wheel}yy > 2 I{wheel}xx: {yy:g} > {2 * xx:g} kg m²")
    for body, label in (("B", "body"), ("H", "fork")):
        xx, zz, xz = n[f"I{body}xx"], n[f"I{body}zz"], n[f"I{body}xz"]
        if f"I{body}yy" not in n:
            continue
        yy = n[f"I{body}yy"]
        spread = math.hypot(xx - zz, 2 * xz)  # difference of the two principal moments in the plane
        if _exceeds(yy, xx + zz) or _exceeds(spread, yy):
            remarks.append(
                f"no rigid {label} has I{body}yy = {yy:g} with I{body}xx = {xx:g}, "
                f"I{body}zz = {zz:g}, I{body}xz = {xz:g} kg m²: "
                f"allowed {spread:.6g} ... {xx + zz:.6g}"
            )
    return remarks


def _exceeds(a: float, b: float) -> bool:
    return a > b * (1 + 1e-9)  # published inertias of thin discs sit exactly on the limit


def _require(given: Mapping[str, float], required: list[str], instead_of_radii: str = "") -> None:
    missing = [key for key in required if key not in given]
    if instead_of_radii:
        missing = [key for key in missing if key not in ("R1", "R2")] + [instead_of_radii]
    if missing:
        raise InputError(
            f"missing parameter{'s' if len(missing) > 1 else ''}: {', '.join(missing)}",
            hint=f"{missing[0]}: {({**MEIJAARD, **PAPER} if missing[0] in PAPER else MEIJAARD)[missing[0]]}",
        )


def _check(key: str, value: float, check: str) -> None:
    if abs(value) > MOST:
        raise InputError(f"{value:g} is out of range", key=(key,), hint=f"allowed: up to {MOST:g}")
    if (check == "positive" and not value > 0) or (check == "non-negative" and not value >= 0):
        meaning = PAPER.get(key) or MEIJAARD[key]
        limit = "> 0" if check == "positive" else ">= 0"
        raise InputError(f"{value:g} is not {check} ({meaning})", key=(key,), hint=f"allowed: {key} {limit}")


def _check_product(key: str, D: float, a: str, A: float, b: str, B: float) -> None:
    if _exceeds(abs(D), math.sqrt(A * B)):
        raise InputError(
            f"|{D:g}| is more than √({a} {b}) = {math.sqrt(A * B):g}",
            key=(key,),
            hint=f"allowed: |{key}| <= {math.sqrt(A * B):.6g} kg m²",
        )
