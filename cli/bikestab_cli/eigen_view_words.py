"""Mode shapes, the motion after a push, and modes against a parameter in words and tables."""

from __future__ import annotations

import cmath
import math
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from bikestab_cli.eigen_words import eigenvalue, eigenvalue_table, narrowed
from bikestab_cli.output import DESIGN_HEAD, aligned, as_read, decimals, design_columns, heading, prose, table
from bikestab_cli.several import Chosen, digits_of

if TYPE_CHECKING:
    from bikestab.against import Against
    from bikestab.model import Model
    from bikestab.motion import Motion, Shapes

_ROWS = 11  # of a motion
_LETTERS = 9  # of its numbers
_MOST = 60  # values of a parameter


def told_shapes(machine: Chosen, design: Any, found: Shapes, model: Model) -> str:
    """Size and phase of roll and steer in each mode; of a pair those of the upper one."""
    upper = [k for k, s in enumerate(found.eigenvalues) if s.imag >= 0]

    def shown(digits: int) -> str:
        rows = []
        for k in upper:
            s, (roll, steer) = found.eigenvalues[k], found.phasors[:, k]
            rows.append([_named(found, k, upper), eigenvalue(s, digits), *_polar(roll), *_polar(steer)])
        return table(head, rows)

    head = ["mode", "eigenvalue [1/s]", "roll", "phase [°]", "steer", "phase [°]"]
    note = "the larger of the two is 1; positive to the right; rates are these times the eigenvalue"
    return _whole(machine, design, model, f"mode shapes at {found.V:.6g} m/s", narrowed(shown), note)


def _named(found: Shapes, k: int, modes: Sequence[int]) -> str:
    """The name of a mode, and which it is of two real ones with that name among the modes."""
    others = [found.eigenvalues[i] for i in modes if i != k and found.names[i] == found.names[k]]
    if not others:
        return found.names[k]
    return f"{found.names[k]}\n{'faster' if abs(found.eigenvalues[k]) > max(map(abs, others)) else 'slower'}"


def _polar(phasor: complex) -> list[str]:
    phase = math.degrees(cmath.phase(phasor))
    return [
        decimals(abs(phasor), 6),
        f"{0.0 if abs(phase) < 1e-9 else phase:z.3f}".replace("-180.000", "180.000"),
    ]


def told_motion(machine: Chosen, design: Any, found: Motion, push: Mapping[str, float], model: Model) -> str:
    """The motion at a few of its times."""
    from bikestab.motion import LARGE, leaves

    pushed = ", ".join(f"{name} = {value:.6g} {_unit(name)}" for name, value in push.items())
    last = len(found.t) - 1
    shown = [round(i * last / (_ROWS - 1)) for i in range(_ROWS)]
    values = (*found.states[:2], found.yaw, found.x, found.y, found.y_front)
    columns = [aligned(each[shown].tolist(), _LETTERS) for each in values]
    rows = [[f"{found.t[k]:.4g}", *row] for k, *row in zip(shown, *columns, strict=True)]
    names = ["t\n[s]", "roll\n[rad]", "steer\n[rad]", "yaw\n[rad]"]
    names += ["along\n[m]", "rear wheel\n[m]", "front wheel\n[m]"]
    note = "all positive to the right; the wheels' contacts are so far to the right of the line ridden before"
    note += f"\nalong: of the rear contact; the front one is {found.x_front[0]:.6g} m further"
    if (left := leaves(found)) is not None:
        note += f"\nthe model is linear: beyond about {LARGE:g} rad these angles are not those of a machine"
        note += f"; it leaves it at {left:.3g} s"
    return _whole(machine, design, model, f"at {found.V:.6g} m/s after {pushed}", table(names, rows), note)


def _unit(name: str) -> str:
    return "rad/s" if name.endswith("rate") else "rad"


def told_against(
    machine: Chosen, found: Against, V: float, unit: str, model: Model, beside: Collection[str]
) -> str:
    """A row of eigenvalues for each value of the parameter, with what is set and ``beside`` it."""
    every = range(0, len(found.values), -(-len(found.values) // _MOST))

    def read(value: float) -> float:
        return as_read(found.name, value, "")[0]

    digits = max(6, digits_of({found.name: found.values.tolist()}))
    rows = [(f"{read(found.values[i]):.{digits}g}", found.modes[i]) for i in every]
    unit = as_read(found.name, 0.0, unit)[1]
    words = f"{found.name} [{unit}] at {V:.6g} m/s"
    if len(rows) < len(found.values):
        words += f"; every {every.step}th of {len(found.values)} values, which --json and --csv have all"
    ends = ", ".join(f"{read(start):.10g} to {read(stop):.10g}" for start, stop in found.stable)
    words += f"\nstable: {ends} {unit}" if ends else "\nstable: nowhere between these"
    changed = f" ({machine.changes})" if machine.set else ""
    table_ = eigenvalue_table(f"{found.name}\n[{unit}]", rows)
    return prose(f"{heading(machine.bicycle, model, [found.name, *beside])}{changed}\n{words}\n\n") + table_


def _whole(machine: Chosen, design: Any, model: Model, words: str, rows: str, note: str) -> str:
    changed = f" ({machine.changes})" if machine.set else ""
    head = prose(heading(machine.bicycle, model) + changed)
    return "\n\n".join([head, table(DESIGN_HEAD, [design_columns(design)]), prose(words), rows, prose(note)])
