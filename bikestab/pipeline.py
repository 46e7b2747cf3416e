"""From a config to its volume and pictures, and from a path to an open volume."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from bikestab.aside import meanwhile, turns
from bikestab.config.file import load_config
from bikestab.config.scanconfig import ScanConfig
from bikestab.errors import InputError
from bikestab.files import written
from bikestab.scan.output import check_size
from bikestab.volume import Volume

if TYPE_CHECKING:
    from bikestab.scan.run import Progress

MOST_DRAWN = 8  # machines of a sweep whose pictures are drawn


class Drawn(NamedTuple):
    """Pictures by their names, as the contents of files, and what is to be told.

    None is the content of one that only the volume has.
    """

    files: dict[str, bytes | None]
    told: list[str]


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
    config: str | Path | ScanConfig, overrides: Sequence[str] = (), *, force: bool = False,
    jobs: int | None = None, scheduler: str = "", progress: Progress = lambda done, points: None,
) -> Scan:  # fmt: skip
    """Evaluate a grid and draw its pictures, as the command ``bikestab scan`` does; what is there is kept.

    Parameters
    ----------
    config : path or ScanConfig
        The YAML file.
    overrides : sequence of str
        Values put over the file's, such as ``"grid.V.num=61"``.
    force : bool
        Replace the output of another config, or compute again.
    jobs, scheduler : int, str, optional
        How many processes compute, by default one for each core if there is work for them; or a Dask
        scheduler's address, or ``"local:N"`` (extra ``cluster``).
    progress : callable
        Called now and then with the points done so far, and all.

    Returns
    -------
    Scan
        Its files, and ``open()``, which opens the volume. What cannot be drawn is a Python warning.

    Raises
    ------
    InputError, ScanError
        For mistakes in the config, an output that is another's, a full disk, a check that fails.

    Notes
    -----
    Conditions (2.2) of Dikarev, Dikareva and Fufaev (1981); docs/format.md describes the volume.

    Examples
    --------
    >>> import bikestab as bs
    >>> done = bs.scan("configs/quick.yaml", ["grid.V.num=11", "slices=[]", "output=out/few"])
    >>> done.path.as_posix(), done.points, [picture.name for picture in done.pictures]
    ('out/few/volume.h5', 10571, ['region.png'])
    """
    loaded, place = _loaded(config, overrides, jobs and scheduler)
    try:
        check_size(loaded)
        with drawing(loaded) as pictures:
            from bikestab.scan.run import run_scan

            done = run_scan(loaded, force=force, jobs=jobs, scheduler=scheduler, progress=progress)
            drawn = pictures()
    except InputError as error:
        raise error.at(place) from None
    paths = write_pictures(loaded, done.path, drawn, _warn)
    if not done.computed:  # it may have proofs, which are drawn again too
        paths += write_proofs(loaded, done.path)
    return Scan(done.path, tuple(paths), done.computed, done.points, done.stable_points)


@contextmanager
def drawing(config: ScanConfig) -> Iterator[Callable[[], Drawn | None]]:
    """Begin with a scan's pictures, meanwhile if there is a core for it; the function draws what is left.

    It gives None for more machines than are drawn, which need no matplotlib.
    """
    if len(config.members) > MOST_DRAWN:
        yield lambda: None
        return
    count = len(config.members) * (1 + 2 * len(config.slices))  # of pictures, at most

    def joined(mine: dict[int, Drawn], others: dict[int, Drawn]) -> Drawn:
        done = mine | others
        done |= _drawn(config, (n for n in range(count) if n not in done))  # of a process that was ended
        every = Drawn({}, [])
        for _, one in sorted(done.items()):
            every.files.update(one.files)
            every.told.extend(one.told)
        return every

    with turns(count) as numbers, meanwhile(partial(_drawn, config, numbers)) as others:
        yield lambda: joined(_drawn(config, numbers), others())


def write_pictures(
    config: ScanConfig, path: str | Path, drawn: Drawn | None, tell: Callable[[str], None]
) -> list[Path]:
    """Write pictures beside the volume at ``path``; ``tell`` is called with what could not be drawn."""
    if drawn is None:
        values = " ".join(f"--at {name}={value:g}" for name, value in config.members[0].values.items())
        x, _, _ = config.grid.names
        plane = "--lam VALUE" if x == "lam" else f"--at {x}=VALUE"
        tell(
            f"note: pictures of {len(config.members)} machines are not drawn; draw one with, for example, "
            f"'bikestab slice {path} {plane} {values}'"
        )
        return []
    for words in drawn.told:
        tell(words)
    files = drawn.files
    if None in files.values():
        from bikestab.plot.pictures import draw_from_volume  # matplotlib takes half a second

        files = {**files, **draw_from_volume(config, path)}
    return _written(path, {name: content for name, content in files.items() if content is not None})


def write_proofs(config: ScanConfig, path: str | Path) -> list[Path]:
    """Write pictures of what is proved in the config's planes beside the volume, if anything is."""
    with Volume(path) as volume:
        if not config.slices or "certified" not in volume.file:
            return []
        from bikestab.plot.pictures import draw_proofs  # matplotlib takes half a second

        return _written(path, draw_proofs(config, volume))


def _written(volume: str | Path, files: Mapping[str, bytes]) -> list[Path]:
    """Write files beside a volume; their paths."""
    paths = {Path(volume).parent / name: content for name, content in files.items()}
    for path, content in paths.items():
        with written(path) as part:
            part.write_bytes(content)
    return list(paths)


def _drawn(config: ScanConfig, numbers: Iterable[int]) -> dict[int, Drawn]:
    """Pictures by their numbers."""
    done = {}
    for number in numbers:
        from bikestab.plot.pictures import draw_without_volume  # not where there is nothing left to draw

        done[number] = Drawn(*draw_without_volume(config, number))
    return done


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


def _loaded(config: str | Path | ScanConfig, overrides: Sequence[str], both: Any) -> tuple[ScanConfig, str]:
    """The config, and where it is from; InputError where one argument would leave another unheeded."""
    if both:
        raise InputError("jobs is for this machine, scheduler for a cluster", hint="give one of them")
    if not isinstance(config, ScanConfig):
        return load_config(config, overrides), str(config)
    if overrides:
        raise InputError("overrides are for a file", hint="give the config as it is to be")
    return config, ""


def _warn(text: str) -> None:
    warnings.warn(text.removeprefix("warning: "), stacklevel=2)
