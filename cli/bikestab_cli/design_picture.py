"""The picture of ``bikestab design -o``: the plane of designs, or the fronts of several machines."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click
from bikestab_cli.quantities import Ends
from bikestab_cli.several import told_apart

from bikestab.aside import meanwhile

if TYPE_CHECKING:
    from bikestab_cli.several import Chosen

    from bikestab.design.best import Best
    from bikestab.design.criteria import Wanted
    from bikestab.region.curves import Curve


def search(asked: Sequence[Wanted], output: str | None) -> tuple[list[Best], list[Curve]]:
    """The best designs of each machine, and the curves of a picture of one, which are traced meanwhile."""
    from bikestab.design.best import best_designs

    if not output or len(asked) > 1:
        return [best_designs(wanted) for wanted in asked], []
    (wanted,) = asked
    with meanwhile(partial(best_designs, wanted)) as best:
        import bikestab.plot.designs  # noqa: F401  # matplotlib takes as long as half of the search
        from bikestab.region.curves import trace

        curves = trace(wanted.family, wanted.x, wanted.y)
        return [best()], curves


def draw(found: Sequence[tuple[Chosen, Wanted, Best]], curves: Sequence[Curve], output: str) -> None:
    """Draw what was found into a file."""
    from bikestab.plot.files import save

    if len(found) > 1:
        from bikestab.plot.fronts import draw_fronts

        common, names = told_apart([machine for machine, _, _ in found])
        fronts = [(name, wanted, best) for name, (_, wanted, best) in zip(names, found, strict=True)]
        save(draw_fronts(fronts, common), Path(output))
        return
    from bikestab.plot.designs import draw_designs

    _, wanted, best = found[0]
    save(draw_designs(wanted, best, curves), Path(output))


def check_picture(lam: Ends, sigma: Ends) -> None:
    """Refuse what no picture can be made of."""
    for name, ends in (("--lam", lam), ("--sigma", sigma)):
        if ends[0] == ends[1]:
            raise click.BadParameter(
                f"a picture needs a range, not {ends[0]:g} alone; leave --output out, or give START:STOP",
                param_hint=name,
            )
