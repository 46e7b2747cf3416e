#!/usr/bin/env bash
# pyvista.read takes every file called .h5 for a Fluent case: a valid VTKHDF image comes back as an empty MultiBlock and
# no exception; the same bytes called .vtkhdf, or force_ext=".vtkhdf", are read.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 h5py==3.16.0 pyvista==0.49.1 vtk==9.7.2
cd "$folder"
venv/bin/python - <<'PY'
import h5py, numpy as np, pyvista, shutil, vtk
with h5py.File("image.h5", "w", track_order=True) as file:
    root = file.create_group("VTKHDF", track_order=True)
    root.attrs["Version"] = [1, 0]
    root.attrs["Type"] = np.bytes_("ImageData")
    root.attrs["WholeExtent"] = [0, 3, 0, 2, 0, 1]
    root.attrs["Origin"], root.attrs["Spacing"] = [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]
    root.attrs["Direction"] = np.eye(3).ravel()
    root.create_group("PointData")["field"] = np.arange(24.0).reshape(2, 3, 4)
shutil.copy("image.h5", "image.vtkhdf")
print("pyvista", pyvista.__version__, "VTK", vtk.vtkVersion().GetVTKVersion(), "h5py", h5py.__version__)
plain = pyvista.read("image.h5")
named = pyvista.read("image.vtkhdf")
forced = pyvista.read("image.h5", force_ext=".vtkhdf")
print("image.h5:     ", type(plain).__name__, "with", len(plain), "blocks")
print("image.vtkhdf: ", type(named).__name__, "with", named.n_points, "points")
print("force_ext:    ", type(forced).__name__, "with", forced.n_points, "points")
assert isinstance(plain, pyvista.MultiBlock) and sum(b is not None and b.n_points for b in plain) == 0, "behaviour changed"
assert named.n_points == forced.n_points == 24
PY
