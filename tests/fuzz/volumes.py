"""``python -m tests.fuzz.volumes [CASES [FIRST]]``: damaged volumes and kept tiles, and how each ended.

A case is a number: the same number is the same damage, of bytes at random places or of objects by h5py.
"""

import contextlib
import importlib
import io
import random
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import bikestab_cli.main
import h5py
import numpy as np

from bikestab.errors import BikestabError, InputError
from bikestab.scan.run import run_scan
from tests.fuzz.limits import alone
from tests.volumes import config_of

GRID = """\
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 4}
  sigma: {values: [0.05, 0.1, 0.15]}
  V: {start: 0, stop: 10, num: 6}
output: OUT
"""
TEXTS = (
    GRID + "fields: [stable, violated, growth_rate, conditions]\n",
    GRID + "sweep: {delta: [0, 1]}\n",
    GRID + "ensemble: {m1: {normal: [80, 1]}, samples: 5, seed: 1}\n",
)
for module in ("info", "export", "slice"):  # what each case needs is here before it forks
    importlib.import_module(f"bikestab_cli.{module}")
for module in ("export.summary", "export.volumes", "export.meshes", "export.tables", "plot.slices"):
    importlib.import_module(f"bikestab.{module}")

COMMANDS = (
    ("info",), ("info", "--json"), ("export", "--intervals", "a.csv"), ("slice", "--V", "5", "-o", "a.svg"),
    ("export", "--intervals", "a.parquet"), ("export", "--at", "delta=1", "--skeleton", "a.csv"),
    ("slice", "--lam", "0.2", "--at", "delta=1", "-o", "a.png"),
    ("export", "--mesh", "a.ply", "--cells", "10"),
)  # fmt: skip


VALUES = (
    None, 0, -1, np.nan, 1e300, 2**63 - 1, "", "\ud800", "[" * 3000, b"\xff", [1, 2], ["a"], "{}", True,
    h5py.Empty("f8"), np.zeros((3, 3)), "x" * 70_000,
)  # fmt: skip


def originals(folder):
    """The bytes of a volume for each of TEXTS, and of the tiles that it is put together from."""
    whole = []
    for number, text in enumerate(TEXTS):
        config, kept = config_of(text, folder / str(number)), []

        def keep(done, points, config=config, kept=kept):
            kept[:] = [Path(config.output, "volume.h5.tiles").read_bytes()]

        path = run_scan(config, jobs=1, progress=keep).path
        whole.append((path.read_bytes(), kept[0]))
    return whole


def changed(content, chance):
    """Bytes with some of them changed, cut off, put in or left out."""
    data = bytearray(content)
    for _ in range(chance.choice((1, 1, 2, 8, 64))):
        at = chance.randrange(len(data))
        kind = chance.randrange(6)
        if kind == 0:
            data[at] ^= 1 << chance.randrange(8)
        elif kind == 1:
            data[at] = chance.choice((0, 1, 127, 128, 255))
        elif kind == 2:
            data[at : at + 8] = chance.choice((0, 1, 2**31, 2**32 - 1, 2**63, 2**64 - 1)).to_bytes(
                8, "little"
            )
        elif kind == 3:
            n = chance.randrange(1, 200)
            data[at : at + n] = bytes(n)
        elif kind == 4:
            other, n = chance.randrange(len(data)), chance.randrange(1, 200)
            data[at : at + n] = data[other : other + n]
        elif chance.random() < 0.3:
            del data[max(1, at) :]
    return bytes(data)


def edit(path, chance):
    """Change one to three objects or attributes of a volume."""
    with h5py.File(path, "a") as file:
        for _ in range(chance.choice((1, 1, 1, 2, 3))):
            names = [""]
            file.visit(names.append)
            name = chance.choice(names)
            with contextlib.suppress(Exception):  # what h5py does not do is no damage
                _edit(file, name, chance)


