"""What no options of any command may do: be given twice for one value, or put two outputs on stdout."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import click
from bikestab_cli.options import Name
from bikestab_cli.quantities import QuantityRange

from bikestab.files import to_stdout


def check_once(command: click.Command, context: click.Context, args: Sequence[str]) -> None:
    """Refuse options of one value that stand more than once in ``args``, and two outputs on stdout."""
    own = click.Context(command, info_name=command.name, parent=context)
    try:
        typed, _, order = command.make_parser(own).parse_args(list(args))
    except click.UsageError:  # which is told of where the command reads them
        return
    if any(param.is_eager for param in order):  # --help
        return
    for param, number in Counter(order).items():
        if number > 1 and takes_one(param):
            several = "; START:STOP:NUM gives several values" if isinstance(param.type, QuantityRange) else ""
            raise click.UsageError(f"{param.opts[0]} is given twice; give it once{several}", own)
    for param in order:
        if typed.get("as_json") and _to_stdout(param, str(typed.get(str(param.name)))):
            raise click.UsageError(f"--json and {param.opts[0]} both go to stdout; give one of them", own)


def _to_stdout(param: click.Parameter, name: str) -> bool:
    """Whether it is an option for a file to write, and this name of one is stdout."""
    of_file = isinstance(param, click.Option) and isinstance(param.type, Name) and "file" in param.type.of
    return of_file and (name == "-" or to_stdout(name))


def takes_one(param: click.Parameter) -> bool:
    """Whether it is an option with one value, and no flag."""
    return isinstance(param, click.Option) and not (param.multiple or param.is_flag or param.count)
