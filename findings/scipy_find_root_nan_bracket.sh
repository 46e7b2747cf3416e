#!/usr/bin/env bash
# scipy.optimize.elementwise.find_root takes NaN at one end of a bracket for a sign change: it homes in on the edge of
# the function's domain and reports success (status 0), even where there is no root, or misses one that is there.
# Who refines roots of a function that is not defined everywhere has to look at f_x, not at success.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 scipy==1.17.1
"$folder/venv/bin/python" - <<'PY'
import numpy as np, scipy
from scipy.optimize.elementwise import find_root

np.seterr(invalid="ignore", divide="ignore")
print("scipy", scipy.__version__)

never = find_root(lambda x: np.sqrt(1 - x) + 1, (0.0, 3.0))      # at least 1 wherever it is defined
print(f"sqrt(1 - x) + 1 in 0 ... 3: success {never.success}, x {never.x:.9g}, f_x {never.f_x}")
missed = find_root(lambda x: np.log(x) + 0.5, (-1.0, 2.0))       # zero at exp(-0.5) = 0.60653
print(f"log(x) + 0.5 in -1 ... 2: success {missed.success}, x {missed.x:.3g}, f_x {missed.f_x:.4g}")

assert never.success and never.status == 0 and np.isnan(never.f_x), "no success any more"
assert missed.success and missed.x < 1e-300 and missed.f_x < -700, "the root is found now"
PY
