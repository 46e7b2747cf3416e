"""What is proved is so: at random points of proved cells, by exact signs; and every proof can be checked."""

import hashlib
import json
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.certify import checker
from bikestab.certify.box import BERNSTEIN, CENTRED
from bikestab.certify.centred import CentredProver
from bikestab.certify.grid import grid_of
from bikestab.certify.proof import prove
from bikestab.certify.search import STABLE, UNDECIDED, UNSTABLE, search
from bikestab.errors import InputError
from bikestab.formulas import table_formulas
from bikestab.model import exact_table
from bikestab.speeds import intervals_of
from tests.references import verify_proofs
from tests.strategies import machines

PAPER, BENCHMARK = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")


def stable_at(bicycle, lam, sigma, V, model="refined"):
    """Whether points are stable, by the exact stable speeds; NaN within their bounds."""
    found = intervals_of(exact_table(bicycle, lam, sigma, model=model))
    inside = (V[:, np.newaxis] > found.V1) & (V[:, np.newaxis] < found.V2)
    near = (np.abs(found.V1 - V[:, np.newaxis]) <= found.V1_error) | (
        np.abs(found.V2 - V[:, np.newaxis]) <= found.V2_error
    )
    unsure = near.any(axis=-1) | (found.marginal[:, 0] > 0)
    return np.where(unsure, np.nan, inside.any(axis=-1))


def sealed(certificate):
    """With the hash of what it says, as somebody who wants to deceive would write it."""
    told = json.dumps({**certificate, "sha256": ""}, sort_keys=True)
    return {**certificate, "sha256": hashlib.sha256(told.encode()).hexdigest()}


def number(fraction):
    return mpmath.mpf(fraction.numerator) / fraction.denominator


def points_of(proof, rng, number):
    """Random points with the verdicts on their cells: half of them corners, half inside."""
    cells = np.array([rng.integers(0, n, number) for n in proof.cells.shape])
    share = rng.uniform(size=cells.shape)
    share[:, ::2] = rng.integers(0, 2, share[:, ::2].shape)
    points = [
        np.clip(edges[i] + s * (edges[i + 1] - edges[i]), edges[i], edges[i + 1])
        for edges, i, s in zip(proof.edges[:3], cells, share, strict=True)
    ]
    return points, proof.cells[tuple(cells)]


@settings(max_examples=12, deadline=None)
@given(machines, st.sampled_from([0.0, 1e-9, 1e-3, 1.0, 1e3]), st.integers(0, 2**32 - 1))
def test_proved_cells_of_random_machines(values, delta, seed):
    rng = np.random.default_rng(seed)
    bicycle = Bicycle.from_mapping(values).with_delta(delta)
    lam = np.sort(rng.uniform(-0.3, 0.6, 2))
    sigma = np.sort(rng.uniform(-0.1, 0.3, 2))
    V = np.sort(rng.uniform(0, 20, 2)) * rng.integers(0, 2, 2).max()
    proof = prove(bicycle, np.linspace(*lam, 7), np.linspace(*sigma, 7), np.linspace(*V, 7))
    points, verdicts = points_of(proof, rng, 400)
    truth = stable_at(bicycle, *points)
    assert not np.any((verdicts == STABLE) & (truth == 0))
    assert not np.any((verdicts == UNSTABLE) & (truth == 1))


def test_the_papers_box_is_decided_but_for_the_boundary():
    edges = [np.linspace(0, end, 33) for end in (0.30, 0.15, 15.0)]
    proof = prove(PAPER, *edges)
    lam, sigma, V = np.meshgrid(*edges, indexing="ij")
    stable = stable_at(PAPER, lam.ravel(), sigma.ravel(), V.ravel()).reshape(lam.shape) == 1
    places = np.ndindex(2, 2, 2)
    corners = np.stack([stable[i : 32 + i, j : 32 + j, k : 32 + k] for i, j, k in places])
    boundary = corners.any(axis=0) & ~corners.all(axis=0)
    assert np.all(proof.cells[boundary] == UNDECIDED)
    assert np.count_nonzero(proof.cells == UNDECIDED) < 1.1 * np.count_nonzero(boundary)
    assert np.all(corners.all(axis=0)[proof.cells == STABLE])
    assert not np.any(corners.any(axis=0)[proof.cells == UNSTABLE])
    assert proof.verdict == "mixed"
    assert proof.counterexample()["eigenvalues"][0][0] > 0
    assert sum(proof.fractions) == pytest.approx(1, abs=1e-12)


