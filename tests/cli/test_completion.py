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
    assert completed("bikestab vrange --bicycle mei") == ["plain,meijaard2007"]
    assert completed("bikestab vrange --bicycle nothing") == ["file,nothing"]
    assert completed("bikestab compare mei") == completed("bikestab compare sharp1971 mei")
    for words in ("compare", "bicycles", "convert", "init --bicycle", "certify --bicycle"):
        assert completed(f"bikestab {words} mei") == ["plain,meijaard2007"]
    assert "plain,vrange" in completed("bikestab schema v")
    assert completed("bikestab scan con") == ["file,con"]
    assert "plain,--lam" in completed("bikestab eigen --la")
    assert [word.split("\t")[0] for word in completed("bikestab comp", "fish")] == [
        "plain,compare",
        "plain,completion",
    ]


def test_bicycles_and_files_together(tmp_path, monkeypatch):
    """Both are words: bash's script of click forgets every word where it meets a file."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mein[1].yaml").touch()
    assert completed("bikestab vrange --bicycle me") == ["plain,meijaard2007", "plain,mein[1].yaml"]


def test_names_of_parameters():
    own = "bikestab vrange --bicycle meijaard2007"
    assert completed(f"{own} --set IB") == [f"plain,IB{axes}=" for axes in ("xx", "xz", "yy", "zz")]
    assert completed(f"{own} --over head") == ["plain,head_angle="]
    assert completed("bikestab design --bicycle none.yaml --free m") == [
        "plain,m1=", "plain,m2=", "plain,mB=", "plain,mF=", "plain,mH=", "plain,mR=",
    ]  # fmt: skip
    assert completed(f"{own} --sd tr") == ["plain,trail="]


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
