"""The ending of a file's name chooses its format, and some formats need a package of an extra."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from pathlib import Path

from bikestab.errors import InputError, nearest


def file_format(path: str | Path, packages: Mapping[str, str]) -> str:
    """The ending of a file's name, in small letters.

    ``packages`` maps each known ending to the package that its format needs, or "". Raises InputError for
    an unknown ending and where the package cannot be imported.
    """
    name = str(path)
    ending = Path(name).suffix.lower()
    if ending not in packages:
        known = ", ".join(packages)
        if not ending:
            raise InputError("has no ending", place=name, hint=f"it chooses the format: {known}")
        raise InputError(
            f"there is no format {ending!r} for this; known: {known}",
            place=name,
            hint=close if (close := nearest(ending, packages)).startswith("did") else "",
        )
    if packages[ending]:
        try:
            importlib.import_module(packages[ending])
        except ImportError as error:
            missing = isinstance(error, ModuleNotFoundError) and error.name == packages[ending]
            problem = 'needs the extra: pip install "bikestab[export]"'
            raise InputError(problem, place=name, hint="" if missing else str(error)) from None
    return ending
