"""Pictures as files: their names and formats."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bikestab.errors import InputError, nearest
from bikestab.files import PICTURES, written
from bikestab.plot.letters import make_drawable
from bikestab.plot.png import png
from bikestab.plot.settings import own_settings
from bikestab.plot.ticks import plain_numbers

DPI = 210
_UNITS = {
    "lam": (("deg", math.pi / 180),),
    "head_angle": (("deg", math.pi / 180),),
    "V": (("kmh", 1 / 3.6),),
}
_UNDATED: dict[str, dict[str, None]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}


def save(figure: Figure, path: Path) -> None:
    """Write the picture, whole or not at all, in the format of the file's ending.

    Raises InputError for an ending that is none of a picture and where the file cannot be written, ScanError
    where the disk is full.
    """
    if path.suffix.lower() not in PICTURES:
        meant = nearest(path.suffix[1:].lower(), [ending[1:] for ending in PICTURES])
        hint = meant if meant.startswith("did") else f"allowed: {', '.join(PICTURES)}"
        raise InputError("has no ending of a picture", place=str(path), hint=hint)
    write(drawn(figure, path.suffix[1:].lower()), path)


@own_settings()
def drawn(figure: Figure, ending: str = "png") -> bytes:
    """The picture as a file's content; some formats end in errors of their own where a disk is full."""
    plain_numbers(figure)
    make_drawable(figure)
    if (
        ending == "png"
    ):  # matplotlib's own draws every figure twice, and takes longer to compress it than to draw
        figure.set_dpi(DPI)
        canvas = FigureCanvasAgg(figure)
        canvas.draw()  # type: ignore[no-untyped-call]  # matplotlib's stubs leave these two without types
        return png(np.asarray(canvas.buffer_rgba()), DPI)  # type: ignore[no-untyped-call]  # as above
    picture = io.BytesIO()
    with rc_context({"svg.hashsalt": "bikestab"}):  # which names its clips at random else
        figure.savefig(picture, format=ending, dpi=DPI, metadata=_UNDATED.get(ending))
    return picture.getvalue()


def write(content: bytes, path: Path) -> None:
    """Write a file's content, whole or not at all; errors as ``save`` raises them."""
    with written(path) as part:
        part.write_bytes(content)


def slice_name(planes: Mapping[str, float], field: str = "growth_rate") -> str:
    """The file name of a slice's picture: its plane, and the machine of a sweep.

    No two have one name that differ by more than rounding, as 0.39749999999999996 and 0.3975 do. What is a
    round number of degrees or kilometres per hour alone is one in the name.
    """
    words = ["slice" if field == "growth_rate" else field]
    for name, value in planes.items():
        words += [name, _spelt(name, float(value))]
    return "_".join(words) + ".png"


def _spelt(name: str, value: float) -> str:
    for unit, size in (("", 1.0), *_UNITS.get(name, ())):
        short = f"{value / size:.6g}"
        if math.isclose(float(short) * size, value, rel_tol=1e-14):
            return short + unit
    return repr(value)
