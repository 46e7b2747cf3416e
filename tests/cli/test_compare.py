"""bikestab compare: bicycles, configs and volumes, what moved, and the exit code."""

import json
from pathlib import Path

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.comparison import Side, box_of, region
from bikestab.model import exact_table
from bikestab.plot.compared import draw_compared
from bikestab.spectrum import growth_rate_of
from bikestab.stability import growth_rate

GRID = """\
grid:
  lam: {start: 0.1, stop: 0.4, num: 7}
  sigma: {start: 0.02, stop: 0.12, num: 6}
  V: {start: 0, stop: 9, num: 10}
"""


def result(run):
    code, out, _ = run
    (found,) = json.loads(out)["results"]
    return code, found


def test_two_bicycles(bikestab):
    code, found = result(bikestab("compare", "meijaard2007", "sharp1971", "--json"))
    assert (code, found["within"], found["holds"]) == (0, None, None)
    V1, V2 = found["ends"]
    assert (V1["A"], V1["B"]) == (pytest.approx(4.292382536341), pytest.approx(6.055729077017))
    assert V1["change"] == V1["B"] - V1["A"]
    assert (V2["A_kind"], V2["B_kind"]) == ("capsize", "capsize")
    rate = found["growth_rate"][0]
    middle = (V1["A"] + V2["A"]) / 2
    assert rate["A"] == pytest.approx(float(growth_rate(Bicycle.preset("meijaard2007"), middle)))
    assert {"m1", "delta", "lam"} <= {each["what"] for each in found["parameters"]}
    _, out, _ = bikestab("compare", "meijaard2007", "sharp1971")
    assert max(map(len, out.splitlines())) <= 80
    assert "V1 [m/s]" in out


def test_the_region_that_differs_is_what_growth_rates_say():
    """The share of points at which the signs of the growth rates differ; 20 000 random points."""
    sides = [
        Side(name, b := Bicycle.preset(name), "refined", (b.lam, b.sigma))
        for name in ("meijaard2007", "sharp1971")
    ]
    ends = ((0.0, 0.6), (0.0, 0.3), (0.0, 30.0))
    found = region(*sides, box_of(ends))
    random = np.random.default_rng(1)
    lam, sigma, V = (random.uniform(*e, 20_000) for e in ends)
    stable = [growth_rate_of(exact_table(side.bicycle, lam, sigma), V) < 0 for side in sides]
    box = 0.6 * 0.3 * 30
    for number, volume in zip(
        [*map(np.mean, stable), np.mean(stable[0] ^ stable[1]), np.mean(stable[0] | stable[1])],
        [*found.volumes, found.difference, found.union], strict=True,
    ):  # fmt: skip
        assert volume / box == pytest.approx(number, abs=4 * np.sqrt(0.25 / 20_000))
    assert found.share == pytest.approx(found.difference / found.union)
    same = region(sides[0], sides[0], box_of(ends))
    assert (same.difference, same.share, same.mean) == (0, 0, 0)


@pytest.mark.parametrize(
    ("within", "code"), [("16%", 0), ("13%", 1), ("3%", 1), ("0.4", 0), ("0.3", 1), ("1.5km/h", 0)]
)
def test_the_exit_code(bikestab, within, code):
    """With damping V1 is 1.9 % higher, the growth rate 15.3 % lower; the regions differ by 12.1 %, 0.354 m/s.

    A speed judges no growth rate.
    """
    Path("damped.yaml").write_text(Path(bicycle_file()).read_text("utf-8") + "\ndelta: 1\n", "utf-8")
    done = bikestab("compare", "meijaard2007", "damped.yaml", "--within", within, "--json")
    found = result(done)[1]
    assert done[0] == code, found["region"]
    assert found["holds"] is (code == 0)
    (rate,) = found["growth_rate"]
    expected = [float(growth_rate(Bicycle.preset("meijaard2007"), 5.158322, delta=d)) for d in (0, 1)]
    assert [rate["A"], rate["B"]] == pytest.approx(expected, rel=1e-5)
    assert rate["within"] is (within == "16%" if "%" in within else None)


