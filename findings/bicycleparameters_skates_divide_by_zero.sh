#!/usr/bin/env bash
# BicycleParameters divides the wheels' spin inertias by their radii, so that a bicycle on skates (radius 0, nothing spins),
# such as the two masses of Kooijman et al. (2011), ends in a ZeroDivisionError, and among arrays in a matrix of NaN.
# With radii of a nanometre the same machine has its eigenvalues, all of them stable at 4 m/s.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check bicycleparameters==1.5.2
"$folder/venv/bin/python" -W ignore - <<'PY'
from importlib.metadata import version
import numpy as np
from bicycleparameters.models import Meijaard2007Model
from bicycleparameters.parameter_sets import Meijaard2007ParameterSet
skates = dict.fromkeys("rR mR IRxx IRyy IBxx IByy IBzz IBxz IHxx IHyy IHzz IHxz rF mF IFxx IFyy".split(), 0.0)
masses = dict(w=1.0, c=0.0, lam=np.radians(5), g=9.81, v=4.0, xB=1.2, zB=-0.4, mB=10.0, xH=1.02, zH=-0.2, mH=1.0)
model = Meijaard2007Model(Meijaard2007ParameterSet({**skates, **masses}, True))
print("BicycleParameters", version("bicycleparameters"))
seen = []
for words, radii in (("radii 0", {}), ("radii [0, 1e-9]", {r: np.array([0, 1e-9]) for r in ("rR", "rF")}),
                     ("radii 1e-9", {"rR": 1e-9, "rF": 1e-9})):
    try:
        eigenvalues, _ = model.calc_eigen(**radii)
        seen.append("stable" if eigenvalues.real.max() < 0 else "unstable")
    except (ZeroDivisionError, np.linalg.LinAlgError) as error:
        seen.append(type(error).__name__)
    print(f"{words:16} {seen[-1]}")
assert seen == ["ZeroDivisionError", "LinAlgError", "stable"], "behaviour changed"
PY
