"""Several free parameters: the optima beat dense random search, and the ball holds random machines."""

import numpy as np
import pytest
from scipy.optimize import minimize

from bikestab.bicycle import Bicycle
from bikestab.design.ball import Ball, contacts, directions
from bikestab.design.criteria import assessed, decay, lowest, width
from bikestab.design.free import Free, best_free, best_of
from bikestab.draws import evenly
from bikestab.errors import InputError
from bikestab.routh import stable
from bikestab.stability import stable_intervals

MEIJAARD = Bicycle.preset("meijaard2007")
OWN = Bicycle.preset("dikarev1981").replaced({"lam": 0.2, "sigma": 0.08})
PROBLEMS = {
    "three": Free(MEIJAARD, {"lam": (0.1, 0.5), "trail": (0.02, 0.15), "xB": (0.2, 0.4)}, stable=(4.6, 5.4)),
    "one": Free(MEIJAARD, {"offset": (-0.05, 0.08)}, judged=(5.0, 5.0)),
    "six": Free(
        MEIJAARD,
        {
            "lam": (0.1, 0.5),
            "trail": (0.02, 0.15),
            "xB": (0.2, 0.4),
            "zB": (-1.1, -0.7),
            "mB": (60.0, 110.0),
            "xH": (0.8, 1.0),
        },
    ),
    "paper": Free(OWN, {"head_angle": (1.2, 1.5), "offset": (0.0, 0.08), "h1": (0.7, 1.1)}),
}
DEVIATIONS = {"lam": 0.01, "trail": 0.005, "xB": 0.01}


@pytest.mark.parametrize("criterion", [width, lowest, decay])
@pytest.mark.parametrize("problem", PROBLEMS)
def test_optima_beat_dense_random_search_and_polish(problem, criterion):
    free = PROBLEMS[problem]
    low, high = free.box
    x, value = best_of(free, criterion)
    assert np.all((low <= x) & (x <= high))
    random = np.random.default_rng(5).uniform(low, high, (6000, len(low))).T

    def cost(points):
        return assessed(free, [criterion], points)[0]

    dense = cost(random)
    best = random[:, np.argmin(dense)]
    end = minimize(
        lambda point: float(cost(np.asarray(point)[:, np.newaxis])[0]), best, method="Nelder-Mead",
        bounds=list(zip(low, high, strict=True)), options={"maxfev": 250},
    )  # fmt: skip
    assert value <= min(end.fun, dense.min()) + 1e-6 * abs(value)


@pytest.fixture(scope="module")
def robust():
    return best_free(PROBLEMS["three"], DEVIATIONS).most_robust


def around(robust, z):
    """A machine z standard deviations from the robust design, by its own reduction."""
    values = {
        name: robust["design"]["over"][name] + sd * step
        for (name, sd), step in zip(DEVIATIONS.items(), z, strict=True)
    }
    return MEIJAARD.replaced({"c" if name == "trail" else name: value for name, value in values.items()})


def test_the_ball_holds_random_machines(robust):
    ball = Ball(MEIJAARD, "refined", (4.6, 5.4), PROBLEMS["three"].ends, DEVIATIONS)
    x = np.array(list(robust["design"]["over"].values()))
    z = np.random.default_rng(6).standard_normal((3, 20_000))
    z *= robust["radius"] / np.linalg.norm(z, axis=0)
    at = np.repeat(x[:, np.newaxis], z.shape[1], axis=1)
    assert ball.certain(at, (1 - 1e-6) * z).all()
    assert not ball.certain(at, 1.02 * z).all()
    for step in (0.999 * z[:, :20]).T:  # as each machine alone says
        found = stable_intervals(around(robust, step))
        assert np.any((found.V1 <= 4.6) & (found.V2 >= 5.4))
    away = [
        (robust["nearest"][name] - robust["design"]["over"][name]) / sd for name, sd in DEVIATIONS.items()
    ]
    assert np.linalg.norm(away) == pytest.approx(robust["radius"], rel=1e-9)
    beyond = stable_intervals(around(robust, 1.0001 * np.array(away)))
    assert not np.any((beyond.V1 <= 4.6) & (beyond.V2 >= 5.4))


