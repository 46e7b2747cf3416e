"""(bicycle, λ, σ) → the paper's letters, of which its equations of motion (1.5) are made."""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bikestab.bicycle import Bicycle
from bikestab.notation import reduced
from bikestab.sines import plain_sine_cosine, sine_cosine
from bikestab.twofold import Twofold, exact_sum
from bikestab.unordered import Unordered

if TYPE_CHECKING:
    from bikestab.machines import Machines

Model = Literal["refined", "unrefined"]
MODELS: tuple[Model, ...] = ("refined", "unrefined")


def letters_of(
    bicycle: Bicycle | Machines, lam: ArrayLike, sigma: ArrayLike, model: Model, *, twofold: bool = True
) -> SimpleNamespace:
    """The paper's letters, and what (1.5) is made of: see section 5 of docs/theory.md.

    In twice double precision, or as doubles.

    J1, M12 and M22 are the inertia matrix; Q, N and W are what a3, b1 and b2 have besides the wheels' spin
    and cos λ; T is b5 without c cos λ. S and U are sums that the refinement leaves no difference in.
    """
    trail: Any = sigma if isinstance(sigma, float) else np.asarray(sigma)
    if twofold:
        return letters(_numbers(bicycle), *sine_cosine(lam), Twofold(trail), model)
    return letters(_doubles(bicycle), *plain_sine_cosine(lam), trail, model)


def unordered_letters_of(
    bicycle: Bicycle | Machines, lam: ArrayLike, sigma: ArrayLike, model: Model
) -> SimpleNamespace:
    """``letters_of`` in twice double precision, as numbers for many operations in a row."""
    global _last
    kept = _last
    if kept is None or kept.bicycle is not bicycle:
        p = SimpleNamespace(**{name: Unordered.of(a) for name, a in vars(_numbers(bicycle)).items()})
        kept = _Kept(bicycle, p, fixed_letters(p))
        if isinstance(bicycle, Bicycle):  # which never changes
            _last = kept
    trail = sigma if isinstance(sigma, float) else np.asarray(sigma)
    sin, cos = (Unordered.of(a) for a in sine_cosine(lam))
    return letters(kept.numbers, sin, cos, Unordered(trail), model, kept.fixed)


class _Kept(NamedTuple):
    """A bicycle's parameters and fixed letters: the tiles of a scan, and designs one by one, share them."""

    bicycle: Bicycle | Machines
    numbers: SimpleNamespace
    fixed: SimpleNamespace


_last: _Kept | None = None


def fixed_letters(p: SimpleNamespace) -> SimpleNamespace:
    """The letters, and parts of others, that the parameters fix whatever tilt and trail are."""
    C1, C2 = p.C1 / p.R1, p.C2 / p.R2  # C1° and C2°: angular momentum per unit of speed
    e, mh1, mh2 = p.m2 * p.ahead, p.m1 * p.h1, p.m2 * p.h2
    h = mh1 + mh2
    J12 = mh1 * p.l1 + p.D1 + mh2 * p.l2 - p.D2
    return SimpleNamespace(
        C1=C1, C2=C2, C12=C1 + C2, e=e, mh1=mh1, mh2=mh2, h=h, ch=p.c * h, J12=J12,
        l=p.m1 * p.l1 + p.m2 * p.l2,
        J1=mh1 * p.h1 + p.A1 + mh2 * p.h2 + p.A2,
        J2=p.m1 * p.l1 * p.l1 + p.B1 + p.m2 * p.l2 * p.l2 + p.B2,
        far=p.m1 * p.l1 + e,
    )  # fmt: skip


