"""Slices: what is drawn, and that the curves are exact."""

import functools

import numpy as np
import pytest
from matplotlib.collections import QuadMesh

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.file import parse_config
from bikestab.errors import InputError
from bikestab.model import characteristic_table
from bikestab.plot.files import save
from bikestab.plot.slices import draw_slice
from bikestab.routh import conditions
from bikestab.scan.run import run_scan
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import CAPSIZE, WEAVE, intervals_of
from bikestab.volume import Volume

BICYCLE = Bicycle.preset("dikarev1981")
STYLES = {"-": ("hurwitz3", WEAVE), "--": ("p0", CAPSIZE)}


def volume_in(folder, more=""):
    text = (
        "title: slices\nbicycle: dikarev1981\ngrid:\n  lam: {start: 0, stop: 0.3, num: 7}\n"
        "  sigma: {start: 0, stop: 0.15, num: 6}\n  V: {start: 0, stop: 15, num: 16}\n"
        f"output: {folder}\n{more}"
    )
    return run_scan(parse_config(yamltext.parse(text, "scan.yaml"))).path


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return volume_in(tmp_path_factory.mktemp("volume"))


@pytest.fixture(scope="module")
def volume(path):
    with Volume(path) as opened:
        yield opened


@pytest.fixture(scope="module")
def draw(volume):
    """``draw_slice`` of the volume, each plane once."""
    return functools.cache(functools.partial(draw_slice, volume))


def legend(figure):
    return [text.get_text() for box in figure.legends for text in box.get_texts()]


def curves(figure):
    """(condition, kind, x, y) of each boundary curve."""
    lines = [line for line in figure.axes[0].lines if line.get_color() == "black"]
    return [(*STYLES[line.get_linestyle()], *line.get_data()) for line in lines]


def texts(figure):
    return [text.get_text() for text in figure.axes[0].texts]


# --- what is drawn


STRAIGHT = "fork offset b = 0 (below: forwards)"


@pytest.mark.parametrize(
    ("fixed", "value", "expected"),
    [
        ("lam", 0.2, ["stable", "weave boundary", "capsize boundary"]),
        ("lam", 0.05, ["stable", "weave boundary"]),
        ("sigma", 0.08, ["stable", "weave boundary", "capsize boundary"]),
        ("sigma", 0.15, ["stable", "weave boundary", "capsize boundary"]),
        ("V", 5.0, ["stable", "weave boundary", "capsize boundary", STRAIGHT]),
        ("V", 14.0, ["stable", "weave boundary", "capsize boundary", STRAIGHT]),
        ("lam", 0.0, []),
        ("V", 1.0, []),
        ("sigma", 0.0, []),
    ],
)
def test_legend(draw, fixed, value, expected):
    figure = draw(fixed, value)
    assert sorted(legend(figure)) == sorted(expected)
    narrow = ["stable"] if (fixed, value) in {("lam", 0.05), ("sigma", 0.15)} else []
    assert texts(figure) == (narrow if expected else ["no stable motion in this plane"])
    assert bool(curves(figure)) == bool(expected)


@pytest.mark.parametrize(
    ("fixed", "value", "x", "y", "title"),
    [
        ("lam", 0.2, "trail / wheelbase σ", "speed V [m/s]", "λ = 0.2 rad (head angle 78.54°)"),
        ("sigma", 0.08, "steering-axis tilt λ [rad]", "speed V [m/s]", "σ = 0.08 (trail 0.0832 m)"),
        ("V", 5.0, "steering-axis tilt λ [rad]", "trail / wheelbase σ", "V = 5 m/s"),
    ],
)
def test_axes_and_title(draw, fixed, value, x, y, title):
    ax = draw(fixed, value).axes[0]
    assert (ax.get_xlabel(), ax.get_ylabel()) == (x, y)
    assert ax.get_title() == f"slices\ndikarev1981: {title}"


def test_the_title_names_damping_and_model(tmp_path):
    with Volume(volume_in(tmp_path, "delta: 1.5\nmodel: unrefined\n")) as volume:
        title = draw_slice(volume, "lam", 0.2).axes[0].get_title()
    assert title.endswith(",\nδ = 1.5 kg m²/s, unrefined model")


def colours(figure):
    (mesh,) = [c for c in figure.axes[0].collections if isinstance(c, QuadMesh)]
    return mesh.get_array()


