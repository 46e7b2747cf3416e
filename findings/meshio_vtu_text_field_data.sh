#!/usr/bin/env bash
# meshio ends the whole program (SystemExit) at a .vtu file of VTK's own writer whose field data have a text, though
# nothing but the text would have to be skipped; numbers in field data it reads.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 meshio==5.3.5 pyvista==0.49.1
cd "$folder"
venv/bin/python -W ignore - <<'PY'
import meshio, numpy as np, pyvista
print("meshio", meshio.__version__, "VTK", ".".join(map(str, pyvista.vtk_version_info)))
seen = {}
for name, value in (("numbers", np.arange(3.0)), ("text", ["a title"])):
    grid = pyvista.PolyData.from_regular_faces(np.eye(3), np.array([[0, 1, 2]])).cast_to_unstructured_grid()
    grid.field_data[name] = value
    grid.save(f"{name}.vtu")
    try:
        seen[name] = str(meshio.read(f"{name}.vtu").field_data)
    except SystemExit as error:
        seen[name] = f"SystemExit {error}"
    print(f"field data of {name}: pyvista {list(pyvista.read(f'{name}.vtu').field_data)}, meshio {seen[name]}")
assert "numbers" in seen["numbers"] and seen["text"] == "SystemExit 1", "behaviour changed"
PY
