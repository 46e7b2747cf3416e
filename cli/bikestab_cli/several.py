"""The options that name several machines: --bicycle more than once, and --set with several values."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import click
from bikestab_cli.completion import parameters
from bikestab_cli.options import BICYCLE, DEFAULT_BICYCLE, equation_options, load_bicycle, tell_which, warn
from bikestab_cli.output import as_read
from bikestab_cli.parameters import parameter

from bikestab.errors import InputError
from bikestab.units import bare_among

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle

F = TypeVar("F", bound=Callable[..., Any])
Values = dict[str, list[float]]
MOST_MACHINES = 1000
MOST_DIGITS = 17  # that tell all doubles apart
FEWEST_DIGITS = 4  # of a value in a picture; tables have six, and both more where it takes more


class Chosen(NamedTuple):
    """A machine, and the parameters that --set gives it."""

    bicycle: Bicycle
    set: dict[str, float]
    digits: int = FEWEST_DIGITS  # that tell its values from those of the others

    @property
    def changes(self) -> str:
        """What is set, in words."""
        digits = max(self.digits, 6)
        values = [(name, *as_read(name, value, "")) for name, value in self.set.items()]
        return " ".join(f"{name}={x:.{digits}g}{'deg' if unit else ''}" for name, x, unit in values)

    @property
    def words(self) -> str:
        """What tells it from the others."""
        return f"{self.bicycle.name} {self.changes}".strip()

    @property
    def stacked(self) -> str:
        """The same in a table's cell."""
        return f"{self.bicycle.name}\n{self.changes}".strip()


def told_apart(machines: Sequence[Chosen]) -> tuple[str, list[str]]:
    """What machines have in common that a picture's title says, and what tells each from the others there."""
    names = {machine.bicycle.name for machine in machines}
    if len(machines) > 1 and len(names) == 1 and all(machine.set for machine in machines):
        return names.pop(), [with_units(machine) for machine in machines]
    return "", [machine.words for machine in machines]


def with_units(machine: Chosen) -> str:
    """What is set, for a picture."""
    from bikestab.variants import FRONT, parameter_of

    known = {**machine.bicycle.notation, **FRONT}
    units = {name: parameter_of(machine.bicycle, name).unit for name in machine.set if name in known}
    digits = machine.digits
    values = [(name, *as_read(name, value, units.get(name, ""))) for name, value in machine.set.items()]
    parts = (f"{name} = {value:.{digits}g} {unit}" for name, value, unit in values)
    return ", ".join(part.removesuffix(" 1").strip().replace(" °", "°") for part in parts)


def _values(_: click.Context, option: click.Parameter, texts: tuple[str, ...]) -> Values:
    values: Values = {}
    for text in texts:
        name, equals, numbers = text.partition("=")
        name = name.strip()
        if not equals or not name:
            raise click.BadParameter(f"{text!r} is not NAME=VALUE, e.g. mB=60,75,100", param=option)
        if name in values:
            raise click.BadParameter(f"{name} is set twice", param=option)
        try:
            values[name] = [parameter(name, number) for number in numbers.split(",")]
        except InputError as error:
            raise click.BadParameter(f"{text!r}: {error.problem}; {error.hint}", param=option) from None
        if note := bare_among(numbers.split(",")):
            click.echo(f"note: {note} ({text})", err=True)
        if twice := [x for x, number in Counter(values[name]).items() if number > 1]:
            raise click.BadParameter(f"{name}={twice[0]:g} is given twice in {text!r}", param=option)
    return values


def digits_of(changes: Values) -> int:
    """How many digits tell all values of each parameter apart."""
    for digits in range(FEWEST_DIGITS, MOST_DIGITS):
        texts = {
            name: {f"{as_read(name, x, '')[0]:.{digits}g}" for x in values}
            for name, values in changes.items()
        }
        if all(len(texts[name]) == len({*values}) for name, values in changes.items()):
            return digits
    return MOST_DIGITS


def several_machines(function: F) -> F:
    """--bicycle and --set, each more than once, --model and --delta."""
    named = click.option(
        "--bicycle", "bicycle_name", type=BICYCLE, metavar="NAME|FILE", multiple=True,
        default=(DEFAULT_BICYCLE,), show_default=True,
        help="A bicycle that comes with bikestab (see 'bikestab bicycles'), a file of one, or a volume; "
        "several.",
    )  # fmt: skip
    changed = click.option(
        "--set", "changes", metavar="NAME=VALUE,...", multiple=True, callback=_values,
        shell_complete=parameters,
        help="Other values of a parameter in the bicycle's notation, e.g. mB=60,75,100 or rider.m=60,100; of "
        "several --set, every combination; c is the trail among the 25 parameters, the wheelbase in the "
        "paper's notation.",
    )  # fmt: skip
    return named(changed(equation_options(function)))


