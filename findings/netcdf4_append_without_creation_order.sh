#!/usr/bin/env bash
# A plain h5py file with dimension scales reads through netCDF4, but cannot be opened for appending unless every group
# in it tracks creation order, which h5py does not do by default; the error says that the file cannot be written, not why.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 h5py==3.16.0 netCDF4==1.7.5
cd "$folder"
venv/bin/python - <<'PY'
import h5py, netCDF4, numpy as np
results = {}
for order in (False, True):
    path = f"order_{order}.nc"
    with h5py.File(path, "w", track_order=order) as file:
        file.create_dataset("x", data=np.arange(3.0), track_order=order).make_scale("x")
        file.create_dataset("y", data=np.arange(3.0), track_order=order).dims[0].attach_scale(file["x"])
    for mode in ("r", "a"):
        try:
            with netCDF4.Dataset(path, mode) as data:
                results[order, mode] = f"opens, y = {data['y'][:].tolist()}"
        except (OSError, RuntimeError) as error:
            results[order, mode] = f"{type(error).__name__}: {error}"
print("netCDF4", netCDF4.__version__, "h5py", h5py.__version__)
for (order, mode), what in results.items():
    print(f"track_order={order!s:5} mode {mode}: {what}")
assert all(what.startswith("opens") for (order, mode), what in results.items() if order or mode == "r"), "changed"
assert not results[False, "a"].startswith("opens"), "behaviour changed"
PY