def bicycle_file():
    from bikestab.presets import preset_text

    Path("preset.yaml").write_text(preset_text("meijaard2007"), "utf-8")
    return "preset.yaml"


DEGENERATE = """\
{R: 0.3, c: 1, g: 9.8, delta: 0, m1: 80, l1: 0.4, h1: 0.9, A1: 3.3, B1: 3.3, D1: 0, C1: 0.1,
 m2: 1, l2: 1, h2: 0, A2: 0, B2: 0, D2: 0, C2: 0, lam: 0, sigma: 0}
"""


def test_a_growth_rate_that_is_infinite_everywhere(bikestab):
    """A massless front with its mass in the axis has p4 = 0; the picture says so in words."""
    Path("degenerate.yaml").write_text(DEGENERATE, "utf-8")
    machine = Bicycle.load("degenerate.yaml")
    assert exact_table(machine, 0.0, 0.0).value[4, 0] == 0
    done = bikestab("compare", "degenerate.yaml", "meijaard2007", "-o", "d.svg", "--within", "99%", "--json")
    code, found = result(done)
    assert code == 1
    (rate,) = found["growth_rate"]
    assert (rate["A"], rate["change"], rate["within"]) == (None, None, False)
    assert "A: degenerate.yaml:" in Path("d.svg").read_text("utf-8")
    assert "infinite throughout" in Path("d.svg").read_text("utf-8")
    assert bikestab("compare", "degenerate.yaml", "degenerate.yaml", "-o", "d.png", "--within", "1%")[0] == 0


def test_per_cent_of_nearly_nothing_is_not_told(bikestab):
    """Of damping that grows a millionfold the difference is."""
    for name, delta in (("a", 1e-6), ("b", 1)):
        Path(f"{name}.yaml").write_text(
            f"{Path(bicycle_file()).read_text('utf-8')}\ndelta: {delta}\n", "utf-8"
        )
    _, out, _ = bikestab("compare", "a.yaml", "b.yaml")
    (row,) = (line.split() for line in out.splitlines() if line.startswith("delta"))
    assert row[3:] == ["1e-06", "1", "0.999999", "-"]
    (found,) = json.loads(bikestab("compare", "a.yaml", "b.yaml", "--json")[1])["results"]
    assert found["parameters"][0]["percent"] == pytest.approx(1e8, rel=1e-5)


def test_growth_rates_of_several_near_zero_are_told_by_their_difference():
    from bikestab_cli.compare_words import _beside

    from bikestab.changes import change

    rows = _beside(
        [[change("growth rate", "1/s", -1e-4, 0.25)], [change("growth rate", "1/s", -1e-4, -2e-4)]], False
    )
    assert rows == [["growth rate [1/s]", "-0.0001", "0.25\n+0.25", "-0.0002\n-100 %"]]


def test_parameters_are_those_of_the_designs_that_are_compared(bikestab):
    for given, names in (
        (("--lam", "0.3", "--sigma", "0.07"), {"mB"}),
        (("--trail", "55mm"), {"mB"}),
        ((), {"mB", "c"}),
        (("--lam", "18deg"), {"mB", "c"}),
    ):
        text = (
            Path(bicycle_file())
            .read_text("utf-8")
            .replace("mB: 85 ", "mB: 95 ")
            .replace("c: 0.08", "c: 0.07")
        )
        Path("b.yaml").write_text(text, "utf-8")
        found = result(bikestab("compare", "meijaard2007", "b.yaml", *given, "--json"))[1]
        assert {each["what"] for each in found["parameters"]} == names
    found = result(
        bikestab("compare", "meijaard2007", "dikarev1981", "--lam", "0.2", "--sigma", "0.08", "--json")
    )[1]
    assert not {"lam", "sigma"} & {each["what"] for each in found["parameters"]}


def test_other_kinds_of_ends_are_always_beyond(bikestab):
    code, out, _ = bikestab("compare", "meijaard2007", "kooijman2011", "--within", "100%")
    assert code == 1
    assert out.endswith("BEYOND 100%\n")


