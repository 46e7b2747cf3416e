"""Every example in the help texts and in the README runs."""

import re
import shlex
import shutil
import sys
from pathlib import Path

import click
import pytest
from bikestab_cli.main import COMMANDS, cli, main

from bikestab.bicycle import Bicycle

ROOT = Path(__file__).parents[2]


def from_help(command):
    """The lines ``bikestab …`` after ``Example:`` or ``Examples:`` of a help text."""
    text = command.get_help(click.Context(command))
    _, found, examples = re.split(r"\n\s*(Examples?:)\s*\n", text)
    assert found
    lines = examples.split("\n\n")[0].replace("\\\n", " ").splitlines()
    return [line.strip() for line in lines if line.strip().startswith("bikestab ")]


def from_markdown(path):
    """The lines ``bikestab …`` in a file's sh and console blocks, in their order."""
    lines = []
    for kind, block in re.findall(r"^```(\w+)\n(.*?)^```", path.read_text("utf-8"), re.M | re.S):
        if kind in ("sh", "bash", "console", "shell"):
            for line in block.replace("\\\n", " ").splitlines():
                line = line.removeprefix("$ ").split(" && ")[-1]
                if line.startswith("bikestab "):
                    lines.append(line)
    return lines


def commands():
    yield "bikestab", cli
    for name in COMMANDS:
        yield name, cli.get_command(click.Context(cli), name)


PAGES = [page for page in (ROOT / "README.md", *ROOT.glob("docs/*.md")) if from_markdown(page)]


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Run lines one after the other, in a folder with the configs and the examples; what fails is told."""
    shutil.copytree(ROOT / "configs", tmp_path / "configs")
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)

    def run_lines(lines):
        printed = []
        for line in lines:
            command, _, target = line.partition(" > ")
            words = shlex.split(command, comments=True)
            files = [sorted(map(str, Path().glob(word))) if "*" in word else [word] for word in words]
            monkeypatch.setattr(sys, "argv", [word for found in files for word in found])
            with pytest.raises(SystemExit) as exit_:
                main()
            out, err = capsys.readouterr()
            assert exit_.value.code == 0, f"{line}\n{err}"
            assert out, line
            printed.append(out)
            if target:
                Path(target.strip()).write_text(out, "utf-8")
        return "".join(printed)

    return run_lines


def test_the_measured_example_is_what_it_says():
    """The benchmark bicycle, each deviation half a per cent."""
    measured, benchmark = Bicycle.load(str(ROOT / "examples/measured.txt")), Bicycle.preset("meijaard2007")
    assert measured.given == benchmark.given
    half = {name: abs(value) / 200 for name, value in benchmark.given.items()}
    assert measured.deviations == pytest.approx(half, rel=1e-5)


def test_there_are_examples_everywhere():
    assert all(from_help(command) for _, command in commands())
    assert len(from_markdown(ROOT / "README.md")) > 8


@pytest.mark.parametrize("name", ["bikestab", *COMMANDS])
def test_examples_of_a_help_text(run, name):
    lines = from_help(dict(commands())[name])
    assert name == "bikestab" or all(line.startswith(f"bikestab {name}") for line in lines)
    if any("out/quick" in line for line in lines):
        run(["bikestab scan configs/quick.yaml --set slices=[]"])
    if any("out/proved" in line for line in lines):
        run(["bikestab scan configs/quick.yaml --set slices=[] --set output=out/proved --certify"])
    run(lines)


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name)
def test_examples_of_a_page(run, path):
    run(from_markdown(path))


@pytest.mark.parametrize("page", ["README.md", "docs/sensitivity.md"])
def test_what_consoles_show_is_printed(run, page):
    text = (ROOT / page).read_text("utf-8")
    shown = re.findall(r"^```console\n\$ (.*)\n((?:.*\n)*?)^```", text, re.M)
    assert shown
    for line, expected in shown:
        assert run([line]) == expected


def test_the_tutorial_decides_in_as_many_commands_as_it_says():
    """One in each of its numbered sections, the decision in the last of them."""
    *numbered, after = (ROOT / "docs" / "tutorial.md").read_text("utf-8").split("\n## ")[1:]
    assert [section[:3] for section in numbered] == [f"{i}. " for i in range(1, 6)]
    assert [section.count("\nbikestab ") for section in numbered] == [1] * 5
    assert "Decision: " in numbered[-1]
    assert not after[0].isdigit()
    for page in ("tutorial.md", "index.md"):
        assert "five commands" in (ROOT / "docs" / page).read_text("utf-8").lower()