def test_rest_is_never_proved_stable():
    """At V = 0 and without damping no machine is asymptotically stable, though it may be at once above."""
    skate = Bicycle.preset("kooijman2011")
    lam, sigma = np.array([skate.lam] * 2), np.array([skate.sigma] * 2)
    proof = prove(skate, lam, sigma, np.linspace(0, 10, 11))
    assert proof.cells[0, 0, 0] != STABLE
    assert proof.cells[0, 0, 9] == STABLE


def test_tolerances_hold_for_every_machine_in_them():
    lam, sigma = np.linspace(0.30, 0.33, 5), np.linspace(0.07, 0.085, 5)
    V = np.linspace(4, 6.5, 11)
    ranges = {"mB": (80.0, 90.0), "xB": (0.28, 0.32)}
    proof = prove(BENCHMARK, lam, sigma, V, tolerances={"mB": ranges["mB"]})
    alone = prove(BENCHMARK, lam, sigma, V)
    assert np.all((proof.cells == alone.cells) | (proof.cells == UNDECIDED))
    assert {STABLE, UNSTABLE} <= set(proof.cells.ravel().tolist())
    rng = np.random.default_rng(1)
    for mB in (80.0, 83.7, 90.0):
        points, verdicts = points_of(proof, rng, 300)
        truth = stable_at(BENCHMARK.replaced({"mB": mB}), *points[:3])
        assert np.all(truth[verdicts == STABLE] == 1)
        assert np.all(truth[verdicts == UNSTABLE] == 0)
    both = prove(BENCHMARK, lam[:2], sigma[:2], np.array([4.9, 5.1]), tolerances=ranges)
    assert both.verdict == "stable"
    assert (proof.box.method, both.box.method) == (BERNSTEIN, CENTRED)
    many = dict.fromkeys([name for name in BENCHMARK.given if name not in ("c", "lam")][:13], (0.1, 0.2))
    with pytest.raises(InputError, match="13 tolerances"):
        prove(BENCHMARK, lam, sigma, V, tolerances=many)
    with pytest.raises(InputError, match="mB"):
        prove(BENCHMARK, lam, sigma, V, tolerances={"mB": (-1.0, 2.0)})


@pytest.mark.parametrize(
    ("bicycle", "tolerances"), [(PAPER, {}), (PAPER, {"m1": (79.9, 80.1)}), (BENCHMARK, {})]
)
def test_certificates_hold_and_one_changed_number_breaks_them(bicycle, tolerances):
    lam, sigma, V = (0.20, 0.21), (0.080, 0.081), (4.2, 4.5)
    if bicycle is BENCHMARK:
        lam, sigma, V = (0.31, 0.32), (0.078, 0.079), (4.8, 5.6)
    proof = prove(bicycle, *map(np.array, (lam, sigma, V)), tolerances=tolerances)
    certificate = json.loads(proof.certificate("1"))
    assert proof.verdict == "stable"
    assert "hold" in checker.check(certificate)
    changes = (
        lambda c: c["blocks"].__setitem__(0, [c["blocks"][0][0], UNSTABLE]),
        lambda c: c["blocks"].append(c["blocks"][0]),
        lambda c: c["edges"][2].__setitem__(0, (1.0).hex()),
        lambda c: c["machine"].__setitem__("g", (99.0).hex()),
    )
    for change in changes[-1:] if tolerances else changes:
        changed = json.loads(proof.certificate("1"))
        change(changed)
        with pytest.raises(ValueError, match="sha256"):
            checker.check(changed)
        with pytest.raises(ValueError, match="block"):
            checker.check(sealed(changed))


@pytest.mark.parametrize(
    "varied", [["m1"] * 2, ["x"], list("cg") + [f"{k}{i}" for k in "mlhABDC" for i in (1, 2)]]
)
def test_what_is_varied_is_bounded_before_anything_is_computed(varied):
    """Coefficients grow as powers of their number: a certificate with all of them varied would not end."""
    certificate = json.loads(prove(PAPER, *np.array([[0.2, 0.2], [0.08, 0.08], [4.2, 4.3]])).certificate("1"))
    certificate["edges"] += [["0x0p0", "0x1p0"]] * len(varied)
    with pytest.raises(checker.Refuted, match="varied"):
        checker.check(sealed(certificate | {"varied": varied}))


