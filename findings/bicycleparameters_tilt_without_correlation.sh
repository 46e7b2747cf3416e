#!/usr/bin/env bash
# BicycleParameters carries uncertainties with their correlations, but where it solves for the tilt of the steering axis
# from lengths, the tilt is a new variable that depends on nothing: the lengths' errors in tilt and trail are taken as
# independent, though both come from the same lengths. (The file's other way, an angle, keeps them.)
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check bicycleparameters==1.5.2 uncertainties==3.2.3
"$folder/venv/bin/python" -W ignore - <<'PY'
from importlib.metadata import version
from bicycleparameters.bicycle import lambda_from_abc
from uncertainties import correlation_matrix, ufloat
rF, rR = ufloat(0.34, 1e-4), ufloat(0.34, 1e-4)
a, b, c = ufloat(0.44, 0.005), ufloat(0.07, 0.005), ufloat(0.96, 0.005)
tilt = lambda_from_abc(rF, rR, a, b, c)
print("BicycleParameters", version("bicycleparameters"), "uncertainties", version("uncertainties"))
print("tilt from lengths:", tilt, "rad")
step = 1e-6
slope = (lambda_from_abc(rF, rR, a, b + step, c) - tilt).nominal_value / step
print(f"d tilt / d b = {slope:.3f} rad/m, yet the correlation of tilt and b is", correlation_matrix([tilt, b])[0, 1])
assert abs(slope) > 0.1 and correlation_matrix([tilt, b])[0, 1] == 0, "behaviour changed"
PY
