"""The files of the reproduction: all or none, each complete."""

import json

import pytest
from matplotlib.figure import Figure

from bikestab.errors import InputError
from bikestab.paper1981 import reproduce as module
from bikestab.paper1981.study import FIGURES
from tests.small import TINY, record, study


@pytest.fixture
def quick_figures(monkeypatch):
    """The figures are looked at by people; here they only have to be written."""
    monkeypatch.setattr(module, "study", lambda bicycle, sampling, progress: record())
    monkeypatch.setattr(module, "draw_all", lambda numbers, sampling: ((name, Figure()) for name in FIGURES))


def test_files(tmp_path, quick_figures):
    module.reproduce(tmp_path / "a" / "b", sampling=TINY)
    names = {path.name for path in (tmp_path / "a" / "b").iterdir()}
    assert names == {*FIGURES, "report.json", "report.md"}
    written = json.loads((tmp_path / "a" / "b" / "report.json").read_text("utf-8"))
    assert written == json.loads(json.dumps(study()))


def test_no_report_without_the_rest(tmp_path, quick_figures, monkeypatch):
    def full(figure, path):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module, "save", full)
    with pytest.raises(Exception, match="No space left"):
        module.reproduce(tmp_path, sampling=TINY)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_a_file(tmp_path):
    (tmp_path / "here").touch()
    with pytest.raises(InputError, match="cannot be written"):
        module.reproduce(tmp_path / "here")