@pytest.mark.parametrize(
    ("bicycle", "varied"),
    [(PAPER, ()), (PAPER, ("R2", "m2")), (BENCHMARK, ("mB", "w", "xH")), (BENCHMARK, ())],
)
@pytest.mark.parametrize("model", ["refined", "unrefined"])
def test_formulas_are_the_table(bicycle, varied, model):
    """The entries at exact numbers near a sine and cosine, against the table in twice double precision."""
    lam, sigma = 0.7, 0.0625
    formulas = table_formulas(bicycle, varied, model=model)
    own = bicycle.bodies or bicycle.numbers()
    with mpmath.workdps(60):
        values = [mpmath.sin(lam), mpmath.cos(lam), mpmath.mpf(sigma), *(mpmath.mpf(own[n]) for n in varied)]

        def value(polynomial):
            return mpmath.fsum(
                number(a) * mpmath.fprod(x**k for x, k in zip(values, powers, strict=True))
                for powers, a in polynomial.terms.items()
            )

        scale = mpmath.fprod(value(factor) ** power for factor, power in formulas.below.items())
        table = exact_table(bicycle, lam, sigma, model=model)
        for (k, j), entry in formulas.entries.items():
            found = value(entry) / scale
            held = mpmath.mpf(float(table.value[k, j])) + float(table.rest[k, j])
            assert abs(found - held) <= table.error[k, j]


def test_tangents_of_half_angles_lie_between():
    lam = [-1.4, -0.3, 0.0, 1e-9, 0.2, 1.3]
    for angle in lam:
        low, high = checker.half_angle(angle, up=False), checker.half_angle(angle, up=True)
        with mpmath.workdps(50):
            exact = mpmath.tan(mpmath.mpf(angle) / 2)
            assert number(low) <= exact <= number(high)
        assert high - low <= Fraction(1, 2**78)


def test_a_rider_is_in_the_certificate_and_in_its_check():
    """A rider beside the bicycle, whose inertia scales with the mass; what is no parameter is refused."""
    rider = {"m": 60, "x": 0.35, "z": -1.1, "Ixx": 9.6, "Izz": 2.2, "Ixz": -1.0, "scale_inertia": True}
    bicycle = Bicycle.from_mapping({**BENCHMARK.given, "mB": 12.0, "rider": rider}).replaced(
        {"rider.m": 62.0}
    )
    found = intervals_of(exact_table(bicycle, bicycle.lam, bicycle.sigma))
    V = found.V1[0] + np.array([0.3, 0.5]) * (found.V2[0] - found.V1[0])
    proof = prove(bicycle, np.full(2, bicycle.lam), np.full(2, bicycle.sigma), V)
    assert proof.verdict == "stable"
    certificate = json.loads(proof.certificate("1"))
    assert "hold" in checker.check(certificate)
    for name, value in (("rider.m", 500.0), ("rider.mass", 60.0)):
        changed = {**certificate, "machine": {**certificate["machine"], name: value.hex()}}
        with pytest.raises(ValueError, match="block"):
            checker.check(sealed(changed))


def test_a_spin_that_is_zero_may_vary():
    still = BENCHMARK.replaced({"IFyy": 0.0})
    design = np.full(2, still.lam), np.full(2, still.sigma)
    for V, verdict in (((4.5, 5.5), "stable"), ((7.5, 8.0), "unstable")):
        proof = prove(still, *design, np.array(V), tolerances={"IFyy": (0.279, 0.281)})
        assert proof.verdict == verdict
        assert "hold" in checker.check(json.loads(proof.certificate("1")))


def test_a_machine_without_its_own_gravity_has_the_usual_one():
    given = {name: value for name, value in BENCHMARK.given.items() if name != "g"}
    bicycle = Bicycle.from_mapping(given)
    proof = prove(bicycle, np.full(2, bicycle.lam), np.full(2, bicycle.sigma), np.array([4.6, 5.5]))
    assert proof.verdict == "stable"
    assert "hold" in checker.check(json.loads(proof.certificate("1")))


@pytest.mark.parametrize(
    ("axis", "end", "value"),
    [(0, 1, 0.205 + 2 * np.pi), (0, 0, -1.6), (2, 0, -4.5), (2, 0, -4.4), (2, 1, np.inf), (1, 0, np.nan)],
)
def test_edges_that_no_machine_has_are_refused(axis, end, value):
    proof = prove(PAPER, *map(np.array, ((0.20, 0.21), (0.080, 0.081), (4.2, 4.5))))
    certificate = json.loads(proof.certificate("1"))
    certificate["edges"][axis][end] = float(value).hex()
    with pytest.raises(ValueError, match="block"):
        checker.check(sealed(certificate))
    with pytest.raises(KeyError, match="xx"):
        checker.check(sealed({**json.loads(proof.certificate("1")), "notation": "xx"}))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("c", -1.0),
        ("c", 0.0),
        ("g", -9.81),
        ("m1", -1.0),
        ("A2", -0.1),
        ("C1", -0.1),
        ("R1", -0.3),
        ("R2", 0.0),
    ],
)
def test_numbers_that_no_machine_has_are_refused(name, value):
    """Conditions are multiplied by lengths, so that their signs would turn with those of lengths."""
    certificate = json.loads(prove(PAPER, *np.array([[0.2, 0.2], [0.08, 0.08], [4.2, 4.3]])).certificate("1"))
    for verdict in (STABLE, UNSTABLE):
        certificate["machine"][name], certificate["blocks"][0][1] = value.hex(), verdict
        with pytest.raises(checker.Refuted, match="no machine"):
            checker.check(sealed(certificate))


