"""Records: what they hold is what JSON can hold, and what the arrays hold."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.records import design_record, interval_records, modes_record, verdict_record
from bikestab.speeds import KINDS, REASONS
from bikestab.stability import modes, stable_intervals

PAPER = Bicycle.preset("dikarev1981")
BENCHMARK = Bicycle.preset("meijaard2007")


def test_intervals_of_each_cell():
    lam = np.array([[0.1], [0.2], [0.04834835], [0.05]])
    found = stable_intervals(PAPER, lam, [0.08, 0.15])
    numbers = set()
    for cell in np.ndindex(4, 2):
        records = interval_records(found, *cell)
        numbers.add(len(records))
        assert json.loads(json.dumps(records, allow_nan=False)) == records
        for k, record in enumerate(records):
            assert record["V1"] == found.V1[cell][k]
            assert (math.inf if record["V2"] is None else record["V2"]) == found.V2[cell][k]
            assert record["lower"] == KINDS[found.lower[cell][k]]
            assert record["upper"] == KINDS[found.upper[cell][k]]
            assert (record["upper"] == "unbounded") == (record["V2"] is None) == (record["V2_error"] is None)
            assert record["V1_error"] == found.V1_error[cell][k] < 1e-9
        assert verdict_record(found, *cell) == {"marginal": False}
    assert numbers == {0, 1, 2}
    assert interval_records(stable_intervals(PAPER, 0.2, 0.08)) == interval_records(found, 1, 0)


def test_what_is_within_rounding():
    found = stable_intervals(PAPER, 0.2, 0.08)
    open_ = replace(found, marginal=np.array([2], np.uint8), V1_error=np.array([np.inf]))
    assert verdict_record(open_) == {"marginal": True, "reason": REASONS[2]}
    (record,) = interval_records(open_)
    assert (record["V1_error"], record["V2_error"]) == (None, found.V2_error[0])


def test_design():
    lam = math.radians(18)
    record = design_record(lam, 0.1, BENCHMARK)
    assert record == {
        "lam": lam, "sigma": 0.1, "head_angle_deg": pytest.approx(72), "trail": 0.1 * 1.02,
        "offset": pytest.approx(0.35 * math.sin(lam) - 0.102 * math.cos(lam), abs=1e-16),
    }  # fmt: skip
    arrays = design_record(np.radians([18.0, 20.0]), np.array([0.1, 0.2]), BENCHMARK)
    assert arrays["head_angle_deg"][0] == record["head_angle_deg"]


def test_modes():
    found = modes(PAPER, [0.0, 5.0], 0.2, 0.08)
    record = modes_record(found)
    assert json.loads(json.dumps(record, allow_nan=False)) == record
    s = np.array(record["branches"][0]["re"]) + 1j * np.array(record["branches"][0]["im"])
    np.testing.assert_array_equal(s, found.eigenvalues[0])
    assert [meeting["V"] for meeting in record["coalescences"]] == found.coalescences.tolist()