def test_configs_and_volumes(bikestab):
    Path("a.yaml").write_text("bicycle: meijaard2007\n" + GRID, "utf-8")
    Path("b.yaml").write_text("bicycle: meijaard2007\ndelta: 1\n" + GRID, "utf-8")
    for name in ("a", "b"):
        assert bikestab("scan", f"{name}.yaml", "--quiet")[0] == 0
    of_configs = result(bikestab("compare", "a.yaml", "b.yaml", "--json"))[1]
    of_volumes = result(bikestab("compare", "out/a", "out/b/volume.h5", "--json"))[1]
    assert of_configs["region"] == of_volumes["region"]
    assert of_configs["region"]["designs"] == [7, 6]
    assert of_configs["region"]["box"] == {"lam": [0.1, 0.4], "sigma": [0.02, 0.12], "V": [0, 9]}
    for one, other in zip(of_configs["ends"], of_volumes["ends"], strict=True):
        assert one["B"] == pytest.approx(other["B"], rel=1e-14)  # a volume has the paper's parameters
    mixed = result(bikestab("compare", "out/a", "meijaard2007", "--within", "0.001%", "--json"))
    assert (mixed[0], mixed[1]["region"]["difference"]) == (0, pytest.approx(0, abs=1e-14))
    other = GRID.replace("start: 0.1,", "start: 0.2,").replace("V: {start: 0", "V: {start: 1")
    Path("c.yaml").write_text("bicycle: meijaard2007\n" + other, "utf-8")
    found = result(bikestab("compare", "out/a", "c.yaml", "--json"))[1]["region"]
    assert found["designs"] == [81, 81]
    assert found["difference"] == pytest.approx(0, abs=1e-14)
    assert found["box"] == {"lam": [0.2, 0.4], "sigma": [0.02, 0.12], "V": [1, 9]}


def test_without_a_design_of_its_own(bikestab):
    code, out, _ = bikestab("compare", "dikarev1981", "meijaard2007")
    assert code == 0
    assert "one of them has no design of its own: give --lam and --sigma" in out
    code, found = result(
        bikestab("compare", "dikarev1981", "dikarev1981", "--lam", "0.2", "--sigma", "0.08", "--json")
    )
    assert found["A"]["design"]["lam"] == 0.2
    assert found["ends"][0]["change"] == 0


def test_a_picture(bikestab):
    _, out, _ = bikestab("compare", "meijaard2007", "sharp1971", "-o", "both.png", "--json")
    assert json.loads(out)["files"] == {"picture": "both.png"}
    assert Path("both.png").read_bytes().startswith(b"\x89PNG")


def test_the_first_is_compared_with_each_of_the_others(bikestab):
    """One command: the records are those of the pairs, and the table has a column each."""
    names = ("meijaard2007", "sharp1971", "kooijman2011")
    code, out, _ = bikestab("compare", *names, "--within", "10%", "--json", "-o", "three.png")
    found = json.loads(out)
    assert (code, found["files"]) == (1, {"picture": "three.png"})
    assert Path("three.png").read_bytes().startswith(b"\x89PNG")
    for other, record in zip(names[1:], found["results"], strict=True):
        alone = result(bikestab("compare", names[0], other, "--within", "10%", "--json"))[1]
        assert record == alone
    _, out, _ = bikestab("compare", *names)
    assert max(map(len, out.splitlines())) <= 80
    (V1,) = (line.split() for line in out.splitlines() if line.startswith("V1 [m/s]"))
    ends = [record["ends"][0] for record in found["results"]]
    assert V1[2:] == [f"{x:.6f}" for x in (ends[0]["A"], ends[0]["B"], ends[1]["B"])]
    assert "l1 [m]" in out  # one notation for all
    assert "mB" not in out
    regions = [line.split() for line in out.splitlines() if line[:2] in ("B ", "C ")][-2:]
    assert [float(row[4]) for row in regions] == pytest.approx(
        [100 * record["region"]["share"] for record in found["results"]], rel=5e-3
    )


