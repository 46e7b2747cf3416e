"""What shells complete, and -V."""

import os
import shutil
import subprocess
import sys

import pytest

from bikestab import __version__


def completed(words, shell="bash"):
    script = "from bikestab_cli.main import main; main()"
    *before, last = words.split(" ")
    asked = {"COMP_WORDS": words, "COMP_CWORD": str(len(before)), "_BIKESTAB_COMPLETE": f"{shell}_complete"}
    if shell != "bash":
        asked["COMP_CWORD"] = last
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, env=os.environ | asked, check=True
    )
    return done.stdout.splitlines()


def test_commands_options_and_bicycles():
    assert completed("bikestab vra") == ["plain,vrange"]
    assert completed("bikestab vrange --bicycle mei") == ["plain,meijaard2007", "file,mei"]
    assert completed("bikestab scan con") == ["file,con"]
    assert "plain,--lam" in completed("bikestab eigen --la")
    assert [word.split("\t")[0] for word in completed("bikestab comp", "fish")] == [
        "plain,compare",
        "plain,completion",
    ]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_scripts(bikestab, shell):
    code, out, err = bikestab("completion", shell)
    assert (code, err) == (0, "")
    assert f"_BIKESTAB_COMPLETE={shell}_complete" in out
    if program := shutil.which(shell):
        subprocess.run([program, "-n"], input=out, text=True, check=True)


def test_a_shell_that_is_not_known(bikestab):
    code, out, err = bikestab("completion", "tcsh")
    assert (code, out) == (2, "")
    assert "'bash', 'zsh', 'fish'" in err


def test_version(bikestab):
    assert bikestab("-V") == (0, f"bikestab {__version__}\n", "")
