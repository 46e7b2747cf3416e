"""Pictures do not depend on the user's settings of matplotlib, which cannot stop them either."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import matplotlib
import pytest

import bikestab
from bikestab.bicycle import Bicycle
from bikestab.plot.files import drawn, save
from bikestab.plot.side import draw_side

ROOM = Path(bikestab.__file__).parent
BIKESTAB = shutil.which("bikestab", path=str(Path(sys.executable).parent)) or shutil.which("bikestab")


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    path = tmp_path_factory.mktemp("expected") / "a.png"
    save(draw_side(Bicycle.preset("meijaard2007"), 0.3, 0.08), path)
    return digest(path)


SETTINGS = {
    "tex": "text.usetex: True\n",
    "no dots": "savefig.dpi: 0\nfigure.dpi: 0\n",
    "huge": "font.size: 900\nlines.linewidth: 50\nfont.family: nowhere\n",
    "odd": "backend: nonsense\nno.such.key: 1\nfont.size: many\n: :\n",
    "bytes": b"\xff\xfe\x00\n",
}


@pytest.mark.parametrize("kind", [*SETTINGS, "unreadable", "backend", "no home"])
def test_settings(tmp_path, expected, kind):
    environment = {**os.environ}
    text = SETTINGS.get(kind, "")
    file = tmp_path / "matplotlibrc"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    if kind == "unreadable":  # also for those who may read everything
        file.unlink()
        os.mkfifo(file)
        file.unlink()
        file.symlink_to("/proc/self/mem")
    elif kind == "backend":
        environment["MPLBACKEND"] = "nonsense"
    elif kind == "no home":
        file.unlink()
        environment = {k: v for k, v in environment.items() if not k.startswith(("XDG", "MPL"))}
        environment["HOME"] = "/proc/none"
    command = [BIKESTAB, "bicycles", "meijaard2007", "--lam", "0.3", "--sigma", "0.08", "-o", "a.png"]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "a.png\n", "")
    assert digest(tmp_path / "a.png") == expected


def test_the_users_own_settings_stay(tmp_path, expected):
    with matplotlib.rc_context({"font.size": 31, "savefig.dpi": 20, "text.usetex": True}):
        save(draw_side(Bicycle.preset("meijaard2007"), 0.3, 0.08), tmp_path / "a.png")
        assert matplotlib.rcParams["font.size"] == 31
    assert digest(tmp_path / "a.png") == expected


def test_the_import_leaves_the_users_settings(tmp_path):
    (tmp_path / "matplotlibrc").write_text("font.size: 31\n")
    program = (
        "import os, bikestab.plot, matplotlib, logging\n"
        "print(matplotlib.rcParams['font.size'], matplotlib.get_backend())\n"
        "print(os.getcwd(), os.environ['MPLBACKEND'])\n"
        "print(logging.getLogger('matplotlib').level)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True,
        env={**os.environ, "MPLBACKEND": "svg"},
    )  # fmt: skip
    assert done.stdout == f"31.0 svg\n{tmp_path} svg\n0\n"


OUTSIDE = {  # of bikestab.plot, of each room one module that imports matplotlib
    path.parent: f"bikestab.{path.parent.relative_to(ROOM).as_posix().replace('/', '.')}.{path.stem}"
    for path in ROOM.rglob("*.py")
    if path.parent != ROOM / "plot" and re.search("^(from|import) matplotlib", path.read_text("utf-8"), re.M)
}


@pytest.mark.parametrize("module", OUTSIDE.values())
def test_rooms_that_import_matplotlib_import_plot_first(module):
    done = subprocess.run(
        [sys.executable, "-c", f"import {module}"], env={**os.environ, "MPLBACKEND": "nonsense"},
        capture_output=True, text=True,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_the_same_picture_has_the_same_bytes(ending):
    figures = (draw_side(Bicycle.preset("meijaard2007"), 0.3, 0.08) for _ in range(2))
    first, second = (drawn(figure, ending) for figure in figures)
    assert first == second
    assert b"Date" not in first
    assert b"date" not in first


def test_matplotlib_is_left_as_it_is(tmp_path):
    program = (
        "import gc, sys\n{first}import bikestab.plot\n"
        "from matplotlib.artist import Artist, kwdoc\n"
        "from matplotlib.lines import Line2D\n"
        "class Line(Line2D): pass\n"
        "print(gc.isenabled(), 'linewidth' in kwdoc(Line2D), 'linewidth' in (Line.set.__doc__ or ''))\n"
        "print('linewidth' in (Line2D.set.__doc__ or ''))"
    )
    for first, documented in (("", "False"), ("sys.ps1 = '>>> '\n", "True")):  # as at a prompt
        run = subprocess.run(
            [sys.executable, "-c", program.format(first=first)], cwd=tmp_path, capture_output=True, text=True
        )
        assert run.stdout.split("\n") == ["True True True", documented, ""], run.stderr
