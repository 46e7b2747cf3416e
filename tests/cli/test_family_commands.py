"""Commands over any two parameters of a machine."""

import json

import meshio
import numpy as np
import pytest

SCAN = """\
bicycle: meijaard2007
grid:
  x: {name: mB, start: 40kg, stop: 110, num: 8}
  y: {name: offset, start: 0mm, stop: 80mm, num: 5}
  V: {start: 0, stop: 36km/h, num: 11}
output: out
"""


@pytest.fixture
def scanned(bikestab, tmp_path):
    (tmp_path / "scan.yaml").write_text(SCAN)
    assert bikestab("scan", "scan.yaml", "--quiet")[0] == 0
    return bikestab


def test_slice(scanned):
    assert scanned("slice", "out", "--at", "offset=45mm", "-o", "a.png") == (0, "a.png\n", "")
    code, _, err = scanned("slice", "out", "--lam", "0.3")
    assert code == 2
    assert "the volume is over mB, offset and V: give one of --at mB=VALUE, --at offset=VALUE and --V" in err
    code, _, err = scanned("slice", "out", "--at", "mB=200")
    assert code == 2
    assert "mB = 200 is outside the volume\n  allowed: 40 ... 110" in err


def test_export_and_info(scanned, tmp_path):
    code, out, _ = scanned(
        "export", "out", "--mesh", "a.ply", "--intervals", "i.csv", "--skeleton", "s.csv", "--cells", "20"
    )
    assert code == 0
    assert "x = 0.2 mB, y = 100 offset, z = 1 V" in out
    head, first, *_ = (tmp_path / "i.csv").read_text().splitlines()
    assert head.startswith("mB,offset,lam,sigma,head_angle_deg,trail,interval,V1,V2")
    assert first.startswith("40.0,0.0,0.314159")
    points = meshio.read("a.ply").points
    assert (np.min(points, axis=0)[:2], np.max(points, axis=0)[:2]) == (
        pytest.approx([8, 0]), pytest.approx([22, 8]),
    )  # fmt: skip
    code, out, _ = scanned("info", "out", "--json")
    assert json.loads(out)["axes"]["mB"] == {
        "first": 40.0, "last": 110.0, "num": 8, "unit": "kg", "uniform": True,
    }  # fmt: skip
