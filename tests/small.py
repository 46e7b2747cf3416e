"""The reproduction on grids so coarse that tests can afford it."""

from functools import cache

from bikestab.bicycle import Bicycle
from bikestab.paper1981 import readings, reproduce
from bikestab.paper1981.box import Size

TINY = Size(
    grid=60, lines=24, grid_damping=12, grid_readings=15, machines=8, grid_machines=7, search=15, picture=61,
    cells=8, every=9,
)  # fmt: skip
_compute = reproduce.study  # tests put this module's study in its place


@cache
def study():
    """All numbers on TINY grids."""
    return _compute(Bicycle.preset(reproduce.BICYCLE), TINY)


@cache
def all_readings():
    return {r.words: r for r in readings.readings(Bicycle.preset(reproduce.BICYCLE))}
