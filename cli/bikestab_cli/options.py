"""Options that several commands share, and their mistakes."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click
from bikestab_cli.completion import parameters
from bikestab_cli.parameters import deviations_given, over_ends, over_values, values_given
from bikestab_cli.quantities import Quantity
from bikestab_cli.riders import rider_option, with_its_rider

from bikestab.errors import InputError
from bikestab.files import PICTURES
from bikestab.units import DAMPING

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle

F = TypeVar("F", bound=Callable[..., Any])
_OF_PARAMETERS = ("--over", "--free", "--tolerance")  # options that name one, of which a mistake is told
DEFAULT_BICYCLE = "dikarev1981"


class Name(click.ParamType):
    """Text that is not empty; of a file, one that a file can have."""

    name = "text"

    def __init__(self, *of: str) -> None:
        self.of = of

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        text = str(value)
        if not text.strip():
            self.fail(f"{text!r} is no name", param, ctx)
        if text == "-" and "picture" not in self.of:
            return self._stream(param, ctx)
        if "file" in self.of and (text.endswith(("/", os.sep)) or Path(text).name in ("", "..")):
            self.fail(f"{text!r} is a folder, not a file to write", param, ctx)
        if "picture" in self.of and Path(text).suffix.lower() not in PICTURES:
            self.fail(f"{text!r} has no ending {', '.join(PICTURES[:-1])} or {PICTURES[-1]}", param, ctx)
        return text

    def _stream(self, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """What - stands for, as in other programs."""
        if "file" not in self.of and param and param.name in ("scheduler", "output"):  # which is a folder
            self.fail("'-' is no name", param, ctx)
        return "/dev/stdout" if "file" in self.of else "/dev/stdin"

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[Any]:
        """Files; where a bicycle is wanted those that come with bikestab too."""
        from bikestab_cli.completion import completed

        return completed(incomplete, bicycles="bicycle" in self.of)


NAME, FILE, PICTURE, BICYCLE = Name(), Name("file"), Name("file", "picture"), Name("bicycle")


def equation_options(function: F) -> F:
    """--rider, --model and --delta."""
    for option in (
        rider_option,
        click.option(
            "--delta", type=Quantity("number", DAMPING),
            help="Steering damping δ [kg m²/s], instead of the bicycle's own.",
        ),
        click.option(
            "--model", type=click.Choice(["refined", "unrefined"]), default="refined", show_default=True,
            help="The paper's refined equations, or those before it.",
        ),
    ):  # fmt: skip
        function = option(function)
    return function


_of_parameters = partial(click.option, multiple=True, shell_complete=parameters)
at_option = _of_parameters(
    "--at", "machine", metavar="NAME=VALUE", callback=values_given,
    help="Which machine of a sweep, e.g. --at delta=1; once for each of its axes.",
)  # fmt: skip
over_option = _of_parameters(
    "--over", "over", metavar="NAME=START:STOP:NUM", callback=over_values,
    help="Values of a parameter of the bicycle, e.g. --over mB=60:110:6 --over offset=0:80mm:5; one or two.",
)  # fmt: skip
over_ends_option = _of_parameters(
    "--over", "over", metavar="NAME=START:STOP", callback=over_ends,
    help="Search over these two parameters instead, e.g. --over mB=60:110 --over offset=0:80mm.",
)  # fmt: skip
free_option = _of_parameters(
    "--free", "free", metavar="NAME=START:STOP", callback=over_ends,
    help="A parameter that the search may choose, e.g. --free lam=0.1:0.4 --free trail=2cm:15cm; up to six.",
)  # fmt: skip
sd_option = _of_parameters(
    "--sd", "deviations", metavar="NAME=VALUE|file", callback=deviations_given,
    help="A parameter's standard deviation, e.g. --sd mB=1.5 --sd trail=5mm; file: all that the file gives "
    "and no other --sd does.",
)  # fmt: skip
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON instead of a table.")


def load_bicycle(name: str, delta: float | None, *, warned: bool = True) -> Bicycle:
    """The bicycle that --bicycle and --delta name; its warnings go to stderr, if they shall."""
    from bikestab.presets import preset_names

    if delta is not None and delta < 0:
        raise click.BadParameter(f"{delta:g} is negative; allowed: 0 and above", param_hint="--delta")
    if "," in name and all(part.strip() in preset_names() for part in name.split(",")):
        problem = f"{name!r} is a list; give --bicycle once for each, where a command takes several"
        raise click.BadParameter(problem, param_hint="--bicycle")
    bicycle = bicycle_named(name)
    with told_as_options():
        bicycle = with_its_rider(bicycle)
        bicycle = bicycle.with_delta(None if delta is None else delta + 0.0)  # not -0
    if warned:
        warn(bicycle)
    return bicycle


def bicycle_named(name: str) -> Bicycle:
    """A preset, the bicycle in a file, or that which a volume was computed of."""
    from bikestab.bicycle import Bicycle
    from bikestab.formats.kinds import kind_of
    from bikestab.presets import preset_names

    if name in preset_names() or kind_of(name) != "volume":
        return Bicycle.load(name)
    from bikestab.computed import computed_bicycle

    return computed_bicycle(name)


def warn(bicycle: Bicycle) -> None:
    """Tell on stderr, once, what was left out of a file, and what no rigid body can have."""
    for kind, texts in (("note", bicycle.notes), ("warning", bicycle.warnings)):
        for text in texts:
            tell_once(f"{kind}: {bicycle.name}: {text}")


def tell_which(bicycle: Bicycle, names: Collection[str]) -> None:
    """Say which of its two meanings c has in this bicycle's notation, if it is among the ``names``."""
    if "c" in names:
        meaning = bicycle.notation["c"].partition(" [")[0]
        tell_once(f"note: {bicycle.name}: c is the {meaning}")


