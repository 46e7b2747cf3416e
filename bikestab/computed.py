"""A volume → the bicycle that it was computed of, in the notation in which its config gives that."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.volume import Volume

_LOST = "the file that the volume's config names is not there, or another: only the two parts are known"


def computed_bicycle(path: str | Path) -> Bicycle:
    """The bicycle of a volume's config, with the damping that was used; of a sweep, before what that changes.

    Where the config names a file, this is looked for from the current folder and from the volume's; what is
    found must have the numbers that the volume keeps. Else the bicycle is that of these numbers, and
    its name and notes say so. Raises InputError for what is no volume.
    """
    from bikestab.config.file import bicycle_in  # a bicycle alone needs no pydantic

    with Volume(path) as volume:
        stored, text = volume.bicycle, volume.text("config")
        folder = volume.path.parent
    for place in (Path(), folder):
        with suppress(InputError):
            given = bicycle_in(text, place)
            if given.numbers() == stored.numbers():
                return given
    if stored.bodies is not None:
        return stored
    named = stored.named(f"{stored.name} (two parts)")
    return named.measured({}, {}, (_LOST,))
