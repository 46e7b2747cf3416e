"""The 1981 paper as an executable document: all computations, figures, report.json and report.md."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bikestab import __version__
from bikestab.bicycle import Bicycle
from bikestab.design.criteria import Wanted
from bikestab.family import Family
from bikestab.files import unwritable, written
from bikestab.model import MODELS
from bikestab.paper1981 import box as paper
from bikestab.paper1981 import claims, damping, evidence
from bikestab.paper1981.box import FULL, LAM, SIGMA, Size, V
from bikestab.paper1981.plot_claims import draw_damping, draw_kinds, draw_widths
from bikestab.paper1981.plot_sections import ARROW, FAMILIES, draw_refinement, draw_sections, draw_space
from bikestab.paper1981.readings import sensitivity
from bikestab.paper1981.refinement import refinement
from bikestab.paper1981.report import rendered
from bikestab.plot.designs import draw_designs
from bikestab.plot.files import save
from bikestab.region.curves import trace
from bikestab.region.mesh import region_mesh

BICYCLE = "dikarev1981"
SECTION = 0.3  # rad: the λ at which the two models are compared; the unrefined one comes nearest there
TABLE = ((0.20, 0.08), (0.30, 0.10), (0.05, 0.15), (0.015, 0.1475), (0.10, 0.08))  # (λ, σ)
FIGURES = {
    "figure3.png": "boundaries in (σ, V) at several λ and in (λ, V) at several σ",
    "figure3_space.png": "the region in three dimensions",
    "refinement.png": "the refined and the unrefined model side by side",
    "conclusion1.png": "which designs have an upper limit of the stable speed",
    "conclusion2.png": "the width of the interval along λ and along σ",
    "conclusion3.png": "the best designs",
    "conclusion4.png": "the boundaries against damping",
}
Numbers = dict[str, Any]
Progress = Callable[[str], None]


def reproduce(folder: str | Path, *, size: Size = FULL, progress: Progress = lambda words: None) -> Numbers:
    """Compute, draw and judge everything; returns what is in report.json.

    Each file is complete or not there, and report.md is the last. Raises InputError for a folder that cannot
    be written, before anything is computed.
    """
    target = Path(folder)
    _prepare(target)
    data = study(Bicycle.preset(BICYCLE), size, progress)
    progress("figures")
    for name, figure in _figures(data, size):
        save(figure, target / name)
    text = json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    _put(target / "report.json", text)
    _put(target / "report.md", rendered(data))
    return data


def study(bicycle: Bicycle, size: Size = FULL, progress: Progress = lambda words: None) -> Numbers:
    """All numbers of the report, and the verdicts that the rules draw from them."""
    progress("map of the stable speeds")
    found = paper.designs(bicycle, size.grid)
    progress("the refinement")
    refined = refinement(bicycle, found, size)
    progress("conclusions 1 and 2")
    first = evidence.finite_interval(bicycle, found, size)
    second = evidence.widening(found) | {
        "limits": evidence.smallest_tilt(bicycle),
        "lines": evidence.widths_along_lines(bicycle, 5 * size.picture),
    }
    progress("conclusion 3")
    third = evidence.margin(bicycle, size)
    progress("conclusion 4")
    fourth = damping.damping(bicycle, size.grid_damping) | {"single_designs": damping.single_designs(bicycle)}
    progress("other readings of the printed values")
    doubts = sensitivity(bicycle, size)
    verdicts = {
        1: claims.judge_finite(**first["judged_by"]),
        2: claims.judge_widening(second["larger_sigma_widens"], second["sigma_from"], second["reaches_zero"]),
        3: claims.judge_margin(**third["judged_by"]),
        4: claims.judge_damping(**fourth["judged_by"]),
    }
    return {
        "bikestab": __version__,
        "source": bicycle.source,
        "bicycle": {name: value for name, value in bicycle.numbers().items() if value is not None},
        "warnings": list(bicycle.warnings),
        "box": {"lam": list(LAM), "sigma": list(SIGMA), "V": list(V)},
        "sampling": size._asdict(),
        "thresholds": claims.THRESHOLDS,
        "figures": FIGURES,
        "figure3": {
            "lam": list(FAMILIES["lam"]),
            "sigma": list(FAMILIES["sigma"]),
            "arrow": [list(end) for end in ARROW],
            "table": [
                {"lam": lam, "sigma": sigma, "intervals": evidence.intervals(bicycle, lam, sigma)}
                for lam, sigma in TABLE
            ],
        },
        "refinement": {"section_lam": SECTION, **refined},
        "conclusions": {
            str(number): {
                "claim": claims.CLAIMS[number],
                "rule": claims.RULES[number],
                "verdict": verdicts[number],
                "numbers": numbers,
            }
            for number, numbers in enumerate((first, second, third, fourth), 1)
        },
        "sensitivity": doubts,
    }


def _figures(data: Numbers, size: Size) -> Any:
    """Names and figures, one at a time."""
    bicycle = Bicycle.preset(BICYCLE)
    numbers = {number: part["numbers"] for number, part in data["conclusions"].items()}
    meshes = {
        model: region_mesh(Family(bicycle, model), LAM, SIGMA, V, cells=size.cells, whole=False)
        for model in MODELS
    }
    yield "figure3.png", draw_sections(bicycle, size.picture)
    yield "figure3_space.png", draw_space(bicycle, meshes["refined"])
    yield "refinement.png", draw_refinement(bicycle, SECTION, meshes, size.picture)
    yield "conclusion1.png", draw_kinds(bicycle, numbers["1"]["counterexamples"], size.picture)
    yield "conclusion2.png", draw_widths(bicycle, evidence.SIGMAS, evidence.LAMS, size.picture)
    yield "conclusion3.png", _designs(bicycle, size)
    yield "conclusion4.png", draw_damping(bicycle, numbers["4"], numbers["4"]["single_designs"])


def _designs(bicycle: Bicycle, size: Size) -> Any:
    wanted = Wanted(Family(bicycle), LAM, SIGMA, V_max=V[1])
    best = evidence.searched(wanted, size.search)
    return draw_designs(wanted, best, trace(Family(bicycle), LAM, SIGMA, samples=size.picture))


def _prepare(folder: Path) -> None:
    """Make the folder, and see that files can be made in it."""
    probe = folder / f".{os.getpid()}.part"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise unwritable(folder, error) from None


def _put(path: Path, text: str) -> None:
    with written(path) as part:
        part.write_text(text, "utf-8")
