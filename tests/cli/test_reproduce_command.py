"""bikestab reproduce."""

import sys

import pytest
from bikestab_cli.main import main

from bikestab.paper1981 import reproduce
from bikestab.paper1981.box import FULL, QUICK
from bikestab.paper1981.study import FIGURES
from tests.small import record


@pytest.fixture
def run(monkeypatch, capsys, tmp_path):
    sizes = []

    def computed(sampling, progress):
        sizes.append(sampling)
        progress("everything")
        return record(), dict.fromkeys(FIGURES, b"")

    monkeypatch.setattr(reproduce, "computed", computed)
    monkeypatch.chdir(tmp_path)

    def run_it(*args):
        monkeypatch.setattr(sys, "argv", ["bikestab", "reproduce", *args])
        with pytest.raises(SystemExit) as end:
            main()
        return (end.value.code, *capsys.readouterr(), sizes)

    return run_it


def test_one_line_for_each_conclusion(run, tmp_path):
    code, out, err, sizes = run()
    assert (code, err, sizes) == (0, "", [FULL])
    lines = out.splitlines()
    assert len(lines) == 5
    assert lines[0].startswith(
        "conclusion 1: does not hold (forks bent forwards: holds): no upper limit for 3."
    )
    assert lines[1].startswith("conclusion 2: holds with limits (forks bent forwards: does not hold): ")
    assert lines[2].startswith("conclusion 3: holds with limits (forks bent forwards: holds): ")
    assert lines[3].startswith("conclusion 4: does not hold (forks bent forwards: does not hold): ")
    assert lines[4] == "report: out/reproduce/report.md"
    assert (tmp_path / "out/reproduce/report.md").is_file()


def test_quick(run, tmp_path):
    code, out, _, sizes = run("--quick", "-o", "there")
    assert (code, sizes) == (0, [QUICK])
    assert out.endswith("report: there/report.md\n")


def test_progress_only_on_a_terminal(run, monkeypatch):
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    assert "everything ...\n" in run()[2]


def test_a_folder_that_cannot_be_written(run, tmp_path):
    (tmp_path / "file").touch()
    code, out, err, _ = run("-o", "file/deep")
    assert (code, out) == (2, "")
    assert err.startswith("error: file/deep: cannot be written (")
    assert "Traceback" not in err
