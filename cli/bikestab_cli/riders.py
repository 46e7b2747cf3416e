"""--rider: a rider's file beside --bicycle, in every command that takes a bicycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle


def _keep(context: click.Context, option: click.Parameter, file: str | None) -> None:
    if file is not None and not file.strip():
        raise click.BadParameter(f"{file!r} is no name", param=option)
    context.meta["bikestab.rider"] = "/dev/stdin" if file == "-" else file


rider_option = click.option(
    "--rider", metavar="FILE", expose_value=False, callback=_keep,
    help="Join the rider in a file of BicycleParameters to --bicycle.",
)  # fmt: skip


def with_its_rider(bicycle: Bicycle) -> Bicycle:
    """The bicycle with the rider that --rider names, if any; InputError where it cannot have that one."""
    file = click.get_current_context().meta.get("bikestab.rider")
    if not file:
        return bicycle
    from bikestab.ridden import with_rider

    return with_rider(bicycle, file)
