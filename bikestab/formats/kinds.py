"""A file that a command cannot use → what it is instead, and which command takes it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from bikestab.errors import InputError
from bikestab.texts import is_file

KINDS = {  # what it is called, and what takes it
    "volume": (
        "a volume",
        "bikestab convert writes its bicycle; info, slice, export, report, compare, vrange --bicycle take it",
    ),
    "picture": ("a picture", "no command reads pictures"),
    "config": ("a scan's config", "bikestab scan and check take it"),
    "bicycle": ("a bicycle's file", "bikestab vrange --bicycle takes it, and 'bicycle:' in a config"),
    "bikecad": (
        "a design of BikeCAD, which has lengths and angles but no masses and moments of inertia",
        "bikestab vrange --bicycle tells its head angle and trail, and what to type with them",
    ),
    "yeadon": (
        "a rider's body for the package yeadon",
        "the inertia that yeadon works out of it goes under rider: in a bicycle's file",
    ),
    "certificate": ("a certificate", "bikestab certify --verify takes it"),
    "rider": ("a rider's file", "bikestab convert BICYCLE --rider takes it"),
}
_TOLD_BY_READER = {("bicycle", "bikecad")}
_HEAD = 65536  # bytes that are looked at
_PICTURES = (b"\x89PNG", b"%PDF", b"\xff\xd8\xff", b"GIF8")
_KEY = re.compile(r"(?:^|[{,])[ \t\"']*(\w+)[\"']?[ \t]*[:=]", re.MULTILINE)
_DIAMETER = re.compile(r"^[ \t]*D(?:rear|front)wheel[ \t]*=", re.MULTILINE)
_OF_BICYCLES = ({"w", "mB"}, {"m1", "h1"}, {"w", "kHaa"}, {"mB", "TtB1"})
_RIDER = {"mB", "xB", "zB", "IBxx", "IBzz", "IBxz"}


def is_bikecad(head: bytes) -> bool:
    """Whether a file that begins so is Java's properties as XML, as BikeCAD saves a design."""
    return b"<!DOCTYPE properties" in head[:1000]


def is_jbike6(text: str) -> bool:
    """Whether a text assigns the diameter of a wheel, as JBike6 does where it saves a bicycle."""
    return bool(_DIAMETER.search(text))


def kind_of(path: str | Path) -> str:
    """Which of ``KINDS`` a file is, or a scan's folder, or nothing where that cannot be told."""
    head = b""
    with suppress(OSError, ValueError):
        if is_file(path) and Path(path).stat().st_size:  # a pipe cannot be read twice
            with Path(path).open("rb") as file:
                head = file.read(_HEAD)
    if head.startswith(b"\x89HDF") or is_file(Path(path, "volume.h5")):
        return "volume"
    if is_bikecad(head):
        return "bikecad"
    if head.startswith(_PICTURES) or b"<svg" in head[:1000]:
        return "picture"
    if b'"bikestab certificate ' in head[:200]:
        return "certificate"
    text = head.decode("utf-8", errors="ignore")
    keys = set(_KEY.findall(text))
    if "bicycle" in keys and keys & {"grid", "expect"}:
        return "config"
    if any(pair <= keys for pair in _OF_BICYCLES) or is_jbike6(text):
        return "bicycle"
    if keys & {"somersault", "measurementconversionfactor"}:
        return "yeadon"
    return "rider" if keys >= _RIDER else ""


@contextmanager
def expected(kind: str, path: str | Path) -> Iterator[None]:
    """Tell of a file of another kind that it is one, in place of the mistake that was found in it."""
    try:
        yield
    except InputError as error:
        found = kind_of(path)
        if not found and Path(path).suffix in (".h5", ".hdf5") and is_file(path) and kind != "volume":
            problem = f"is named as a volume, and is neither one nor {KINDS[kind][0]}"
            hint = "'bikestab scan CONFIG' writes volumes"
            raise InputError(problem, place=str(path), hint=hint) from error
        if not found or found == kind or (kind, found) in _TOLD_BY_READER:
            raise
        what, takes = KINDS[found]
        raise InputError(f"is {what}, not {KINDS[kind][0]}", place=str(path), hint=takes) from error
