#!/usr/bin/env bash
# HDF5's default fill value is 0, and kerchunk hands it on as zarr's fill_value, which xarray takes for "missing": every
# stored zero of such a dataset (a flag, a speed of 0) is NaN when it is read through the references.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check \
    numpy==2.4.6 h5py==3.16.0 kerchunk==0.2.10 xarray==2026.9.0 h5netcdf==1.8.2 zarr==3.1.6 aiohttp
cd "$folder"
venv/bin/python -W ignore - <<'PY'
import h5py, json, numpy as np, xarray
from importlib.metadata import version
from kerchunk.hdf import SingleHdf5ToZarr
with h5py.File("flags.h5", "w", track_order=True) as file:
    file.create_dataset("x", data=np.arange(3.0), track_order=True).make_scale("x")
    flags = file.create_dataset("flag", data=np.array([0, 1, 0], np.uint8), track_order=True)
    flags.dims[0].attach_scale(file["x"])
json.dump(SingleHdf5ToZarr("flags.h5").translate(), open("refs.json", "w"))
direct = xarray.open_dataset("flags.h5", engine="h5netcdf")["flag"]
through = xarray.open_dataset("refs.json", engine="kerchunk")["flag"]
print("kerchunk", version("kerchunk"), "zarr", version("zarr"), "xarray", xarray.__version__)
print("h5netcdf:", direct.dtype, direct.values.tolist())
print("kerchunk:", through.dtype, through.values.tolist())
assert direct.values.tolist() == [0, 1, 0]
assert np.isnan(through.values[[0, 2]]).all() and through.values[1] == 1, "behaviour changed"
PY
