#!/usr/bin/env bash
# In a list of repeated measurements of which one has no uncertainty, BicycleParameters gives that one an uncertainty of 1
# in its last printed digit: "1.38+/-0.02, 1.4" is as uncertain as if 1.4 were known to ± 0.1. Alone, "1.4" has none.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check bicycleparameters==1.5.2 uncertainties==3.2.3
cd "$folder"
venv/bin/python -W ignore - <<'PY'
from importlib.metadata import version
from pathlib import Path
from bicycleparameters.io import load_parameter_text_file
Path("m.txt").write_text("mR = 1.38+/-0.02, 1.4\nmF = 1.4\nmB = 1.38+/-0.02, 1.40+/-0.02\n")
found = load_parameter_text_file("m.txt")
print("BicycleParameters", version("bicycleparameters"), "uncertainties", version("uncertainties"))
for key, text in (("mF", "1.4"), ("mB", "1.38+/-0.02, 1.40+/-0.02"), ("mR", "1.38+/-0.02, 1.4")):
    print(f"{text:26} gives {found[key]}, standard deviation {getattr(found[key], 'std_dev', 0):.4f}")
assert getattr(found["mF"], "std_dev", 0) == 0 and found["mR"].std_dev > 0.05, "behaviour changed"
PY
