"""The command line as a function."""

import sys

import pytest
from bikestab_cli.main import main


@pytest.fixture
def bikestab(monkeypatch, capsys, tmp_path):
    """Run a command in an empty folder: exit code, stdout, stderr."""
    monkeypatch.chdir(tmp_path)

    def run(*args):
        monkeypatch.setattr(sys, "argv", ["bikestab", *map(str, args)])
        with pytest.raises(SystemExit) as exit_:
            main()
        return exit_.value.code, *capsys.readouterr()

    return run


@pytest.fixture
def without_warnings(bikestab):
    """The same with the warnings about the paper's bicycle left out of stderr."""

    def run(*args):
        code, out, err = bikestab(*args)
        errors = [line for line in err.splitlines(keepends=True) if not line.startswith("warning: ")]
        return code, out, "".join(errors)

    return run
