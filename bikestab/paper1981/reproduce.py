"""The 1981 paper as an executable document: all computations, figures, report.json and report.md."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path

from matplotlib.figure import Figure

from bikestab.aside import meanwhile
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

    def other_half() -> tuple[Others, dict[str, bytes]]:
        numbers = others(bicycle, sampling, lambda words: None)
        return numbers, _drawn(draw_others(bicycle, sampling, numbers))

    with meanwhile(other_half) as other:
        one = undamped(bicycle, sampling, progress)
        progress("figures")
        figures = _drawn(draw_undamped(bicycle, sampling, one))
        progress("conclusion 4, other readings of the printed values and a motorcycle")
        two, more = other()
    figures |= more
    return joined(bicycle, sampling, one, two), {name: figures[name] for name in FIGURES}


def _drawn(figures: Iterator[tuple[str, Figure]]) -> dict[str, bytes]:
    return {name: drawn(figure) for name, figure in figures}


def draw_undamped(bicycle: Bicycle, sampling: Sampling, numbers: Undamped) -> Iterator[tuple[str, Figure]]:
    """Names and figures, one at a time, of conclusions 1 and 3, whose curves and search are numbers too."""
    examples = [(e.lam, e.sigma) for e in numbers.finite.counterexamples]
    yield "conclusion1.png", pictures.draw_kinds(bicycle, examples, sampling.picture)
    wanted = whole_box(bicycle)
    best = searched(wanted, sampling.search)
    yield "conclusion3.png", draw_designs(wanted, best, box_curves(bicycle, sampling.picture))


def draw_others(bicycle: Bicycle, sampling: Sampling, numbers: Others) -> Iterator[tuple[str, Figure]]:
    """The other names and figures."""
    mesh = region_mesh(Family(bicycle), LAM, SIGMA, V, cells=sampling.cells)
    yield "machine.png", pictures.draw_machine(bicycle, *TABLE[0])
    yield "figure3.png", pictures.draw_sections(bicycle, sampling.picture)
    yield "figure3_space.png", pictures.draw_space(bicycle, mesh)
    yield "refinement.png", pictures.draw_refinement(bicycle, SECTION, sampling.picture)
    yield "conclusion2.png", pictures.draw_widths(bicycle, sampling.picture)
    yield "conclusion4.png", pictures.draw_damping(bicycle, numbers.damped)


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
