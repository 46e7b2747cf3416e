"""Pictures as files: formats, names, and what cannot be written."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from bikestab.errors import InputError
from bikestab.plot.files import save, slice_name


@pytest.mark.parametrize(
    ("name", "start"), [("a.png", b"\x89PNG"), ("a.pdf", b"%PDF"), ("a.svg", b"<?xml"), ("a.PNG", b"\x89PNG")]
)
def test_formats(tmp_path, name, start):
    save(Figure(), tmp_path / name)
    assert (tmp_path / name).read_bytes().startswith(start)


def test_an_unknown_format(tmp_path):
    with pytest.raises(InputError, match=r"a\.pgn: has no ending of a picture\ndid you mean 'png'\?"):
        save(Figure(), tmp_path / "a.pgn")
    with pytest.raises(InputError, match=r"/a: has no ending of a picture\nallowed: \.png, \.pdf, \.svg"):
        save(Figure(), tmp_path / "a")
    with pytest.raises(InputError, match=r"x\.gif: has no ending of a picture"):
        save(Figure(), tmp_path / "x.gif")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match=r"cannot be written \(No such file or directory\)"):
        save(Figure(), tmp_path / "none" / "a.png")


def test_names_of_files():
    assert slice_name({"lam": 0.2}) == "slice_lam_0.2.png"
    assert slice_name({"V": 5.0}) == "slice_V_5.png"
    assert slice_name({"sigma": 0.0784313725}) == "slice_sigma_0.0784313725.png"
    assert slice_name({"lam": 0.39749999999999996}, "probability") == "probability_lam_0.3975.png"
    assert slice_name({"lam": np.float64(0.2)}) == "slice_lam_0.2.png"
    assert slice_name({"lam": np.radians(18)}) == "slice_lam_18deg.png"
    assert slice_name({"lam": np.radians(72.5), "delta": 1.0}, "region") == "region_lam_72.5deg_delta_1.png"
    assert slice_name({"V": 20 / 3.6}) == "slice_V_20kmh.png"
    assert slice_name({"lam": 0.1 + 1e-9}) == "slice_lam_0.100000001.png"


def test_two_planes_have_two_names():
    assert slice_name({"sigma": 0.07843137}) != slice_name({"sigma": 0.07843138})
