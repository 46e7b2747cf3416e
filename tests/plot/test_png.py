"""PNG files: what another reader finds in them."""

import io
import zlib

import numpy as np
import pytest
from isal import isal_zlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from bikestab.plot.files import DPI, save
from bikestab.plot.png import png


@pytest.mark.parametrize(("alpha", "mode"), [(255, "RGB"), (254, "RGBA")])
@pytest.mark.parametrize("shape", [(1, 1), (3, 5), (200, 301)])
def test_pixels(shape, alpha, mode):
    pixels = np.random.default_rng(1).integers(0, 256, (*shape, 4), dtype=np.uint8)
    pixels[..., 3] = 255
    pixels[0, 0, 3] = alpha
    with Image.open(io.BytesIO(png(pixels, 160))) as image:
        image.load()  # which checks the sums
        assert (image.mode, image.size) == (mode, shape[::-1])
        np.testing.assert_array_equal(np.asarray(image), pixels[..., : len(mode)])
        assert image.info["dpi"] == pytest.approx((160, 160), abs=0.01)


def test_bytes_do_not_depend_on_the_process():
    """Which one process cannot see: the level is one at which isal gives the same bytes everywhere."""
    pixels = np.random.default_rng(2).integers(0, 2, (300, 400, 4), dtype=np.uint8) * 255
    written = png(pixels, 160)
    start = written.index(b"IDAT")
    stream = written[start + 4 :][: int.from_bytes(written[start - 4 : start])]
    assert stream in [isal_zlib.compress(zlib.decompress(stream), level) for level in (0, 3)]


@pytest.mark.parametrize("layout", [None, "constrained"])
def test_a_picture_is_what_matplotlib_saves(tmp_path, layout):
    def figure():
        figure = Figure(figsize=(3, 2), layout=layout)
        ax = figure.add_subplot(title="a")
        ax.plot([0, 1], [1, 0], label="line")
        figure.legend(loc="outside lower center" if layout else "lower center")
        return figure

    save(figure(), tmp_path / "a.png")
    FigureCanvasAgg(figure()).print_figure(tmp_path / "b.png", dpi=DPI)
    a, b = (np.asarray(Image.open(tmp_path / name).convert("RGB")) for name in ("a.png", "b.png"))
    np.testing.assert_array_equal(a, b)
