"""Draw the pictures of this folder anew: ``python docs/images/draw.py``.

They are those of the commands in the README, from grids that are small where a picture does not show it. Each
PNG keeps what it shows as text, by which the tests see whether it is current.
"""

from __future__ import annotations

import io
import json
import re
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from matplotlib.collections import Collection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.text import Text
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from bikestab.bicycle import Bicycle
from bikestab.certified import add_certified
from bikestab.config.file import load_config
from bikestab.design.best import best_designs
from bikestab.design.criteria import Wanted
from bikestab.family import Family
from bikestab.paper1981.pictures import draw_sections
from bikestab.plot.designs import draw_designs
from bikestab.plot.region import draw_region
from bikestab.plot.slices import draw_slice
from bikestab.region.curves import trace
from bikestab.scan.run import run_scan
from bikestab.volume import Volume

HERE = Path(__file__).parent
CONFIGS = HERE.parents[1] / "configs"
DPI = 180
COLOURS = 256  # of a picture: a third of the bytes, and no eye sees it


def figures() -> Iterator[tuple[str, Figure]]:
    """Every picture's file name and figure."""
    with scanned("dikarev1981.yaml", "grid.sigma.num=2") as volume:
        yield "slice_sigma_0.15.png", draw_slice(volume, "sigma", 0.15)
        yield "region.png", draw_region(volume)
    with scanned("spread.yaml", "grid.lam.num=3", "sweep={}") as volume:
        yield "probability.png", draw_slice(volume, "lam", float(volume.axis("lam")[1]), "probability")
    with scanned(
        "dikarev1981.yaml", "grid.lam.num=61", "grid.V.num=76", "grid.sigma.num=76", proved=True
    ) as volume:
        yield "certified.png", draw_slice(volume, "sigma", 0.15, "certified")
    dikarev = Bicycle.preset("dikarev1981")
    wanted = Wanted(Family(dikarev))
    yield "design.png", draw_designs(wanted, best_designs(wanted), trace(wanted.family, wanted.x, wanted.y))
    loads = load_config(CONFIGS / "loads.yaml")
    ends = (loads.grid.ends(name) for name in loads.grid.names[:2])
    wanted = Wanted(loads.family(), *ends, V_max=12)
    yield "loads.png", draw_designs(wanted, best_designs(wanted), trace(wanted.family, wanted.x, wanted.y))
    yield "figure3.png", draw_sections(dikarev, 401)


def scanned(config: str, *overrides: str, proved: bool = False) -> Volume:
    """The volume of a config, with its cells ``proved`` or not; its file is gone when it is closed."""
    with TemporaryDirectory() as folder:
        loaded = load_config(CONFIGS / config, [*overrides, "slices=[]", f"output={folder}"])
        path = run_scan(loaded).path
        if proved:
            add_certified(path, loaded.machine, loaded.model)
        return Volume(path)


def contents(figure: Figure) -> dict[str, Any]:
    """What a figure shows, apart from how a version of matplotlib sets it: words, lines and colours."""
    figure.draw_without_rendering()
    words = {text.get_text() for text in figure.findobj(Text)}
    words = {text for text in words if re.search(r"[^\W\d]", text)}  # numbers are mostly those of axes
    shown: list[list[Any]] = []
    for ax in figure.axes:
        shown += [["line", to_hex(line.get_color()), *_extent(line.get_xydata())] for line in ax.lines]
        for surface in [*ax.images, *ax.collections]:
            values = surface.get_array()
            colours = surface.get_facecolor() if isinstance(surface, Collection) else []
            data = colours if values is None else np.ma.compressed(values)
            shown.append([type(surface).__name__, *_extent(data)])
    return {"words": sorted(words), "shown": shown, "size": figure.get_size_inches().tolist()}


def _extent(values: Any) -> list[float]:
    """Least, mean and greatest of values, or of each column, to a few digits."""
    if not len(values):
        return []
    rows = np.asarray(values, dtype=float).reshape(len(values), -1)
    rows = rows[np.isfinite(rows).all(axis=1)]
    return [float(f"{x:.3g}") for f in (np.min, np.mean, np.max) for x in f(rows, axis=0)]


def save(figure: Figure, path: Path) -> None:
    """Write a picture with few colours, and what it shows."""
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=DPI)
    about = PngInfo()
    about.add_text("contents", json.dumps(contents(figure)), zip=True)
    few = Image.Quantize.MAXCOVERAGE, 3  # which keeps a star's colour
    picture = Image.open(drawn).convert("RGB").quantize(COLOURS, *few, dither=Image.Dither.NONE)
    picture.save(path, optimize=True, pnginfo=about)


if __name__ == "__main__":
    for name, figure in figures():
        save(figure, HERE / name)