def test_each_is_compared_as_it_would_be_alone(bikestab):
    """Bit for bit, whatever the others are: bicycles of both notations, configs and volumes, other grids."""
    grids = {
        "trails": "{x: {name: c, start: 0.06, stop: 0.1, num: 3}, y: {name: delta, values: [0, 0.4, 1]}",
        "tilts": "{lam: {start: 0.1, stop: 0.4, num: 3}, sigma: {start: 0.02, stop: 0.12, num: 3}",
        "wider": "{lam: {start: 0, stop: 0.5, num: 3}, sigma: {start: 0.05, stop: 0.2, num: 3}",
    }
    for name, grid in grids.items():
        text = f"bicycle: meijaard2007\ngrid: {grid}, V: {{start: 0, stop: 9, num: 4}}}}\nfields: [stable]\n"
        Path(f"{name}.yaml").write_text(text, "utf-8")
    text = Path(bicycle_file()).read_text("utf-8").replace("mB: 85 ", "mB: 95 ")
    Path("heavy.yaml").write_text(text, "utf-8")
    assert bikestab("scan", "tilts.yaml", "trails.yaml", "--quiet")[0] == 0
    for first, *others in (
        ("trails.yaml", "heavy.yaml", "out/trails"),
        ("out/trails", "heavy.yaml", "trails.yaml", "meijaard2007"),
        ("meijaard2007", "heavy.yaml", "sharp1971", "tilts.yaml", "out/trails", "out/tilts"),
        ("out/tilts", "tilts.yaml", "sharp1971", "wider.yaml", "dikarev1981"),
    ):
        found = json.loads(bikestab("compare", first, *others, "--within", "5%", "--json")[1])["results"]
        alone = [result(bikestab("compare", first, x, "--within", "5%", "--json"))[1] for x in others]
        assert found == alone
        _, out, _ = bikestab("compare", first, *others, "-o", "all.png")
        assert max(map(len, out.splitlines())) <= 80
        boxes = {json.dumps(record["region"]["box"]) for record in found}
        assert out.count("stable region over") == (1 if len(boxes) == 1 else len(others))


def test_many_are_compared_in_several_tables_of_80_columns(bikestab):
    for mass in (60, 70, 80, 90, 100):
        text = Path(bicycle_file()).read_text("utf-8").replace("mB: 85 ", f"mB: {mass} ")
        Path(f"m{mass}.yaml").write_text(text.replace("name: meijaard2007\n", ""), "utf-8")
    names = ["m60.yaml", "dikarev1981", *(f"m{mass}.yaml" for mass in (70, 80, 90, 100))]
    code, out, _ = bikestab("compare", *names)
    assert code == 0
    assert max(map(len, out.splitlines())) <= 80
    assert "B has no design of its own: give --lam and --sigma" in out
    heads = [line.split() for line in out.splitlines() if line.split()[:1] == ["parameter"]]
    assert heads == [["parameter", "A", "B", "C", "D"], ["parameter", "A", "E", "F"]]


def test_a_picture_without_growth_rates_says_who_they_are():
    sides = [Side(name, Bicycle.preset("dikarev1981"), "refined", None) for name in ("a.yaml", "out/b")]
    box = box_of(((0.1, 0.4), (0.02, 0.12), (0.0, 9.0)))
    (ax,) = draw_compared(sides, [region(*sides, box)]).axes
    assert ax.get_title().split("\n")[:2] == ["A: a.yaml", "B: out/b"]


