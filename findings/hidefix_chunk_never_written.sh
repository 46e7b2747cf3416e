#!/usr/bin/env bash
# hidefix refuses to read a chunked HDF5 dataset in which one chunk was never written, though the format defines such a
# chunk as the fill value, and h5py gives it.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 h5py==3.16.0 xarray==2026.9.0 hidefix==0.12.0
cd "$folder"
venv/bin/python -W ignore - <<'PY'
import h5py, hidefix, numpy as np
from importlib.metadata import version
def indexed(path):
    try:
        return f"{type(hidefix.Index(path)).__name__} made"
    except RuntimeError as error:
        return str(error).splitlines()[0]
for path, last in (("whole.h5", 8), ("part.h5", 4)):
    with h5py.File(path, "w") as file:
        file.create_dataset("a", shape=(8,), dtype="f4", chunks=(4,), compression="gzip")[:last] = 1
print("hidefix", version("hidefix"), "h5py", h5py.__version__)
print("h5py,    a chunk missing:    ", h5py.File("part.h5")["a"][()].tolist())
whole, part = indexed("whole.h5"), indexed("part.h5")
print("hidefix, every chunk written:", whole)
print("hidefix, a chunk missing:    ", part)
assert whole == "Index made" and "unexpected number of chunks" in part, "behaviour changed"
PY
