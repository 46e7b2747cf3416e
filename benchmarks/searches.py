"""The search of `design --free` beside those of cma, pymoo and nlopt, with as many evaluations for each.

Each that is not installed is left out; none of them is needed elsewhere. Run by hand.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.design.criteria import assessed, decay, lowest, width
from bikestab.design.free import Free, best_of
from bikestab.model import Floats

SEEDS = 3
MEIJAARD = Bicycle.preset("meijaard2007")
OWN = Bicycle.preset("dikarev1981").replaced({"lam": 0.2, "sigma": 0.08})
FRAME = {"lam": (0.1, 0.5), "trail": (0.02, 0.15), "xB": (0.2, 0.4)}
PROBLEMS = {
    "one": Free(MEIJAARD, {"offset": (-0.05, 0.08)}, judged=(5.0, 5.0)),
    "three": Free(MEIJAARD, FRAME, stable=(4.6, 5.4)),
    "paper": Free(OWN, {"head_angle": (1.2, 1.5), "offset": (0.0, 0.08), "h1": (0.7, 1.1)}),
    "six": Free(MEIJAARD, {**FRAME, "zB": (-1.1, -0.7), "mB": (60.0, 110.0), "xH": (0.8, 1.0)}),
}
CRITERIA = {"widest": width, "lowest V1": lowest, "decay": decay}
Cost = Callable[[Floats], Floats]  # of points (parameter, point) in the unit box


def by_cma(cost: Cost, n: int, evaluations: int, seed: int) -> float:
    """CMA-ES with restarts at doubled populations, from the middle of the box, a step's points at once."""
    cma, best, size, left = import_module("cma"), np.inf, 20, evaluations
    random = np.random.default_rng(seed)
    m = max(n, 2)  # it knows no single parameter; the second does nothing
    while left > size:
        options = {
            "bounds": [[0] * m, [1] * m], "popsize": size, "seed": seed + size, "verbose": -9,
            "tolfun": 1e-12, "tolx": 1e-11,
        }  # fmt: skip
        search = cma.CMAEvolutionStrategy(random.random(m) if size > 20 else [0.5] * m, 0.3, options)
        while not search.stop() and left > size:
            points = search.ask()
            values = cost(np.array(points)[:, :n].T)
            search.tell(points, values.tolist())
            best, left = min(best, float(values.min())), left - size
        size *= 2
    return best


def by_pymoo(cost: Cost, n: int, evaluations: int, seed: int) -> float:
    """Its differential evolution, 40 points at a time."""
    problem = import_module("pymoo.core.problem").Problem

    class Designs(problem):  # type: ignore[misc, valid-type]  # a class of a package that may be missing
        def __init__(self) -> None:
            super().__init__(n_var=n, n_obj=1, xl=np.zeros(n), xu=np.ones(n))

        def _evaluate(self, x: Floats, out: dict[str, Any], *_: object, **__: object) -> None:
            out["F"] = cost(x.T)[:, np.newaxis]

    search = import_module("pymoo.algorithms.soo.nonconvex.de").DE(pop_size=40)
    minimize = import_module("pymoo.optimize").minimize
    return float(minimize(Designs(), search, ("n_eval", evaluations), seed=seed).F[0])


def by_nlopt(cost: Cost, n: int, evaluations: int, seed: int) -> float:
    """Controlled random search (CRS2) for half of them, then Subplex from there, one point at a time."""
    nlopt = import_module("nlopt")
    nlopt.srand(seed)
    x, best = np.full(n, 0.5), np.inf
    for kind in (nlopt.GN_CRS2_LM, nlopt.LN_SBPLX):
        search = nlopt.opt(kind, n)
        search.set_lower_bounds(np.zeros(n))
        search.set_upper_bounds(np.ones(n))
        search.set_min_objective(lambda x, _: float(cost(np.array(x)[:, np.newaxis])[0]))
        search.set_maxeval(evaluations // 2)
        search.set_xtol_abs(1e-10)
        x = search.optimize(x)
        best = min(best, search.last_optimum_value())
    return best


OTHERS = {"cma": by_cma, "pymoo": by_pymoo, "nlopt": by_nlopt}


def compared(free: Free, criterion: Any, searches: dict[str, Any]) -> dict[str, tuple[float, float, float]]:
    """The worst and the best value of the seeds, and the seconds of one search; own has one seed."""
    low, high = (end[:, np.newaxis] for end in free.box)
    calls = [0]

    def cost(x: Floats) -> Floats:
        calls[0] += x.shape[1]
        values = assessed(free, [criterion], low + (high - low) * np.clip(x, 0, 1))[0]
        return np.minimum(values, 1e6)  # some of them do not take infinite ones

    def counted(found: Any, criteria: Any, x: Floats) -> Floats:
        calls[0] += x.shape[1]
        return assessed(found, criteria, x)

    module = import_module("bikestab.design.free")
    module.assessed = counted  # type: ignore[attr-defined]  # counts the evaluations from outside
    start = time.process_time()
    _, value = best_of(free, criterion)
    found = {"own": (value, value, time.process_time() - start)}
    module.assessed = assessed  # type: ignore[attr-defined]  # as it was
    evaluations = calls[0]
    for name, search in searches.items():
        start = time.process_time()
        values = [search(cost, len(low), evaluations, seed) for seed in range(1, SEEDS + 1)]
        found[name] = max(values), min(values), (time.process_time() - start) / SEEDS
    return {**found, "evaluations": (evaluations, evaluations, 0.0)}


def main() -> None:
    """Print a row for each problem and criterion."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="the smallest problem alone")
    quick = parser.parse_args().quick
    searches = {name: search for name, search in OTHERS.items() if find_spec(name)}
    for key, free in list(PROBLEMS.items())[: 1 if quick else None]:
        for name, criterion in CRITERIA.items():
            found = compared(free, criterion, searches)
            number = int(found.pop("evaluations")[0])
            cells = [
                f"{which} {worst:.8g} ... {best:.8g} in {seconds:.2f} s"
                for which, (worst, best, seconds) in found.items()
            ]
            print(f"{key}, {name}, {number} evaluations: " + "; ".join(cells), flush=True)


if __name__ == "__main__":
    main()
