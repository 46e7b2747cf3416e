#!/usr/bin/env bash
# kerchunk's SingleHdf5ToZarr visits a dataset once: one that has two names (a hard link in a group, as VTKHDF files use
# to share arrays) is given to one of them and vanishes from the other, without a word.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 h5py==3.16.0 kerchunk==0.2.10
cd "$folder"
venv/bin/python - <<'PY'
import h5py, kerchunk, numpy as np
from importlib.metadata import version
from kerchunk.hdf import SingleHdf5ToZarr
names = {}
for kind in ("hard", "soft"):
    path = f"{kind}.h5"
    with h5py.File(path, "w") as file:
        file["speed"] = np.arange(1.0, 5.0)
        group = file.create_group("AGroup")
        group["speed"] = file["speed"] if kind == "hard" else h5py.SoftLink("/speed")
    refs = SingleHdf5ToZarr(path).translate()["refs"]
    names[kind] = sorted({key.rpartition("/")[0] for key in refs if key.endswith("speed/.zarray")})
print("kerchunk", version("kerchunk"), "h5py", h5py.__version__)
print("with a hard link it knows", names["hard"], "and with a soft link", names["soft"])
assert names["hard"] == ["AGroup/speed"] and "speed" in names["soft"], "behaviour changed"
PY
