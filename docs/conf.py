"""Sphinx: the pages of this folder, and the reference from the docstrings. Nothing is fetched from a network.

pip install ".[docs]" && sphinx-build -W --keep-going docs build/docs
"""

import re
from typing import Any

import bikestab
from bikestab.bicycle import parameters

project = "bikestab"
release = bikestab.__version__
extensions = ["myst_parser", "numpydoc", "sphinx.ext.autodoc"]
html_theme = "furo"
html_title = f"bikestab {release}"
html_copy_source = False
myst_heading_anchors = 3
numpydoc_show_class_members = False
autodoc_typehints = "none"  # the sections say it in words
autodoc_member_order = "bysource"
html_show_copyright = False


def setup(app: Any) -> None:
    """Connect what follows with the reading of pages and docstrings."""
    app.connect("source-read", without_outside_links)
    app.connect("autodoc-process-docstring", with_parameters)


def without_outside_links(_: Any, __: str, source: list[str]) -> None:
    """Take out links that leave this folder: a site has no such pages, unlike the project."""
    source[0] = re.sub(r"\[([^\]]*)\]\(\.\./[^)]*\)", r"\1", source[0])


def with_parameters(_: Any, __: str, name: str, ___: object, ____: object, lines: list[str]) -> None:
    """List the parameters of a Bicycle, which have unit and meaning beside their definition."""
    if name == "bikestab.Bicycle":
        lines += [
            "",
            *(f"- ``{p.name}`` [{p.metadata['unit']}]: {p.metadata['meaning']}" for p in parameters()),
        ]
