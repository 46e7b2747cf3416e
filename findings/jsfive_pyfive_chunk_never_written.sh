#!/usr/bin/env bash
# A chunk of an HDF5 dataset that was never written is the fill value, as h5py gives it. jsfive gives an empty list for a
# dataset without any chunk, and holes for a missing one; pyfive raises KeyError where one is missing.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 h5py==3.16.0 pyfive==1.3.0
cd "$folder"
npm install --silent --no-package-lock --no-audit --no-fund jsfive@0.4.2 >/dev/null
venv/bin/python - <<'PY'
import h5py, pyfive
with h5py.File("some.h5", "w") as file:
    for name, written in (("all", 4), ("half", 2), ("none", 0)):
        data = file.create_dataset(name, shape=(4,), dtype="f8", chunks=(2,), compression="gzip", fillvalue=7)
        if written:
            data[:written] = 1
print("h5py", h5py.__version__, "pyfive", pyfive.__version__)
for name in ("all", "half", "none"):
    with h5py.File("some.h5") as file:
        print("h5py  ", name, file[name][()].tolist())
    try:
        found = pyfive.File("some.h5")[name][()].tolist()
    except KeyError as error:
        found = f"KeyError {error}"
    print("pyfive", name, found)
    assert (name == "half") == (found == "KeyError (2,)"), "behaviour changed"
PY
cat > read.mjs <<'JS'
import { readFileSync } from "node:fs";
import * as hdf5 from "jsfive";
const file = new hdf5.File(new Uint8Array(readFileSync("some.h5")).buffer, "some.h5");
const shown = ["all", "half", "none"].map((name) => `${name} ${JSON.stringify([...file.get(name).value])}`);
console.log(shown.map((line) => `jsfive ${line}`).join("\n"));
if (shown[1] === "half [1,1,7,7]" || shown[2] !== "none []") throw new Error("behaviour changed");
JS
node read.mjs
