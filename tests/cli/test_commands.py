"""bikestab slice, info, bicycles, init, schema and check."""

import json
import math
import shutil
from pathlib import Path

import h5py
import jsonschema
import pytest
from bikestab_cli.main import COMMANDS
from ruamel.yaml import YAML

from bikestab import __version__, yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.file import load_config, parse_config
from bikestab.presets import preset_text
from bikestab.scan.run import run_scan

CONFIGS = Path(__file__).parents[2] / "configs"
CONFIG = """\
title: small
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 7}
  sigma: {start: 0, stop: 0.15, num: 6}
  V: {values: [0, 3, 4.5, 10]}
output: OUT
"""


@pytest.fixture(scope="module")
def volume(tmp_path_factory):
    folder = tmp_path_factory.mktemp("volume")
    text = CONFIG.replace("OUT", str(folder))
    return run_scan(parse_config(yamltext.parse(text, "scan.yaml"))).path


def mistake(result, expected):
    code, out, err = result
    assert (code, out) == (2, "")
    assert err.startswith("error: ")
    assert expected in err
    assert len(err.splitlines()) <= 3


# --- the command line as a whole


def test_version(bikestab):
    assert bikestab("--version") == (0, f"bikestab {__version__}\n", "")


def test_help_names_every_command(bikestab):
    code, out, err = bikestab("--help")
    assert (code, err) == (0, "")
    assert [line.split()[0] for line in out.split("Commands:\n")[1].splitlines()] == list(COMMANDS)
    assert bikestab("-h") == (code, out, err)


@pytest.mark.parametrize("name", COMMANDS)
def test_help_of_a_command_has_examples(bikestab, name):
    code, out, err = bikestab(name, "--help")
    assert (code, err) == (0, "")
    assert f"  bikestab {name}" in out.split("Example")[1]
    assert max(map(len, out.splitlines())) <= 100


def test_no_command_prints_the_help(bikestab):
    code, out, err = bikestab()
    assert code in (0, 2)
    assert (out + err).startswith("Usage: bikestab")


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        (["vrnge"], "there is no command 'vrnge'; did you mean 'vrange'?"),
        (["xyzzy"], "there is no command 'xyzzy'; known: scan, vrange"),
        (["--hepl"], "'--help'"),
        (["slice", "v", "--lamb", "1"], "'--lam'"),
        (["slice", "v", "--lam"], "see 'bikestab slice --help'"),
    ],
)
def test_an_unknown_word_is_told_with_the_nearest(bikestab, args, expected):
    mistake(bikestab(*args), expected)


# --- slice


@pytest.mark.parametrize(
    ("option", "value", "name"),
    [("--lam", "0.2", "slice_lam_0.2.png"), ("--lam", "9deg", "slice_lam_9deg.png"),
     ("--sigma", "0.08", "slice_sigma_0.08.png"), ("--V", "18km/h", "slice_V_5.png")],
)  # fmt: skip
def test_slice_writes_beside_the_volume(bikestab, volume, tmp_path, option, value, name):
    shutil.copy(volume, tmp_path / "volume.h5")
    given = tmp_path if option == "--V" else tmp_path / "volume.h5"
    assert bikestab("slice", given, option, value) == (0, f"{tmp_path / name}\n", "")
    assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("name", ["a.svg", "a.pdf", "a", "a.b", "a.d/b"])
