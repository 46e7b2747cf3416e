"""Round trips through every format that is written, to the last bit; and riders' files."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.formats.writing import ENDINGS, written
from bikestab.ridden import with_rider
from tests.formats.test_kinds import RIDER
from tests.strategies import machines


def round_trip(bicycle, ending, folder):
    path = folder / f"b{ending}"
    texts = {"name": bicycle.name, "source": bicycle.source}
    path.write_text(written(ending, bicycle.given, bicycle.deviations, texts), "utf-8")
    return Bicycle.load(str(path))


@pytest.mark.parametrize("ending", ENDINGS)
@settings(deadline=None, max_examples=20, derandomize=True)
@given(values=machines, share=st.floats(1e-9, 0.1))
def test_exact(tmp_path_factory, ending, values, share):
    bicycle = Bicycle.from_mapping(values) if isinstance(values, dict) else values
    bicycle = bicycle.measured(
        {key: share * abs(x) for key, x in bicycle.given.items() if share * abs(x)}, {}
    )
    found = round_trip(bicycle, ending, tmp_path_factory.getbasetemp())
    assert (found.given, found.deviations) == (bicycle.given, bicycle.deviations)
    assert found.numbers() == bicycle.numbers()


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_rider_and_odd_texts(tmp_path, ending):
    (tmp_path / "rider.txt").write_text(RIDER)
    preset = Bicycle.preset("meijaard2007")
    bicycle = with_rider(preset.replaced({"g": 9.8}), tmp_path / "rider.txt")
    assert bicycle.deviations == {"rider.m": 2.0}
    assert bicycle.given["rider.Ixz"] == -1.9
    odd = Bicycle.from_mapping({**bicycle.given, "name": "a: #'\"", "source": "ünïcode\n# w = 3"})
    found = round_trip(odd.measured(bicycle.deviations, {}), ending, tmp_path)
    assert found.given == bicycle.given
    assert found.deviations == bicycle.deviations
    assert found.name == odd.name
    assert found.source == (" ".join(odd.source.split()) if ending in (".ini", ".txt") else odd.source)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("meijaard2007", "", "r.txt: holds no parameter of a rider"),
        ("meijaard2007", RIDER + "v = 1\ndelta = 1\n", "r.txt, line 10: delta: is no parameter of a rider"),
        ("meijaard2007", RIDER.replace("xB = 0.29\n", ""), "missing parameter: rider.x"),
        ("meijaard2007", RIDER.replace("72.0", "-72"), "r.txt, line 1: mB: -72 is not non-negative"),
        ("meijaard2007", RIDER.replace("yB = 0.0", "yB = 0.1"), "line 3: yB: 0.1 is not what the others say"),
        ("dikarev1981", RIDER, "rider: the bicycle 'dikarev1981' is not given by the 25 parameters"),
    ],
)
def test_riders_refused(tmp_path, name, text, message):
    path = tmp_path / "r.txt"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        with_rider(Bicycle.preset(name), path)
    assert message in str(caught.value)


def test_no_such_format():
    with pytest.raises(InputError, match=r"\.yamml is no format that can be written\ndid you mean '\.yaml'"):
        written(".yamml", {}, {}, {})
