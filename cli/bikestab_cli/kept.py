"""Files that no output may replace: the command's own inputs, configs, bicycles and volumes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import click

from bikestab.errors import InputError
from bikestab.files import check_writable


def check_kept(name: str) -> None:
    """Refuse what cannot be written, what the command reads, and what another command would read."""
    check_writable(name)
    if not Path(name).is_file():
        return
    hint = "give another file to write"
    place = os.path.realpath(name)
    if any(os.path.realpath(each) == place or Path(each).samefile(place) for each in _inputs()):
        raise InputError("is read by this command, and would be replaced", place=name, hint=hint)
    from bikestab.formats.kinds import KINDS, kind_of

    kind = kind_of(name)
    text = Path(name).suffix.lower() in (".yaml", ".yml") or kind in ("config", "bicycle", "rider")
    if kind == "volume" or (text and not _is_output(name)):
        what = KINDS[kind][0] if kind else "YAML"
        raise InputError(f"is {what}, and would be replaced", place=name, hint=hint)


def _inputs() -> Iterator[str]:
    """The files that the arguments and options of this command name, those of volumes' folders too."""
    from bikestab_cli.options import Name

    context = click.get_current_context()
    for param in context.command.params:
        if param.name == "rider" or (isinstance(param.type, Name) and "file" not in param.type.of):
            value = context.params.get(param.name) or context.meta.get(f"bikestab.{param.name}") or ()
            for each in (value,) if isinstance(value, str) else value:
                yield from (str(path) for path in (Path(each), Path(each, "volume.h5")) if path.is_file())


def _is_output(name: str) -> bool:
    """Whether a text is a page, XML or JSON, which commands write."""
    with Path(name).open("rb") as file:
        return file.read(64).lstrip()[:1] in (b"<", b"{")