def letters(
    p: SimpleNamespace, sin: Any, cos: Any, trail: Any, model: Model, fixed: SimpleNamespace | None = None
) -> SimpleNamespace:
    """``letters_of`` parameters, l2 − c as ``ahead``, sin λ, cos λ and σ that are numbers of any kind.

    ``fixed`` are the parameters' ``fixed_letters``, where they are there already.
    """
    if model not in MODELS:
        raise ValueError(f"model is {model!r}, not one of {MODELS}")
    f = fixed or fixed_letters(p)
    mu, c2 = trail * cos, trail * p.c  # c1/c, and the trail along the ground

    d = p.h2 * sin + (p.ahead - c2) * cos
    md = p.m2 * d
    own3, own4 = p.A2 * sin - p.D2 * cos, p.B2 * cos - p.D2 * sin
    J = md * d + (sin * own3 + cos * own4)
    J3, J4 = p.h2 * md + own3, p.l2 * md + own4  # (1.3)

    leading = mu * f.J2

    up, along = f.mh2 * sin, cos * (f.e + trail * f.far)
    turn = up + along  # m2 d + l c1/c
    if model == "unrefined":
        along = cos * (f.e - c2 * p.m2)
    S = turn if model == "refined" else up + along
    return SimpleNamespace(
        p=p, d=d, mu=mu, c=p.c, g=p.g, delta=p.delta, sin=sin, cos=cos, C1=f.C1, C2=f.C2, h=f.h, J1=f.J1, S=S,
        U=along - f.mh1 * sin,  # = S − h sin λ
        M12=J3 + mu * f.J12,
        M22=J + mu * (2 * J4 + leading),
        Q=f.J12 + trail * f.ch,
        T=f.C2 + trail * f.C12,
        N=J4 + c2 * turn + leading,
        W=turn + f.C2 * sin,
        missing=None if model == "refined" else f.h * f.l * mu,
    )  # fmt: skip


def determinant(n: SimpleNamespace) -> Any:
    """c² det M as a sum of terms that are not negative (Cauchy and Binet), for nearly singular inertias.

    Both masses move sideways by h_i χ + Y_i ψ; I is what their central inertias have in M.
    """
    p, far = n.p, n.cos + n.mu
    Y1, Y2 = p.l1 * n.mu, n.d + p.l2 * n.mu
    I11 = p.A1 + p.A2
    I12 = p.D1 * n.mu + p.A2 * n.sin - p.D2 * far
    I22 = p.B1 * n.mu * n.mu + (p.A2 * n.sin * n.sin - 2 * p.D2 * n.sin * far + p.B2 * far * far)
    across = p.h1 * n.d + n.mu * (p.h1 * p.l2 - p.h2 * p.l1)
    total = p.m1 * p.m2 * across * across + (I11 * I22 - I12 * I12)
    for m, h, Y in ((p.m1, p.h1, Y1), (p.m2, p.h2, Y2)):
        total = total + m * (h * h * I22 - 2 * h * Y * I12 + Y * Y * I11)
    return n.c * n.c * total


def _numbers(bicycle: Bicycle | Machines) -> SimpleNamespace:
    """The paper's parameters, and how far the front centre of mass is ahead of the contact, l2 − c."""
    given: Mapping[str, Any] | None = getattr(bicycle, "bodies", None)
    if given is None:
        numbers = {name: Twofold(getattr(bicycle, name)) for name in PARAMETERS}
        ahead = exact_sum(bicycle.l2, -bicycle.c)
    else:
        numbers = reduced({name: Twofold(value) for name, value in given.items()})
        numbers = {name: x if isinstance(x, Twofold) else Twofold(x) for name, x in numbers.items()}
        numbers |= {name: Twofold(getattr(bicycle, name)) for name in getattr(bicycle, "parts", ())}
        ahead = numbers["l2"] - numbers["c"]
    numbers |= {name: Twofold(value) for name, value in dict(getattr(bicycle, "gains", ())).items()}
    return _with_radii(bicycle, numbers, ahead)


def _doubles(bicycle: Bicycle | Machines) -> SimpleNamespace:
    """The same as doubles."""
    numbers = {name: getattr(bicycle, name) for name in PARAMETERS} | dict(getattr(bicycle, "gains", ()))
    return _with_radii(bicycle, numbers, bicycle.l2 - bicycle.c)


def _with_radii(bicycle: Bicycle | Machines, numbers: dict[str, Any], ahead: Any) -> SimpleNamespace:
    """What does not spin gets a radius, for it may be a skate, with none."""
    for i in "12":
        numbers[f"R{i}"] = numbers[f"R{i}"] + 1 * (getattr(bicycle, f"C{i}") == 0)
    return SimpleNamespace(**numbers, ahead=ahead)


PARAMETERS = (
    "c", "g", "delta", "m1", "l1", "h1", "A1", "B1", "D1", "C1", "R1",
    "m2", "l2", "h2", "A2", "B2", "D2", "C2", "R2",
)  # fmt: skip
