"""The equations of motion (1.5), derived from first principles with sympy; docs/theory.md tells the same.

Nothing of bikestab is used, and nothing of the paper but its letters: two rigid parts on two thin wheels
are placed and moved, their energies and the rolling of the wheels are expanded in the small quantities,
and the forces of the ground are eliminated. Every kinematic formula the paper has follows here.
Run ``python tests/references/derive_equations.py`` to print the coefficients of both models.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import sympy as sp

# Axes: x to the right, y forward, z up; at rest the rear contact is their origin.

# -- parameters ---------------------------------------------------------------------------------------

c, g, V, lam, sigma, delta = sp.symbols("c g V lam sigma delta", positive=True)
m1, l1, h1, A1, B1, D1, C1, R1 = sp.symbols("m1 l1 h1 A1 B1 D1 C1 R1", positive=True)
m2, l2, h2, A2, B2, D2, C2, R2 = sp.symbols("m2 l2 h2 A2 B2 D2 C2 R2", positive=True)
PARAMETERS = (c, g, lam, sigma, m1, l1, h1, A1, B1, D1, C1, R1, m2, l2, h2, A2, B2, D2, C2, R2)
c2 = sigma * c  # trail along the ground

# -- small quantities: coordinates, velocities, accelerations ---------------------------------------------

COORDINATES = ("x", "y", "theta", "chi", "psi", "spin1", "spin2")
Q = {name: sp.Symbol(name) for name in COORDINATES}
QDOT = {name: sp.Symbol(name + "'") for name in COORDINATES}  # without what straight motion has of it:
QDDOT = {name: sp.Symbol(name + "''") for name in COORDINATES}
STRAIGHT = {"y": V, "spin1": -V / R1, "spin2": -V / R2}
RATE = {name: STRAIGHT.get(name, 0) + QDOT[name] for name in COORDINATES}
x, y, theta, chi, psi = (Q[name] for name in COORDINATES[:5])
pitch = sp.Symbol("phi")  # of the rear part about its axle, front down: of second order

_ORDER = {x: 1, theta: 1, chi: 1, psi: 1, pitch: 2} | dict.fromkeys([*QDOT.values(), *QDDOT.values()], 1)


def cut(value, order=2):
    """An expression or a matrix without the terms of more than that order in the small quantities."""
    if isinstance(value, sp.MatrixBase):
        return value.applyfunc(lambda entry: cut(entry, order))
    terms = sp.Add.make_args(sp.expand(value))
    return sp.Add(*(term for term in terms if _order(term) <= order))


def _order(term):
    return sum(_ORDER.get(factor, 0) * power for factor, power in term.as_powers_dict().items())


def rate(value):
    """The time derivative."""
    if isinstance(value, sp.MatrixBase):
        return value.applyfunc(rate)
    return sum(value.diff(Q[n]) * RATE[n] + value.diff(QDOT[n]) * QDDOT[n] for n in COORDINATES)


# -- placing the parts ------------------------------------------------------------------------------------


def cross(v):
    """The matrix of v ×."""
    return sp.Matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def turn(axis, angle):
    """A rotation to second order in the angle."""
    return sp.eye(3) + angle * cross(axis) + angle**2 / 2 * cross(axis) ** 2


def angular_velocity(spinning):
    """The vector ω of a matrix dR Rᵀ or Rᵀ dR."""
    return sp.Matrix([spinning[2, 1], spinning[0, 2], spinning[1, 0]])


X, Y, Z = (sp.eye(3).col(i) for i in range(3))
AXLE1, AXLE2 = R1 * Z, c * Y + R2 * Z
STEERING = -sp.sin(lam) * Y + sp.cos(lam) * Z  # its axis, and where it meets the ground:
GROUND = (c + c2) * Y


class Part(NamedTuple):
    """A part in its place: rotation, centre of mass, axle, axle's direction, all to second order."""

    rotation: sp.Matrix
    centre: sp.Matrix
    axle: sp.Matrix
    direction: sp.Matrix


def placed(pitch):
    """Both parts after pitch, steer ψ, roll χ and yaw θ, the rear contact at (x, y)."""
    contact = x * X + y * Y
    upright = cut(turn(Z, theta) * turn(Y, chi))
    rear = cut(upright * turn(-X, pitch))
    steer = turn(STEERING, psi)
    front = cut(rear * steer)

    def at(r):
        return cut(contact + upright * AXLE1 + rear * (r - AXLE1))

    def steered(r):
        return at(GROUND + steer * (r - GROUND))

    return (
        Part(rear, at(l1 * Y + h1 * Z), at(AXLE1), cut(rear * X)),
        Part(front, steered(l2 * Y + h2 * Z), steered(AXLE2), cut(front * X)),
    )


def upward(part):
    """From contact point to axle, divided by the radius: in the wheel's plane and steepest, to 2nd order."""
    n = part.direction
    return cut((Z - n[2] * n) * (1 + n[2] ** 2 / 2))


@cache
def pitch_angle():
    """(1.2): the pitch that keeps the front wheel's lowest point on the ground."""
    _, front = placed(pitch)
    lowest = cut(front.axle[2] - R2 * upward(front)[2])
    (found,) = sp.solve(lowest, pitch)
    return sp.expand(found)


# -- energies and constraints -----------------------------------------------------------------------------


