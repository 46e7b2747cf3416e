"""bikestab certify: proofs that a box of designs and speeds is stable, or unstable."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.chosen import Given, box_chosen, design_options
from bikestab_cli.options import (
    BICYCLE,
    DEFAULT_BICYCLE,
    FILE,
    NAME,
    check_files,
    json_option,
    load_bicycle,
    of_file,
    told_as_options,
)  # fmt: skip
from bikestab_cli.output import print_json, tell, tell_file
from bikestab_cli.progress import progress
from bikestab_cli.quantities import SPEED_ENDS, Ends, Quantity
from bikestab_cli.tolerances import DESIGN, tolerances_of, with_design

from bikestab.errors import InputError
from bikestab.gains import GAINS
from bikestab.units import DAMPING

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.certify.box import Box
    from bikestab.certify.proof import Proof
    from bikestab.model import Model

MOST_CELLS = 512


@click.command("certify")
@click.argument("config", type=NAME, required=False, metavar="[CONFIG]")
@design_options("two ends")
@click.option("--V", "speed", type=SPEED_ENDS, metavar="A:B", help="Speeds: 5 or 4.6:5.6.")
@click.option(
    "--bicycle",
    "bicycle_name",
    type=BICYCLE,
    metavar="NAME|FILE",
    help=f"A bicycle that comes with bikestab, or a file.  [default: {DEFAULT_BICYCLE}, or the config's]",
)
@click.option(
    "--delta",
    type=Quantity("number", DAMPING),
    help="Steering damping δ [kg m²/s], instead of the bicycle's own.",
)
@click.option(
    "--model",
    type=click.Choice(["refined", "unrefined"]),
    help="The paper's refined equations, or those before it.  [default: refined]",
)
@click.option(
    "--tolerance",
    multiple=True,
    metavar="NAME=VALUE+-HALF",
    help="A parameter that may be anything in this range, e.g. mB=85+-2.",
)
@click.option(
    "--cells",
    type=click.IntRange(1, MOST_CELLS),
    default=64,
    show_default=True,
    help="Cells along each axis that has two ends.",
)
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="How many processes compute; by default one for each core, if it takes long.",
)
@click.option(
    "--work",
    type=click.IntRange(min=1),
    metavar="BLOCKS",
    help="Look at about so many blocks of cells, and leave what is open undecided.",
)
@click.option(
    "-o", "--certificate", type=FILE, metavar="FILE", help="Write the proof for a checker, as JSON."
)
@click.option("--verify", type=NAME, metavar="FILE", help="Check a certificate, and nothing else.")
@click.option("-q", "--quiet", is_flag=True, help="Tell nothing of the progress.")
@json_option
def command(
    config: str | None, given: Given, speed: Ends | None, bicycle_name: str | None, delta: float | None,
    model: Model | None, tolerance: tuple[str, ...], cells: int, jobs: int | None, work: int | None,
    certificate: str | None, verify: str | None, quiet: bool, as_json: bool,
) -> None:  # fmt: skip
    """Prove a box of designs and speeds stable or unstable.

    A scan tells of the points of a grid; this tells of every point between them. The box of a config, or
    the one between two tilts (or head angles), two trails and two speeds, is cut into cells, and each is
    proved to be stable throughout, to be unstable throughout, or stays undecided, as do those with the
    boundary in them or near it. The numbers are the
    exact doubles that are given; all rounding is bounded. With --tolerance a cell is proved for all
    machines in the range; one of head_angle, trail, offset, lam or sigma is a side of the box.

    With -o a proof that is stopped loses nothing that was finished: the same command goes on from there.

    The verdict is stable, unstable, mixed (both are there for certain) or undecided; the exit code
    is 0 for each of them.

    \b
    Examples:
      bikestab certify configs/quick.yaml
      bikestab certify --bicycle meijaard2007 --lam 17deg:19deg --sigma 0.08 --V 5
      bikestab certify --lam 0.2 --sigma 0.08 --V 4.3 --tolerance m1=90+-0.2
      bikestab certify --bicycle meijaard2007 --head-angle 72deg --trail 8cm --V 5
      bikestab certify --lam 0.2 --V 4.3 --tolerance trail=83mm+-0.1mm
      bikestab certify --lam 0.2:0.21 --sigma 0.08 --V 4.3 --cells 4 -o proof.json
      bikestab certify --verify proof.json
    """
    if verify:
        from bikestab_cli.verify import verify_certificate

        verify_certificate(verify, quiet, as_json)
        return
    from bikestab import __version__
    from bikestab.certify.box import box_of

    check_files(certificate)
    given, texts = with_design(given, tolerance)
    if config:
        others = {"V": speed, "bicycle": bicycle_name, "delta": delta, "model": model}
        if twice := [f"--{k.replace('_', '-')}" for k, v in {**given, **others}.items() if v is not None]:
            raise click.UsageError(f"{config} says what {twice[0]} says", click.get_current_context())
        bicycle, model, ends = _of_config(config)
    else:
        bicycle = load_bicycle(bicycle_name or DEFAULT_BICYCLE, delta)
        ends = _of_options(bicycle, given, speed)
    edges = {name: _edges(name, pair, cells) for name, pair in ends.items()}
    tolerances = tolerances_of(texts, bicycle)
    with told_as_options(**dict.fromkeys(tolerances, "--tolerance")):
        sides = edges["lam"], edges["sigma"], edges["V"]
        box = box_of(bicycle, *sides, model or "refined", tolerances)
    proof = _proof(box, jobs, work, certificate, quiet)
    if certificate:
        from bikestab.files import written

        with written(certificate) as part:
            part.write_text(proof.certificate(__version__) + "\n", encoding="utf-8")
    if as_json:
        print_json(proof.record() | ({"files": {"certificate": certificate}} if certificate else {}))
    else:
        from bikestab_cli.certify_words import told

        tell(told(proof), certificate)
        if certificate:
            tell_file(certificate)


def _proof(box: Box, jobs: int | None, work: int | None, certificate: str | None, quiet: bool) -> Proof:
    """Prove it; where that is stopped, parts that are finished are kept beside the certificate."""
    from bikestab.files import to_stdout
    from bikestab.proving import prove_in_parts

    keep = None
    if certificate and not to_stdout(certificate) and not Path(certificate).is_char_device():
        keep = Path(f"{certificate}.parts")
    cells = prod(len(edges) - 1 for edges in box.edges)
    with progress("certify", quiet, "cells") as show:
        return prove_in_parts(
            box, jobs=jobs, most_blocks=work, keep=keep,
            progress=lambda share: show(int(cells * share), cells),
        )  # fmt: skip


def _edges(name: str, ends: Ends, cells: int) -> Any:
    import numpy as np

    start, stop = ends
    if stop < start:
        raise click.BadParameter(f"{start:g}:{stop:g} ends before it starts", param_hint=f"--{name}")
    if name == "V" and start < 0:
        raise click.BadParameter(f"{start:g} m/s is negative; allowed: 0 and above", param_hint="--V")
    return np.linspace(start, stop, cells + 1) if stop > start else np.array([start, stop])


def _of_options(bicycle: Bicycle, given: Given, speed: Ends | None) -> dict[str, Ends]:
    box = box_chosen(bicycle, given) | ({"V": speed} if speed else {})
    for axis in ("lam", "sigma", "V"):
        if axis not in box:
            problem = f"a box needs a CONFIG, or --lam, --sigma and --V: --{axis} is missing"
            raise click.UsageError(problem, click.get_current_context())
    return box


def _of_config(name: str) -> tuple[Bicycle, Model, dict[str, Ends]]:
    from bikestab.config.file import load_config

    with of_file(name):
        config = load_config(name)
        if config.sweep or config.ensemble:
            key = "sweep" if config.sweep else "ensemble"
            raise InputError(
                "a proof is of one machine",
                key=(key,),
                hint=f"leave {key} out, or give ranges as --tolerance",
            )
        if config.grid.names != ("lam", "sigma", "V"):
            raise _other_axes(config.grid.names[:2], [config.grid.ends(x) for x in config.grid.names[:2]])
    return config.machine, config.model, {axis: config.grid.ends(axis) for axis in ("lam", "sigma", "V")}


def _other_axes(names: Sequence[str], ends: Sequence[Ends]) -> InputError:
    """What to say of a grid over other parameters: which of them can be proved as tolerances."""
    others = [(name, pair) for name, pair in zip(names, ends, strict=True) if name not in (*DESIGN, *GAINS)]
    hint = "leave the config out: --lam A:B --sigma A:B --V A:B"
    if any(name in GAINS for name in names):
        hint, others = (
            "of feedback nothing can be proved; 'bikestab vrange --over' has exact speeds with it",
            [],
        )
    for name, (low, high) in others:
        hint += f" --tolerance {name}={0.5 * (low + high):g}+-{0.5 * (high - low):g}"
    problem = f"the grid is over {' and '.join(names)}, and cells are of tilt, trail and speed"
    return InputError(problem, key=("grid",), hint=hint + (" proves such a box" if others else ""))