def test_no_other_centre_has_a_larger_ball(robust):
    """Of the best of many random designs by some rays, which overestimate."""
    ball = Ball(MEIJAARD, "refined", (4.6, 5.4), PROBLEMS["three"].ends, DEVIATIONS)
    low, high = PROBLEMS["three"].box
    x = np.random.default_rng(7).uniform(low, high, (400, 3)).T
    u = directions(3, 10)
    reach = ball.reach(np.repeat(x, u.shape[1], axis=1), np.tile(u, x.shape[1])).reshape(400, -1).min(axis=1)
    for i in np.argsort(-reach)[:4]:
        assert contacts(ball, x[:, i], 256)[1].min() <= robust["radius"]


def test_a_parameter_that_is_uncertain_but_not_free():
    ends = {"trail": (0.02, 0.15)}
    free = Free(MEIJAARD, ends, stable=(5.0, 5.0))
    found = best_free(free, {"mB": 5.0}).most_robust
    trails = np.linspace(0.02, 0.15, 261)
    masses = np.linspace(0, 400, 4001)
    best = 0.0
    for trail in trails:
        machine = MEIJAARD.replaced({"c": trail})
        holds = np.array([stable(Free(machine, {"mB": (0.0, 400.0)}).table(masses[np.newaxis]), 5.0)]).ravel()
        lost = masses[~holds]
        best = max(best, np.abs(lost - 85).min() / 5)
    assert found["radius"] == pytest.approx(best, abs=0.1 / 5 + 0.02)
    assert found["radius"] >= best - 0.02


@pytest.mark.parametrize(
    ("ends", "more", "key", "words"),
    [
        ({}, {}, "free", "0 parameters cannot be free"),
        ({"mb": (1.0, 2.0)}, {}, "mb", "did you mean 'mB'?"),
        ({"mB": (-1.0, 2.0)}, {}, "mB", "-1 is not non-negative"),
        ({"mB": (60.0, 90.0)}, {"stable": (5.0, 40.0)}, "stable", "above 30 m/s"),
    ],
)
def test_mistakes(ends, more, key, words):
    with pytest.raises(InputError) as error:
        Free(MEIJAARD, ends, **more)
    assert error.value.key == (key,)
    assert words in str(error.value)


def test_robustness_needs_speeds():
    with pytest.raises(InputError, match="speeds to be stable at"):
        best_free(Free(MEIJAARD, {"mB": (60.0, 90.0)}), {"mB": 5.0})
    with pytest.raises(InputError, match="no parameter 'mb'"):
        best_free(Free(MEIJAARD, {"mB": (60.0, 90.0)}, stable=(5.0, 5.0)), {"mb": 5.0})


@pytest.mark.parametrize("dimensions", [1, 2, 6])
def test_points_are_spread_evenly(dimensions):
    """Each of 32 slices along each axis has its share of the points, as no random ones have."""
    points = evenly(dimensions, 1024)
    assert points.shape == (1024, dimensions)
    for x in points.T:
        assert np.abs(np.histogram(x, 32, (0, 1))[0] - 32).max() <= 3
    assert len(np.unique(points, axis=0)) == 1024


SHARP = Bicycle.preset("sharp1971")


def test_optima_end_on_limits_and_none_is_beaten_in_its_own_column():
    found = best_free(Free(SHARP, {"delta": (0.0, 20.0), "trail": (0.05, 0.2)}))
    for design in (found.widest, found.fastest_decay):
        assert design["over"] == {"delta": 0.0, "trail": 0.2}
        assert design["at"] == "limit of delta, limit of trail"
    for free in (PROBLEMS["paper"], PROBLEMS["one"]):
        found = best_free(free)
        designs = list(found.designs.values())
        assert found.widest["width"] == max(each["width"] for each in designs[1:])
        assert found.fastest_decay["growth_rate"] == min(each["growth_rate"] for each in designs[1:])


def test_an_interval_in_name_only_is_said():
    found = best_free(Free(MEIJAARD, {"lam": (0.0, 0.6), "sigma": (0.0, 0.3)})).lowest_V1
    assert found["width"] < 0.01
    assert found["at"].endswith("edge of the stable region, where the interval shrinks to a point")