def kinetic_energy(parts):
    """T1 + T2 to second order. A, B, D = inertias about y and z; D1 = ∫ y z dm, D2 = −∫ y z dm.

    The inertia about x contributes with the square of the pitching, which is of fourth order; but the
    wheel has its spin besides, and an inertia C about its axle.
    """
    total = 0
    for part, m, A, B, yz, C, spin in (
        (parts[0], m1, A1, B1, D1, C1, "spin1"),
        (parts[1], m2, A2, B2, -D2, C2, "spin2"),
    ):
        v = cut(rate(part.centre))
        w = angular_velocity(cut(part.rotation.T * rate(part.rotation)))
        total += m * v.dot(v) / 2 + (A * w[1] ** 2 + B * w[2] ** 2 - 2 * yz * w[1] * w[2]) / 2
        total += C * (w[0] + RATE[spin]) ** 2 / 2
    return cut(total)


def potential_energy(parts):
    return cut(g * (m1 * parts[0].centre[2] + m2 * parts[1].centre[2]))


def slip(part, radius, spin):
    """The velocity of the wheel's material point on the ground, to first order."""
    w = angular_velocity(cut(rate(part.rotation) * part.rotation.T)) + RATE[spin] * part.direction
    return cut(rate(part.axle) - radius * w.cross(upward(part)), 1)


def lagrange(name, T, U):
    """d/dt ∂T/∂q' − ∂T/∂q + ∂U/∂q to first order."""
    return cut(rate(T.diff(QDOT[name])) - T.diff(Q[name]) + U.diff(Q[name]), 1)


# -- the equations of motion ------------------------------------------------------------------------------


class Derivation(NamedTuple):
    """What the paper's section 1 has: (1.2), U, (1.3), (1.4) and the coefficients of (1.5)."""

    pitch: sp.Expr
    potential: sp.Expr
    lagrange: dict[str, sp.Expr]  # L_q by coordinate
    yaw_rate: sp.Expr  # θ' of (1.4)
    coefficients: dict[str, sp.Expr]  # a0 … a5, b0 … b6 without damping, and "damping": of ψ'


@cache
def derive(model="refined"):
    """Derive the equations of motion; the unrefined model leaves the pitch out."""
    parts = placed(pitch_angle() if model == "refined" else sp.Integer(0))
    T, U = kinetic_energy(parts), potential_energy(parts)
    L = {name: lagrange(name, T, U) for name in COORDINATES}

    # The ground pushes forwards and backwards in second order only, for speed and spin stay constant:
    rear, front = slip(parts[0], R1, "spin1"), slip(parts[1], R2, "spin2")
    for name in ("y", "spin1", "spin2"):
        assert L[name].free_symbols & {*_ORDER} == {QDDOT[name]}
    assert rear[1:] == [QDOT["y"] + R1 * QDOT["spin1"], 0]
    assert sp.expand(front[1] - QDOT["y"] - R2 * QDOT["spin2"]) == 0 == sp.expand(front[2])

    # (1.4): no slip sideways
    found = sp.solve([rear[0], front[0]], [QDOT["x"], QDOT["theta"]], dict=True)[0]
    velocities = {QDOT[name]: sp.expand(found[QDOT[name]]) for name in ("x", "theta")}
    accelerations = {QDDOT[name]: sp.expand(rate(velocities[QDOT[name]])) for name in ("x", "theta")}

    # Displacements without slip have no work of the ground: δx = 0, and δθ goes with δψ as θ' with ψ'
    follow = velocities[QDOT["theta"]].coeff(QDOT["psi"])
    assert velocities[QDOT["x"]] == -V * theta
    lean = L["chi"]
    steer = L["psi"] + delta * QDOT["psi"] + follow * L["theta"]
    lean, steer = (
        sp.expand(sp.expand(c * each).subs(accelerations).subs(velocities).subs(QDDOT["y"], 0))
        for each in (lean, steer)
    )
    return Derivation(pitch_angle(), U, L, velocities[QDOT["theta"]], _coefficients(lean, steer))


def _coefficients(lean, steer):
    """Of (1.5); fails if an equation has a term that (1.5) has not."""
    chi1, chi2, psi1, psi2 = QDOT["chi"], QDDOT["chi"], QDOT["psi"], QDDOT["psi"]
    places = {
        "a0": (lean, chi2, 0, 1), "a1": (lean, chi, 0, -1), "a2": (lean, psi2, 0, -1),
        "a3": (lean, psi1, 1, -1), "a4": (lean, psi, 0, 1), "a5": (lean, psi, 2, -1),
        "b0": (steer, psi2, 0, 1), "b1": (steer, psi1, 1, 1), "b2": (steer, psi, 2, 1),
        "b3": (steer, psi, 0, -1), "b4": (steer, chi2, 0, -1), "b5": (steer, chi1, 1, 1),
        "b6": (steer, chi, 0, 1), "damping": (steer, psi1, 0, 1),
    }  # fmt: skip
    found = {}
    for name, (equation, q, power, sign) in places.items():
        found[name] = sign * equation.coeff(q).coeff(V, power)
    for equation in (lean, steer):
        used = [sign * found[n] * q * V**k for n, (e, q, k, sign) in places.items() if e is equation]
        assert sp.expand(equation - sum(used)) == 0
    return found


def same(a, b):
    """Whether two expressions are equal for every λ, rational ones in any way they are written."""
    sine, cosine = sp.symbols("sine cosine")
    names = {sp.sin(lam): sine, sp.cos(lam): cosine}
    difference = sp.expand(sp.expand_trig(sp.sympify(a) - b).subs(names))
    if difference == 0:
        return True
    over, _ = sp.fraction(sp.together(difference))
    return sp.rem(sp.Poly(over, sine), sp.Poly(sine**2 + cosine**2 - 1, sine)).is_zero


if __name__ == "__main__":
    print("phi =", sp.factor(derive().pitch))
    print("theta' =", derive().yaw_rate)
    for model in ("refined", "unrefined"):
        print(f"\n{model}:")
        for name, value in derive(model).coefficients.items():
            print(f"{name} = {value}")
