"""matplotlib without the user's settings: they stop no import, and change no picture."""

from __future__ import annotations

import logging
import os
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path


def import_matplotlib() -> None:
    """Import matplotlib, unless it is, where its own defaults are what it reads; the user's come after it.

    Its import ends in an error where a ``matplotlibrc``, which it looks for in the current folder too, cannot
    be read, and where MPLBACKEND is no backend, and it warns where there is no folder for its caches.
    """
    spec = find_spec("matplotlib")
    if "matplotlib" in sys.modules or not spec or not spec.origin:
        return
    logger, backend = logging.getLogger("matplotlib"), os.environ.pop("MPLBACKEND", None)
    level, wanted, data = logger.level, backend, Path(spec.origin).parent / "mpl-data"
    try:
        logger.setLevel(logging.CRITICAL)
        with warnings.catch_warnings(action="ignore"):
            with _within(data):
                import matplotlib
                import matplotlib.font_manager  # which makes its list of fonts
            with suppress(Exception):  # whatever is wrong with them, pictures of one's own tell of it
                if Path(matplotlib.matplotlib_fname()).parent != data:
                    users = dict(matplotlib.rc_params())
                    theirs = users.pop("backend")
                    wanted = wanted or theirs
                    matplotlib.rcParams.update(users)
            with suppress(ValueError):
                if isinstance(wanted, str):  # to look for one imports pyplot
                    matplotlib.rcParams["backend"] = wanted
    finally:
        logger.setLevel(level)
        if backend is not None:
            os.environ["MPLBACKEND"] = backend


@contextmanager
def own_settings() -> Iterator[None]:
    """Within it matplotlib has the settings it comes with."""
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        yield


@contextmanager
def _within(folder: Path) -> Iterator[None]:
    """Make a folder the current one, if there is a way back."""
    try:
        here = os.open(".", getattr(os, "O_PATH", os.O_RDONLY))
    except OSError:
        yield
        return
    try:
        with suppress(OSError):
            os.chdir(folder)
        yield
    finally:
        os.fchdir(here)
        os.close(here)
