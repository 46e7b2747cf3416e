"""What --help prints: it fits a terminal, hides no default, and says the same of the same option."""

import click
import pytest
from bikestab_cli.main import COMMANDS, cli


def command(name):
    return cli.get_command(click.Context(cli), name)


@pytest.mark.parametrize("name", COMMANDS)
def test_it_fits_80_columns(name):
    context = click.Context(command(name), info_name=f"bikestab {name}", terminal_width=80)
    lines = command(name).get_help(context).splitlines()
    assert [line for line in lines if len(line) > 80] == []


def options():
    for name in COMMANDS:
        yield from ((name, each) for each in command(name).params if isinstance(each, click.Option))


def test_every_option_says_what_it_is_for_and_what_it_is_without():
    for name, option in options():
        assert option.help, (name, option.opts)
        hidden = isinstance(option.default, (int, float, str)) and not isinstance(option.default, bool)
        assert not hidden or option.show_default or "default" in option.help, (name, option.opts)


@pytest.mark.parametrize("name", ["--model", "--delta", "--json", "--quiet", "--sd", "--set", "--over"])
def test_the_same_option_is_described_alike(name):
    """Where its values have the same form."""
    texts = {}
    for _, option in options():
        if name in option.opts:
            texts.setdefault(option.metavar, set()).add((option.help or "").partition("  [default")[0])
    assert texts
    assert all(len(each) == 1 for each in texts.values())
