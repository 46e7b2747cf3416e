"""From a config to its volume and pictures, and from a path to an open volume."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from bikestab.config.file import load_config
from bikestab.config.scanconfig import ScanConfig
from bikestab.errors import InputError
from bikestab.scanning.run import run_scan
from bikestab.volume import Volume


class Scan(NamedTuple):
    """A scan that is done: its files, and how many points of its grid are stable.

    ``computed`` is False where the volume of this config was there already.

    >>> import bikestab as bs
    >>> bs.Scan._fields
    ('path', 'pictures', 'computed', 'points', 'stable_points')
    """

    path: Path
    pictures: tuple[Path, ...]
    computed: bool
    points: int
    stable_points: int

    def open(self) -> Volume:
        """The volume, open for reading."""
        return Volume(self.path)


def scan(
    config: str | Path | ScanConfig,
    overrides: Sequence[str] = (),
    *,
    force: bool = False,
    jobs: int | None = None,
    scheduler: str = "",
    progress: Callable[[int, int], None] = lambda done, points: None,
) -> Scan:
    """Evaluate a grid and draw its pictures, as the command ``bikestab scan`` does.

    The output folder, from the current one, gets ``volume.h5``, ``region.png`` and a picture for each of the
    config's ``slices``. A volume of the same config that is there already is kept and only its pictures are
    drawn; a scan that was stopped goes on where it was.

    Parameters
    ----------
    config : path or ScanConfig
        The YAML file. Paths in it start from its folder.
    overrides : sequence of str
        Values put over those of the file, such as ``"grid.V.num=61"``, as with ``--set``.
    force : bool
        Replace the output of another config, or compute again.
    jobs : int, optional
        How many processes compute; by default one for each core, if there is work for them.
    scheduler : str
        Address of a Dask scheduler, ``"tcp://HOST:PORT"``, or ``"local:N"`` for N processes of its own. Needs
        the extra ``cluster``.
    progress : callable
        Called now and then with the number of points done so far, and of all.

    Returns
    -------
    Scan
        ``path`` of the volume, ``pictures``, ``computed``, ``points``, ``stable_points``, and ``open()``,
        which opens the volume. A picture that cannot be drawn is a Python warning.

    Raises
    ------
    InputError
        For a mistake in the config (it names file, line, key and what is allowed), and for an output that
        belongs to another config, cannot be written, or would be too large.
    ScanError
        Where the disk is full, a worker is lost, or the exact speeds and the conditions do not agree. What is
        finished is kept.

    Notes
    -----
    The grid is that of the conditions (2.2) of Dikarev, Dikareva and Fufaev (1981); docs/format.md describes
    the volume.

    Examples
    --------
    >>> import bikestab as bs
    >>> done = bs.scan("configs/quick.yaml", ["grid.V.num=11", "slices=[]", "output=out/few"])
    >>> done.path.as_posix(), done.points, [picture.name for picture in done.pictures]
    ('out/few/volume.h5', 10571, ['region.png'])
    >>> with done.open() as volume:
    ...     int(volume.read("stable").sum()) == done.stable_points
    True
    """
    from bikestab.plot.pictures import draw_pictures  # matplotlib takes half a second

    place = "" if isinstance(config, ScanConfig) else str(config)
    loaded = config if isinstance(config, ScanConfig) else load_config(config, overrides)
    try:
        done = run_scan(loaded, force=force, jobs=jobs, scheduler=scheduler, progress=progress)
    except InputError as error:
        raise error.at(place) from None
    pictures = draw_pictures(loaded, done.path, _warn)
    return Scan(done.path, tuple(pictures), done.computed, done.points, done.stable_points)


def open_volume(path: str | Path) -> Volume:
    """Open what a scan has written.

    Parameters
    ----------
    path : path
        A ``volume.h5``, or its folder.

    Returns
    -------
    Volume
        To be used as a context manager, or closed with ``close()``. ``to_xarray()`` gives an
        ``xarray.Dataset``, ``read(name)`` an array, ``at({"delta": 1})`` one machine of a sweep.

    Raises
    ------
    InputError
        For a file that is no volume, incomplete, damaged, or being written.

    Notes
    -----
    docs/format.md lists what is in it, with shapes and units.

    Examples
    --------
    >>> import bikestab as bs
    >>> done = bs.scan("configs/quick.yaml", ["grid.V.num=11", "slices=[]", "output=out/few"])
    >>> with bs.open_volume("out/few") as volume:
    ...     volume.bicycle.name, volume.fields, volume.read("V1").shape
    ('dikarev1981', ['stable', 'violated', 'growth_rate'], (31, 31, 1))
    """
    return Volume(path)


def _warn(text: str) -> None:
    warnings.warn(text.removeprefix("warning: "), stacklevel=2)