def test_slice_prints_the_file_that_it_wrote(bikestab, volume, name):
    Path("a.d").mkdir()
    code, out, err = bikestab("slice", volume, "--lam", "0.2", "-o", name)
    if name in ("a.svg", "a.pdf") or code == 0:
        assert (code, err) == (0, "")
        assert Path(out.strip()).stat().st_size > 1000
    else:
        mistake((code, out, err), name)
        assert [path for path in Path().rglob("*") if path.is_file()] == []


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ([], "give one of --lam, --sigma and --V"),
        (["--lam", "0.1", "--V", "5"], "give one of --lam, --sigma and --V"),
        (["--lam", "0.4"], "λ = 0.4 is outside the volume\n  allowed: 0 ... 0.3"),
        (["--V", "-1"], "V = -1 is outside the volume\n  allowed: 0 ... 10"),
        (["--lam", "abc"], "'abc' is not a number"),
        (["--lam", "0.1", "-o", "a.pgn"], "did you mean 'png'?"),
        (["--lam", "0.1", "-o", "none/a.png"], "none/a.png: cannot be written"),
    ],
)
def test_slice_mistakes(bikestab, volume, args, expected):
    mistake(bikestab("slice", volume, *args), expected)


# --- info


def test_info(bikestab, volume):
    code, out, err = bikestab("info", volume)
    assert (code, err) == (0, "")
    lines = dict(line.split(maxsplit=1) for line in out.splitlines())
    assert lines["title"] == "small"
    assert lines["points"] == "168"
    assert lines["lam"] == "0 ... 0.3 rad, 7 values, equal steps"
    assert lines["V"].endswith("4 values, own values")
    assert bikestab("info", volume.parent)[1] == out


def test_info_json(bikestab, volume):
    code, out, _ = bikestab("info", volume, "--json")
    assert code == 0
    (found,) = json.loads(out)["results"]
    assert found["volume"] == str(volume)
    assert (found["designs"], found["points"]) == (42, 168)
    assert found["axes"]["V"] == {"first": 0, "last": 10, "num": 4, "unit": "m s-1", "uniform": False}
    with h5py.File(volume) as file:
        assert found["config_sha256"] == file.attrs["config_sha256"]
        assert found["stable_points"] == int((file["stable"][()] == 1).sum()) > 0
        some = (file["upper"][()] > 0).any(axis=2)
    assert found["designs_with_a_stable_speed"] == int(some.sum()) > 0


def test_info_config_scans_again(bikestab, volume):
    code, out, err = bikestab("info", volume, "--config")
    assert (code, err) == (0, "")
    assert out == CONFIG.replace("OUT", str(volume.parent))


@pytest.mark.parametrize("command", [["info"], ["slice", "--lam", "0.1"]])
@pytest.mark.parametrize(
    ("content", "expected"),
    [(None, "there is no such volume"), (b"text", "is not an HDF5 file")],
)
def test_no_volume(bikestab, command, content, expected):
    if content is not None:
        Path("v.h5").write_bytes(content)
    mistake(bikestab(*command, "v.h5"), f"v.h5: {expected}")


