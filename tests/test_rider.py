"""A rider apart from the bicycle: joined to B as BicycleParameters joins them, varied, and refused."""

import numpy as np
import pytest
from bicycleparameters.inertia import combine_bike_rider
from hypothesis import given, settings

import bikestab as bs
from bikestab.bicycle import Bicycle
from bikestab.config.file import parse_config
from bikestab.errors import InputError
from bikestab.machines import Machines
from bikestab.yamltext import parse
from tests.configs import GOOD
from tests.strategies import meijaard_machines

# A bicycle and a rider of 83.5 kg on it (Moore 2012), to five digits.
BROWSER = {
    "w": 1.121, "c": 0.068581, "lam": 0.39968, "g": 9.81, "rR": 0.34096, "mR": 3.11, "IRxx": 0.090411,
    "IRyy": 0.15239, "xB": 0.27595, "zB": -0.53784, "mB": 9.86, "IBxx": 0.52963, "IByy": 1.3164,
    "IBzz": 0.75679, "IBxz": -0.11629, "xH": 0.86695, "zH": -0.74824, "mH": 3.22, "IHxx": 0.25336,
    "IHyy": 0.24583, "IHzz": 0.095569, "IHxz": -0.072022, "rF": 0.34353, "mF": 2.02, "IFxx": 0.088383,
    "IFyy": 0.14922,
}  # fmt: skip
RIDER = {"m": 83.5, "x": 0.35247, "z": -1.1067, "Ixx": 9.5771, "Iyy": 9.7144, "Izz": 2.1636, "Ixz": -1.0298}


def with_rider(bicycle=BROWSER, **changes):
    rider = {key: value for key, value in {**RIDER, **changes}.items() if value is not None}
    return Bicycle.from_mapping({**bicycle, "rider": rider})


def joined(bicycle, rider):
    """The peer's 25 parameters of both."""
    theirs = {"mB": rider["m"], "xB": rider["x"], "yB": 0.0, "zB": rider["z"]}
    theirs |= {f"IB{axes}": rider[f"I{axes}"] for axes in ("xx", "yy", "zz", "xz")}
    found = combine_bike_rider(dict(bicycle), theirs)
    return {key: float(found[key]) for key in bicycle}


def same(found, expected):
    """Equal to rounding of sums of three terms about the ground."""
    scale = max(abs(value) for value in expected.numbers().values() if value is not None)
    for name, value in expected.numbers().items():
        assert getattr(found, name) == pytest.approx(value, rel=1e-13, abs=1e-14 * scale), name


def test_joined_as_the_peer_joins_them():
    same(with_rider(), Bicycle.from_mapping(joined(BROWSER, RIDER)))


@settings(deadline=None, max_examples=40, derandomize=True)
@given(n=meijaard_machines(), m=meijaard_machines())
def test_any_rider_on_any_bicycle(n, m):
    """Another machine's body as the rider."""
    rider = {"m": m["mB"], "x": m["xB"], "z": m["zB"]} | {f"I{a}": m[f"IB{a}"] for a in ("xx", "zz", "xz")}
    bicycle = {"IByy": 1.0, "IHyy": 1.0, **n}
    expected = Bicycle.from_mapping(joined(bicycle, {**rider, "Iyy": 1.0}))
    same(Bicycle.from_mapping({**n, "rider": rider}), expected)


def test_no_rider_at_all():
    assert with_rider(m=0, Ixx=0, Iyy=0, Izz=0, Ixz=0).numbers() == Bicycle.from_mapping(BROWSER).numbers()


def test_another_rider():
    bicycle = with_rider()
    light = bicycle.replaced({"rider.m": 60})
    same(light, with_rider(m=60))
    (note,) = light.notes
    assert note.startswith(
        "the rider's mass alone changes from the file's 83.5 kg, the rider's inertia stays; "
    )
    assert light.replaced({"rider.m": 50}).notes[0] == note
    assert bicycle.replaced({"rider.m": 60, "rider.Ixx": 7}).notes == ()
    assert bicycle.replaced({"mB": 12}).notes == ()


def test_inertia_in_proportion_to_the_mass():
    scaled = with_rider(scale_inertia=True)
    assert scaled.numbers() == with_rider().numbers()
    light = scaled.replaced({"rider.m": 60})
    assert light.notes == ()
    inertias = {f"I{a}": RIDER[f"I{a}"] * (60 / 83.5) for a in ("xx", "yy", "zz", "xz")}
    assert light.numbers() == with_rider(m=60, **inertias).numbers()
    assert Bicycle.from_mapping(scaled.given).replaced({"rider.m": 60}) == light  # nothing is lost