def _edit(file, name, chance):
    item = file[name] if name else file
    kind = chance.choice(("attribute", "attribute", "values", "delete", "retype", "reshape", "group", "link"))
    if kind == "attribute":
        key = chance.choice(sorted(item.attrs))
        value = chance.choice(VALUES)
        if value is None:
            del item.attrs[key]
        else:
            item.attrs[key] = value
    elif kind == "values" and item.size:
        at = tuple(chance.randrange(n) for n in item.shape)
        item[at] = chance.choice((0, 1, 2, 5, 200, -1, np.nan, np.inf, 1e300, -1e300))
    elif name:
        data = item[()] if isinstance(item, h5py.Dataset) else np.zeros(3)
        del file[name]
        if kind == "retype":
            file[name] = data.astype(chance.choice(("f4", "f8", "i8", "u1", "S3", "c16", "?", ">f8")))
        elif kind == "reshape":
            shapes = ((), (0,), (1,), data.shape[::-1], (*data.shape, 1), (2**40,), (2**20, 2**20, 2**20))
            file.create_dataset(name, chance.choice(shapes), data.dtype, chunks=None)
        elif kind == "group":
            file.create_group(name)
        elif kind == "link":
            links = (h5py.SoftLink("/nowhere"), h5py.SoftLink(f"/{name}"), h5py.SoftLink("/lam"))
            file[name] = chance.choice((*links, h5py.ExternalLink("other.h5", "/"), file["/"]))


def told(content, number):
    """The exit code of a command for a damaged volume."""
    chance, out, err = random.Random(number), io.StringIO(), io.StringIO()
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        path = Path("volume.h5")
        path.write_bytes(changed(content, chance) if number % 2 else content)
        if not number % 2:
            edit(path, chance)
        command, *more = COMMANDS[number // 6 % len(COMMANDS)]
        sys.argv, code = ["bikestab", command, str(path), *more], 0
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                bikestab_cli.main.main()
            except SystemExit as end:
                code = int(end.code or 0)
        left = sorted(name.name for name in Path().iterdir())
    text = err.getvalue()
    assert code in (0, 2, 3), code
    assert "a mistake of bikestab" not in text, text
    assert (not text) if code == 0 else text.startswith("error: "), text
    assert len(text.splitlines()) <= 3, text
    written = {
        name for name in more if name.startswith("a.") and code == 0 and "no mesh" not in out.getvalue()
    }
    assert set(left) == {"volume.h5", *written}, left
    return code


def resumed(whole, number):
    """How a scan ends that goes on from damaged tiles: with the same volume, or one message."""
    chance, text = random.Random(number), TEXTS[number % len(TEXTS)]
    volume, tiles = whole[number % len(TEXTS)]
    with tempfile.TemporaryDirectory() as folder:
        damaged = changed(tiles, chance)
        path = Path(folder, "volume.h5.tiles")
        path.write_bytes(damaged)
        try:
            done = run_scan(config_of(text, folder), jobs=1)
        except BikestabError as error:
            kept = path.read_bytes()
            assert kept == damaged, "kept tiles were lost"
            lines = str(error).splitlines()
            assert len(lines) <= 3, lines
            return 2 if isinstance(error, InputError) else 3
        made = done.path.read_bytes()
    assert _content(made) == _content(volume)
    return 0


def _content(volume):
    """Without the config's text, in which the folder's name stands."""
    found = {}
    with h5py.File(io.BytesIO(volume)) as file:

        def keep(name, item):
            if isinstance(item, h5py.Dataset):
                found[name] = item[()].tobytes()

        file.visititems(keep)
        return found, file.attrs["config_sha256"], file.attrs["stable_points"]


def ended(whole, kind, numbers):
    """How cases end in one process of their own, as exit codes."""
    return alone(_all_ended, whole, kind, numbers)


def _all_ended(whole, kind, numbers):
    if kind == "tiles":
        return [resumed(whole, number) for number in numbers]
    return [told(whole[number // 2 % len(TEXTS)][0], number) for number in numbers]


def main():
    """Run cases of both kinds; those that fail are told."""
    cases, first = (int(text) for text in [*sys.argv[1:], *("5000", "0")[len(sys.argv) - 1 :]])
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        whole = originals(Path(folder))
        for kind, share in (("volumes", 0.8), ("tiles", 0.2)):
            codes, begin = Counter(), time.perf_counter()
            for number in range(first, first + int(cases * share)):
                try:
                    codes[ended(whole, kind, [number])[0]] += 1
                except AssertionError as problem:
                    failed += 1
                    print(f"{kind} {number}: {str(problem)[-1500:]}")  # noqa: T201
            counts = ", ".join(f"{codes[code]} ended with {code}" for code in sorted(codes))
            print(f"{kind}: {codes.total()} in {time.perf_counter() - begin:.0f} s: {counts}", flush=True)  # noqa: T201
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
