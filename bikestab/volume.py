"""A volume.h5 that is complete, open for reading; docs/format.md describes it, ``writer`` writes it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Self

import h5py
import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.config import Axis
from bikestab.errors import InputError
from bikestab.model import Floats, Model
from bikestab.plan import FIELDS


class Volume:
    """A complete volume, open for reading. Raises InputError for any other file."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        if self.path.is_dir() and (self.path / "volume.h5").is_file():
            self.path = self.path / "volume.h5"
        place = str(path)
        if not self.path.is_file():
            raise InputError("there is no such volume", place=place, hint="'bikestab scan CONFIG' writes one")
        try:
            self.file = h5py.File(self.path, "r")
        except OSError:
            raise InputError("is not an HDF5 file, or a damaged one", place=place) from None
        attributes = self.file.attrs
        if "config_sha256" not in attributes or "lam" not in self.file:
            self.file.close()
            raise InputError("is an HDF5 file, but no volume of bikestab", place=place)
        if not attributes.get("complete", 0):
            self.file.close()
            raise InputError("is incomplete", place=place, hint="'bikestab scan --force' writes it again")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.file.close()

    def text(self, name: str) -> str:
        """A text attribute of the file."""
        value = self.file.attrs[name]
        return value.decode() if isinstance(value, bytes) else str(value)

    def read(self, name: str, where: tuple[int | slice, ...] = ()) -> NDArray[Any]:
        """A dataset or a part of it; InputError where the file is damaged there."""
        try:
            return self.file[name][where]
        except OSError:
            problem = f"is damaged: {name} cannot be read"
            raise InputError(problem, place=str(self.path), hint="scan again with --force") from None

    def axis(self, name: Axis) -> Floats:
        """The values of λ [rad], σ [1] or V [m/s]."""
        return self.read(name)

    @property
    def fields(self) -> list[str]:
        """The names of the (lam, sigma, V) fields in the file."""
        return [name for name in FIELDS if name in self.file]

    @property
    def bicycle(self) -> Bicycle:
        """The machine that was computed, with the damping used."""
        return Bicycle(
            **json.loads(self.text("bicycle_parameters")),
            name=self.text("bicycle"),
            source=self.text("references"),
        )

    @property
    def model(self) -> Model:
        """``refined`` or ``unrefined``."""
        return self.text("model")  # type: ignore[return-value]  # written from a Model


def parameters_text(bicycle: Bicycle) -> str:
    """The bicycle's numbers as the volume keeps them."""
    return json.dumps(bicycle.numbers())


def uniform(values: Floats) -> bool:
    """Whether an axis has equal steps, which VTK's image data needs."""
    steps = np.diff(values)
    return bool(np.allclose(steps, steps[0], rtol=1e-9, atol=0))