def test_growth_rates_are_drawn_to_beyond_the_ends():
    bike = Bicycle.preset("meijaard2007")
    side = Side("a", bike, "refined", (bike.lam, bike.sigma))
    for top, right in ((30.0, 10.0), (8.0, 8.0)):
        box = box_of(((0.1, 0.4), (0.02, 0.12), (0.0, top)))
        figure = draw_compared([side, side, side], [region(side, side, box)] * 2)
        growth, *maps = figure.axes
        assert growth.get_xlim() == (0, right)  # V2 = 6.02
        for ax, letter in zip(maps[:2], "BC", strict=True):
            title = " ".join(ax.get_title().replace("\N{NO-BREAK SPACE}", " ").split())
            said = "stable regions differ in 0 % of their union"
            assert title == f"A and {letter}: {said}"
            assert "identical" in [text.get_text() for text in ax.texts]


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (("meijaard2007", "nothing"), "there is no bicycle 'nothing'"),
        (("meijaard2007",), "Missing argument 'B...'"),
        (("meijaard2007", "sharp1971", "--within", "0%"), "0% is out of range"),
        (("meijaard2007", "sharp1971", "--within", "much"), "'much' is not a number"),
        (("a.yaml", "b.yaml"), "b.yaml: has no lam in common with a.yaml"),
        (("a.yaml", "meijaard2007", "b.yaml"), "b.yaml: has no lam in common with a.yaml"),
        (("f.yaml", "meijaard2007", "sharp1971"), "sharp1971: the bicycle 'sharp1971' has no parameter 'mB'"),
        (("c.yaml", "sharp1971"), "sharp1971: c is the wheelbase here, and in c.yaml the trail along"),
        (("meijaard2007", "sharp1971", "nothing"), "there is no bicycle 'nothing'"),
        (("meijaard2007", "sharp1917"), "did you mean 'sharp1971'?"),
        (("meijaard2007", "first.yaml"), "first.yaml: there is no such file\n  YAML files in '.': a.yaml"),
        (("meijaard2007", "scan.yml"), "scan.yml: there is no such file\n  did you mean 'scans.yaml'?"),
        (("meijaard2007", "out/a.h5"), "out/a.h5: there is no such volume"),
        (("f.yaml", "b.yaml"), "b.yaml: is over lam and sigma, and f.yaml over mB and xB"),
    ],
)
def test_mistakes(bikestab, args, words):
    Path("a.yaml").write_text("bicycle: meijaard2007\n" + GRID, "utf-8")
    Path("b.yaml").write_text(
        "bicycle: meijaard2007\n" + GRID.replace("0.1, stop: 0.4", "0.5, stop: 0.6"), "utf-8"
    )
    family = "grid: {x: {name: mB, start: 60, stop: 90, num: 3}, y: {name: xB, start: 0.2, stop: 0.4, num: 3}"
    Path("f.yaml").write_text(
        f"bicycle: meijaard2007\n{family}, V: {{start: 0, stop: 9, num: 9}}}}\n", "utf-8"
    )
    Path("scans.yaml").touch()
    Path("c.yaml").write_text(
        Path("f.yaml").read_text("utf-8").replace("mB", "c").replace("xB", "delta"), "utf-8"
    )
    code, out, err = bikestab("compare", *args)
    assert (code, out) == (2, "")
    assert words in err


def swept(name, *values):
    values = ", ".join(map(str, values))
    Path(name).write_text(f"bicycle: meijaard2007\n{GRID}sweep: {{delta: [{values}]}}\n", "utf-8")


def test_the_machine_of_a_sweep(bikestab):
    """Each side is the machine at --at, as one of its own config would be."""
    swept("sw.yaml", 0, 1)
    swept("more.yaml", 1, 4, 6)
    Path("b.yaml").write_text("bicycle: meijaard2007\ndelta: 1\n" + GRID, "utf-8")
    code, _, err = bikestab("compare", "more.yaml", "sw.yaml", "--within", "1%")
    assert code == 2
    assert "more.yaml: has several machines, with delta = 1, 4, 6\n  choose one, for example --at" in err
    code, _, err = bikestab("compare", "more.yaml", "sw.yaml", "--at", "delta=4")
    assert code == 2
    assert "sw.yaml: has no delta = 4\n  allowed: 0, 1" in err
    assert bikestab("scan", "sw.yaml", "--quiet")[0] == 0
    for one, other in (("more.yaml", "b.yaml"), ("b.yaml", "sw.yaml"), ("more.yaml", "out/sw")):
        code, found = result(
            bikestab("compare", one, other, "--at", "delta=1", "--within", "0.001%", "--json")
        )
        assert (code, found["A"]["delta"], found["B"]["delta"]) == (0, 1, 1)
    code, found = result(bikestab("compare", "sw.yaml", "b.yaml", "--at", "delta=0", "--json"))
    assert (code, found["A"]["delta"], found["B"]["delta"]) == (0, 0, 1)
    assert found["region"]["share"] > 0.01


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (("meijaard2007", "sharp1971", "--at", "foo=3"), "neither has an axis 'foo'; they have no sweep"),
        (("sw.yaml", "meijaard2007", "--at", "detla=1"), "has several machines, with delta = 0, 1"),
        (
            ("sw.yaml", "un.yaml", "--at", "delta=1", "--at", "mB=80"),
            "neither has an axis 'mB'; known: delta",
        ),
        (("un.yaml", "un.yaml", "--model", "refined"), "--model is for a bicycle"),
        (("un.yaml", "un.yaml", "--delta", "1"), "--delta is for a bicycle"),
    ],
)
def test_an_option_that_says_nothing_of_either_is_refused(bikestab, args, words):
    swept("sw.yaml", 0, 1)
    Path("un.yaml").write_text("bicycle: meijaard2007\nmodel: unrefined\n" + GRID, "utf-8")
    code, out, err = bikestab("compare", *args)
    assert (code, out) == (2, "")
    assert words in err


