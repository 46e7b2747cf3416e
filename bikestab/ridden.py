"""A bicycle and the file of a rider → the bicycle with that rider apart."""

from __future__ import annotations

from pathlib import Path

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.formats.reading import read_rider


def with_rider(bicycle: Bicycle, path: str | Path) -> Bicycle:
    """The bicycle with the rider in a file of BicycleParameters, whose keys are those of its body B.

    InputError where the file is none, the bicycle has a rider already, or is not given by the 25 parameters.
    """
    if bicycle.bodies is None or "rider.m" in bicycle.bodies:
        why = "has a rider already" if bicycle.bodies else "is not given by the 25 parameters of its bodies"
        hint = "it takes a bicycle of the 25 parameters, such as meijaard2007, without 'rider:' in its file"
        raise InputError(f"the bicycle {bicycle.name!r} {why}", key=("rider",), hint=hint)
    found = read_rider(path)
    try:
        joined = Bicycle.from_mapping(
            {**bicycle.given, **found.values, "source": bicycle.source}, name=bicycle.name
        )
    except InputError as error:
        raise found.located(error) from None
    deviations = {**bicycle.deviations, **found.deviations}
    return joined.measured(deviations, bicycle.correlations, (*bicycle.notes, *found.notes))
