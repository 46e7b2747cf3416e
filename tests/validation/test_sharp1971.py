"""Sharp (1971): his motorcycle, and his equations of motion when the tyres are rigid.

His numbers are in slugs, feet and pounds. The same numbers stand, in SI or in those units, in two public
programs (aerotinez/trajopt; a MATLAB function of his matrices). His equations, written out here with his
letters, know nothing of bikestab; with the tyres' slip held at zero they must give its eigenvalues.
"""

from math import cos, radians, sin

import numpy as np
import pytest
from bicycleparameters.bicycle import ab_matrix, benchmark_par_to_canonical
from scipy.linalg import eigvals
from scipy.optimize import brentq

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.spectrum import eigenvalues_of
from bikestab.speeds import CAPSIZE, WEAVE, intervals_of

FT, LBF = 0.3048, 4.4482216152605  # m, N
SLUG = LBF / FT
SLUG_FT2 = SLUG * FT**2
# rounding of four eigenvalues of very different size, of a matrix and of a pencil: relative to the largest
ROUNDING = 1e-11


class Sharp:
    """The standard machine in SI units with Sharp's letters, ε the rake."""

    Mf, Mr = 2.1 * SLUG, 14.9 * SLUG
    Ifx, Ifz, Irx, Irz, Crxz, ify, iry = (x * SLUG_FT2 for x in (0.91, 0.326, 23, 15.54, 1.28, 0.53, 0.775))
    a, b, e, f, h, R, t = (x * FT for x in (3.112, 1.574, 0.08, 0.093, 2.02, 1.0, 0.38))
    K = 5 * LBF * FT
    Cf1, Cf2, Cr1, Cr2, relaxation = 2512 * LBF, 211 * LBF, 3559 * LBF, 298 * LBF, 0.8 * FT
    s, c = sin(radians(27)), cos(radians(27))
    l = (a - t) / c  # noqa: E741  # Sharp's letter: front contact ahead of the rear centre of mass
    k = (a + e) * c + f * s  # front centre of mass, forward of the rear one
    j = (a + e) * s - f * c  # and above the ground
    g = 9.81
    Zf = -(Mr * b + Mf * (b + k)) * g / (b + l)  # static load; he prints -226 lbf, 0.7 % less

    def pencil(self, u, K, tyres):
        """E x' = A x for x = (v, r, steer rate, roll rate, steer, roll, Yf, Yr)."""
        p = self
        s, c, weight = p.s, p.c, p.t * p.Zf - p.Mf * p.e * p.g
        G, T = p.ify / p.R, (p.ify + p.iry) / p.R
        yaw_steer, yaw_roll = (
            p.Mf * p.e * p.k + p.Ifz * c,
            p.Mf * p.j * p.k - p.Crxz + (p.Ifz - p.Ifx) * s * c,
        )
        steer_roll = p.Mf * p.e * p.j + p.Ifz * s
        E, A = np.zeros((8, 8)), np.zeros((8, 8))
        E[:4, :4] = [
            [p.Mf + p.Mr, p.Mf * p.k, p.Mf * p.e, p.Mf * p.j + p.Mr * p.h],
            [p.Mf * p.k, p.Mf * p.k**2 + p.Irz + p.Ifx * s**2 + p.Ifz * c**2, yaw_steer, yaw_roll],
            [p.Mf * p.e, yaw_steer, p.Ifz + p.Mf * p.e**2, steer_roll],
            [p.Mf * p.j + p.Mr * p.h, yaw_roll, steer_roll, 0],
        ]
        E[3, 3] = p.Mf * p.j**2 + p.Mr * p.h**2 + p.Irx + p.Ifx * c**2 + p.Ifz * s**2
        A[0] = [0, -(p.Mf + p.Mr) * u, 0, 0, 0, 0, 1, 1]
        A[1] = [0, -p.Mf * p.k * u, G * s * u, T * u, 0, 0, p.l, -p.b]
        A[2] = [0, -(p.Mf * p.e + G * s) * u, -K, G * c * u, -weight * s, -weight, -p.t, 0]
        A[3] = [0, -(E[3, 0] + T) * u, -G * c * u, 0, -weight, E[3, 0] * p.g, 0, 0]
        E[4, 4] = E[5, 5] = A[4, 2] = A[5, 3] = 1
        if tyres:  # σ/u Y' + Y = C1 slip + C2 camber
            E[6, 6] = E[7, 7] = p.relaxation / u
            A[6] = [-p.Cf1 / u, -p.Cf1 * p.l / u, p.Cf1 * p.t / u, 0, p.Cf1 * c + p.Cf2 * s, p.Cf2, -1, 0]
            A[7] = [-p.Cr1 / u, p.Cr1 * p.b / u, 0, 0, 0, p.Cr2, 0, -1]
        else:  # no slip
            A[6] = [1, p.l, -p.t, 0, -u * c, 0, 0, 0]
            A[7] = [1, -p.b, 0, 0, 0, 0, 0, 0]
        return A, E

    def eigenvalues(self, u, K=K, tyres=True):
        s = eigvals(*self.pencil(u, K, tyres))
        s = s[np.isfinite(s)]
        return s[np.argsort(np.abs(s))][: 8 if tyres else 4]  # constraints leave infinite ones, or huge


