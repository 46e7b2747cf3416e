#!/usr/bin/env bash
# meshio cannot read a binary PLY whose faces have a property beside the list of their vertices, which the format
# allows and trimesh reads; and it takes the format's own type uchar, 0 … 255, for a signed one.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check numpy==2.4.6 meshio==5.3.5 trimesh==5.2.0
cd "$folder"
venv/bin/python -W ignore - <<'PY'
import meshio, numpy as np, trimesh
def save(path, more, face):
    vertex = np.zeros(3, [("x", "<f8", 3), ("red", "u1")])
    vertex["x"], vertex["red"] = np.eye(3), 200
    head = ("ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
            "property uchar red\nelement face 1\nproperty list uchar int vertex_indices\n" + more + "end_header\n")
    open(path, "wb").write(head.encode() + vertex.tobytes() + face.tobytes())
corners = [("n", "u1"), ("i", "<i4", 3)]
save("plain.ply", "", np.array([(3, [0, 1, 2])], corners))
save("more.ply", "property uchar kind\n", np.array([(3, [0, 1, 2], 1)], [*corners, ("kind", "u1")]))
print("meshio", meshio.__version__, "trimesh", trimesh.__version__)
print("trimesh, with a face property:", trimesh.load("more.ply", process=False).faces.tolist())
plain = meshio.read("plain.ply")
print("meshio, without:", plain.cells_dict["triangle"].tolist(), "red 200 becomes", plain.point_data["red"][0])
try:
    seen = str(meshio.read("more.ply"))
except TypeError as error:
    seen = f"TypeError: {error}"
print("meshio, with a face property:", seen)
assert plain.point_data["red"][0] == -56 and seen.startswith("TypeError"), "behaviour changed"
PY
