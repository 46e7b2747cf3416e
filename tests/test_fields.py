"""The records of the fields: what readers load, and that one record more is all a new field takes."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

import bikestab
from bikestab.fields import AXES, COORDINATES, FIELDS, askable
from bikestab.routh import CONDITIONS
from tests.configs import GOOD

LIBRARY = Path(bikestab.__file__).parent
COMMANDS = Path(__file__).parents[1] / "cli" / "bikestab_cli"
RECORD = """

def _margin(points: Points) -> NDArray:
    from bikestab.routh import conditions

    return conditions(points.table, points.V).p0 > 1


FIELDS["steep"] = Field(
    name="steep", dtype=np.int16, unit="furlong", meaning="whether p0 is large", values=_margin,
    asked="steep", cost=3, packing=2, flags=("gentle", "steep"),
)
"""


def test_every_record_is_whole():
    assert list(COORDINATES) == list(AXES)
    for name, field in FIELDS.items():
        assert field.name == name
        assert field.meaning
        assert field.cost >= 0
        assert field.packing >= 1
        assert not (field.flags and field.masks)
    assert askable() == ["stable", "violated", "growth_rate", "conditions", "dV1"]
    assert [name for name, field in FIELDS.items() if field.asked == "conditions"] == list(CONDITIONS)


@pytest.mark.parametrize("module", ["bikestab.volume", "bikestab.fields"])
def test_a_reader_loads_numpy_and_h5py_only(module):
    code = f"import json, sys, {module}; print(json.dumps(sorted(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = {name.partition(".")[0] for name in json.loads(done.stdout)}
    assert not loaded & {"scipy", "pydantic", "pydantic_core", "isal", "matplotlib", "yaml", "click"}
    ours = {name for name in json.loads(done.stdout) if name.startswith("bikestab")}
    assert not ours & {"bikestab.spectrum", "bikestab.speeds", "bikestab.config", "bikestab.scan"}


def test_a_field_is_one_record(tmp_path):
    """A copy of the program with one record more scans, stores, lists and allows the new field."""
    shutil.copytree(LIBRARY, tmp_path / "bikestab", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(COMMANDS, tmp_path / "bikestab_cli", ignore=shutil.ignore_patterns("__pycache__"))
    with (tmp_path / "bikestab" / "fields.py").open("a", encoding="utf-8") as file:
        file.write(RECORD)
    (tmp_path / "scan.yaml").write_text(GOOD + "fields: [steep, stable]\noutput: out\n", encoding="utf-8")

    def bikestab_(*arguments):
        command = [sys.executable, "-c", "from bikestab_cli.main import main; main()", *arguments]
        environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True
        ).stdout

    bikestab_("scan", "scan.yaml", "--quiet")
    assert json.loads(bikestab_("info", "out", "--json"))["results"][0]["fields"] == ["stable", "steep"]
    assert "steep" in json.loads(bikestab_("schema"))["properties"]["fields"]["items"]["enum"]
    with h5py.File(tmp_path / "out" / "volume.h5") as file:
        data = file["steep"]
        assert data.dtype == np.int16
        assert data.attrs["units"] == b"furlong"
        assert data.attrs["long_name"] == b"whether p0 is large"
        assert data.attrs["flag_meanings"] == b"gentle steep"
        np.testing.assert_array_equal(data.attrs["flag_values"], np.array([0, 1], np.int16))
        assert 0 < data[()].sum() < data.size
        assert file["VTKHDF/PointData/steep"] == data
