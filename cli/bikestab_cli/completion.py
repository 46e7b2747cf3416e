"""bikestab completion: what makes a shell complete commands, options, bicycles and files."""

from __future__ import annotations

from collections.abc import Collection
from contextlib import suppress
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

_FILES = {"bash": "~/.bashrc", "zsh": "~/.zshrc", "fish": "~/.config/fish/completions/bikestab.fish"}

_MENDED = {  # what click's scripts leave undone: zsh may not have loaded compdef; descriptions have commas
    "zsh": [
        (
            "    compdef ",
            "    (( $+functions[compdef] )) || { autoload -Uz compinit && compinit -i }\n    compdef ",
        )
    ],
    "fish": [('string split "," $completion', 'string split --max 1 "," $completion')],
}


def completed(incomplete: str, *, bicycles: bool) -> list[CompletionItem]:
    """Files; where a bicycle's name fits, both as words: bash shows none of them beside "file"."""
    from glob import escape, glob

    from click.shell_completion import CompletionItem

    from bikestab.presets import preset_names

    fitting = [name for name in preset_names() if name.startswith(incomplete)] if bicycles else []
    if not fitting:
        return [CompletionItem(incomplete, type="file")]
    there = sorted(glob(f"{escape(incomplete)}*"))  # noqa: PTH207  # as it is typed
    return [CompletionItem(name) for name in (*fitting, *there)]


def parameters(ctx: click.Context, _: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Names of parameters: of the bicycle that was typed, or of both notations."""
    from bikestab_cli.options import bicycle_named
    from click.shell_completion import CompletionItem

    from bikestab.bicycle import PAPER
    from bikestab.notation import MEIJAARD

    names: Collection[str] = {**MEIJAARD, **PAPER}
    if typed := ctx.params.get("bicycle_name"):
        with suppress(Exception):  # a file that is no bicycle: the command will say so
            names = bicycle_named(typed if isinstance(typed, str) else typed[-1]).notation
    fitting = (name for name in {*names, "head_angle", "trail", "offset"} if name.startswith(incomplete))
    return [CompletionItem(f"{name}=") for name in sorted(fitting, key=str.casefold)]


@click.command("completion")
@click.argument("shell", type=click.Choice(list(_FILES)))
def command(shell: str) -> None:
    """Print what lets a shell complete commands, options, names of bicycles and files.

    For bash 4.4 or later: put  eval "$(bikestab completion bash)"  into ~/.bashrc; the same for zsh
    into ~/.zshrc, below the line with compinit if there is one; for fish write it into
    ~/.config/fish/completions/bikestab.fish.

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
    script = maker.source_template % maker.source_vars()  # source() would start a bash
    for old, new in _MENDED.get(shell, ()):
        script = script.replace(old, new)
    click.echo(script, nl=False)
