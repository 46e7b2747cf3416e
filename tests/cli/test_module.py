"""``python -m bikestab`` is the command line too."""

import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    ("args", "code", "out", "err"),
    [
        (["vrange", "--bicycle", "meijaard2007"], 0, "meijaard2007, refined model", ""),
        (["vrange", "--help"], 0, "Usage: python -m bikestab vrange [OPTIONS]", ""),
        (["vrange", "--lam", "x"], 2, "", "see 'python -m bikestab vrange --help'"),
        (["vrnge"], 2, "", "did you mean 'vrange'?"),
        (["info", "none"], 2, "", "none: there is no such volume"),
    ],
)
def test_as_a_module(args, code, out, err):
    done = subprocess.run([sys.executable, "-m", "bikestab", *args], capture_output=True, text=True)
    assert done.returncode == code
    assert done.stdout.startswith(out) if out else done.stdout == ""
    assert err in done.stderr if err else done.stderr == ""