@pytest.fixture
def flipped(volume, tmp_path):
    """A volume with a bit of some of its chunks turned."""
    path = tmp_path / "v.h5"
    data = bytearray(volume.read_bytes())
    with h5py.File(volume) as file:
        for name in ("growth_rate", "upper", "V2"):
            chunk = file[name].id.get_chunk_info(0)
            data[chunk.byte_offset + chunk.size // 2] ^= 0x10
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("command", [["info"], ["export", "--intervals", "all.csv"]])
def test_a_volume_with_a_flipped_byte(bikestab, flipped, command):
    code, out, err = bikestab(*command, flipped)
    assert (code, out) in ((2, ""), (3, ""))
    assert err.startswith("error: ")
    assert "damaged" in err


def test_a_plane_of_a_damaged_volume_is_computed_and_right(bikestab, volume, flipped):
    """A slice takes the machine and the axes from the file, and its growth rates from the model."""
    pictures = []
    for path, name in ((volume, "whole.png"), (flipped, "damaged.png")):
        assert bikestab("slice", path, "--lam", "0.2", "-o", name)[0] == 0
        pictures.append(Path(name).read_bytes())
    assert pictures[0] == pictures[1]


# --- bicycles


def test_bicycles(bikestab):
    code, out, err = bikestab("bicycles")
    assert (code, err) == (0, "")
    names = [line for line in out.splitlines() if not line.startswith(" ")]
    assert names == ["dikarev1981", "kooijman2011", "meijaard2007", "sharp1971"]
    assert "warning: no rigid front part has A2 + B2 < C2" in out
    assert max(map(len, out.splitlines())) <= 80


def test_bicycles_json(bikestab):
    found = json.loads(bikestab("bicycles", "--json")[1])["results"]
    assert [b["name"] for b in found] == ["dikarev1981", "kooijman2011", "meijaard2007", "sharp1971"]
    assert found[2]["lam"] == pytest.approx(math.pi / 10)
    (one,) = json.loads(bikestab("bicycles", "meijaard2007", "--json")[1])["results"]
    assert one == found[2]


@pytest.mark.parametrize("name", ["dikarev1981", "kooijman2011", "meijaard2007", "sharp1971"])
def test_a_printed_bicycle_is_a_bicycle(bikestab, name):
    code, out, _ = bikestab("bicycles", name)
    assert (code, out) == (0, preset_text(name))
    Path("mine.yaml").write_text(out, "utf-8")
    assert Bicycle.load("mine.yaml") == Bicycle.preset(name)


def test_bicycles_mistake(bikestab):
    mistake(bikestab("bicycles", "dikarev"), "did you mean 'dikarev1981'?")
    bikestab("convert", "meijaard2007", "-o", "mine.yaml")
    mistake(bikestab("bicycles", "mine.yaml"), "mine.yaml: is a file, not a bicycle that comes with bikestab")
    Path("a.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    mistake(bikestab("bicycles", "a.png"), "a.png: is a picture, not a bicycle's file")
    mistake(bikestab("certify", "--verify", "a.png"), "a.png: is a picture, not a certificate")
    Path("notes.txt").write_text("some words\n")
    Path("empty").touch()
    for name in ("notes.txt", "empty"):
        for args in (("bicycles", name), ("vrange", "--bicycle", name)):
            mistake(bikestab(*args), "lines such as 'mB = 85'; see 'bikestab bicycles meijaard2007'")


@pytest.mark.parametrize("command", ["scan", "check"])
def test_a_bicycle_in_place_of_a_config(bikestab, command):
    told = bikestab(command, "meijaard2007")
    mistake(told, "meijaard2007: is a bicycle, not a scan's config")
    mistake(told, "'bikestab init --bicycle meijaard2007' writes a config of it")


# --- init and schema


@pytest.mark.parametrize("args", [[], ["mine.yaml"], ["mine.yaml", "--bicycle", "meijaard2007"]])
def test_init_writes_a_good_config(bikestab, args):
    code, out, err = bikestab("init", *args)
    path = args[0] if args else "bikestab.yaml"
    assert (code, out, err) == (0, f"{path}; now 'bikestab scan {path}'\n", "")
    config = load_config(path)
    assert config.output == f"out/{Path(path).stem}"
    assert config.machine == Bicycle.preset(args[-1] if len(args) > 1 else "dikarev1981")
    schema = json.loads(bikestab("schema")[1])
    text = Path(path).read_text("utf-8")
    jsonschema.Draft202012Validator(schema).validate(YAML(typ="safe", pure=True).load(text))
    # the lines that are remarks are good too, without their mark
    uncommented = (
        text.replace("# delta:", "delta:").replace("# expect:", "expect:").replace("#   - {", "  - {")
    )
    Path(path).write_text(uncommented, "utf-8")
    assert load_config(path).delta == 1.0
    assert len(load_config(path).expect) == 1  # its own speeds, which check then finds


def test_what_init_wrote_scans(bikestab):
    bikestab("init", "mine.yaml")
    coarse = [f"--set=grid.{axis}.num=5" for axis in ("lam", "sigma", "V")]
    code, out, _ = bikestab("scan", "mine.yaml", "--set=slices=[]", *coarse)
    assert code == 0
    assert out.startswith("mine.yaml: out/mine/volume.h5, 1 picture: ")


@pytest.mark.parametrize(
    "name", ["a b.yaml", "#a.yaml", "it: a.yaml", "'.yaml", "ü.yaml", "LAM.yaml", "deep/a.yaml"]
)
def test_init_with_an_odd_name(bikestab, name):
    Path("deep").mkdir()
    assert bikestab("init", name)[0] == 0
    assert load_config(name).output == f"out/{Path(name).stem}"


def test_init_with_a_bicycle_of_ones_own(bikestab):
    Path("mine-bicycle.yaml").write_text(preset_text("meijaard2007"), "utf-8")
    assert bikestab("init", "--bicycle", "mine-bicycle.yaml")[0] == 0
    assert load_config("bikestab.yaml").machine.source == Bicycle.preset("meijaard2007").source


def test_init_keeps_what_is_there(bikestab):
    Path("bikestab.yaml").write_text("mine")
    mistake(bikestab("init"), "bikestab.yaml: exists already\n  --force replaces it")
    assert Path("bikestab.yaml").read_text() == "mine"
    assert bikestab("init", "--force")[0] == 0
    assert load_config("bikestab.yaml")


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ([".", "--force"], "'.' is a folder, not a file to write"),
        (["--bicycle", "dikarev"], "did you mean 'dikarev1981'?"),
    ],
)
def test_init_mistakes(bikestab, args, expected):
    mistake(bikestab("init", *args), expected)
    assert list(Path().iterdir()) == []


