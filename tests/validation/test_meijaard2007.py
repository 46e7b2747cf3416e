"""Meijaard, Papadopoulos, Ruina and Schwab (2007): the benchmark bicycle's published numbers.

Matrices: their equations (5.4)-(5.7); speeds: section 6; eigenvalues: table 2. All are printed with 14
digits behind the point. A castering eigenvalue of 10 and more is asked for to 2e-14 of its size, since
doubles there are 4e-15 apart; everything else to 1e-13.
"""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.model import canonical_matrices, characteristic_table
from bikestab.spectrum import eigenvalues_of, growth_rate_of
from bikestab.speeds import KINDS, intervals_of

PUBLISHED = {
    "M": [[80.81722, 2.31941332208709], [2.31941332208709, 0.29784188199686]],
    "C1": [[0, 33.86641391492494], [-0.85035641456978, 1.68540397397560]],
    "K0": [[-80.95, -2.59951685249872], [-2.59951685249872, -0.80329488458618]],
    "K2": [[0, 76.59734589573222], [0, 2.65431523794604]],
}
EIGENVALUES = {
    0: [3.13164324790656, -3.13164324790656, 5.53094371765393, -5.53094371765393],
    1: [-3.13423125066578, 3.52696170990070 + 0.80774027519930j, -7.11008014637442],
    2: [-3.07158645641514, 2.68234517512745 + 1.68066296590675j, -8.67387984831735],
    3: [-2.63366137253667, 1.70675605663975 + 2.31582447384325j, -10.35101467245920],
    4: [-1.42944427361326, 0.41325331521125 + 3.07910818603206j, -12.15861426576450],
    5: [-0.32286642900409, -0.77534188219585 + 4.46486771378823j, -14.07838969279820],
    6: [-0.00406690076970, -1.52644486584142 + 5.87673060598709j, -16.08537123098026],
    7: [0.10268170574766, -2.13875644258362 + 7.19525913329805j, -18.15788466125202],  # see below
    8: [0.14327879765713, -2.69348683581097 + 8.46037971396931j, -20.27940894394569],
    9: [0.15790184030917, -3.21675402252485 + 9.69377351531791j, -22.43788559040858],
    10: [0.16105338653172, -3.72016840437287 + 10.90681139476287j, -24.62459635017404],
}
# At 7 m/s the castering eigenvalue is -18.157884661252020911 in 40 digits; the printed table's last two
# digits, 62, differ from that by 6e-13.
COALESCENCE = 0.68428307889246  # m/s


@pytest.fixture(scope="module")
def bicycle():
    return Bicycle.preset("meijaard2007")


@pytest.fixture(scope="module")
def table(bicycle):
    return characteristic_table(bicycle, bicycle.lam, bicycle.sigma)


@pytest.mark.parametrize("name", PUBLISHED)
def test_matrices(bicycle, name):
    found = canonical_matrices(bicycle, bicycle.lam, bicycle.sigma)
    assert found[list(PUBLISHED).index(name)] == pytest.approx(
        np.array(PUBLISHED[name]), rel=1e-13, abs=1e-13
    )


def test_weave_and_capsize_speed(table):
    found = intervals_of(table)
    assert found.V1.tolist() == pytest.approx([4.29238253634111], rel=0, abs=1e-14)
    assert found.V2.tolist() == pytest.approx(
        [6.02426201538837], rel=0, abs=2e-14
    )  # printed 1.1e-14 too high
    assert [KINDS[found.lower[0]], KINDS[found.upper[0]]] == ["weave", "capsize"]


def test_speeds_in_40_digits(table):
    """To 1e-15 relative: the paper's digits end before double precision does."""
    found = intervals_of(table)
    assert found.V1[0] == pytest.approx(4.2923825363411039587, rel=1e-15)
    assert found.V2[0] == pytest.approx(6.0242620153883588899, rel=1e-15)


@pytest.mark.parametrize("V", EIGENVALUES)
def test_eigenvalues(table, V):
    expected = np.array([s for x in EIGENVALUES[V] for s in {x, np.conj(x)}])
    found = eigenvalues_of(table, V)
    assert np.sort_complex(found) == pytest.approx(np.sort_complex(expected), rel=2e-14, abs=1e-13)
    assert growth_rate_of(table, V) == pytest.approx(expected.real.max(), rel=0, abs=1e-13)


def test_coalescence(table):
    """The two positive eigenvalues are real below 0.68428307889246 m/s, and a pair above."""
    for V, pairs in ((COALESCENCE - 1e-12, 0), (COALESCENCE + 1e-12, 1)):
        assert np.count_nonzero(eigenvalues_of(table, V).imag > 0) == pairs
