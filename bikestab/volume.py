"""A volume.h5 that is complete, open for reading; docs/format.md describes it, ``writer`` writes it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from contextlib import suppress
from copy import copy
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.fields import FIELDS, Axes, Axis
from bikestab.formats.kinds import expected
from bikestab.hdf5 import open_file, text_of
from bikestab.layout import bicycle_of, check_ends, check_values, grid_axes, machine_names, sweep_names
from bikestab.model import Floats, Model
from bikestab.sweeps import chosen
from bikestab.volumecheck import check_volume
from bikestab.watched import watched

if TYPE_CHECKING:
    import xarray


_AGAIN = "'bikestab scan CONFIG --force' computes a volume anew"
_MOST_TOLD = 6  # volumes beside one that is not there


class Subject(Protocol):
    """What a ``Volume`` is of, and may be known before there is one."""

    @property
    def path(self) -> Path: ...
    @property
    def title(self) -> str: ...
    @property
    def family(self) -> Family: ...
    @property
    def axes(self) -> Axes: ...
    def axis(self, name: Axis) -> Floats: ...


class Volume:
    """A complete volume, open for reading. Raises InputError for any other file.

    ``swept`` has the values of each axis of a sweep by its name; ``at`` chooses one of its machines.

    >>> import bikestab as bs
    >>> with bs.scan("configs/quick.yaml", ["slices=[]", "output=out/few"]).open() as volume:
    ...     volume.axis("V")[:3], volume.read("stable", (20, 16, slice(22, 25))), volume.model
    (array([0. , 0.2, 0.4]), array([1, 1, 0], dtype=uint8), 'refined')
    """

    def __init__(self, path: str | Path) -> None:
        self.path = _found(Path(path))
        try:
            with expected("volume", self.path):
                watched(partial(check_volume, self.path))
                self.file = open_file(self.path)
        except InputError as error:
            raise _advised(error).at(str(path)) from None
        self.axes = grid_axes(self.file)
        self.swept: dict[str, Floats] = {name: self.file[name][()] for name in sweep_names(self.file)}
        self._chosen: dict[str, int] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the file; all volumes that ``at`` gave share it."""
        self.file.close()

    def text(self, name: str) -> str:
        """A text attribute of the file."""
        return text_of(self.file, name)

    def read(self, name: str, where: tuple[int | slice, ...] = ()) -> NDArray[Any]:
        """A dataset or a part of it, without the sweep's axes where a machine was chosen.

        Raises InputError where the file is damaged there, or has values that the dataset cannot have.
        """
        data, whole = self.file[name], where
        if self._chosen and data.ndim > len(self._chosen) + 1:
            where = (*self._chosen.values(), *where)
        try:
            values = data[where].astype(
                data.dtype.newbyteorder("="), copy=False
            )  # as other programs want them
        except OSError:
            problem = f"is damaged: {name} cannot be read"
            raise InputError(problem, place=str(self.path), hint=_AGAIN) from None
        try:
            check_values(name, values)
            if name in ("V1", "V2"):
                check_ends(name, values, self.read("upper", whole))
        except InputError as error:
            raise _advised(error).at(str(self.path)) from None
        return values

    def axis(self, name: Axis) -> Floats:
        """The values of one of ``axes``: λ [rad], σ [1] and V [m/s], or others in place of λ and σ."""
        return self.read(name)

    @property
    def fields(self) -> list[str]:
        """The names of the fields over the grid in the file."""
        return [name for name in FIELDS if name in self.file]

    def to_xarray(self) -> xarray.Dataset:
        """An ``xarray.Dataset`` with named axes and units; of a sweep the chosen machine, or all.

        Values are read when they are needed. The dataset has the file open by itself, until its ``close()``.
        Raises InputError without the extra ``xarray``.
        """
        try:
            import h5netcdf  # noqa: F401  # the engine below
            import xarray
        except ImportError:
            hint = 'it needs the extra: pip install "bikestab[xarray]"'
            raise InputError("cannot be opened with xarray", place=str(self.path), hint=hint) from None
        data = xarray.open_dataset(self.path, engine="h5netcdf")
        return data.isel({name: number for name, number in self._chosen.items() if name in data.dims})

    def at(self, values: Mapping[str, float]) -> Volume:
        """The volume of one machine of the sweep, at these values of its axes; itself without a sweep.

        Raises InputError for an unknown or missing axis, and for a value that it does not have.
        """
        machine = copy(self)
        machine._chosen = {**self._chosen, **chosen(self.swept, values, str(self.path))}
        return machine

    @property
    def chosen(self) -> bool:
        """Whether one machine of a sweep was chosen."""
        return bool(self._chosen)

    @property
    def samples(self) -> int:
        """How many machines its ensemble has; 0 without one."""
        return int(self.file.attrs.get("ensemble_samples", 0))

    @property
    def title(self) -> str:
        """The title, and what tells the chosen machine from the others."""
        values = ", ".join(f"{name} = {self.swept[name][i]:g}" for name, i in self._chosen.items())
        return self.text("title") + (f" ({values})" if values else "")

    @property
    def bicycle(self) -> Bicycle:
        """The machine that was computed, with the damping used; of a sweep the chosen one."""
        numbers = json.loads(self.text("bicycle_parameters"))
        if self._chosen:
            row = self.file["machine"][tuple(self._chosen.values())].tolist()
            names = machine_names(self.file["machine"])
            numbers = {
                name: None if np.isnan(value) else value for name, value in zip(names, row, strict=True)
            }
        try:
            return bicycle_of(numbers, self.text("bicycle"), self.text("references"))
        except InputError as error:
            raise error.at(str(self.path), under=("machine",)) from None

    @property
    def family(self) -> Family:
        """The designs that the grid has of the machine."""
        x, y, _ = self.axes
        return Family(self.bicycle, self.model, x, y)

    @property
    def model(self) -> Model:
        """``refined`` or ``unrefined``."""
        return self.text("model")  # type: ignore[return-value]  # written from a Model


