"""Volumes → one HTML file with everything in it: numbers, drawing library, our own scripts and styles."""

from __future__ import annotations

import base64
import json
import re
import zlib
from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Any

from bikestab import __version__
from bikestab.errors import InputError
from bikestab.files import written
from bikestab.report.volumes import Progress, volume_records
from bikestab.volume import Volume

_MODULES = (
    "twofold", "table", "roots", "intervals", "eigenvalues", "modes", "motion", "geometry", "drawings",
    "volumes", "opening", "words", "elements", "library", "charts", "curves", "region", "labels", "controls",
    "saving", "page",
)  # fmt: skip
_IMPORT = re.compile(r'from "\./([a-z]+)\.mjs"')
CITE = (
    "E. D. Dikarev, S. B. Dikareva and N. A. Fufaev, Effect of inclination of steering axis and of stagger "
    "of the front wheel on stability of motion of a bicycle, Mechanics of Solids 16 (1981)"
)


NEEDED = InputError(
    "a page cannot be made without plotly", hint='it needs the extra: pip install "bikestab[report]"'
)


def save_page(
    volumes: Sequence[Volume], path: str | Path, progress: Progress = lambda done, machines: None
) -> int:
    """Write the page of one or more volumes; its size in bytes.

    ``progress`` is told of machines done, and of all.
    Raises InputError without the extra ``report``, as ``volume_records``, and as ``files.written``.
    """
    library = _plotly()
    text = page_text(volume_records(volumes, progress), library)
    with written(Path(path)) as part:
        part.write_text(text, encoding="utf-8", newline="\n")
    return len(text.encode())


def page_text(records: Sequence[dict[str, Any]], library: str) -> str:
    """The page of records as ``volume_records`` makes them, with the text of plotly's script."""
    about = {"version": __version__, "cite": CITE, "volumes": list(records)}
    parts = {
        "TITLE": _escaped(" · ".join(record["title"] for record in records)),
        "STYLE": _file("page.css"),
        "LIBRARY": base64.b64encode(zlib.compress(library.encode(), 9)).decode(),  # a third of its size
        "MODULES": json.dumps({"imports": {f"bikestab/{name}": _module(name) for name in _MODULES}}),
        "DATA": json.dumps(about, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c"),
    }
    return re.sub(r"\{\{([A-Z]+)\}\}", lambda found: parts[found[1]], _file("page.html"))


def _file(name: str) -> str:
    return resources.files("bikestab.report").joinpath("page", name).read_text(encoding="utf-8")


def _module(name: str) -> str:
    """A script as an address of its own, for an import map: nothing is fetched."""
    text = _IMPORT.sub(r'from "bikestab/\1"', _file(f"{name}.mjs"))
    return "data:text/javascript;base64," + base64.b64encode(text.encode()).decode()


def _plotly() -> str:
    try:
        from plotly.offline import get_plotlyjs
    except ImportError:
        raise NEEDED from None
    return str(get_plotlyjs())


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
