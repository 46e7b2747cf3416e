"""bikestab scan: a config → the volume and its pictures."""

from __future__ import annotations

import os
import sys
import time
from contextlib import suppress
from functools import partial
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING

import click
from bikestab_cli.options import NAME, json_option, of_file
from bikestab_cli.output import print_json
from bikestab_cli.progress import progress

if TYPE_CHECKING:
    from bikestab.config.scanconfig import ScanConfig
    from bikestab.scan.run import ScanResult


@click.command("scan")
@click.argument("configs", type=NAME, nargs=-1, required=True, metavar="CONFIG...")
@click.option(
    "--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Override a value, e.g. grid.V.num=61."
)
@click.option("--force", is_flag=True, help="Replace the output of another config, or compute again.")
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="How many processes compute; by default one for each core, if there is work for them.",
)
@click.option(
    "--scheduler",
    type=NAME,
    metavar="ADDRESS",
    help="Compute on a Dask cluster: tcp://HOST:PORT, or local:N processes. Needs the extra 'cluster'.",
)
@click.option("--certify", is_flag=True, help="Prove the cells between the points: the field 'certified'.")
@click.option("--report", is_flag=True, help="Write report.html, an interactive page, beside the pictures.")
@click.option("--quiet", is_flag=True, help="Tell nothing of the progress.")
@json_option
def command(
    configs: tuple[str, ...], overrides: tuple[str, ...], force: bool, jobs: int | None,
    scheduler: str | None, certify: bool, report: bool, quiet: bool, as_json: bool,
) -> None:  # fmt: skip
    """Evaluate grids; write volumes and pictures.

    Each YAML config gives in its output folder a volume.h5, the stable region in three dimensions as
    region.png, and PNG slices.

    'bikestab init' writes a commented config to start from. All configs are read before the first is
    computed. A volume that is there already, made from a config that means the same, is kept
    and only its pictures are drawn again: another title, comment or slice computes nothing. A scan
    that was stopped, however, goes on where it was when the same command is run again.

    \b
    Examples:
      bikestab scan configs/quick.yaml
      bikestab scan configs/quick.yaml --set grid.V.num=61 --set output=out/fine
      bikestab scan configs/quick.yaml configs/meijaard2007.yaml --force --json
      bikestab scan configs/quick.yaml --jobs 2 --quiet
      bikestab scan configs/quick.yaml --certify
    """
    if jobs and scheduler:
        raise click.UsageError("--jobs is for this machine, --scheduler for a cluster; give one of them")
    from bikestab.pipeline import write_proofs

    loaded = _load(configs, overrides, certify, report)
    done: list[dict[str, object]] = []
    try:
        for name, config in loaded:
            for word, texts in (("note", config.notes), ("warning", config.warnings)):
                for text in texts:
                    click.echo(f"{word}: {config.machine.name}: {text}", err=True)
            start = time.perf_counter()
            with of_file(name):
                result, pictures = _run(name, config, force, jobs, scheduler or "", quiet)
                if certify:
                    _certify(name, config, result.path, jobs, quiet)
                if certify or not result.computed:
                    pictures += write_proofs(config, result.path)
                page = _page(name, result.path, quiet) if report else None
            done.append(_summary(name, config, result, pictures, page))
            if not as_json:
                click.echo(_line(name, result, pictures, time.perf_counter() - start))
    finally:
        if as_json and (done or not sys.exc_info()[0]):
            print_json({"results": done})


def _load(
    names: tuple[str, ...], overrides: tuple[str, ...], certify: bool, report: bool
) -> list[tuple[str, ScanConfig]]:
    """All configs, before the first is computed."""
    from bikestab.config.file import load_config
    from bikestab.errors import InputError
    from bikestab.scan.output import check_size, volume_path

    loaded: dict[Path, tuple[str, ScanConfig]] = {}
    for name in names:
        with of_file(name):
            config = load_config(name, overrides)
            check_size(config)
            for asked, option in ((certify, "--certify"), (report, "--report")):
                if asked:
                    _check_exact(config, option)
            if report:
                _check_page(config)
            path = Path(os.path.realpath(volume_path(config)))
            if path in loaded:
                problem = f"{config.output} is the output of {loaded[path][0]} too"
                raise InputError(problem, key=("output",), hint="give each config an output of its own")
        loaded[path] = name, config
    return list(loaded.values())


def _check_exact(config: ScanConfig, option: str) -> None:
    """Raise InputError where proofs and the page do not know what the config is of."""
    from bikestab.errors import InputError
    from bikestab.fields import AXES

    hint = f"leave {option} out"
    if config.grid.names != AXES:
        x, y, _ = config.grid.names
        if option == "--certify":
            hint += "; 'bikestab certify --tolerance' proves ranges of other parameters"
        raise InputError(
            f"the grid is over {x} and {y}, and {option} takes lam and sigma", key=("grid",), hint=hint
        )
    if option == "--certify" and config.machine.gains:
        raise InputError("has feedback, which --certify does not know", key=("bicycle",), hint=hint)
    if option == "--certify" and config.axes:
        raise InputError("--certify takes one machine, and there is a sweep", key=("sweep",), hint=hint)