def test_schema(bikestab):
    code, out, err = bikestab("schema")
    assert (code, err) == (0, "")
    schema = json.loads(out)
    jsonschema.Draft202012Validator.check_schema(schema)
    for path in CONFIGS.glob("*.yaml"):
        jsonschema.validate(YAML(typ="safe", pure=True).load(path.read_text("utf-8")), schema)


# --- check

EXPECT = CONFIG.replace("OUT", "out/x")


def check(bikestab, *entries):
    Path("c.yaml").write_text(EXPECT + "expect:\n" + "".join(f"  - {{{entry}}}\n" for entry in entries))
    return bikestab("check", "c.yaml")


def test_check_the_configs(bikestab):
    paths = sorted(CONFIGS.glob("*.yaml"))
    code, out, err = bikestab("check", *paths)
    assert (code, err) == (0, "")
    number = sum(len(load_config(path).expect) for path in paths)
    assert (out.count("  holds\n"), out.count("FAILED")) == (number, 0)
    assert max(map(len, out.splitlines())) <= 80


@pytest.mark.parametrize(
    "entry",
    [
        "lam: 0.2, sigma: 0.08, V1: 4.0556",
        "lam: 0.2, sigma: 0.08, V2: 4.6361",
        "lam: 0.2, sigma: 0.08, V1: 4.05, within: 0.01",
        "lam: 0.05, sigma: 0.15, V1: 4.8065, V2: unbounded",
        "lam: 0.1, sigma: 0.08, stable: never",
        "lam: 0.04834835, sigma: 0.15, V1: 24.3337, V2: unbounded",
    ],
)
def test_what_holds(bikestab, entry):
    code, out, err = check(bikestab, entry)
    assert (code, err) == (0, "")
    assert out.count("  holds\n") == 1


@pytest.mark.parametrize(
    "entry",
    [
        "lam: 0.2, sigma: 0.08, V1: 4.05",
        "lam: 0.2, sigma: 0.08, V1: 4.0556, V2: 4.7",
        "lam: 0.2, sigma: 0.08, V1: 4.0556, V2: unbounded",
        "lam: 0.05, sigma: 0.15, V1: 4.8065, V2: 30",
        "lam: 0.2, sigma: 0.08, stable: never",
        "lam: 0.1, sigma: 0.08, V1: 4",
        "lam: 0.04834835, sigma: 0.15, V1: 2.2903, V2: unbounded",
    ],
)
def test_what_fails(bikestab, entry):
    code, out, err = check(bikestab, "lam: 0.1, sigma: 0.08, stable: never", entry)
    assert code == 1
    assert [line.split()[-1] for line in out.splitlines() if line.endswith(("holds", "FAILED"))] == [
        "holds", "FAILED",
    ]  # fmt: skip
    assert err == "1 of 2 expectations failed\n"