def _found(path: Path) -> Path:
    """The file of a volume, told by its own name or by its folder's; InputError where there is none."""
    if path.is_dir() and (path / "volume.h5").is_file():
        return path / "volume.h5"
    if path.is_file():
        return path
    folder = path if path.is_dir() else path.parent
    if (folder / "volume.h5.tiles").exists():
        hint = "'bikestab scan CONFIG' goes on where it was stopped"
        raise InputError("holds a scan that is not finished", place=str(path), hint=hint)
    raise InputError("there is no such volume", place=str(path), hint=_elsewhere(path))


def _elsewhere(path: Path) -> str:
    """Which volumes are in the folder, or beside what is not there; how to make one where none is."""
    near = path.with_name(f"{path.name}.h5") if path.name else path
    folder = path if path.is_dir() else path.parent
    names: list[str] = []
    with suppress(OSError, ValueError):
        there = (p for p in folder.glob("*/volume.h5") if p.is_file())
        names = [str(near)] if near.is_file() else sorted(str(p.parent) for p in islice(there, _MOST_TOLD))
    if not names:
        return "'bikestab scan CONFIG' writes one"
    return f"did you mean {names[0]!r}?" if len(names) == 1 else f"volumes there: {', '.join(names)}"


def _advised(error: InputError) -> InputError:
    """With what to do about it, whatever is wrong with a volume."""
    return InputError(error.problem, key=error.key, hint=error.hint or _AGAIN, place=error.place)


def parameters_text(family: Family) -> str:
    """The bicycle's numbers as the volume keeps them."""
    return json.dumps(family.kept)


def check_ranges(subject: Subject, names: Iterable[Axis], what: str) -> None:
    """Raise InputError where one of these axes has a single value, which ``what`` cannot be made of."""
    for name in names:
        if len(subject.axis(name)) == 1:
            problem = f"has one value of {name} alone, and {what} needs a range"
            hint = f"scan with several, such as grid.{name}: {{start: ..., stop: ..., num: ...}}"
            raise InputError(problem, place=str(subject.path), hint=hint)


def uniform(values: Floats) -> bool:
    """Whether an axis has equal steps, which VTK's image data needs."""
    steps = np.diff(values)
    return bool(len(steps) and np.allclose(steps, steps[0], rtol=1e-9, atol=0))
