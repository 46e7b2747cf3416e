"""bikestab convert: files of one format into another."""

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