SHARP = Sharp()


def reduced(**other):
    """Sharp's machine as the paper's two parts, unrounded."""
    p = SHARP
    return {
        "c": p.b + p.l, "g": p.g, "lam": radians(27), "trail": p.t / p.c, "delta": p.K,
        "m1": p.Mr, "l1": p.b, "h1": p.h, "A1": p.Irx, "B1": p.Irz, "D1": -p.Crxz, "C1": p.iry, "R1": p.R,
        "m2": p.Mf, "l2": p.b + p.k, "h2": p.j, "C2": p.ify, "R2": p.R,
        "A2": p.Ifx * p.c**2 + p.Ifz * p.s**2, "B2": p.Ifx * p.s**2 + p.Ifz * p.c**2,
        "D2": (p.Ifx - p.Ifz) * p.s * p.c,
    } | other  # fmt: skip


def table_of(bicycle):
    return characteristic_table(bicycle, bicycle.lam, bicycle.sigma)


@pytest.fixture(scope="module")
def bicycle():
    return Bicycle.preset("sharp1971")


def test_preset_is_the_reduced_machine(bicycle):
    """To half a unit of the preset's seventh digit; what Sharp gives as such is in it."""
    exact = Bicycle.from_mapping(reduced()).numbers()
    for key, value in bicycle.numbers().items():
        assert value == pytest.approx(exact[key], rel=5.001e-7), key
    assert bicycle.lam == radians(27)
    assert not bicycle.warnings


def test_another_transcription(bicycle):
    """The SI values of aerotinez/trajopt, of four or five digits; it reads t as the normal trail."""
    p = bicycle
    assert [p.m1, p.l1, p.h1, p.m2] == pytest.approx([217.45, 0.4798, 0.6157, 30.65], rel=2e-4)
    inertias = [p.A1, p.B1, p.D1, p.C1, p.A2 + p.B2, p.C2]
    assert inertias == pytest.approx([31.18, 21.07, -1.7355, 1.0508, 1.2338 + 0.4420, 0.7186], rel=2e-4)
    assert p.R1 == p.R2 == 0.3048
    assert p.sigma * p.c * cos(p.lam) == pytest.approx(0.1158, rel=3e-4)
    assert p.delta == pytest.approx(6.77, abs=0.01)


@pytest.mark.parametrize("K", [0.0, SHARP.K])
@pytest.mark.parametrize("u", [0.5, 3.0, 6.0, 10.0, 20.0, 60.0])
def test_sharps_equations_without_slip(u, K):
    """All four eigenvalues, hence every sign of the reduction."""
    found = eigenvalues_of(table_of(Bicycle.from_mapping(reduced(delta=K))), u)
    expected = SHARP.eigenvalues(u, K, tyres=False)
    distance = np.abs(found[:, np.newaxis] - expected)
    assert distance.min(axis=0).max() <= ROUNDING * np.abs(expected).max()
    assert distance.min(axis=1).max() <= ROUNDING * np.abs(expected).max()


