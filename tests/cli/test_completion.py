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


@pytest.fixture
def in_shell(bikestab, tmp_path):
    """Run lines below the script in a shell with nothing of the user's, where bikestab is a command."""

    def run(shell, lines, *options):
        program = shutil.which(shell)
        if not program:
            pytest.skip(f"no {shell} here")
        there = tmp_path / "bin" / "bikestab"
        there.parent.mkdir()
        there.write_text(f"#!{sys.executable}\nfrom bikestab_cli.main import main\nmain()\n", "utf-8")
        there.chmod(0o755)
        own = {"HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path), "XDG_DATA_HOME": str(tmp_path)}
        env = os.environ | own | {"PATH": f"{there.parent}{os.pathsep}{os.environ['PATH']}"}
        script = bikestab("completion", shell)[1] + lines
        done = subprocess.run(
            [program, *options], input=script, text=True, capture_output=True, env=env, check=True
        )
        assert done.stderr == ""
        return done.stdout.splitlines()

    return run


def test_zsh_without_compinit(in_shell):
    """Nothing but what is printed: neither the user's files nor the system's are read."""
    assert in_shell("zsh", "print $_comps[bikestab]\n", "-f") == ["_bikestab_completion"]


def test_fish_shows_whole_descriptions(in_shell):
    """Beyond their first comma, of which there is one in each of these."""
    lines = "complete --do-complete 'bikestab compa'\ncomplete --do-complete 'bikestab sensi'\n"
    assert in_shell("fish", lines, "--no-config") == [
        "compare\tCompare bicycles, configs or volumes: the...",
        "sensitivity\tPrint which parameter moves V1 and V2, and...",
    ]


def test_a_shell_that_is_not_known(bikestab):
    code, out, err = bikestab("completion", "tcsh")
    assert (code, out) == (2, "")
    assert "'bash', 'zsh', 'fish'" in err


def test_version(bikestab):
    assert bikestab("-V") == (0, f"bikestab {__version__}\n", "")
