"""The 1981 paper as an executable document: all computations, figures, report.json and report.md."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable
from pathlib import Path

from matplotlib.figure import Figure

from bikestab.aside import meanwhile, turns
from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.files import unwritable, written
from bikestab.paper1981 import pictures
from bikestab.paper1981.box import FULL, LAM, SIGMA, Sampling, V
from bikestab.paper1981.maps import box_curves
from bikestab.paper1981.margin import searched, whole_box
from bikestab.paper1981.refinement import SECTION
from bikestab.paper1981.report import rendered
from bikestab.paper1981.study import (
    FIGURES,
    TABLE,
    Others,
    Progress,
    Study,
    Undamped,
    joined,
    others,
    plain,
    undamped,
)
from bikestab.plot.designs import draw_designs
from bikestab.plot.files import drawn, write
from bikestab.region.mesh import region_mesh

BICYCLE = "dikarev1981"


def reproduce(
    folder: str | Path, *, sampling: Sampling = FULL, progress: Progress = lambda words: None
) -> Study:
    """Compute, draw and judge everything; returns what is in report.json.

    Each file is complete or not there, and report.md is the last. Raises InputError for a folder that cannot
    be written, before anything is computed.
    """
    target = Path(folder)
    _prepare(target)
    numbers, figures = computed(sampling, progress)
    for name, content in figures.items():
        write(content, target / name)
    text = json.dumps(plain(numbers), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    _put(target / "report.json", text)
    _put(target / "report.md", rendered(numbers))
    return numbers


def computed(sampling: Sampling, progress: Progress) -> tuple[Study, dict[str, bytes]]:
    """The study and its figures; where there is a core for it, half of them meanwhile."""
    bicycle = Bicycle.preset(BICYCLE)
    free = figures_of_all(bicycle, sampling)

    def drawn_of(numbers: Iterable[int]) -> dict[str, bytes]:
        return _drawn(free[number] for number in numbers)

    with turns(len(free)) as numbers:

        def other_half() -> tuple[Others, dict[str, bytes]]:
            damped = others(bicycle, sampling, lambda words: None)
            return damped, _drawn(figures_of_others(bicycle, damped)) | drawn_of(numbers)

        with meanwhile(other_half) as other:
            one = undamped(bicycle, sampling, progress)
            progress("figures")
            figures = _drawn(figures_of_undamped(bicycle, sampling, one)) | drawn_of(numbers)
            progress("conclusion 4, other readings of the printed values and a motorcycle")
            two, more = other()
    figures |= more
    figures |= drawn_of(n for n, (name, _) in enumerate(free) if name not in figures)  # of one that was ended
    return joined(bicycle, sampling, one, two), {name: figures[name] for name in FIGURES}


_Named = tuple[str, Callable[[], Figure]]


def _drawn(figures: Iterable[_Named]) -> dict[str, bytes]:
    return {name: drawn(draw()) for name, draw in figures}


def figures_of_undamped(bicycle: Bicycle, sampling: Sampling, numbers: Undamped) -> list[_Named]:
    """Names and figures of conclusions 1 and 3, whose curves and search are numbers too."""
    examples = [(e.lam, e.sigma) for e in numbers.finite.counterexamples]

    def best() -> Figure:
        wanted = whole_box(bicycle)
        return draw_designs(wanted, searched(wanted, sampling.search), box_curves(bicycle, sampling.picture))

    return [
        ("conclusion1.png", lambda: pictures.draw_kinds(bicycle, examples, sampling.picture)),
        ("conclusion3.png", best),
    ]


def figures_of_others(bicycle: Bicycle, numbers: Others) -> list[_Named]:
    """The name and the figure of conclusion 4."""
    return [("conclusion4.png", lambda: pictures.draw_damping(bicycle, numbers.damped))]


def figures_of_all(bicycle: Bicycle, sampling: Sampling) -> list[_Named]:
    """Names and figures that need no numbers of the study, those that take longest first."""

    def space() -> Figure:
        return pictures.draw_space(bicycle, region_mesh(Family(bicycle), LAM, SIGMA, V, cells=sampling.cells))

    return [
        ("figure3_space.png", space),
        ("figure3.png", lambda: pictures.draw_sections(bicycle, sampling.picture)),
        ("refinement.png", lambda: pictures.draw_refinement(bicycle, SECTION, sampling.picture)),
        ("conclusion2.png", lambda: pictures.draw_widths(bicycle, sampling.picture)),
        ("machine.png", lambda: pictures.draw_machine(bicycle, *TABLE[0])),
    ]


def _prepare(folder: Path) -> None:
    """Make the folder, and see that files can be made in it."""
    probe = folder / f".{os.urandom(8).hex()}.part"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise unwritable(folder, error) from None


def _put(path: Path, text: str) -> None:
    with written(path) as part:
        part.write_text(text, "utf-8")
