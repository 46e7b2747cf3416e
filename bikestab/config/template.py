"""A commented config to start from."""

from __future__ import annotations

import json
import math
import os
import re
from pathlib import Path

from bikestab.bicycle import Bicycle
from bikestab.config.meaning import OUT_OF_EQUATIONS
from bikestab.errors import InputError
from bikestab.model import exact_table
from bikestab.presets import preset_names
from bikestab.speeds import intervals_of

CORRELATED = "# correlated as in the bicycle's file; correlation: {[mB, xB]: 0.5} would say otherwise"
_NO_ENSEMBLE = """\
# ensemble:                     # machines drawn at random: how probable stability is at each point
#   delta: {uniform: [0, 2]}    # or {normal: [mean, standard deviation]}; any parameters
#   samples: 1000
#   seed: 1"""


def starting_config(bicycle_name: str, file: str | Path, *, uncertain: bool = False) -> str:
    """YAML text of a config for ``file``: a grid around the bicycle's own design, with remarks for the rest.

    With ``uncertain`` its measured parameters are drawn at random, each with the standard deviation that the
    bicycle's file gives. Raises InputError as ``Bicycle.load``, and where there are no such deviations.
    """
    bicycle = Bicycle.load(bicycle_name)
    lam = 0.2 if bicycle.lam is None else bicycle.lam
    sigma = 0.08 if bicycle.sigma is None else bicycle.sigma
    values = {
        "LAM_START": f"{min(0.0, 1.5 * lam):.3g}",
        "LAM_STOP": f"{max(0.4, min(1.5 * lam, 0.5 * lam + 0.78)):.3g}",  # below a right angle
        "SIGMA_START": f"{min(0.0, 1.5 * sigma):.3g}",
        "SIGMA_STOP": f"{max(0.15, 1.5 * sigma):.3g}",
        "TITLE": json.dumps(f"Stable motion of {bicycle.name}", ensure_ascii=False),
        "BICYCLE": json.dumps(
            _from_its_folder(bicycle_name, file), ensure_ascii=False
        ),  # any name may need quotes
        "OUTPUT": json.dumps(f"out/{Path(file).stem}", ensure_ascii=False),
        "LAM": f"{lam:.6g}",
        "SIGMA": f"{sigma:.6g}",
        "NAME": " ".join(bicycle.name.split()),  # in a remark of one line
        "EXPECT": _expect(bicycle, lam, sigma),
        "ENSEMBLE": _ensemble(bicycle) if uncertain else _NO_ENSEMBLE,
    }
    text = (Path(__file__).parent / "template.yaml").read_text("utf-8")
    return re.sub("@([A-Z_]+)@", lambda match: values[match[1]], text)


def _expect(bicycle: Bicycle, lam: float, sigma: float) -> str:
    """Remarks that are entries of ``expect`` once uncommented: a design's exact speeds, in six digits."""
    own = bicycle.lam is not None and bicycle.sigma is not None
    design = "" if own else f"lam: {lam!r}, sigma: {sigma!r}, "
    found = intervals_of(exact_table(bicycle, lam, sigma))
    if not found.number:
        return f"#   - {{{design}stable: never}}"
    pairs = zip(found.V1[: found.number].tolist(), found.V2[: found.number].tolist(), strict=True)
    ends = [(f"{V1:.6g}", f"{V2:.6g}" if math.isfinite(V2) else "unbounded") for V1, V2 in pairs]
    within = "0.01" if "0" in dict(ends) else "1%"  # per cent of standing still are none
    lines = [f"#   - {{{design}V1: {V1}, V2: {V2}, within: {within}}}" for V1, V2 in ends]
    return "\n".join([f"{lines[0]}   # [m/s]; without lam and sigma of its own design", *lines[1:]])


def _from_its_folder(bicycle_name: str, file: str | Path) -> str:
    """The same bicycle as a config in ``file`` names it, whatever folder that is read from."""
    if bicycle_name in preset_names():
        return bicycle_name
    folder, path = (Path(os.path.realpath(name)) for name in (Path(file).parent, bicycle_name))
    try:
        found = Path(os.path.relpath(path, folder)).as_posix()
    except ValueError:  # on another drive
        return str(path)
    return f"./{found}" if found in preset_names() else found


def _ensemble(bicycle: Bicycle) -> str:
    deviations = {name: sd for name, sd in bicycle.deviations.items() if name not in OUT_OF_EQUATIONS}
    if not deviations:
        raise InputError(
            f"the bicycle {bicycle.name!r} has no uncertainties to draw",
            hint="a file has them as 'mB = 85 +/- 0.5'; or write an ensemble into the config by hand",
        )
    lines = [
        "ensemble:                     # machines drawn at random, by the standard deviations of the file"
    ]
    lines += [f"  {name}: {{normal: [{bicycle.given[name]!r}, {sd!r}]}}" for name, sd in deviations.items()]
    lines += ["  samples: 1000", "  seed: 1"]
    if any({*pair} <= deviations.keys() for pair in bicycle.correlations):
        lines.append(CORRELATED)
    return "\n".join(lines)
