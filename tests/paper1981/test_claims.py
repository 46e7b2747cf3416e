"""The verdicts, and the rules that draw them from numbers."""

import pytest

from bikestab.paper1981 import claims
from tests.small import study


def test_verdicts():
    verdicts = [part["verdict"] for part in study()["conclusions"].values()]
    assert verdicts == ["does not hold", "holds with limits", "holds with limits", "does not hold"]
    forwards = [part["verdict_forwards"] for part in study()["conclusions"].values()]
    assert forwards == ["holds", "does not hold", "holds", "does not hold"]


@pytest.mark.parametrize(
    ("rule", "values", "verdict"),
    [
        (claims.judge_finite, (0.0, 0.0), "holds"),
        (claims.judge_finite, (0.0, 1e-9), "holds with limits"),
        (claims.judge_finite, (1e-9, 0.0), "does not hold"),
        (claims.judge_widening, (1.0, 0.0, True, False), "holds"),
        (claims.judge_widening, (0.995, 0.1, False, False), "holds with limits"),
        (claims.judge_widening, (0.98, 0.1, False, False), "does not hold"),
        (claims.judge_widening, (1.0, 0.1, True, True), "does not hold"),
        (claims.judge_widening, (1.0, None, False, False), "does not hold"),
        (claims.judge_margin, (0.1,), "holds"),
        (claims.judge_margin, (0.11,), "holds with limits"),
        (claims.judge_margin, (None,), "does not hold"),
        (claims.judge_damping, (None,), "holds"),
        (claims.judge_damping, (10.5,), "holds"),
        (claims.judge_damping, (0.35,), "holds with limits"),
        (claims.judge_damping, (0.34,), "does not hold"),
    ],
)
def test_rules(rule, values, verdict):
    assert rule(*values) == verdict


def test_first_marked():
    assert claims.first_marked([0.01, 0.1, 1.0], [0.0, 0.1, 0.2]) == pytest.approx(10**-1.5)
    assert claims.first_marked([0.01, 0.1], [0.06, 0.1]) == 0.01
    assert claims.first_marked([0.01, 0.1], [0.01, None]) == 0.1  # what was there is gone
    assert claims.first_marked([0.01, 0.1], [-0.01, 0.04]) is None