def machines_chosen(
    names: tuple[str, ...], delta: float | None, changes: Values, given: Collection[str] = ()
) -> list[Chosen]:
    """Every bicycle with every combination of the values that are set, unless options have ``given`` them."""
    combinations = list(product(*changes.values()))
    if len(names) * len(combinations) > MOST_MACHINES:
        problem = f"{len(names) * len(combinations)} machines are too many; allowed: {MOST_MACHINES}"
        raise click.UsageError(problem, click.get_current_context())
    if twice := [name for i, name in enumerate(names) if name in names[:i]]:
        raise click.BadParameter(f"{twice[0]} is given twice; give it once", param_hint="--bicycle")
    machines = []
    for own in _told_apart(names, [load_bicycle(name, delta, warned=False) for name in names]):
        _check_once(own, changes, given if delta is None else [*given, "delta"])
        tell_which(own, changes)
        for combination in combinations:
            values = dict(zip(changes, combination, strict=True))
            try:
                bicycle = own.replaced(values) if values else own
            except InputError as error:
                problem = f"{error.key[0] if error.key else ', '.join(values)}: {error.problem}; {error.hint}"
                if "rider.m" not in own.given and any(key.startswith("rider.") for key in values):
                    problem = f"{own.name} has no rider apart; its file needs one under rider:"
                    problem += " (see 'bikestab convert --rider')"
                raise click.BadParameter(problem, param_hint="--set") from None
            warn(bicycle)
            machines.append(Chosen(bicycle, values, digits_of(changes)))
    return machines


def _told_apart(names: Sequence[str], bicycles: Sequence[Bicycle]) -> list[Bicycle]:
    """The bicycles that ``names`` stand for; where several have one name, their files go with it."""
    number = Counter(each.name for each in bicycles)
    return [
        each if number[each.name] == 1 or name == each.name else each.named(f"{each.name} ({name})")
        for name, each in zip(names, bicycles, strict=True)
    ]


def check_varied(
    bicycle: Bicycle, over: Collection[str], changes: Collection[str], delta: float | None
) -> None:
    """Refuse to vary what --set or --delta fixes."""
    from bikestab.variants import fixed_by, front_of

    fixed = fixed_by(bicycle, over)
    for name, option in [
        *((name, "--set") for name in changes),
        *([] if delta is None else [("delta", "--delta")]),
    ]:
        if name in over or ((front := front_of(bicycle, name)) and fixed.get(front)):
            raise click.BadParameter(
                f"{option} fixes {name}, which varies; give one of them", param_hint="--over"
            )


def _check_once(bicycle: Bicycle, changes: Collection[str], given: Collection[str]) -> None:
    """Refuse what --set and an option both say: the tilt, the trail, the offset, the damping."""
    from bikestab.variants import fixed_by, front_of

    fixed = fixed_by(bicycle, given)
    for name in changes:
        front = front_of(bicycle, name)
        other = fixed.get(front, "") if front else name if name in given else ""
        if other:
            problem = f"{name} is set, and --{other.replace('_', '-')} fixes it too; give one of them"
            raise click.BadParameter(problem, param_hint="--set")


def record_of(
    machines: Sequence[Chosen], model: str, results: Sequence[Sequence[Mapping[str, Any]]],
    files: Mapping[str, str] | None = None, ranges: Sequence[Sequence[Mapping[str, Any]]] | None = None,
) -> dict[str, Any]:  # fmt: skip
    """What --json prints of machines and the results of each: docs/json.md has the shape.

    Of several machines, and of one with other values, each result tells which it is of, and each of the
    ``ranges`` of a parameter.
    """
    several = len(machines) > 1 or machines[0].set

    def listed(parts: Sequence[Sequence[Mapping[str, Any]]]) -> list[dict[str, Any]]:
        whose = [{"bicycle": each.bicycle.name, "set": each.set} if several else {} for each in machines]
        return [{**one, **part} for one, own in zip(whose, parts, strict=True) for part in own]

    bicycles = [each.bicycle for each in machines]
    names, deltas = ([*dict.fromkeys(x)] for x in ([b.name for b in bicycles], [b.delta for b in bicycles]))
    return {
        "bicycle": names[0] if len(names) == 1 else names,
        "model": model,
        "delta": deltas[0] if len(deltas) == 1 else deltas,
        **({} if ranges is None else {"ranges": listed(ranges)}),
        "results": listed(results),
        **({"files": dict(files)} if files else {}),
    }