def tell_once(line: str) -> None:
    """Print the line on stderr, unless this command did so before."""
    told: set[str] = click.get_current_context().find_root().meta.setdefault("bikestab.told", set())
    if line not in told:
        click.echo(line, err=True)
    told.add(line)


def check_files(*names: str | None) -> None:
    """Refuse files that have no folder, are read, or are asked for twice, before anything is computed."""
    from bikestab_cli.kept import check_kept

    places = [Path(name).absolute() for name in names if name]
    for name, place in zip(filter(None, names), places, strict=True):
        if places.count(place) > 1:
            raise click.UsageError(f"{name} is asked for twice", click.get_current_context())
        check_kept(name)


def check_curves(output: str | None, number: int) -> None:
    """Refuse a picture of more curves than can be told apart, before anything is computed."""
    if output and number > 1:
        from bikestab.plot.sidelabels import lines_for

        lines_for(number)


@contextmanager
def told_as_options(**others: str) -> Iterator[None]:
    """Tell of the library's mistakes in its arguments as of the options of these names, or of ``others``.

    ``x`` and ``y`` are parameters of a family, which names them itself.
    """
    try:
        yield
    except InputError as error:
        if error.place or not error.key:
            raise
        name, hint = str(error.key[0]), error.hint
        if examples := re.findall(r"(?<= )(lam|sigma)=(\S+)", hint):
            typed = [f"--{argument} {value}" for argument, value in examples]
            options = " and ".join(each.split()[0] for each in typed)
            problem = f"{error.problem}: give {options}, for example {' '.join(typed)}"
            raise click.UsageError(problem, click.get_current_context()) from None
        option, problem = others.get(name, f"--{name.replace('_', '-')}"), error.problem
        known = name in others or any(
            option in param.opts for param in click.get_current_context().command.params
        )
        if option in _OF_PARAMETERS or not known:
            problem = problem if name in ("x", "y") else f"{name}: {problem}"
        elif not hint.startswith("known: "):  # parameters, and no arguments
            for argument, its_option in others.items():
                hint = re.sub(rf"(?<![\w-]){re.escape(argument)}\b", its_option, hint)
        problem = f"{problem}; {hint}".strip("; ")
        raise click.BadParameter(problem, param_hint=option if known else None) from None


@contextmanager
def of_file(name: str) -> Iterator[None]:
    """Tell of the library's mistakes, unless they have a place, as of ones in this file."""
    try:
        yield
    except InputError as error:
        raise error.at(name) from None
