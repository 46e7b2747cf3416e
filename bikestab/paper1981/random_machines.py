"""Random machines that could be built, two rigid parts with the wheels within them, and what they show."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.paper1981.box import Sampling
from bikestab.paper1981.forks import offset
from bikestab.paper1981.maps import DesignMap, map_each
from bikestab.paper1981.one_design import eigenvalues, intervals


@dataclass(frozen=True)
class Example:
    """A design of the machine of this number, its fork offset b [m], without upper limit above V1 [m/s].

    ``growth_rate`` [1/s] is that at 100 m/s, by a general solver.
    """

    number: int
    lam: float
    sigma: float
    offset: float
    V1: float
    growth_rate: float


@dataclass(frozen=True)
class RandomMachines:
    """How many random machines have stable designs in the paper's box, and such without upper limit."""

    machines: int
    designs_each: int
    designs: int
    with_stable: float
    with_unbounded: float
    with_several: float
    stable_designs: float
    unbounded_designs: float
    formula_disagreements: int
    forwards_of_designs: float
    with_stable_forwards: float
    with_unbounded_forwards: float
    unbounded_designs_forwards: int
    example_forwards: Example | None


def study_random_machines(sampling: Sampling) -> RandomMachines:
    """The stable speeds of random machines over the paper's box."""
    machines = list(random_machines(sampling.machines))
    maps = map_each(machines, sampling.grid_machines)
    stable = np.array([(designs.number > 0).mean() for designs in maps])
    unbounded = np.array([designs.unbounded.mean() for designs in maps])
    several = np.array([(designs.number > 1).mean() for designs in maps])
    stable_forwards = [bool(((designs.number > 0) & designs.forwards).any()) for designs in maps]
    both = [int(np.count_nonzero(designs.unbounded & designs.forwards)) for designs in maps]
    return RandomMachines(
        machines=sampling.machines,
        designs_each=sampling.grid_machines**2,
        designs=sampling.machines * sampling.grid_machines**2,
        with_stable=float(np.mean(stable > 0)),
        with_unbounded=float(np.mean(unbounded > 0)),
        with_several=float(np.mean(several > 0)),
        stable_designs=float(stable.mean()),
        unbounded_designs=float(unbounded.mean()),
        formula_disagreements=int(
            sum(np.count_nonzero(designs.formula != designs.unbounded) for designs in maps)
        ),
        forwards_of_designs=float(np.mean([designs.forwards.mean() for designs in maps])),
        with_stable_forwards=float(np.mean(stable_forwards)),
        with_unbounded_forwards=float(np.mean(np.array(both) > 0)),
        unbounded_designs_forwards=sum(both),
        example_forwards=_example(machines, maps),
    )


def _example(machines: list[Bicycle], maps: list[DesignMap]) -> Example | None:
    """The first design without upper limit whose fork is bent forwards."""
    for number, (machine, designs) in enumerate(zip(machines, maps, strict=True), 1):
        where = np.argwhere(designs.unbounded & designs.forwards)
        if len(where):
            lam, sigma = float(designs.lam[where[0, 0], 0]), float(designs.sigma[where[0, 1]])
            ((rate, _), *_) = eigenvalues(machine, lam, sigma, 100.0)
            V1 = intervals(machine, lam, sigma)[-1].V1
            return Example(number, lam, sigma, float(offset(machine, lam, sigma)), V1, rate)
    return None


def random_machines(number: int, seed: int = 1981) -> Iterator[Bicycle]:
    """Bicycles and motorcycles of Meijaard's 25 parameters, the same ones for the same seed.

    Each body is given by the spread of its mass along three axes, so its inertias obey every inequality
    of a rigid body; each wheel lies between a disc and a thin rim, and its part is heavier than it.
    """
    rng = np.random.default_rng(seed)
    for i in range(number):
        yield Bicycle.from_mapping(_machine(rng), name=f"random {i + 1}")


def _machine(rng: np.random.Generator) -> dict[str, float]:
    w, heavy = rng.uniform(0.8, 1.6), rng.uniform()  # wheelbase [m]; from bicycle (0) to motorcycle (1)
    masses = {
        "mB": rng.uniform(50, 100) + 170 * heavy,
        "mH": rng.uniform(1, 5) + 15 * heavy,
        "mR": rng.uniform(0.8, 3) + 12 * heavy,
        "mF": rng.uniform(0.8, 3) + 10 * heavy,
    }  # kg
    n = {"w": w, "c": 0.05 * w, "lam": 0.2, **masses}  # its own design is not used
    n |= {"xB": w * rng.uniform(0.25, 0.5), "zB": -rng.uniform(0.5, 1.1)}
    n |= {"xH": w * rng.uniform(0.75, 1.05), "zH": -rng.uniform(0.4, 0.9)}
    for wheel in "RF":
        r, share = rng.uniform(0.2, 0.37), rng.uniform(0.5, 1)  # of m r²: disc … rim
        spin = share * n["m" + wheel] * r**2
        n |= {"r" + wheel: r, f"I{wheel}yy": spin, f"I{wheel}xx": 0.5 * spin * rng.uniform(1, 1.1)}
    for body, size in (("B", (0.35, 0.2, 0.4)), ("H", (0.12, 0.15, 0.25))):
        x, y, z = (s * rng.uniform(0.5, 1) for s in size)  # spread of the mass: radii of gyration [m]
        m, tilt = n["m" + body], rng.uniform(-0.6, 0.6)  # correlation of x and z
        n |= {f"I{body}xx": m * (y**2 + z**2), f"I{body}yy": m * (x**2 + z**2)}
        n |= {f"I{body}zz": m * (x**2 + y**2), f"I{body}xz": m * x * z * tilt}
    return n
