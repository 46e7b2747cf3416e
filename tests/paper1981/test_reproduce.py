"""The files of the reproduction: all or none, each complete."""

import json

import pytest
from matplotlib.figure import Figure

from bikestab.errors import InputError
from bikestab.paper1981 import reproduce as module
from bikestab.paper1981.study import FIGURES, plain
from tests.small import TINY, halves, record, study


@pytest.fixture
def quick_figures(monkeypatch):
    """The figures are looked at by people; here they only have to be written."""
    monkeypatch.setattr(
        module, "computed", lambda sampling, progress: (record(), dict.fromkeys(FIGURES, b""))
    )


def test_files(tmp_path, quick_figures):
    module.reproduce(tmp_path / "a" / "b", sampling=TINY)
    names = {path.name for path in (tmp_path / "a" / "b").iterdir()}
    assert names == {*FIGURES, "report.json", "report.md"}
    written = json.loads((tmp_path / "a" / "b" / "report.json").read_text("utf-8"))
    assert written == json.loads(json.dumps(study()))


def test_no_report_without_the_rest(tmp_path, quick_figures, monkeypatch):
    def full(content, path):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module, "write", full)
    with pytest.raises(Exception, match="No space left"):
        module.reproduce(tmp_path, sampling=TINY)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_a_file(tmp_path):
    (tmp_path / "here").touch()
    with pytest.raises(InputError, match="cannot be written"):
        module.reproduce(tmp_path / "here")


def test_halves(monkeypatch):
    """Both halves make the study, whether one is computed in another process or not."""
    kinds = "figures_of_undamped", "figures_of_others", "figures_of_all"
    for name in kinds:
        monkeypatch.setattr(module, name, lambda *given, name=name: [(name, Figure)])
    monkeypatch.setattr(module, "FIGURES", kinds)
    monkeypatch.setattr(module, "others", lambda *given: halves()[1])
    monkeypatch.setattr(module, "undamped", lambda *given: halves()[0])
    told = []
    for cores in (1, 2):
        monkeypatch.setattr("bikestab.aside.cores", lambda cores=cores: cores)
        numbers, figures = module.computed(TINY, told.append)
        assert plain(numbers) == study()
        assert [content[:4] for content in figures.values()] == [b"\x89PNG"] * 3
    assert told[0] == "figures"
