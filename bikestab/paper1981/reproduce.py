"""The 1981 paper as an executable document: all computations, figures, report.json and report.md."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path

from matplotlib.figure import Figure

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.files import unwritable, written
from bikestab.paper1981 import pictures
from bikestab.paper1981.box import FULL, LAM, SIGMA, Sampling, V
from bikestab.paper1981.maps import box_curves
from bikestab.paper1981.margin import searched, whole_box
from bikestab.paper1981.refinement import SECTION
from bikestab.paper1981.report import rendered
from bikestab.paper1981.study import TABLE, Progress, Study, plain, study
from bikestab.plot.designs import draw_designs
from bikestab.plot.files import save
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
    numbers = study(Bicycle.preset(BICYCLE), sampling, progress)
    progress("figures")
    for name, figure in draw_all(numbers, sampling):
        save(figure, target / name)
    text = json.dumps(plain(numbers), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    _put(target / "report.json", text)
    _put(target / "report.md", rendered(numbers))
    return numbers


def draw_all(numbers: Study, sampling: Sampling) -> Iterator[tuple[str, Figure]]:
    """Names and figures, one at a time."""
    bicycle = Bicycle.preset(BICYCLE)
    mesh = region_mesh(Family(bicycle), LAM, SIGMA, V, cells=sampling.cells)
    samples, conclusions = sampling.picture, numbers.conclusions
    yield "machine.png", pictures.draw_machine(bicycle, *TABLE[0])
    yield "figure3.png", pictures.draw_sections(bicycle, samples)
    yield "figure3_space.png", pictures.draw_space(bicycle, mesh)
    yield "refinement.png", pictures.draw_refinement(bicycle, SECTION, samples)
    examples = [(e.lam, e.sigma) for e in conclusions.finite_interval.numbers.counterexamples]
    yield "conclusion1.png", pictures.draw_kinds(bicycle, examples, samples)
    yield "conclusion2.png", pictures.draw_widths(bicycle, samples)
    wanted = whole_box(bicycle)
    best = searched(wanted, sampling.search)
    yield "conclusion3.png", draw_designs(wanted, best, box_curves(bicycle, samples))
    yield "conclusion4.png", pictures.draw_damping(bicycle, conclusions.damping.numbers)


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
