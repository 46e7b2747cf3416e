"""Text of ``key = value +/- deviation``: what BicycleParameters' reader makes of it, and what it cannot."""

import math
import time

import pytest
from bicycleparameters.io import load_parameter_text_file
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.errors import InputError
from bikestab.formats.equalities import looks_like, parse
from bikestab.units import LENGTH, quantity


def peer(tmp_path, text):
    """Values and standard deviations as BicycleParameters reads them."""
    path = tmp_path / "peer.txt"
    path.write_text(text, "utf-8")
    found = load_parameter_text_file(path)
    return {
        key: (getattr(value, "nominal_value", value), getattr(value, "std_dev", 0.0))
        for key, value in found.items()
    }


def ours(text):
    return {key: (entry.value, entry.deviation) for key, entry in parse(text, "x.txt").entries.items()}


TEXT = """\
# a comment
w = 1.121+/-0.002
c=0.0686 +/- 0.0017 # m
lam =0.3997+/-0.0035
mR= 1.38+/-0.02, 1.37+/-0.02
mB = 9.86 +/-0.02, 9.9+/-0.04 , 9.7+/- 0.03
nF = 4, 4
g = 9.81
zB = -0.538+/-2.65e-03
v = 5.0
"""


def test_as_the_peer_reads_it(tmp_path):
    expected = peer(tmp_path, TEXT)
    found = ours(TEXT)
    assert found.keys() == expected.keys()
    for key, pair in expected.items():
        assert found[key] == pytest.approx(pair, rel=1e-15)


@settings(deadline=None, max_examples=50, derandomize=True)
@given(st.lists(st.tuples(st.floats(-1e3, 1e3), st.floats(1e-6, 10)), min_size=1, max_size=5))
def test_repeated_measurements(tmp_path_factory, pairs):
    """Their mean, and the standard deviation of the mean of independent ones."""
    text = "mB = " + ", ".join(f"{value!r}+/-{deviation!r}" for value, deviation in pairs) + "\n"
    expected = peer(tmp_path_factory.getbasetemp(), text)["mB"]
    assert ours(text)["mB"] == pytest.approx(expected, rel=1e-14, abs=1e-12)


def test_what_is_free():
    """Blanks, blank lines, a header, ± in three spellings, fractions of pi; no digit is lost."""
    text = (
        "\n  [bicycle]\n; old\n\tw=1.02±0.001\n\nc = 0.08 +- 0.002#x\nlam=pi/10\nmB = 2*pi\nmH = -18*pi/180\n"
    )
    found = parse(text, "x.txt")
    assert found.values == {
        "w": 1.02, "c": 0.08, "lam": math.pi / 10, "mB": 2 * math.pi, "mH": -18 * math.pi / 180
    }  # fmt: skip
    assert found.deviations == {"w": 0.001, "c": 0.002}
    assert found.entries["lam"].line == 7
    assert parse("lam = 18deg", "x").values == {"lam": "18deg"}  # units are for the bicycle


@pytest.mark.parametrize(
    ("text", "value", "deviation"),
    [
        ("80mm +/- 2mm", "80mm", 0.002),
        ("80 +/- 2 mm", "80 mm", 0.002),
        ("80mm ± 2", "80mm", 0.002),
        ("8cm ± 2mm", "8cm", 0.002),
        ("72deg +/- 0.5deg", "72deg", 0.5 * math.pi / 180),
        ("187 lb +- 1 kg", "187 lb", 1.0),
    ],
)
def test_units_of_measured_values(text, value, deviation):
    """One without a unit has that of the other; the value keeps its own, for the bicycle to check."""
    found = parse(f"c = {text}\n", "x.txt")
    assert found.values == {"c": value}
    assert found.deviations == {"c": pytest.approx(deviation, rel=1e-15)}


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("w 1.02", "x.txt, line 3: 'w 1.02' has no '='"),
        ("w = 1+/-2+/-3", "x.txt, line 3: w: '1+/-2+/-3' has more than one ±"),
        ("w = one +/- 2", "x.txt, line 3: w: 'one +/- 2' is not two numbers"),
        ("w = 1 +/- ", "x.txt, line 3: w: '1 +/-' is not two numbers"),
        ("w = 1.0+/-nan", "x.txt, line 3: w: '1.0+/-nan' is not a measured value"),
        ("w = nan+/-1", "x.txt, line 3: w: 'nan+/-1' is not a measured value"),
        ("w = 1.0+/--1", "x.txt, line 3: w: '1.0+/--1' is not a measured value"),
        ("w = 80mm +/- 2kg", "x.txt, line 3: w: '80mm +/- 2kg' is not two numbers"),
        ("w = 80mm +/- 2 ells", "x.txt, line 3: w: '80mm +/- 2 ells' is not two numbers"),
        ("w = 80mm +/- -2mm", "x.txt, line 3: w: '80mm +/- -2mm' is not a measured value"),
        ("w = 1.0, two", "x.txt, line 3: w: 'two' is not a number"),
        ("w = 1.0,", "x.txt, line 3: w: '' is not a number"),
        ("c = 2", "x.txt, line 3: c: given twice, first in line 2"),
    ],
)
def test_refused(line, message):
    with pytest.raises(InputError) as caught:
        parse(f"# head\nc = 1\n{line}\n", "x.txt")
    assert str(caught.value).split("\n")[0] == message


@pytest.mark.parametrize("value", ["85,5", "-85,5", "85,5 +/- 0.5", "85 +/- 0,5", "85,5+/-0,5", "1,86,87"])
def test_a_decimal_comma(value):
    with pytest.raises(InputError, match=r"mB: .* has a decimal comma"):
        parse(f"mB = {value}\n", "x.txt")


@pytest.mark.parametrize("value", ["85, 86", "85.0,86.0", "85.5,86", "85+/-1,86+/-1", "85 ,86.0"])
def test_no_decimal_comma(value):
    assert 85 <= parse(f"mB = {value}\n", "x.txt").values["mB"] <= 86


@pytest.mark.parametrize("number", ["1_000", "\u0661", "1\uff10", "2*1_0", "0x10", "1/0", "2**3", "1*"])
def test_no_number(number):
    assert parse(f"w = {number}\n", "x.txt").values == {"w": number}
    with pytest.raises(InputError, match="is not"):
        parse(f"w = {number} +/- 1\n", "x.txt")
    with pytest.raises(InputError, match="is not a number"):
        quantity(number, LENGTH)


def test_blanks_take_no_time():
    blanks = 200_000 * " "
    begin = time.process_time()
    assert parse(f"a = 1{blanks}x={blanks}\n", "x.txt").values == {"a": f"1{blanks}x="}
    assert parse(f"a{blanks}= 1{blanks}*{blanks}*\nb = {1000 * '1'}x\n", "x.txt").values["a"][:1] == "1"
    assert time.process_time() - begin < 1


def test_recognised():
    assert looks_like("# c\n\nw = 1\n")
    assert looks_like("[bicycle]\nw=1\n")
    for other in ("", "w: 1\n", "title: a = b\n", "# w = 1\n", "- w = 1\n", "{w: 1}\n", "just words\n"):
        assert not looks_like(other)


def test_name_and_source_are_texts():
    found = parse("# name: my bike, 2020\n[bicycle]\nsource = a, b # c\nw = 1\n", "a.ini")
    assert found.texts == {"name": "my bike, 2020", "source": "a, b"}
    assert found.values == {"w": 1.0}
    assert parse("# name: one\nname = two\nw = 1\n# name: three\n", "a.ini").texts == {"name": "two"}
