#!/usr/bin/env bash
# unyt_quantity.from_string takes time that grows with the square of a run of blanks before it refuses a text: 8000
# blanks take about half a second, and every doubling four times as long.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 unyt==3.2.0
"$folder/venv/bin/python" - <<'PY'
import time
import unyt
taken = {}
for blanks in (2000, 8000):
    start = time.process_time()
    try:
        unyt.unyt_quantity.from_string("1" + " " * blanks + "x y")
    except ValueError:
        pass
    taken[blanks] = time.process_time() - start
print("unyt", unyt.__version__, {n: f"{t:.3f} s" for n, t in taken.items()})
assert unyt.unyt_quantity.from_string("1" + " " * 8000 + "m") == 1 * unyt.m  # the same text with a unit is a length
assert taken[8000] > 8 * taken[2000], "behaviour changed"
PY