def test_eigenvalues_of_bicycleparameters(bicycle):
    """The same bodies in the 25 parameters, all wheel mass in the frames; its equations have no damper."""
    p = bicycle
    massless = dict.fromkeys(("mR", "IRxx", "mF", "IFxx"), 0.0)
    machine = massless | {
        "w": p.c, "c": p.sigma * p.c, "lam": p.lam, "g": p.g, "rR": p.R1, "rF": p.R2, "IRyy": p.C1,
        "IFyy": p.C2, "mB": p.m1, "xB": p.l1, "zB": -p.h1, "IBxx": p.A1, "IBzz": p.B1,
        "IBxz": p.D1, "mH": p.m2, "xH": p.l2, "zH": -p.h2, "IHxx": p.A2, "IHzz": p.B2, "IHxz": -p.D2,
    }  # fmt: skip
    matrices, table = benchmark_par_to_canonical(machine), table_of(bicycle.with_delta(0))
    for V in np.linspace(0, 60, 25):
        expected = np.linalg.eigvals(ab_matrix(*matrices, V, p.g)[0])
        distance = np.abs(eigenvalues_of(table, V)[:, np.newaxis] - expected)
        assert distance.min(axis=0).max() <= ROUNDING * np.abs(expected).max()
        assert distance.min(axis=1).max() <= ROUNDING * np.abs(expected).max()


def test_stable_speeds(bicycle):
    """Weave to capsize; the damper raises the weave speed and leaves the capsize speed."""
    found = intervals_of(table_of(bicycle))
    assert found.V1.tolist() == pytest.approx([6.055729], rel=0, abs=5e-7)
    assert found.V2.tolist() == pytest.approx([11.316033], rel=0, abs=5e-7)
    assert (found.lower.tolist(), found.upper.tolist()) == ([WEAVE], [CAPSIZE])
    free = intervals_of(table_of(bicycle.with_delta(0)))
    assert free.V1.tolist() == pytest.approx([5.633071], rel=0, abs=5e-7)
    assert free.V2.tolist() == pytest.approx(found.V2.tolist(), rel=1e-14)


def edge(select, low, high):
    """The speed between ``low`` and ``high`` at which Sharp's model with tyres is neutral."""
    return brentq(lambda u: select(SHARP.eigenvalues(u)).real.max(), low, high, xtol=1e-9)


def test_what_his_tyres_change(bicycle):
    """The numbers of docs/motorcycle.md: both ends within 2 %, and a wobble the rigid wheels do not have."""
    found = intervals_of(table_of(bicycle))
    weave = edge(lambda s: s[np.abs(s.imag) < 5], 3, 8)
    capsize = edge(lambda s: s[np.abs(s.imag) < 1e-9], 8, 20)
    wobble = edge(lambda s: s[s.imag > 45], 30, 80)
    assert [weave, capsize, wobble] == pytest.approx([5.97, 11.11, 58.58], abs=0.005)
    assert found.V1[0] == pytest.approx(weave, rel=0.02)
    assert found.V2[0] == pytest.approx(capsize, rel=0.02)
    for u in (10.0, 30.0, 60.0):
        s = SHARP.eigenvalues(u)
        assert s.imag.max() / (2 * np.pi) == pytest.approx(9, abs=0.7)  # Hz, at any speed
    rigid, slipping = eigenvalues_of(table_of(bicycle), 40.0), SHARP.eigenvalues(40.0)
    pair = slipping[(slipping.imag > 10) & (slipping.imag < 45)]
    assert rigid.real[rigid.imag > 0] == pytest.approx([-19.2], abs=0.05)  # weave is overdamped without slip
    assert pair.real == pytest.approx([-1.10], abs=0.005)
