"""An option that takes one value is typed once: of two, the first would count for nothing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import click
from bikestab_cli.quantities import QuantityRange


def check_once(command: click.Command, context: click.Context, args: Sequence[str]) -> None:
    """Refuse options of one value that stand more than once in a command's ``args``."""
    own = click.Context(command, info_name=command.name, parent=context)
    try:
        order = command.make_parser(own).parse_args(list(args))[2]
    except click.UsageError:  # which is told of where the command reads them
        return
    if any(param.is_eager for param in order):  # --help
        return
    for param, number in Counter(order).items():
        if number > 1 and takes_one(param):
            several = "; START:STOP:NUM gives several values" if isinstance(param.type, QuantityRange) else ""
            raise click.UsageError(f"{param.opts[0]} is given twice; give it once{several}", own)


def takes_one(param: click.Parameter) -> bool:
    """Whether it is an option with one value, and no flag."""
    return isinstance(param, click.Option) and not (param.multiple or param.is_flag or param.count)
