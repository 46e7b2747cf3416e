"""bikestab certify: its verdicts, its JSON and its mistakes."""

import json

import pytest

BOX = ["--bicycle", "meijaard2007", "--lam", "17deg:19deg", "--sigma", "0.07:0.085"]
KEYS = {"verdict", "proved_stable", "proved_unstable", "undecided", "counterexample"}


@pytest.mark.parametrize(
    ("speeds", "verdict"),
    [("4.6:5.6", "stable"), ("1:3", "unstable"), ("3:8", "mixed"), ("4.29:4.3", "undecided")],
)
def test_verdicts(bikestab, speeds, verdict):
    cells = "1" if verdict == "undecided" else "16"
    code, out, _ = bikestab("certify", *BOX, "--V", speeds, "--cells", cells, "--json")
    assert code == 0
    found = json.loads(out)
    assert found.keys() >= KEYS
    assert found["verdict"] == verdict
    assert found["proved_stable"] + found["proved_unstable"] + found["undecided"] == pytest.approx(
        1, abs=1e-12
    )
    assert (found["counterexample"] is not None) == (verdict == "mixed")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ([], "a box needs a CONFIG"),
        (["--lam", "0.1", "--sigma", "0.1"], "--V is missing"),
        (["--lam", "1:2", "--sigma", "0.1", "--V", "1:2"], "does not meet the ground"),
        (["--lam", "0.2:0.1", "--sigma", "0.1", "--V", "1:2"], "ends before it starts"),
        (["--lam", "0.1", "--sigma", "0.1", "--V=-1:2"], "negative"),
        (["--lam", "0.1", "--sigma", "0.1", "--V", "1:2", "--tolerance", "mB=85+-2"], "no parameter 'mB'"),
        (["--lam", "0.1", "--sigma", "0.1", "--V", "1:2", "--tolerance", "m1=85"], "mB=85+-2"),
        (["--lam", "0.1", "--sigma", "0.1", "--V", "1:2", "--tolerance", "m1=1+-2"], "m1"),
        (["--verify", "nowhere.json"], "nowhere.json"),
        (["nowhere.yaml"], "nowhere.yaml"),
        (["nowhere.yaml", "--lam", "1"], "says what --lam says"),
    ],
)
def test_mistakes(bikestab, options, words):
    code, out, err = bikestab("certify", *options)
    assert (code, out) == (2, "")
    assert words in err


def test_a_certificate_is_written_and_checked(bikestab, tmp_path):
    path = tmp_path / "proof.json"
    assert bikestab("certify", *BOX, "--V", "4.8:5.2", "--cells", "2", "-o", path)[0] == 0
    assert "hold" in bikestab("certify", "--verify", path)[1]
    text = path.read_text("utf-8")
    path.write_text(text.replace((4.8).hex(), (2.0).hex()), "utf-8")
    code, out, err = bikestab("certify", "--verify", path)
    assert (code, out) == (1, "")
    assert "not proved" in err
    path.write_text("{}", "utf-8")
    assert bikestab("certify", "--verify", path)[0] == 2
