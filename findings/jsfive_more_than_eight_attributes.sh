#!/usr/bin/env bash
# jsfive shows no attribute at all of a group that has more than eight and tracks their order (as netCDF-4 wants): HDF5
# then keeps them in a dense index, which jsfive does not read, and it gives an empty object instead of an error. A group
# whose creation properties raise that limit (H5Pset_attr_phase_change), so that nothing is dense, it does not open at all:
# "thing is not a function". Untracked order of attributes, with the old format's headers, is what it reads.
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
raised, untracked = h5py.h5p.create(h5py.h5p.FILE_CREATE), h5py.h5p.create(h5py.h5p.FILE_CREATE)
order = h5py.h5p.CRT_ORDER_TRACKED | h5py.h5p.CRT_ORDER_INDEXED
for creation in (raised, untracked):
    creation.set_link_creation_order(order)
raised.set_attr_creation_order(order)
raised.set_attr_phase_change(64, 60)
access = h5py.h5p.create(h5py.h5p.FILE_ACCESS)
access.set_libver_bounds(h5py.h5f.LIBVER_EARLIEST, h5py.h5f.LIBVER_LATEST)
for name, creation in (("raised", raised), ("untracked", untracked)):
    path = f"{sys.argv[1]}/{name}.h5".encode()
    with h5py.File(h5py.h5f.create(path, h5py.h5f.ACC_TRUNC, creation, access)) as file:
        for i in range(9):
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
let refused = "";
try { number("raised.h5"); } catch (error) { refused = error.message; }
console.log(`with the limit raised to 64: ${refused || "opened"}; without order: ${number("untracked.h5")}`);
const [eight, nine] = [number("8.h5"), number("9.h5")];
console.log(`jsfive 0.4.2: file with 8 attributes shows ${eight}, file with 9 shows ${nine}`);
if (eight !== 8 || nine !== 0 || !refused || number("untracked.h5") !== 9) { console.log("behaviour changed"); process.exit(1); }
JS
node read.mjs
