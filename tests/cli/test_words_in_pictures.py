"""In no picture of a command a word covers another or leaves the picture."""

import pytest

from bikestab.design import best, search
from bikestab.plot import files
from bikestab.plot.letters import make_drawable
from bikestab.plot.ticks import plain_numbers
from tests.words import faults, offsets, smallest

PAPER = "--lam 0.2 --sigma 0.08"
NAMED = "--bicycle named.yaml --bicycle lettered.yaml --bicycle sharp1971"
VIEWS = ["--push roll_rate=0.5", "--shapes", "--over delta=0:5:5", "--over delta=0:5:5 --over mB=60:110:3"]
FREE = "design --free trail=2cm:15cm --free mB=60:110"
ALONE = ["eigen --locus", "vrange --trail 0:15cm:7", "design", FREE]
ALL = "--bicycle meijaard2007 --bicycle sharp1971 --bicycle kooijman2011"
COMMANDS = [
    f"eigen {PAPER}",
    "eigen --bicycle meijaard2007 --V 3:20:2 --delta 1",
    "eigen --bicycle sharp1971",
    f"eigen {PAPER} --locus",
    "eigen --bicycle meijaard2007 --locus",
    "eigen --bicycle sharp1971 --locus --V 0:60:2",
    "eigen --bicycle kooijman2011 --locus",
    "eigen --bicycle meijaard2007 --delta 1 --locus --V 3:8:2",
    f"eigen {ALL}",
    "eigen --bicycle meijaard2007 --set mB=60,75,90,110",
    "eigen --bicycle kooijman2011 --over delta=0:5:11 --at 4.5",
    "eigen --bicycle sharp1971 --over head_angle=65deg:80deg:6 --at 4.5",
    "eigen --bicycle meijaard2007 --shapes",
    "eigen --bicycle sharp1971 --shapes --at 0.1",
    "eigen --bicycle kooijman2011 --push roll_rate=0.5 --at 4.5",
    "eigen --bicycle meijaard2007 --push roll_rate=0.5,steer=2deg --at 1 --until 30",
    "eigen --bicycle kooijman2011 --over delta=0:5:11 --over m1=5:15:3 --at 4.5",
    f"eigen {ALL} --over delta=0:8:5 --at 7",
    f"eigen {ALL} --push roll_rate=0.5 --at 7",
    "eigen --bicycle meijaard2007 --set mB=60,85,110 --push roll_rate=0.5",
    f"eigen {ALL} --shapes --at 7",
    f"eigen {ALL} --locus",
    "eigen --bicycle meijaard2007 --set delta=0,2,4 --locus",
    "eigen --bicycle meijaard2007 --bicycle heavier.yaml --bicycle longer.yaml",
    "vrange --bicycle meijaard2007 --set delta=0,2 --trail 0:15cm:16",
    "vrange --bicycle meijaard2007 --trail 0:15cm:16 --sd c=10mm",
    f"vrange {ALL} --trail 0:15cm:31",
    f"vrange {ALL}",
    "vrange --lam 0:0.3:61 --sigma 0.15",
    "vrange --bicycle meijaard2007 --bicycle kooijman2011 --over delta=0:8:9",
    "vrange --bicycle meijaard2007 --sd c=10mm --sd lam=1.5deg",
    "vrange --bicycle meijaard2007 --over mB=60:110:11 --over offset=0:60mm:4",
    "design",
    "design --bicycle meijaard2007 --delta 1",
    "design --bicycle sharp1971",
    "design --stable 4:6 --V 4:6",
    "design --lam 0.1:0.1001 --sigma 0.08:0.0801",
    "design --lam 0.2:0.2000000001 --sigma 0.08:0.0800001",
    "design --bicycle meijaard2007 --head-angle 68deg:74deg --offset 0:80mm --V 5",
    "design --bicycle meijaard2007 --over mB=60:110 --over offset=0:80mm",
    f"design {ALL}",
    "design --bicycle meijaard2007 --set mB=60,85,110",
    "design --bicycle meijaard2007 --free trail=2cm:15cm --free mB=60:110 --stable 5:5.4",
    f"sensitivity {PAPER}",
    "sensitivity --bicycle meijaard2007 --of growth",
    "sensitivity --lam 0.1 --sigma 0.08 --of sigma_min",
    "sensitivity --bicycle kooijman2011 --bicycle meijaard2007 --bicycle sharp1971",
    f"sensitivity {ALL} --of growth",
    "sensitivity --bicycle meijaard2007 --set mB=60,65,70,75,80,85,90,95 --of sigma_min",
    "compare meijaard2007 kooijman2011",
    "compare dikarev1981 meijaard2007",
    "compare meijaard2007 meijaard2007",
    "compare meijaard2007 heavier.yaml",
    "compare meijaard2007 longer.yaml",
    f"vrange {NAMED}",
    f"vrange {NAMED} --trail 0:15cm:7",
    f"eigen {NAMED} --V 0:10:5",
    f"eigen {NAMED} --locus",
    f"design {NAMED}",
    f"sensitivity {NAMED}",
    f"sensitivity {NAMED} --of growth",
    f"eigen {NAMED} --at 5 --push roll_rate=0.5",
    f"eigen {NAMED} --at 5 --shapes",
    f"eigen {NAMED} --at 5 --over delta=0:5:5",
    *(f"eigen --bicycle {name} --at 5 {view}" for name in ("named.yaml", "lettered.yaml") for view in VIEWS),
    *(f"{command} --bicycle {name}" for name in ("named.yaml", "lettered.yaml") for command in ALONE),
    *(f"bicycles {name}" for name in ("named.yaml", "lettered.yaml")),
    "compare meijaard2007 named.yaml",
    "compare meijaard2007 sharp1971 kooijman2011",
    "compare meijaard2007 dikarev1981 sharp1971 heavier.yaml longer.yaml",
    f"bicycles dikarev1981 {PAPER}",
    "bicycles meijaard2007",
    "bicycles sharp1971",
    "bicycles kooijman2011",
]


