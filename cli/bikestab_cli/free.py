"""The options --free and --sd of ``design``: the best designs of several free parameters, a column each."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click
from bikestab_cli.design_words import VANISHES
from bikestab_cli.designless import end_of_all, lacking, results_of_all, told_without, with_design
from bikestab_cli.options import check_files, told_as_options
from bikestab_cli.output import (
    as_read,
    heading,
    print_json,
    prose,
    span_read,
    table,
    tell,
    tell_file,
    within,
)
from bikestab_cli.quantities import Ends
from bikestab_cli.several import Chosen, record_of

from bikestab.variants import parameter_of, told_deviations

if TYPE_CHECKING:
    from bikestab.design.free import Free, FreeBest, FreeDesign
    from bikestab.model import Model


def check_free(free: dict[str, Ends], others: object) -> None:
    """Refuse options that leave others unheeded."""
    context = click.get_current_context()
    if not free:
        raise click.UsageError("--sd is for the most robust design of --free parameters", context)
    fixed = ("lam", "sigma", "trail", "head_angle", "offset")
    default = click.core.ParameterSource.DEFAULT
    if others or any(context.get_parameter_source(name) != default for name in fixed):
        problem = "--free says all that is searched: leave out the options of tilt and trail, and --over"
        raise click.UsageError(problem, context)


def tell_free(
    machines: list[Chosen], ends: dict[str, Ends], deviations: tuple[bool, dict[str, float]], model: Model,
    speeds: tuple[float, Ends | None, Ends | None], output: str | None, csv_file: str | None, as_json: bool,
) -> None:  # fmt: skip
    """Search over several free parameters, and tell what was found, draw it and write it."""
    from bikestab.design.free import Free, best_free
    from bikestab.export.optima import optima_blocks, optima_columns
    from bikestab.export.tables import of_machines, save_csv

    if output and len(machines) > 1:
        raise click.BadParameter("this picture is of one machine", param_hint="--output")
    check_files(csv_file, output)

    V_max, judged, stable = speeds
    of_file, given = deviations
    named = dict.fromkeys(ends, "--free")
    results, told, bests = [], [], []
    lacks = lacking(machines, ends)
    able = with_design(machines, lacks)
    for machine in able:
        known = {name: sd for name, sd in machine.bicycle.deviations.items() if sd > 0} if of_file else {}
        with told_as_options(judged="--V", V_max="--V-max", **named):
            free = Free(machine.bicycle, ends, model, V_max, judged, stable)
            best = best_free(free, {**known, **given})
        searched = {**ends, "V_max": V_max, "judged": judged, "stable": stable}
        results.append([{"searched": searched, **best._asdict(), "pareto": [], "closest": None}])
        told.append(told_free(free, best, {**known, **given}, machine.changes))
        bests.append(best)
    if not as_json:
        told += told_without(machines, lacks)
        tell("\n\n".join(told), csv_file, output)
    if csv_file:
        blocks = [
            (machine.bicycle.name, machine.changes, optima_blocks(best))
            for machine, best in zip(able, bests, strict=True)
        ]
        save_csv(*of_machines(optima_columns(free), blocks), csv_file)
    if output:
        from bikestab.plot.files import save
        from bikestab.plot.free import draw_free

        save(draw_free(free, bests[0]), Path(output))
    files = {kind: name for kind, name in (("csv", csv_file), ("picture", output)) if name}
    if as_json:
        print_json(record_of(machines, model, results_of_all(machines, lacks, results), files))
    else:
        for name in files.values():
            tell_file(name)
    end_of_all(machines, lacks)


def told_free(free: Free, best: FreeBest, deviations: Mapping[str, float], changes: str) -> str:
    """What was searched, the optima, and how robust the last of them is."""
    changed = f" ({changes})" if changes else ""
    ranges = []
    for name, (low, high) in free.ends.items():
        unit = parameter_of(free.bicycle, name).unit
        ranges.append(f"{name} = {span_read(name, low, high, unit)}")
    stable = f"; stable from {free.stable[0]:g} to {free.stable[1]:g} m/s" if free.stable else ""
    searched = f"searched: {', '.join(ranges)}{stable}"
    if deviations:
        searched += f"\nstandard deviations: {told_deviations(free.bicycle, deviations)}"
    parts = [f"{heading(free.bicycle, free.model)}{changed}\n{searched}"]
    found = {name.replace(" ", "\n"): design for name, design in best.designs.items()}
    if not (best.widest or best.lowest_V1):
        parts.append("no design was found that is stable as asked; larger ranges of --free may help")
    if found:
        parts.append(table(["", *found], _rows(free, list(found.values()))))
    places = [
        f"{name}: {design['at']}" for name, design in best.designs.items() if design["at"] != "interior"
    ]
    if places:
        parts.append("\n".join(places))
    if best.lowest_V1 and "shrinks" in best.lowest_V1["at"]:
        parts.append(VANISHES)
    if best.most_robust:
        robust = best.most_robust
        at = ", ".join(f"{n} = {as_read(n, x, '')[0]:.6g}" for n, x in robust["nearest"].items())
        parts.append(
            f"most robust: every machine within {robust['radius']:.4g} standard deviations of it is stable "
            f"at these speeds; the nearest that is not has {at}"
        )
    return "\n\n".join(map(prose, parts))


def _rows(free: Free, designs: list[FreeDesign]) -> list[list[str]]:
    rows = []
    for name in free.ends:
        unit = as_read(name, 0.0, parameter_of(free.bicycle, name).unit)[1]
        values = [within(as_read(name, d["over"][name], "")[0], 9) for d in designs]
        rows.append([f"{name} [{unit}]".removesuffix(" [1]"), *values])
    rows.append(["head angle [°]", *(f"{d['head_angle_deg']:.3f}" for d in designs)])
    rows += [[f"{key} [m]", *(f"{value:z.4f}" for value in values)] for key, values in (
        ("trail", [d["trail"] for d in designs]), ("offset", [d["offset"] for d in designs])
    ) if key not in free.ends]  # fmt: skip
    for end, kind in (("V1", "lower"), ("V2", "upper")):
        shown: list[str] = []
        for d in designs:
            V = d["V1"] if end == "V1" else d["V2"]
            word = d["lower"] if kind == "lower" else d["upper"]
            shown.append(f"{V:.5f}\n{word}" if V is not None else word or "none")
        rows.append([f"{end} [m/s]", *shown])
    rows.append(["width [m/s]", *(f"{d['width']:.5f}" for d in designs)])
    rates = (("inf" if d["growth_rate"] is None else f"{d['growth_rate']:z.5f}", d["V"]) for d in designs)
    rows.append(["growth [1/s]\nat [m/s]", *(f"{rate}\n{V:.4f}" for rate, V in rates)])
    return rows
