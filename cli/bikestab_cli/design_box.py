"""The options of design that say what is searched, and at which speeds."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from bikestab_cli.options import over_ends_option, told_as_options
from bikestab_cli.quantities import ANGLE_ENDS, LENGTH_ENDS, SPEED_ENDS, SPEED_VALUE, TRAIL_ENDS, Ends

if TYPE_CHECKING:
    from bikestab_cli.several import Chosen

    from bikestab.design.criteria import Wanted
    from bikestab.model import Model

Speeds = tuple[float, Ends | None, Ends | None]  # up to which intervals count, where judged, stable
_FRONT = ("lam", "sigma", "trail", "head_angle", "offset")


class Box(NamedTuple):
    """Ends of tilt, trail and offset, or of the two parameters in ``over``, and speeds [m/s]."""

    lam: Ends
    sigma: Ends
    trail: Ends | None
    head_angle: Ends | None
    offset: Ends | None
    judged: Ends | None
    stable: Ends | None
    V_max: float
    over: dict[str, Ends]

    @property
    def speeds(self) -> Speeds:
        """Up to which intervals count, where decay is judged, and where all must be stable."""
        return self.V_max, self.judged, self.stable

    def checked(self) -> Box:
        """The same with tilts for head angles; UsageError for ranges that do not go together."""
        context = click.get_current_context()
        default = click.core.ParameterSource.DEFAULT
        typed = [name for name in _FRONT if context.get_parameter_source(name) != default]
        if self.over and len(self.over) != 2:
            raise click.UsageError("--over is given twice, for two parameters", context)
        if self.over and typed:
            problem = "--over says all that is searched: leave out "
            problem += "--lam, --sigma, --trail, --head-angle and --offset"
            raise click.UsageError(problem, context)
        if self.head_angle is None:
            return self
        if "lam" in typed:
            raise click.UsageError("--lam and --head-angle are one range: give one of them", context)
        from bikestab.geometry import tilt_of

        low, high = (tilt_of(angle) for angle in self.head_angle[::-1])
        return self._replace(lam=(low, high))

    @property
    def ends(self) -> dict[str, Ends]:
        """Those of the two parameters that are searched over, by their names."""
        return self.over or {"lam": self.lam, "sigma": self.sigma}

    def wanted(self, machines: Sequence[Chosen], model: Model) -> list[Wanted]:
        """What is asked of each machine."""
        from bikestab.design.criteria import Wanted
        from bikestab.family import Family

        (x, x_ends), (y, y_ends) = self.ends.items()
        named = dict.fromkeys((*self.over, "x", "y", "lam", "sigma"), "--over") if self.over else {}
        with told_as_options(judged="--V", V_max="--V-max", **named):
            return [
                Wanted(
                    Family(each.bicycle, model, x, y), x_ends, y_ends, self.trail, *self.speeds, self.offset
                )
                for each in machines
            ]

    def searched(self) -> dict[str, object]:
        """The same as JSON has it."""
        front = {"lam": self.lam, "sigma": self.sigma, "trail": self.trail, "offset": self.offset}
        V_max, judged, stable = self.speeds
        return {**(self.over or front), "V_max": V_max, "judged": judged, "stable": stable}


def box_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """What is searched and at which speeds, as one argument ``box``."""

    @functools.wraps(function)
    def command(**arguments: Any) -> Any:
        return function(box=Box(*(arguments.pop(name) for name in Box._fields)), **arguments)

    options = (
        click.option(
            "--lam", type=ANGLE_ENDS, metavar="START:STOP", default="0:0.6", show_default=True,
            help="Tilts of the steering axis, such as 10deg:25deg; one value fixes the tilt.",
        ),
        click.option(
            "--sigma", type=TRAIL_ENDS, metavar="START:STOP", default="0:0.3", show_default=True,
            help="Trails divided by the wheelbase; one value fixes the trail.",
        ),
        click.option(
            "--trail", type=LENGTH_ENDS, metavar="START:STOP", help="Trails, such as 40mm:80mm; cuts --sigma."
        ),
        click.option(
            "--head-angle", type=ANGLE_ENDS, metavar="START:STOP", help="Head angles, instead of --lam."
        ),
        click.option(
            "--offset", type=LENGTH_ENDS, metavar="START:STOP",
            help="Fork offsets, such as 0:80mm; cuts the box.",
        ),
        click.option(
            "--V", "judged", type=SPEED_ENDS, metavar="SPEED|START:STOP",
            help="Where decay is judged, at the worst of a range.  "
            "[default: at the best speed of each design]",
        ),
        click.option(
            "--stable", type=SPEED_ENDS, metavar="START:STOP",
            help="Only designs that are stable at all these speeds.",
        ),
        click.option(
            "--V-max", "V_max", type=SPEED_VALUE, metavar="SPEED", default="30", show_default=True,
            help="Intervals count up to here [m/s]; those that start above do not.",
        ),
        over_ends_option,
    )  # fmt: skip
    for option in reversed(options):
        command = option(command)
    return command
