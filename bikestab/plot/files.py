"""Pictures as files: their names and formats."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from bikestab.errors import InputError, ScanError, nearest


def save(figure: Figure, path: Path) -> None:
    """Write the picture in the format of the file's ending."""
    try:
        figure.savefig(path, dpi=160)
    except OSError as error:
        if error.errno == 28:
            raise ScanError(f"{path}: the disk is full") from None
        raise InputError(f"cannot be written ({error.strerror})", place=str(path)) from None
    except ValueError as error:  # matplotlib's word for an unknown file ending
        known = sorted(figure.canvas.get_supported_filetypes())
        raise InputError(
            str(error).split("(")[0].strip(), place=str(path), hint=nearest(path.suffix[1:], known)
        ) from None


def slice_name(planes: Mapping[str, float], field: str = "growth_rate") -> str:
    """The file name of a slice's picture: its plane, and the machine of a sweep; no two have one name."""
    words = ["slice" if field == "growth_rate" else field]
    for name, value in planes.items():
        short = f"{value:.6g}"
        words += [name, short if float(short) == value else repr(float(value))]
    return "_".join(words) + ".png"
