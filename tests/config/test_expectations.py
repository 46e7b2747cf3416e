"""What configs expect, held against exact speeds."""

import math

import pytest

from bikestab import yamltext
from bikestab.config.checks import checked
from bikestab.config.expectations import outcome_of
from bikestab.config.file import parse_config
from bikestab.errors import InputError

CONFIG = """\
bicycle: {}
grid: {{lam: {{values: [0, 1]}}, sigma: {{values: [0, 1]}}, V: {{values: [0, 1]}}}}
expect: [{}]
"""


def found(*entries, bicycle="dikarev1981"):
    text = CONFIG.format(bicycle, ", ".join(f"{{{entry}}}" for entry in entries))
    config = parse_config(yamltext.parse(text, "a.yaml"))
    return [outcome_of(config, expected, ("expect", i)) for i, expected in enumerate(config.expect)]


def test_an_outcome_says_what_was_found():
    first, second = found(
        "lam: 0.05, sigma: 0.15, V1: 4.8065, V2: unbounded", "lam: 0.1, sigma: 0.08, stable: never"
    )
    assert (first.holds, first.design["lam"], first.design["sigma"]) == (True, 0.05, 0.15)
    assert math.inf == first.expected.V2
    assert [(i["V2"], i["upper"]) for i in first.found] == [(None, "unbounded")]
    assert (second.holds, second.found) == (True, [])


@pytest.mark.parametrize(
    ("expected", "holds"),
    [
        ("V1: 4.055596", True),
        ("V1: 4.0535", False),
        ("V1: 4.0535, within: 0.01", True),
        ("V2: 4.636", True),
        ("V1: 4.0556, V2: 5", False),
        ("V2: unbounded", False),
        ("stable: never", False),
    ],
)
def test_what_holds(expected, holds):
    assert found(f"lam: 0.2, sigma: 0.08, {expected}")[0].holds is holds


def test_the_bicycles_own_design():
    (outcome,) = found("V1: 4.2924, V2: 6.0243", bicycle="meijaard2007")
    assert outcome.holds
    with pytest.raises(InputError) as caught:
        found("lam: 0.1, sigma: 0.1, stable: never", "lam: 0.1, V1: 4")
    assert caught.value.key == ("expect", 1)
    assert "no sigma of its own" in caught.value.problem


def test_no_expectations(tmp_path):
    path = tmp_path / "a.yaml"
    path.write_text(CONFIG.format("dikarev1981", ""), "utf-8")
    with pytest.raises(InputError, match="has no expectations"):
        checked(path)