def on_grid(values, shape):
    """Of colours those at the grid's points: between them there are others, so that no steps are seen."""
    rows, columns = ((n - 1) // (m - 1) for n, m in zip(values.shape, shape, strict=True))
    assert min(values.shape) > 140
    return values[::rows, ::columns]


def test_on_the_grid_the_colours_are_the_volumes(volume, draw):
    stored = volume.file["growth_rate"][()]
    for plane, values in (
        (("lam", 0.2), stored[4]),
        (("sigma", 0.09), stored[:, 3]),
        (("V", 5), stored[:, :, 5]),
    ):
        # computed anew, so that pictures need not wait for the volume, which has single precision
        np.testing.assert_allclose(on_grid(colours(draw(*plane)), values.T.shape), values.T, rtol=1.2e-7)


def test_off_the_grid_the_colours_are_computed(volume, draw):
    lam, sigma, V = (volume.axis(name) for name in ("lam", "sigma", "V"))
    table = characteristic_table(BICYCLE, 0.123, sigma)
    expected = growth_rate_of(table[..., np.newaxis], V).T
    np.testing.assert_allclose(on_grid(colours(draw("lam", 0.123)), expected.shape), expected, rtol=1e-12)
    table = characteristic_table(BICYCLE, lam[:, np.newaxis], sigma)
    expected = growth_rate_of(table, 5.5).T
    np.testing.assert_allclose(on_grid(colours(draw("V", 5.5)), expected.shape), expected, rtol=1e-12)


def test_a_volume_without_growth_rate(tmp_path, draw):
    with Volume(volume_in(tmp_path, "fields: [stable]\n")) as bare:
        figure = draw_slice(bare, "lam", 0.2)
    np.testing.assert_allclose(colours(figure), colours(draw("lam", 0.2)), rtol=1e-6)
    assert "stable" in legend(figure)


# --- the curves


def ends(lam, sigma):
    """The ends of the stable intervals of designs, with kind: (cell, end)."""
    found = intervals_of(characteristic_table(BICYCLE, lam, sigma))
    return (
        np.concatenate([found.V1, found.V2], axis=-1),
        np.concatenate([found.lower, found.upper], axis=-1),
    )


@pytest.mark.parametrize(("fixed", "value"), [("lam", 0.2), ("lam", 0.05), ("sigma", 0.08), ("sigma", 0.15)])
def test_a_vertex_is_the_exact_end_of_a_stable_interval(draw, fixed, value):
    checked = 0
    for _, kind, x, V in curves(draw(fixed, value)):
        inside = (V > 0) & (x > 0)
        x, V = x[inside], V[inside]
        at, kinds = ends(value, x) if fixed == "lam" else ends(x, value)
        off = np.where(kinds == kind, np.abs(at / V[:, np.newaxis] - 1), np.inf)
        off = np.fmin.reduce(off, axis=1)
        # where two ends meet the curve runs along V, so that V is less sharp there than the curve
        assert np.mean(off < 1e-9) > 0.95
        assert np.all((off < 1e-6) | np.isinf(off))
        assert np.mean(np.isinf(off)) < 0.02
        checked += len(V)
    assert checked > 100


@pytest.mark.parametrize("V", [5.0, 3.625, 10.0])
def test_a_vertex_in_a_plane_of_one_speed_is_on_the_surface(draw, V):
    checked = 0
    for name, _, lam, sigma in curves(draw("V", V)):
        table = characteristic_table(BICYCLE, lam, sigma)
        value = getattr(conditions(table, V), name)
        size = conditions(np.abs(table), V).p0
        if name == "hurwitz3":
            a = conditions(np.abs(table), V)
            size = a.p1 * (a.p2 * a.p3 + a.p4 * a.p1) + a.p0 * a.p3**2
        assert np.all(np.abs(value) < 1e-9 * size)
        checked += len(lam)
    assert checked > 20


@pytest.mark.parametrize(("fixed", "value"), [("lam", 0.2), ("sigma", 0.15)])
def test_no_end_is_left_out(draw, fixed, value):
    """Every interval's end inside the picture has a curve next to it."""
    drawn = curves(draw(fixed, value))
    across = np.linspace(0.02, 0.14, 25) if fixed == "lam" else np.linspace(0.02, 0.29, 25)
    at, kinds = ends(value, across) if fixed == "lam" else ends(across, value)
    seen = 0
    for i, x in enumerate(across):
        for V, kind in zip(at[i], kinds[i], strict=True):
            if kind in (WEAVE, CAPSIZE) and V < 15:
                near = [np.hypot((cx - x) / 0.3, (cy - V) / 15).min() for _, k, cx, cy in drawn if k == kind]
                assert min(near) < 0.01, (x, V)
                seen += 1
    assert seen > 20


def test_curves_end_where_stability_does(draw):
    """Off the stable region neither p0 = 0 nor hurwitz3 = 0 is drawn: it is no boundary there."""
    for name, _, sigma, V in curves(draw("lam", 0.2)):
        values = conditions(characteristic_table(BICYCLE, 0.2, sigma), V)._asdict()
        for other, value in values.items():
            assert other == name or np.all(value > 0)


# --- requests


def test_the_same_picture_twice(volume, draw, tmp_path):
    save(draw("lam", 0.2), tmp_path / "a.png")
    save(draw_slice(volume, "lam", 0.2), tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


@pytest.mark.parametrize(
    ("fixed", "value"), [("lam", 0.31), ("sigma", -0.001), ("V", 15.1), ("V", float("nan"))]
)
def test_a_plane_outside_the_volume(volume, fixed, value):
    with pytest.raises(InputError, match=r"is outside the volume\nallowed: 0 \.\.\. "):
        draw_slice(volume, fixed, value)


def test_the_line_of_straight_forks(draw):
    """σ = R2 tan λ / c, from the wheel's axle above the point where the steering axis meets the ground."""
    (line,) = (each for each in draw("V", 5.0).axes[0].lines if each.get_color() == "0.25")
    lam, sigma = line.get_data()
    shown = np.isfinite(sigma)
    assert shown.sum() > 20
    np.testing.assert_allclose(sigma[shown], 0.35 * np.tan(lam[shown]) / 1.04, rtol=1e-12)


# --- scale and marks

LAM, SIGMA = np.pi / 10, 0.08 / 1.02  # of the benchmark bicycle


def test_every_picture_has_one_scale_that_is_equal_on_both_sides_of_zero(draw):
    norms = [
        mesh.norm
        for fixed, value in (("lam", 0.2), ("V", 5.0))
        for mesh in draw(fixed, value).axes[0].collections
        if isinstance(mesh, QuadMesh)
    ]
    rates = np.array([0.0, 0.02, 0.3, 4.0])
    for norm in norms:
        np.testing.assert_allclose(norm(rates) - 0.5, 0.5 - norm(-rates), atol=1e-12)
        np.testing.assert_array_equal(norm(rates), norms[0](rates))
    bar = draw("lam", 0.2).axes[1]
    labels = [label.get_text() for label in bar.get_yticklabels()]
    assert (labels[0], labels[-1]) == ("≤−5", "≥5")


@pytest.mark.parametrize(
    ("fixed", "value", "x", "y"),
    [
        ("V", 5.0, LAM, SIGMA),
        ("lam", LAM, SIGMA, None),
        ("sigma", SIGMA, LAM, None),
        ("lam", 0.2, None, None),
    ],
)
def test_own_design(tmp_path, fixed, value, x, y):
    """A point in a plane of one speed, a line where the plane has its tilt or trail, and else nothing."""
    text = (
        "bicycle: meijaard2007\ngrid:\n  lam: {start: 0, stop: 0.4, num: 3}\n"
        "  sigma: {start: 0, stop: 0.15, num: 3}\n  V: {start: 0, stop: 15, num: 3}\n"
        f"output: {tmp_path}\n"
    )
    with Volume(run_scan(parse_config(yamltext.parse(text, "scan.yaml"))).path) as volume:
        figure = draw_slice(volume, fixed, value)
    marks = [line for line in figure.axes[0].lines if line.get_label() == "own design"]
    assert ("own design" in legend(figure)) == (x is not None) == bool(marks)
    for mark in marks:
        assert mark.get_xdata()[0] == pytest.approx(x)
        assert y is None or mark.get_ydata()[0] == pytest.approx(y)


def test_the_arrow_of_a_narrow_region_ends_within_it(draw):
    for plane in (("lam", 0.05), ("sigma", 0.15)):
        ax = draw(*plane).axes[0]
        (word,) = (text for text in ax.texts if text.get_text() == "stable")
        x, V = ax.transData.inverted().transform(ax.transAxes.transform(word.xy))
        lam, sigma = (0.05, x) if plane[0] == "lam" else (x, 0.15)
        found = intervals_of(characteristic_table(BICYCLE, lam, sigma))
        assert any(a + 0.05 < V < b - 0.05 for a, b in zip(found.V1, found.V2, strict=True))