def _check_page(config: ScanConfig) -> None:
    """Raise InputError where no page can be made of the config's volume."""
    from importlib.util import find_spec

    from bikestab.errors import InputError
    from bikestab.report.page import NEEDED
    from bikestab.report.volumes import MOST_MACHINES

    if not find_spec("plotly"):
        raise NEEDED
    short = [name for name in config.grid.names if len(config.grid.values(name)) < 2]
    if short:
        raise InputError(
            "one value alone, and a page needs a range", key=("grid", short[0]), hint="leave --report out"
        )
    if len(config.members) > MOST_MACHINES:
        problem = f"{len(config.members)} machines, and a page shows {MOST_MACHINES} at most"
        raise InputError(problem, key=("sweep",), hint="leave --report out, or sweep fewer values")


def _run(
    name: str, config: ScanConfig, force: bool, jobs: int | None, scheduler: str, quiet: bool
) -> tuple[ScanResult, list[Path]]:
    from bikestab.pipeline import drawing, write_pictures
    from bikestab.scan.output import tiles_path

    with drawing(config) as pictures:
        from bikestab.scan.run import run_scan

        try:
            with progress(name, quiet) as show:
                result = run_scan(config, force=force, jobs=jobs, scheduler=scheduler, progress=show)
        except KeyboardInterrupt:
            hint = ""
            with suppress(OSError):
                if tiles_path(config).stat().st_size:
                    hint = f"{name}: what is finished is kept; the same command goes on from there"
            raise KeyboardInterrupt(hint) from None
        return result, write_pictures(config, result.path, pictures(), partial(click.echo, err=True))


def _certify(name: str, config: ScanConfig, volume: Path, jobs: int | None, quiet: bool) -> None:
    from bikestab.certified import add_certified

    with progress(f"{name}: proofs", quiet, "cells") as show:
        cells = prod(max(config.grid.size(axis) - 1, 1) for axis in config.grid.names)
        denied = add_certified(
            volume, config.machine, config.model, lambda share: show(int(cells * share), cells), jobs
        )
    if denied:
        text = f"{denied} cells stay undecided, since rounding makes 'stable' say otherwise at a corner"
        click.echo(f"note: {name}: {text}", err=True)


def _page(name: str, volume: Path, quiet: bool) -> str:
    """Write the page of a volume beside it; its path."""
    from bikestab.report.page import save_page
    from bikestab.volume import Volume

    path = volume.with_name("report.html")
    with Volume(volume) as opened, progress(f"{name}: page", quiet, "machines") as show:
        save_page([opened], path, show)
    click.echo(f"{path}: opens in any browser", err=True)
    return str(path)


def _line(name: str, result: ScanResult, pictures: list[Path], seconds: float) -> str:
    share = f"{100 * result.stable_points / result.points:.3g} % of {result.points} points stable"
    if not result.stable_points:
        share = f"no stable point among {result.points}"
    drawn = f", {len(pictures)} picture{'s' if len(pictures) != 1 else ''}" if pictures else ""
    if not result.computed:
        return f"{name}: {result.path}{drawn}: {share}; was complete already (--force computes again)"
    found = result.agreement
    agree = f"{found.roots} boundary points agree with the exact speeds to {found.largest:.1e} m/s"
    if found.loose:
        agree += f" ({found.loose} close to a fold to {found.largest_loose:.1e})"
    if found.touching:
        agree += f"; at {found.touching} of them a condition only touches zero, which is no exact speed"
    scipy = result.bracketed
    agree += f"; {scipy.roots} zeros that scipy finds between speeds of the grid to {scipy.largest:.1e} m/s"
    if scipy.loose:
        agree += f" ({scipy.loose} close to a fold to {scipy.largest_loose:.1e})"
    return f"{name}: {result.path}{drawn}: {share}; {agree}; {seconds:.1f} s"


def _summary(
    name: str, config: ScanConfig, result: ScanResult, pictures: list[Path], page: str | None
) -> dict[str, object]:
    return {
        "config": name,
        "bicycle": config.machine.name,
        "volume": str(result.path),
        "pictures": [str(p) for p in pictures],
        "report": page,
        "computed": result.computed,
        "points": result.points,
        "stable_points": result.stable_points,
        "largest_boundary_difference": result.agreement.largest if result.computed else None,
        "bracketed_zeros": result.bracketed.roots if result.computed else None,
        "largest_bracketed_difference": result.bracketed.largest if result.computed else None,
        "warnings": config.warnings,
    }
