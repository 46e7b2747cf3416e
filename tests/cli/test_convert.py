"""bikestab convert: files of one format into another."""

import json
from pathlib import Path

import pytest

from bikestab.bicycle import Bicycle
from tests.formats.test_kinds import RIDER


def test_convert(bikestab):
    assert bikestab("convert", "meijaard2007", "-o", "a.json") == (0, "a.json\n", "")
    code, text, err = bikestab("convert", "a.json")
    assert (code, err) == (0, "")
    Path("b.yaml").write_text(text)
    preset = Bicycle.preset("meijaard2007")
    assert Bicycle.load("b.yaml").given == preset.given
    assert Bicycle.load("b.yaml").name == "meijaard2007"
    code, text, err = bikestab("convert", "b.yaml", "--notation", "paper", "-o", "c.ini")
    assert (code, text, err) == (0, "c.ini\n", "")
    assert Bicycle.load("c.ini").numbers() == preset.numbers()
    Path("rider.txt").write_text(RIDER)
    assert bikestab("convert", "a.json", "--rider", "rider.txt", "-o", "d.yaml")[0] == 0
    assert Bicycle.load("d.yaml").m1 == 87 + 72


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["none.txt"], "none.txt: there is no such file"),
        (["meijaard2007", "-o", "a.xls"], "a.xls: .xls is no format that can be written"),
        (["meijaard2007", "-o", "a"], "a: has no ending\n  give the format with an ending, e.g. -o out.yaml"),
        (["meijaard2007", "-o", "/dev/stdout"], "without -o it goes to stdout"),
        (["meijaard2007", "-o", "."], "is a folder"),
        (["meijaard2007", "-o", "there.yaml"], "there.yaml: exists already"),
        (["meijaard2007", "-o", "no/a.yaml"], "no/a.yaml: cannot be written"),
    ],
)
def test_convert_mistakes(bikestab, args, message):
    Path("there.yaml").write_text("mine")
    code, out, err = bikestab("convert", *args)
    assert (code, out) == (2, "")
    assert message in err
    assert [path.name for path in Path().iterdir()] == ["there.yaml"]


def test_what_a_design_of_bikecad_says_to_type_can_be_typed(bikestab, tmp_path):
    entries = {
        "Head angle": 71, "FORK0R": 45, "Wheel diameter front": 680, "Wheel diameter rear": 680, "Stack": 600,
        "FCD textfield": 390, "CS textfield": 430, "BB textfield": 70,
        "Top tube front center measure style": 3,
    }  # fmt: skip
    lines = "".join(f'<entry key="{key}">{value}</entry>\n' for key, value in entries.items())
    (tmp_path / "a.bcad").write_text(f"<!DOCTYPE properties SYSTEM 'p'>\n<properties>\n{lines}</properties>")
    code, out, err = bikestab("vrange", "--bicycle", "a.bcad")
    assert (code, out) == (2, "")
    typed = err.rpartition("bikestab vrange ")[2].replace("NAME", "meijaard2007").split()
    code, out, err = bikestab("vrange", *typed, "--json")
    assert (code, err) == (0, "")
    (result,) = json.loads(out)["results"]
    assert result["head_angle_deg"] == pytest.approx(71, rel=1e-12)
    assert result["offset"] == pytest.approx(0.045, abs=1e-7)  # of a trail that is told to 0.1 µm
    assert result["set"] == {"w": pytest.approx(1.04435, abs=1e-5), "rF": 0.34}


def test_two_parts_cannot_be_taken_apart(bikestab):
    assert bikestab("convert", "meijaard2007", "--notation", "meijaard2007") == bikestab(
        "convert", "meijaard2007"
    )
    code, out, err = bikestab("convert", "dikarev1981", "--notation", "meijaard2007", "-o", "a.yaml")
    assert (code, out) == (2, "")
    assert "error: dikarev1981: the paper's two parts cannot be taken apart into the four bodies" in err


def test_the_name_is_kept(bikestab):
    assert bikestab("convert", "meijaard2007", "-o", "other.ini")[0] == 0
    assert Bicycle.load("other.ini").name == "meijaard2007"


def test_a_rider_beside_the_bicycle_is_the_joined_one(bikestab):
    """With the correlations of a measured file, which a joined file written anew has lost."""
    Path("rider.txt").write_text(RIDER)
    bikestab("convert", "meijaard2007", "--rider", "rider.txt", "-o", "joined.yaml")
    beside = bikestab("vrange", "--bicycle", "meijaard2007", "--rider", "rider.txt", "--json")
    joined = bikestab("vrange", "--bicycle", "joined.yaml", "--json")
    assert beside[0] == joined[0] == 0
    assert json.loads(beside[1])["results"] == json.loads(joined[1])["results"]
    assert (
        "--rider: the bicycle 'dikarev1981' is not given by the 25"
        in bikestab("vrange", "--rider", "rider.txt")[2]
    )
