"""bikestab scan: a config → the volume and its pictures."""

from __future__ import annotations

import math
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click
from bikestab_cli.options import json_option, print_json, warn

if TYPE_CHECKING:
    from bikestab.config import ScanConfig
    from bikestab.scan import Progress, ScanResult


@click.command("scan")
@click.argument("configs", nargs=-1, required=True, metavar="CONFIG...")
@click.option(
    "--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Override a value, e.g. grid.V.num=61."
)
@click.option("--force", is_flag=True, help="Replace the output of another config, or compute again.")
@json_option
def command(configs: tuple[str, ...], overrides: tuple[str, ...], force: bool, as_json: bool) -> None:
    """Evaluate grids; write volumes and pictures.

    Each YAML config gives in its output folder a volume.h5, the stable region in three dimensions as
    region.png, and PNG slices.

    'bikestab init' writes a commented config to start from. All configs are read before the first is
    computed. A volume that is there already, made from the same config, is kept and only its
    pictures are drawn again.

    \b
    Examples:
      bikestab scan configs/quick.yaml
      bikestab scan configs/quick.yaml --set grid.V.num=61 --set output=out/fine
      bikestab scan configs/quick.yaml configs/meijaard2007.yaml --force --json
    """
    from bikestab.configfile import load_config
    from bikestab.errors import InputError
    from bikestab.scan import check_size, run_scan, volume_path

    loaded: dict[Path, tuple[str, ScanConfig]] = {}
    for name in configs:
        config = load_config(name, overrides)
        try:
            check_size(config)
        except InputError as error:
            raise InputError(error.problem, key=error.key, hint=error.hint, place=name) from None
        path = volume_path(config).resolve()
        if path in loaded:
            problem = f"{config.output} is the output of {loaded[path][0]} too"
            raise InputError(problem, key=("output",), place=name)
        loaded[path] = name, config
    done = []
    for name, config in loaded.values():
        warn(config.machine)
        start = time.perf_counter()
        try:
            with _progress(name, config) as progress:
                result = run_scan(config, force=force, progress=progress)
        except InputError as error:
            place = error.place or name
            raise InputError(error.problem, key=error.key, hint=error.hint, place=place) from None
        pictures = _draw(config, result)
        seconds = time.perf_counter() - start
        done.append(_summary(name, config, result, pictures))
        if not as_json:
            click.echo(_line(name, result, pictures, seconds))
    if as_json:
        print_json(done)


@contextmanager
def _progress(name: str, config: ScanConfig) -> Iterator[Progress]:
    """A bar on a terminal, nothing elsewhere; and Ctrl-C between two tiles.

    Python raises KeyboardInterrupt wherever it is, which may be a place in h5py that drops it.
    """
    stops: list[int] = []

    def check() -> None:
        if stops:
            raise KeyboardInterrupt

    handler = signal.signal(signal.SIGINT, lambda number, _: stops.append(number))
    try:
        with click.progressbar(
            length=math.prod(config.grid.shape), label=name, file=sys.stderr, show_eta=True, width=30,
            hidden=not sys.stderr.isatty(),
        ) as bar:  # fmt: skip

            def progress(points: int) -> None:
                check()
                bar.update(points)

            yield progress
        check()
    finally:
        signal.signal(signal.SIGINT, handler)


def _draw(config: ScanConfig, result: ScanResult) -> list[Path]:
    from bikestab.plot import draw_slice, save, slice_name
    from bikestab.plot_region import draw_region
    from bikestab.volume import Volume

    pictures = []
    with Volume(result.path) as volume:
        path = result.path.parent / "region.png"
        try:
            figure = draw_region(volume)
        except Exception as error:  # the volume and the other pictures are worth more than this one
            text = f"{type(error).__name__}: {error}".rstrip(": ")
            click.echo(f"warning: {path} cannot be drawn ({text}); please report this", err=True)
        else:
            save(figure, path)
            pictures.append(path)
        for plane in config.slices:
            fixed, value = plane.fixed
            pictures.append(result.path.parent / slice_name(fixed, value))
            save(draw_slice(volume, fixed, value), pictures[-1])
    return pictures


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
    return f"{name}: {result.path}{drawn}: {share}; {agree}; {seconds:.1f} s"


def _summary(name: str, config: ScanConfig, result: ScanResult, pictures: list[Path]) -> dict[str, object]:
    return {
        "config": name,
        "bicycle": config.machine.name,
        "volume": str(result.path),
        "pictures": [str(p) for p in pictures],
        "computed": result.computed,
        "points": result.points,
        "stable_points": result.stable_points,
        "largest_boundary_difference": result.agreement.largest if result.computed else None,
        "warnings": list(config.machine.warnings),
    }
