"""Mode shapes and the motion after a push, against BicycleParameters, and where eigenvalues meet."""

import functools

import numpy as np
import pytest
import scipy.integrate
from bicycleparameters import models
from scipy.linalg import expm

import bikestab as bs
from bikestab.errors import InputError
from bikestab.motion import STATES, matrices, motion, shapes
from tests.validation.test_bicycleparameters import MEASURED, model_of

MACHINES = sorted(MEASURED)[::4][:5]


@pytest.mark.parametrize("V", [1.0, 4.6, 5.3, 9.0])
@pytest.mark.parametrize("name", MACHINES)
def test_eigenvectors_are_those_of_bicycleparameters(name, V):
    assert len(MACHINES) == 5
    values, vectors = (np.squeeze(each) for each in model_of(MEASURED[name]).calc_eigen(v=V))
    found = shapes(bs.Bicycle.from_mapping(MEASURED[name]), V)
    for s, phasor in zip(found.eigenvalues, found.phasors.T, strict=True):
        k = np.argmin(np.abs(values - s))
        assert s == pytest.approx(values[k], abs=1e-8 * np.abs(values).max())
        ours = np.concatenate([phasor, s * phasor])
        theirs = vectors[:, k] / vectors[np.argmax(np.abs(vectors[:2, k])), k]
        assert ours == pytest.approx(theirs, abs=1e-8 * max(1, abs(s)))
    assert np.abs(found.phasors).max(axis=0) == pytest.approx(1, abs=1e-15)


@pytest.mark.parametrize("name", MACHINES)
def test_motion_is_what_bicycleparameters_simulates(name, monkeypatch):
    """Its simulate has a tolerance of 1e-3, which is made 1e-12 here."""
    exact = functools.partial(scipy.integrate.solve_ivp, rtol=1e-12, atol=1e-14)
    monkeypatch.setattr(models.spi, "solve_ivp", lambda *a, method, **k: exact(*a, method="DOP853", **k))
    t = np.linspace(0, 3, 61)
    push = {"roll": 0.02, "steer": -0.01, "roll_rate": 0.5, "steer_rate": 0.3}
    theirs, _ = model_of(MEASURED[name]).simulate(t, [push[name] for name in STATES], v=5.0)
    found = motion(bs.Bicycle.from_mapping(MEASURED[name]), 5.0, push, t)
    assert pytest.approx(theirs, abs=1e-8 * max(1.0, float(np.abs(theirs).max()))) == found.states.T


def test_the_path_rolls_without_slip():
    """The integral of the yaw rate and of the way sideways, and no slip at the front contact."""
    bike = bs.Bicycle.preset("meijaard2007")
    push = {"roll_rate": 0.5, "steer": 0.05}
    lam, w, trail, V = bike.lam, bike.c, bike.c * bike.sigma, 4.0

    def rate(t, z):
        M, C, K = matrices(bike, V)
        q, dq, yaw = z[:2], z[2:4], z[4]
        turning = (V * q[1] + trail * dq[1]) * np.cos(lam) / w
        return np.concatenate([dq, -np.linalg.solve(M, C @ dq + K @ q), [turning, V * yaw]])

    t = np.linspace(0, 2, 21)
    start = [push.get(name, 0.0) for name in STATES] + [0, 0]
    done = scipy.integrate.solve_ivp(rate, (0, 2), start, t_eval=t, rtol=1e-12, atol=1e-14, method="DOP853")
    found = motion(bike, V, push, t)
    assert found.states == pytest.approx(done.y[:4], abs=1e-9)
    assert found.yaw == pytest.approx(done.y[4], abs=1e-9)
    assert found.y == pytest.approx(done.y[5], abs=1e-9)
    assert found.x == pytest.approx(V * t)
    fine = motion(bike, V, push, 1.0 + np.array([-1e-5, 0, 1e-5]))
    sideways = (fine.y_front[2] - fine.y_front[0]) / 2e-5
    assert sideways == pytest.approx(V * (fine.yaw[1] + fine.states[1, 1] * np.cos(lam)), abs=1e-8)


@pytest.mark.parametrize("offset", [0.0, 1e-13, 1e-9, 1e-6, 1e-3])
def test_where_eigenvalues_meet_or_are_zero(offset):
    """Beside a coalescence, and at a capsize end, the motion is that of the matrix' exponential."""
    bike = bs.Bicycle.preset("meijaard2007")
    for end in (bs.modes(bike, [1.0]).coalescences[0], bs.stable_intervals(bike).V2[0]):
        V = end * (1 + offset)
        M, C, K = matrices(bike, V)
        A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
        found = motion(bike, V, {"roll_rate": 0.1}, [0.0, 0.7, 1.5])
        expected = np.array([expm(A * t) @ [0, 0, 0.1, 0] for t in found.t]).T
        assert found.states == pytest.approx(expected, abs=1e-9 * max(1, np.abs(expected).max()))


@pytest.mark.parametrize("V", [0.5, 4.0, 8.0])
def test_feedback_is_in_the_matrices(V):
    """Their eigenvalues are those of the table, which has the gains too."""
    gains = {"k_phi": -12.0, "k_phidot_V": -1.5, "k_delta_V": 0.7, "k_deltadot": 0.4, "delta": 0.3}
    bike = bs.Bicycle.preset("meijaard2007").replaced(gains)
    M, C, K = matrices(bike, V)
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    ours, theirs = (np.sort_complex(s) for s in (np.linalg.eigvals(A), bs.eigenvalues(bike, V)))
    assert ours == pytest.approx(theirs, abs=1e-9 * np.abs(theirs).max())


def test_damping_and_the_start():
    bike = bs.Bicycle.preset("sharp1971")
    push = {"roll": 0.1, "steer": 0.02, "roll_rate": -0.3, "steer_rate": 0.4}
    found = motion(bike, "30km/h", push, [0.0, 1.0])
    assert found.states[:, 0] == pytest.approx([push[name] for name in STATES], abs=1e-12)
    assert (found.yaw[0], found.y[0]) == pytest.approx((0, 0), abs=1e-15)
    none = motion(bike.with_delta(0), "30km/h", push, [1.0])
    assert np.abs(none.states - found.states[:, 1:]).max() > 1e-3


@pytest.mark.parametrize(
    ("V", "push", "t", "words"),
    [
        (5, {"rol": 1}, [1], "there is no state 'rol'"),
        (5, {"roll": 1}, [-1], "a time is negative"),
        ([4, 5], {"roll": 1}, [1], "at one speed"),
        (1, {"roll": 1}, [1e4], "grows beyond all numbers"),
    ],
)
def test_mistakes(V, push, t, words):
    with pytest.raises(InputError, match=words):
        motion(bs.Bicycle.preset("meijaard2007"), V, push, t)


@pytest.mark.parametrize("name", ["meijaard2007", "kooijman2011", "sharp1971"])
@pytest.mark.parametrize("V", [0.0, 2.0, 5.0, 20.0])
def test_a_motion_starts_where_it_was_pushed(name, V):
    bike = bs.Bicycle.preset(name)
    push = {"roll": 1e-9, "steer_rate": 0.1 / 3}
    found = motion(bike, V, push, [0.0, 0.1, 0.0])
    for k in (0, 2):
        assert found.states[:, k].tolist() == [1e-9, 0.0, 0.0, 0.1 / 3]
        assert [str(x[k]) for x in (found.yaw, found.x, found.y, found.y_front)] == ["0.0"] * 4
