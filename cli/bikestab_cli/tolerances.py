"""NAME=VALUE+-HALF: tolerances of a machine, and those of its design, which are sides of a box."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click
from bikestab_cli.chosen import Given
from bikestab_cli.parameters import parameter
from bikestab_cli.quantities import Ends

from bikestab.errors import InputError
from bikestab.gains import GAINS
from bikestab.units import united

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle

DESIGN = ("lam", "sigma", "head_angle", "trail", "offset")


def with_design(given: Given, texts: tuple[str, ...]) -> tuple[Given, tuple[str, ...]]:
    """Tolerances of the design are ends of its box; the others are left."""
    found, others = dict(given), []
    for text in texts:
        name = text.partition("=")[0].strip().replace("-", "_")
        if name not in DESIGN:
            others.append(text)
            continue
        if name in found:
            raise click.BadParameter(f"{name} is given twice", param_hint="--tolerance")
        found[name] = _range(name, text)
    return found, tuple(others)


def tolerances_of(texts: tuple[str, ...], bicycle: Bicycle) -> dict[str, Ends]:
    """Ends of parameters that may be anything between, by their names."""
    pairs = [_tolerance(text, bicycle) for text in texts]
    names = [name for name, _ in pairs]
    if twice := {name for name in names if names.count(name) > 1}:
        raise click.BadParameter(f"{twice.pop()} is given twice", param_hint="--tolerance")
    return dict(pairs)


def _tolerance(text: str, bicycle: Bicycle) -> tuple[str, Ends]:
    from bikestab.errors import nearest

    name = text.partition("=")[0].strip()
    allowed = {*bicycle.given, "g", "delta"} - {"lam", "sigma", "rider.inertia_mass"}
    allowed -= {"c"} if bicycle.bodies else set()
    if "=" in text and name in GAINS:
        problem = f"{name} is feedback, of which nothing can be proved; 'bikestab vrange --over {name}=A:B:N'"
        raise click.BadParameter(f"{problem} has exact speeds", param_hint="--tolerance")
    if "=" in text and name not in allowed:
        known = sorted(allowed | {*DESIGN})
        problem = f"{bicycle.name} has no parameter {name!r} that can vary; {nearest(name, known)}"
        raise click.BadParameter(problem, param_hint="--tolerance")
    return name, _range(name, text)


def _range(name: str, text: str) -> Ends:
    """The ends of NAME=VALUE+-HALF."""
    _, equals, value = text.partition("=")
    middle, sign, half = value.replace("±", "+-").replace("+/-", "+-").partition("+-")
    if not equals or not sign:
        raise click.BadParameter(f"{text!r} is not NAME=VALUE+-HALF, e.g. mB=85+-2", param_hint="--tolerance")
    try:
        x, d = (parameter(name, number) for number in united([middle, half]))
    except InputError as error:
        raise click.BadParameter(
            f"{text!r}: {error.problem}; {error.hint}", param_hint="--tolerance"
        ) from None
    if d < 0:
        raise click.BadParameter(f"{text!r}: {d:g} is negative", param_hint="--tolerance")
    return x - d, x + d
