"""A commented config to start from."""

from __future__ import annotations

import json
import re
from pathlib import Path

from bikestab.bicycle import Bicycle


def starting_config(bicycle_name: str, file: str | Path) -> str:
    """YAML text of a config for ``file``: a grid around the bicycle's own design, with remarks for the rest.

    Raises InputError as ``Bicycle.load``.
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
        "BICYCLE": json.dumps(bicycle_name, ensure_ascii=False),  # quoted, as any name may need it in YAML
        "OUTPUT": json.dumps(f"out/{Path(file).stem}", ensure_ascii=False),
        "LAM": f"{lam:.6g}",
        "SIGMA": f"{sigma:.6g}",
    }
    text = (Path(__file__).parent / "template.yaml").read_text("utf-8")
    return re.sub("@([A-Z_]+)@", lambda match: values[match[1]], text)
