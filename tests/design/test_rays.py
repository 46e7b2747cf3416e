"""Rays end where their margin does, to 1e-8, whatever the margin is like, and after few looks at it."""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.design.ball import Ball, directions
from bikestab.design.rays import FARTHEST, first_ends

ENDS = np.array([3e-7, 1e-3, 0.0199, 0.02, 1.0, np.pi, 18.42, 57.0, 99.9])
MARGINS = {
    "straight": lambda far: ENDS - far,
    "flat": lambda far: (1 - far / ENDS) ** 9,
    "steep beyond": lambda far: 1 - np.exp(np.minimum(40 * (far / ENDS - 1), 600)),
    "steep before": lambda far: np.exp(np.minimum(40 * (1 - far / ENDS), 600)) - 1,
    "a jump": lambda far: np.where(far < ENDS, 5.0, -1.0),
    "a small jump": lambda far: np.where(far < ENDS, 1e-12, -1.0),
    "a kink": lambda far: np.where(far < ENDS, 1e-6, 1e3) * (ENDS - far),
}


@pytest.mark.parametrize("name", MARGINS)
def test_ends_are_right_to_what_is_stated(name):
    looks = []

    def margin(far, ray):
        looks.append(len(far))
        return np.choose(ray, [*MARGINS[name](far[:, np.newaxis]).T])

    found = first_ends(margin, len(ENDS))
    assert np.all(found < ENDS)
    assert np.all(ENDS - found <= 1.1e-8 * np.maximum(ENDS, 1e-6))
    assert len(looks) <= 2 + 12 + 60


def test_rays_that_are_never_lost_or_at_once():
    level = np.array([1.0, -1.0, 0.0])
    assert first_ends(lambda far, ray: level[ray], 3).tolist() == [FARTHEST, 0, 0]


def test_no_machine_is_stable_just_beyond_the_end_of_a_ray():
    """By halving, from the end and what is 5 % farther."""
    bicycle = Bicycle.preset("meijaard2007")
    deviations = {"mB": 3.0, "mH": 0.5, "trail": 0.004, "xB": 0.02}
    ball = Ball(bicycle, "refined", (5.0, 5.5), {"lam": (0.25, 0.4), "trail": (0.05, 0.12)}, deviations)
    u = directions(4, 512)
    x = np.repeat([[bicycle.lam], [0.08]], u.shape[1], axis=1)
    found = ball.reach(x, u)
    assert np.all(ball.margin(x, found * u) > 0)
    low, high = found, 1.05 * found
    lost = (found < FARTHEST) & (ball.margin(x, high * u) <= 0)
    assert lost.sum() > 480
    for _ in range(40):
        middle = 0.5 * (low + high)
        holds = ball.margin(x, middle * u) > 0
        low, high = np.where(holds, middle, low), np.where(holds, high, middle)
    assert np.all((low - found)[lost] <= 1.1e-8 * low[lost])
