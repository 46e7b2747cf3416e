#!/usr/bin/env bash
# jsfive shows no attribute at all of a group that has more than eight and tracks their order (as netCDF-4 wants): HDF5
# then keeps them in a dense index, which jsfive does not read, and it gives an empty object instead of an error.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 h5py==3.16.0
"$folder/venv/bin/python" - "$folder" <<'PY'
import sys, h5py
print("h5py", h5py.__version__, "HDF5", h5py.version.hdf5_version)
for count in (8, 9):
    with h5py.File(f"{sys.argv[1]}/{count}.h5", "w", track_order=True) as file:
        for i in range(count):
            file.attrs[f"a{i}"] = i
PY
cd "$folder"
npm install --silent --no-fund --no-audit jsfive@0.4.2 >/dev/null
cat > read.mjs <<'JS'
import { readFileSync } from "node:fs";
import * as hdf5 from "jsfive";
const number = (name) => {
  const bytes = readFileSync(name);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  return Object.keys(new hdf5.File(buffer, name).attrs).length;
};
const [eight, nine] = [number("8.h5"), number("9.h5")];
console.log(`jsfive 0.4.2: file with 8 attributes shows ${eight}, file with 9 shows ${nine}`);
if (eight !== 8 || nine !== 0) { console.log("behaviour changed"); process.exit(1); }
JS
node read.mjs