def test_edges_ascend():
    with pytest.raises(InputError, match="ascend"):
        prove(PAPER, np.array([0.21, 0.2]), np.array([0.08, 0.08]), np.array([4.2, 4.5]))


def test_the_checker_is_short_and_shares_nothing():
    text = Path(checker.__file__).read_text("utf-8")
    assert text.count("\n") < 200
    assert "bikestab." not in text
    assert "numpy" not in text


def test_blocks_that_touch_the_boundary_nearly_are_checked_in_parts():
    """Every tenth block of a coarse proof; the checker's own bounds are wider than the proof's."""
    proof = prove(PAPER, *[np.linspace(0, end, 9) for end in (0.30, 0.15, 15.0)])
    certificate = json.loads(proof.certificate("1"))
    certificate["blocks"] = certificate["blocks"][::10]
    assert f"{len(certificate['blocks'])} blocks hold" in checker.check(sealed(certificate))


@pytest.mark.parametrize(
    ("bicycle", "share"), [(PAPER, 0.85), (BENCHMARK, 0.85), (Bicycle.preset("kooijman2011"), 0.4)]
)
def test_both_methods_agree(bicycle, share):
    """The centred form knows nothing of Bernstein coefficients, and decides nearly as much.

    Of point masses on skates less: the determinant of their inertias is a small difference.
    """
    edges = [np.linspace(*ends, 17) for ends in ((0.0, 0.4), (0.0, 0.15), (0.0, 10.0))]
    proof = prove(bicycle, *edges)
    grid = grid_of(edges)
    cells = search(CentredProver(bicycle, (), "refined", grid)).on_cells()
    assert not np.any((cells != proof.cells) & (cells != UNDECIDED) & (proof.cells != UNDECIDED))
    decided = [np.count_nonzero(each != UNDECIDED) for each in (cells, proof.cells)]
    assert share * decided[1] < decided[0] <= decided[1]


def test_six_tolerances_by_the_centred_form():
    given = BENCHMARK.given
    names = ("mB", "xB", "zB", "IBxx", "mH", "IFyy")
    ranges = {
        name: (given[name] - abs(given[name]) / 500, given[name] + abs(given[name]) / 500) for name in names
    }
    design = np.full(2, BENCHMARK.lam), np.full(2, BENCHMARK.sigma)
    proof = prove(BENCHMARK, *design, np.linspace(3, 8, 21), tolerances=ranges)
    assert proof.box.method == CENTRED
    assert set(proof.cells.ravel().tolist()) == {UNDECIDED, STABLE, UNSTABLE}
    rng = np.random.default_rng(3)
    for _ in range(10):
        machine = BENCHMARK.replaced(
            {name: rng.choice([*ends, rng.uniform(*ends)]) for name, ends in ranges.items()}
        )
        points, verdicts = points_of(proof, rng, 100)
        truth = stable_at(machine, *points)
        assert np.all(truth[verdicts == STABLE] == 1)
        assert np.all(truth[verdicts == UNSTABLE] == 0)
    certificate = json.loads(proof.certificate("1"))
    certificate["blocks"] = certificate["blocks"][:3]
    assert "hold" in checker.check(sealed(certificate))
    with pytest.raises(InputError, match="feedback"):
        prove(BENCHMARK.replaced({"k_phidot": 1.0}), *design, np.array([5.0, 6.0]))


def test_a_sample_of_random_boxes_in_400_bits():
    """``python -m tests.references.verify_proofs`` checks more; docs/trust.md has its counts."""
    counts = verify_proofs.run(8, seed=5, designs=15, most=1)
    assert counts["WRONG"] == counts["CERTIFICATES REFUSED"] == counts["CHANGED ONES TAKEN"] == 0
    assert counts["points"] > 800
    assert counts["certificates"] >= 6
