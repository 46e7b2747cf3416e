"""Eigenvalues at one speed against any parameter of a machine, with the names of their modes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, cast

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import ExactTable, Floats, Model, exact_table
from bikestab.modes import Modes, follow
from bikestab.records import Design, design_record
from bikestab.variants import check_names, check_values, varied


class Against(NamedTuple):
    """The designs of one machine in which the parameter ``name`` has ``values``: their tables and modes.

    ``tables`` and ``modes`` have one entry for each value, and each of ``modes`` is of one speed.
    """

    name: str
    values: Floats
    designs: list[Design]
    tables: list[ExactTable]
    modes: list[Modes]


def modes_against(
    bicycle: Bicycle, name: str, values: Sequence[float], V: float, others: Mapping[str, float] | None = None,
    *, model: Model = "refined",
) -> Against:  # fmt: skip
    """The modes at a speed V [m/s] where a parameter has other values, SI, and ``others`` these.

    Names as in ``Family``. Raises InputError, with the parameter's name as key, for an unknown one, and for
    values that no machine can have; and as ``bikestab.modes``.
    """
    fixed = dict(others or {})
    check_names(bicycle, {each: each for each in (name, *fixed)})
    for value in (min(values), max(values)):
        check_values(bicycle, {**fixed, name: value})
    x = np.asarray(values, dtype=float)
    machine, lam, sigma = varied(bicycle, {**fixed, name: x})
    lam, sigma, _ = np.broadcast_arrays(lam, sigma, x)
    table = exact_table(machine, lam, sigma, model=model)
    tables = [ExactTable(*(part[..., i] for part in table)) for i in range(len(x))]
    whole = design_record(lam, sigma, machine)
    columns: dict[str, list[float]] = {
        key: np.broadcast_to(cast("Floats", each), x.shape).tolist() for key, each in whole.items()
    }
    designs = [{key: each[i] for key, each in columns.items()} for i in range(len(x))]
    return Against(name, x, designs, tables, [follow(each, V) for each in tables])  # type: ignore[arg-type]  # a Design