def test_an_option_that_says_nothing_of_one_is_told(bikestab):
    Path("un.yaml").write_text("bicycle: meijaard2007\nmodel: unrefined\n" + GRID, "utf-8")
    code, out, err = bikestab("compare", "un.yaml", "meijaard2007", "--delta", "1", "--json")
    (found,) = json.loads(out)["results"]
    assert (code, found["A"]["delta"], found["B"]["delta"]) == (0, 0, 1)
    assert err == "note: un.yaml says itself what --delta says; it holds for the other only\n"


LOADS = """\
bicycle: meijaard2007
grid:
  x: {name: mB, start: 60, stop: 100, num: 9}
  y: {name: offset, start: 10mm, stop: 60mm, num: 6}
  V: {start: 0, stop: 9, num: 10}
fields: [stable]
output: OUT
"""


def test_volumes_and_configs_over_other_parameters(bikestab):
    """A volume, its config and its bicycle are one; damping changes the region as growth rates say."""
    Path("one.yaml").write_text(LOADS.replace("OUT", "out/one"), "utf-8")
    Path("two.yaml").write_text("delta: 2\n" + LOADS.replace("OUT", "out/two"), "utf-8")
    assert bikestab("scan", "one.yaml", "--quiet")[0] == 0
    for other in ("one.yaml", "meijaard2007"):
        code, found = result(bikestab("compare", "out/one", other, "--within", "0.01%", "--json"))
        assert (code, found["region"]["share"]) == (0, pytest.approx(0, abs=1e-12))
        assert found["region"]["box"] == {"mB": [60, 100], "offset": [0.01, 0.06], "V": [0, 9]}
        assert found["region"]["designs"] == [9, 6]
    code, found = result(
        bikestab("compare", "out/one", "two.yaml", "--within", "1%", "--json", "-o", "a.png")
    )
    assert code == 1
    bike = Bicycle.preset("meijaard2007")
    rng = np.random.default_rng(4)
    mB, offset, V = rng.uniform([60, 0.01, 0], [100, 0.06, 9], (4000, 3)).T
    lam, trail = bike.lam, (bike.R2 * np.sin(bike.lam) - offset) / np.cos(bike.lam)
    signs = [
        np.array(
            [
                growth_rate_of(exact_table(bike.replaced({"mB": m, "delta": delta}), lam, t / bike.c), v) < 0
                for m, t, v in zip(mB, trail, V, strict=True)
            ]
        )
        for delta in (0.0, 2.0)
    ]
    share = np.mean(signs[0] != signs[1]) / np.mean(signs[0] | signs[1])
    assert found["region"]["share"] == pytest.approx(share, abs=0.03)


def test_trails_in_metres_only_of_one_wheelbase(bikestab):
    for other, there in (("sharp1971", False), ("meijaard2007", True)):
        assert bikestab("compare", "meijaard2007", other, "-o", "a.svg")[0] == 0
        assert ("<!-- trail [m] -->" in Path("a.svg").read_text(encoding="utf-8")) == there
