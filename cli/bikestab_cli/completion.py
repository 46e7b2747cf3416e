"""bikestab completion: what makes a shell complete commands, options, bicycles and files."""

from __future__ import annotations

import click

_FILES = {"bash": "~/.bashrc", "zsh": "~/.zshrc", "fish": "~/.config/fish/completions/bikestab.fish"}


@click.command("completion")
@click.argument("shell", type=click.Choice(list(_FILES)))
def command(shell: str) -> None:
    """Print what lets a shell complete commands, options, names of bicycles and files.

    For bash 4.4 or later: put  eval "$(bikestab completion bash)"  into ~/.bashrc; the same for zsh
    into ~/.zshrc; for fish write it into ~/.config/fish/completions/bikestab.fish.

    \b
    Examples:
      bikestab completion bash > bikestab.bash
      bikestab completion zsh > bikestab.zsh
      bikestab completion fish > bikestab.fish
    """
    from bikestab_cli.main import COMPLETE, cli
    from click.shell_completion import get_completion_class

    kind = get_completion_class(shell)
    assert kind  # click knows all three
    maker = kind(cli, {}, "bikestab", COMPLETE)
    click.echo(maker.source_template % maker.source_vars(), nl=False)  # source() would start a bash
