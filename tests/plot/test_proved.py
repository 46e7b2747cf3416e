"""Pictures of what is proved: the cells of the plane, and never a boundary in a proved one."""

import numpy as np
import pytest
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_rgb

from bikestab.certified import add_certified
from bikestab.errors import InputError
from bikestab.plot.proved import _KINDS, proved_in_plane
from bikestab.plot.slices import draw_slice
from bikestab.scan.run import run_scan
from bikestab.volume import Volume
from tests.volumes import config_of

CONFIG = """\
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 16}
  sigma: {values: [0.05, 0.06, 0.09, 0.14, 0.15]}
  V: {start: 0, stop: 12, num: 31}
fields: [stable]
slices: [{lam: 0.2}, {V: 5}]
output: OUT
"""


@pytest.fixture(scope="module")
def volume(tmp_path_factory):
    config = config_of(CONFIG, tmp_path_factory.mktemp("proved"))
    path = run_scan(config).path
    add_certified(path, config.machine, config.model)
    with Volume(path) as opened:
        yield opened


def drawn(figure):
    """The cells' kinds, as drawn, and the boundary curves."""
    ax = figure.axes[0]
    (mesh,) = (each for each in ax.collections if isinstance(each, QuadMesh))
    curves = [line.get_xydata() for line in ax.lines if line.get_color() == "black"]
    return np.asarray(mesh.get_array()), np.asarray(mesh.get_coordinates()), curves


@pytest.mark.parametrize(("fixed", "value", "cell"), [("lam", 0.205, 10), ("sigma", 0.1, 2), ("V", 4.9, 12)])
def test_cells_are_those_of_the_volume_and_curves_in_undecided_ones(volume, fixed, value, cell):
    cells, corners, curves = drawn(draw_slice(volume, fixed, value, "certified"))
    where = [slice(None)] * 3
    where[volume.axes.index(fixed)] = cell
    np.testing.assert_array_equal(cells, volume.read("certified", tuple(where)).T)
    assert curves
    for curve in curves:
        x, y = curve.T
        i, j = (
            np.searchsorted(edges, at) - 1 for edges, at in ((corners[:, 0, 1], y), (corners[0, :, 0], x))
        )
        inside = [np.clip(at, 0, n - 1) for at, n in zip((i, j), cells.shape, strict=True)]
        assert np.all(cells[tuple(inside)] == 0)


def test_between_two_layers_what_either_proves_holds(volume):
    """All points of a cell are proved, those at its sides too."""
    whole = volume.read("certified")
    both = np.maximum(whole[9], whole[10])
    np.testing.assert_array_equal(proved_in_plane(volume, "lam", volume.axis("lam")[10]), both.T)
    assert np.any(both != whole[9]) or np.any(both != whole[10])
    for end, cell in ((0, 0), (-1, -1)):
        np.testing.assert_array_equal(proved_in_plane(volume, "V", volume.axis("V")[end]), whole[..., cell].T)


def test_the_legend_has_shares_that_are_all(volume):
    figure = draw_slice(volume, "sigma", 0.15, "certified")
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert [word.partition(":")[0] for word in words[:3]] == ["proved stable", "proved unstable", "undecided"]
    assert words[3:] == ["weave boundary", "capsize boundary"]
    assert sum(float(word.split()[-2]) for word in words[:3]) == pytest.approx(100, abs=0.2)


def test_kinds_differ_in_lightness_alone():
    """By the luminance of sRGB: for greyscale, and for every kind of colour vision."""

    def luminance(colour):
        parts = np.array(to_rgb(colour))
        linear = np.where(parts > 0.04045, ((parts + 0.055) / 1.055) ** 2.4, parts / 12.92)
        return linear @ [0.2126, 0.7152, 0.0722]

    light = sorted(116 * luminance(colour) ** (1 / 3) - 16 for _, colour in _KINDS)
    assert np.all(np.diff(light) > 14)


def test_no_proofs(tmp_path):
    config = config_of(CONFIG.replace("16", "3"), tmp_path)
    with Volume(run_scan(config).path) as bare, pytest.raises(InputError, match="has no proofs"):
        draw_slice(bare, "V", 5, "certified")