@pytest.fixture
def figures(monkeypatch):
    """The figures that commands draw, instead of their files."""
    drawn = []

    def save(figure, path):
        plain_numbers(figure)
        make_drawable(figure)
        drawn.append(figure)

    monkeypatch.setattr(files, "save", save)
    return drawn


@pytest.fixture(autouse=True)
def coarse(monkeypatch):
    monkeypatch.setattr(best, "GRID", 31)
    monkeypatch.setattr(search, "ROUNDS", 12)
    monkeypatch.setattr(search, "ROUNDS_TOGETHER", 6)


@pytest.fixture(autouse=True)
def nearly(bikestab, tmp_path):
    """Files of machines that differ little from meijaard2007: in a mass, in the trail, in their names."""
    _, text, _ = bikestab("bicycles", "meijaard2007")
    for name, old, new in (
        ("heavier", "mB: 85 ", "mB: 86 "), ("longer", "c: 0.08 ", "c: 0.081 "),
        ("named", "name: meijaard2007", f"name: {'a name of many words ' * 9}"),
        ("lettered", "name: meijaard2007", "name: 自転車の安定性を調べるための標準的な二輪車モデル"),
    ):  # fmt: skip
        assert old in text
        (tmp_path / f"{name}.yaml").write_text(text.replace(old, new), encoding="utf-8")


@pytest.mark.parametrize("command", COMMANDS)
def test_words_stand_apart(bikestab, figures, command):
    code, _, err = bikestab(*command.split(), "-o", "a.png")
    assert code == 0, err
    assert faults(figures[0]) == []
    assert offsets(figures[0]) == []
    assert smallest(figures[0]) > 6


def test_designs_in_one_place_have_one_mark(bikestab, figures):
    assert bikestab("compare", "meijaard2007", "meijaard2007", "-o", "a.png")[0] == 0
    _, plane = figures[0].axes  # without a colour bar: there is no difference
    assert [text.get_text() for text in plane.texts] == ["identical", "A, B"]
    assert len(plane.lines) == 1
