"""Every kind of file on a disk that is full, or that may not grow: a message, and what was there is there."""

import json
import resource
import shutil
import subprocess
from contextlib import contextmanager

import numpy as np
import pytest
from bikestab_cli.main import main
from matplotlib.figure import Figure

from bikestab.bicycle import Bicycle
from bikestab.errors import ScanError
from bikestab.export.meshes import MESHES, save_mesh
from bikestab.export.tables import TABLES, save_table
from bikestab.family import Family
from bikestab.files import MAKE_ROOM
from bikestab.paper1981.reproduce import _put
from bikestab.plot.files import save
from bikestab.region.mesh import region_mesh

OLD = b"what was there" * 100
PICTURES = (".png", ".pdf", ".svg")


@contextmanager
def no_room(folder):
    """Files of this process may not grow beyond 4 kB."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4000, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@contextmanager
def full(folder):
    """A file system of its own, with 4 kB left."""
    if not shutil.which("mount"):
        pytest.skip("needs the right to mount a file system")
    command = ["mount", "-t", "tmpfs", "-o", "size=32k", "tmpfs", str(folder)]
    names = {path.name: path.read_bytes() for path in folder.iterdir()}
    if subprocess.run(command, capture_output=True).returncode:
        pytest.skip("needs the right to mount a file system")
    try:
        for name, content in names.items():
            (folder / name).write_bytes(content)
        (folder / "fill").write_bytes(b"\0" * (shutil.disk_usage(folder).free - 4096))
        yield
        (folder / "fill").unlink()
        kept = {path.name: path.read_bytes() for path in folder.iterdir()}
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)
    for name in {*names, *kept}:
        (folder / name).unlink(missing_ok=True)
    for name, content in kept.items():
        (folder / name).write_bytes(content)


def _picture(path):
    figure = Figure()
    figure.add_subplot().imshow(np.random.default_rng(1).random((60, 60)))
    save(figure, path)


@pytest.fixture(scope="module")
def mesh():
    family = Family(Bicycle.preset("dikarev1981"))
    return region_mesh(family, (0.1, 0.3), (0.05, 0.15), (0.0, 15.0), cells=10)


@pytest.mark.parametrize("short", [no_room, full])
@pytest.mark.parametrize("ending", [*PICTURES, *MESHES, *TABLES, ".json"])
def test_what_was_there_stays(tmp_path, mesh, ending, short):
    path = tmp_path / f"a{ending}"
    path.write_bytes(OLD)
    columns = {"re": ("float64", "1/s")}

    def put(path):
        if ending in PICTURES:
            _picture(path)
        elif ending in MESHES:
            save_mesh(mesh, path, (1, 1, 1), {})
        elif ending in TABLES:
            blocks = ({"re": part} for part in np.random.default_rng(1).random((10, 3000)))
            save_table(columns, blocks, path, {})
        else:
            _put(path, json.dumps(list(range(10_000))))

    put(tmp_path / f"warm{ending}")  # which imports what it needs
    (tmp_path / f"warm{ending}").unlink()
    with short(tmp_path), pytest.raises(ScanError, match=rf"a\.\w+: the disk is full\n{MAKE_ROOM}$"):
        put(path)
    assert path.read_bytes() == OLD
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("short", [no_room, full])
def test_init_force(tmp_path, monkeypatch, capsys, short):
    path = tmp_path / "a.yaml"
    path.write_bytes(OLD)
    monkeypatch.setattr("sys.argv", ["bikestab", "init", str(path), "--force", "--bicycle", "meijaard2007"])
    monkeypatch.setattr("bikestab.config.template.starting_config", lambda *_, **__: "# x\n" * 3000)
    with short(tmp_path), pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 3
    assert capsys.readouterr().err == f"error: {path}: the disk is full\n  {MAKE_ROOM}\n"
    assert path.read_bytes() == OLD
    assert list(tmp_path.iterdir()) == [path]