def test_drawn_and_swept_as_one_by_one():
    bicycle = with_rider(scale_inertia=True)
    mass = np.array([55.0, 83.5, 110.0])
    many = Machines.drawn(bicycle, {"rider.m": mass, "rider.z": np.array([-1.0, -1.1, -1.2])})
    for i, (m, z) in enumerate(zip(mass, (-1.0, -1.1, -1.2), strict=True)):
        one = bicycle.replaced({"rider.m": float(m), "rider.z": z})
        for name in ("m1", "l1", "h1", "A1", "B1", "D1"):
            assert getattr(many, name)[i, 0] == pytest.approx(getattr(one, name), rel=1e-14)
    with pytest.raises(InputError, match=r"rider\.m: 1 of 2 samples is no machine"):
        Machines.drawn(bicycle, {"rider.m": np.array([-1.0, 80.0])})


IN_PLACE = GOOD.replace(
    "bicycle: dikarev1981\n",
    "bicycle:\n" + "".join(f"  {k}: {v}\n" for k, v in BROWSER.items()) + f"  rider: {RIDER}\n",
)


@pytest.mark.parametrize("sweep", ["{rider.m: [60, 80, 100]}", "{rider: {m: [60, 80, 100]}}"])
def test_a_sweep(sweep):
    config = parse_config(parse(f"{IN_PLACE}sweep: {sweep}\n", "scan.yaml"))
    assert [axis.name for axis in config.axes] == ["rider.m"]
    assert config.axes[0].unit == "kg"
    assert [m.bicycle.m1 for m in config.members] == pytest.approx([72.97, 92.97, 112.97])
    assert len(config.notes) == 1
    assert "scale_inertia: true" in config.notes[0]
    assert parse_config(parse(config.model_copy(update={"title": "x"}).text, "again")).sha256 == config.sha256
    typed = parse_config(parse(IN_PLACE, "scan.yaml"), ["sweep.rider.m=[60, 80, 100]"])
    assert typed.sha256 == config.sha256


def test_a_volume_of_a_sweep_is_a_whole_one(tmp_path):
    text = f"{IN_PLACE}sweep: {{rider.m: [60, 80]}}\nfields: [stable]\noutput: {tmp_path}\n"
    path = bs.scan(parse_config(parse(text, "scan.yaml"))).path
    with bs.open_volume(path) as volume:
        assert list(volume.swept["rider.m"]) == [60, 80]
        assert volume.at({"rider.m": 80}).bicycle.m1 == pytest.approx(92.97)


def test_speeds_of_a_rider_who_leans_forward():
    """A number for the whole way, from eigenvalues of the peer's joined machine."""
    found = bs.stable_intervals(with_rider())
    before, inside = found.V1[0] * (1 - 1e-9), found.V1[0] * (1 + 1e-9)
    model = Bicycle.from_mapping(joined(BROWSER, RIDER))
    assert bs.growth_rate(model, before) > 0 > bs.growth_rate(model, inside)


@pytest.mark.parametrize(
    ("rider", "message"),
    [
        ("rider: 75", "line 28: rider: 75 is not keys with values"),
        ("rider: {m: 75, x: 0.3, z: -1, Ixx: 9, Izz: 2}", "missing parameter: rider.Ixz"),
        (
            "rider: {m: -75, x: 0.3, z: -1, Ixx: 9, Izz: 2, Ixz: 0}",
            "line 28: rider.m: -75 is not non-negative",
        ),
        ("rider: {m: 75, x: 0, z: -1, Ixx: 9, Izz: 2, Ixz: 9}", "line 28: rider.Ixz: |9| is more than"),
        ("rider:\n  mass: 75", "line 29: rider.mass: unknown parameter\ndid you mean 'rider.m"),
        ("rider: {m: 75, scale_inertia: 3}", "line 28: rider.scale_inertia: 3 is neither true nor false"),
        ("rider: {m: 9, x: 0, z: -1, Ixx: 9, Iyy: 99, Izz: 2, Ixz: 0}", None),
    ],
)
def test_refused_or_doubted(tmp_path, rider, message):
    path = tmp_path / "b.yaml"
    path.write_text("# mine\n" + "".join(f"{k}: {v}\n" for k, v in BROWSER.items()) + rider + "\n", "utf-8")
    if message is None:
        assert any("no rigid rider has rider.Iyy = 99" in text for text in Bicycle.load(str(path)).warnings)
        return
    with pytest.raises(InputError) as caught:
        Bicycle.load(str(path))
    assert message in str(caught.value)


def test_not_in_the_papers_notation():
    with pytest.raises(InputError, match=r"rider\.m: unknown parameter"):
        Bicycle.preset("dikarev1981").replaced({"rider.m": 75})