def test_check_without_a_design(bikestab):
    code, out, err = check(bikestab, "V1: 4")
    assert code == 2
    assert "ERROR" in out  # a row of its own, beside which others are judged
    assert "c.yaml" in err
    assert "expect[0]: the bicycle 'dikarev1981' has no lam and no sigma of its own" in err


def test_check_mistakes(bikestab):
    Path("c.yaml").write_text(EXPECT)
    mistake(bikestab("check", "c.yaml"), "c.yaml: has no expectations")
    mistake(bikestab("check", "none.yaml"), "none.yaml: there is no such file")
    mistake(bikestab("check"), "Missing argument")


# --- names


@pytest.mark.parametrize(
    "args",
    [["check"], ["scan"], ["info"], ["slice", "--lam", "1"], ["vrange", "--bicycle"], ["init"], ["bicycles"]],
)
def test_an_empty_name_is_told(bikestab, args):
    mistake(bikestab(*args, ""), "'' is no name")


@pytest.mark.parametrize("name", ["", ".", "..", "/", "deep/"])
@pytest.mark.parametrize(
    "args",
    [["eigen", "-o"], ["eigen", "--csv"], ["design", "-o"], ["slice", "v", "--lam", "1", "-o"],
     ["export", "v", "--mesh"], ["export", "v", "--intervals"]],
)  # fmt: skip
def test_a_folder_is_no_file_to_write(bikestab, args, name):
    Path("deep").mkdir()
    mistake(bikestab(*args, name), f"{name!r} is {'a folder, not a file to write' if name else 'no name'}")
    assert [path.name for path in Path().rglob("*")] == ["deep"]


# --- mistakes of its own


def test_no_traceback_even_of_its_own_mistakes(bikestab, monkeypatch):
    def broken(*args, **kwargs):
        raise ZeroDivisionError("no\nsuch luck " + 300 * "x")

    monkeypatch.setattr("bikestab.region.answers.stable_speeds", broken)
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007")
    assert (code, out) == (3, "")
    first, hint = err.splitlines()
    assert first.startswith("error: a mistake of bikestab itself (ZeroDivisionError: no such luck xxx")
    assert len(first) < 250
    assert "python -X dev -m bikestab" in hint


def test_a_side_view(bikestab, tmp_path):
    code, out, _ = bikestab("bicycles", "meijaard2007", "-o", str(tmp_path / "side.png"))
    assert (code, out) == (0, f"{tmp_path / 'side.png'}\n")
    assert (tmp_path / "side.png").read_bytes().startswith(b"\x89PNG")
    assert bikestab("bicycles", "-o", str(tmp_path / "side.png"))[0] == 2
    assert bikestab("bicycles", "dikarev1981", "-o", str(tmp_path / "no.png"))[0] == 2  # no design of its own
    assert not (tmp_path / "no.png").exists()
    assert bikestab("bicycles", "meijaard2007", "--lam", "0.2")[0] == 2
    built = ["--head-angle", "71deg", "--trail", "55mm", "-o", str(tmp_path / "built.svg")]
    assert bikestab("bicycles", "dikarev1981", *built)[0] == 0
    title = "λ = 0.3316 rad (head angle 71.00°), σ = 0.05288"  # 55 mm of 1.04 m
    assert title in (tmp_path / "built.svg").read_text("utf-8")
    mistake(bikestab("bicycles", "meijaard2007", "--offset", "45mm"), "--offset is for a picture: give -o")
