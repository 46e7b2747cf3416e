"""The report: every number in it is in its data."""

import json
import math
import re

import numpy as np
import pytest

from bikestab.paper1981.report import decisive_numbers, rendered
from bikestab.paper1981.study import FIGURES
from tests.small import record, study

# what is no number of the study: formulas, names such as V1 or C2°, references and years, links, units
NOT_NUMBERS = [
    r"(?m)^    .*$", r"\]\([^)]*\)",
    r"\((?:19|20)\d\d\)", r"\((?:1\.2|1\.4|2\.2)\)", r"\bfigure 3\b", r"## Figure 3",
    r"1/s\b", r"1/V", r"rad m/s", r"(?:Conclusion|conclusion) [1-4]", r"[pVcAabBCDRmlhαΔ]_?\d°?(?:/c)?",
]  # fmt: skip
NUMBER = re.compile(r"(?<![\w.^])[−-]?\d+(?:\.\d+)?(?:e[−-]?\d+)?")


@pytest.fixture(scope="module")
def text():
    return rendered(record())


def values(data):
    """Every number in the data, also those within its texts and keys."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield from values(key)
            yield from values(value)
    elif isinstance(data, list | tuple):
        for value in data:
            yield from values(value)
    elif isinstance(data, str):
        yield from (float(found.replace("−", "-")) for found in re.findall(r"[−-]?\d+(?:\.\d+)?", data))
    elif isinstance(data, int | float) and not isinstance(data, bool):
        yield float(data)


def test_every_number_is_in_the_data(text):
    assert foreign(text) == []
    assert len(NUMBER.findall(text)) > 500


def test_a_foreign_number_is_noticed(text):
    assert foreign(f"{text} It is 3.9172 m/s, or 61.87 %.") == ["3.9172", "61.87"]


def foreign(text):
    """The numbers of a text that are no rounding of any in the data."""
    known = np.array(sorted({abs(value) for value in values(study())}))
    known = np.concatenate([known, 100 * known])  # percent
    for pattern in NOT_NUMBERS:
        text = re.sub(pattern, " ", text)
    found = []
    for number in NUMBER.findall(text):
        digits = number.replace("−", "-").lstrip("-")
        mantissa, _, power = digits.partition("e")
        half = 0.5001 * 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))
        if np.abs(known - float(digits)).min() > half:
            found.append(number)
    return found


def test_the_report_is_complete(text):
    for part in study()["conclusions"].values():
        assert f"**Verdict: {part['verdict']}.**" in text
        assert f"**For forks bent forwards: {part['verdict_forwards']}" in text
        assert part["claim"] in text
    for name in FIGURES:
        assert f"]({name})" in text
    assert "{" not in text
    assert "None" not in text
    assert not re.search(r"\b(nan|inf)\b", text)
    tables = [line for line in text.splitlines() if line.startswith("|")]
    assert len(tables) > 60
    for anchor in re.findall(r"\]\(#([\w-]+)\)", text):
        headings = {h.strip("# ").lower().replace(" ", "-") for h in text.splitlines() if h.startswith("#")}
        assert anchor in headings


def test_the_data_are_finite_json():
    def check(value):
        if isinstance(value, dict):
            for part in value.values():
                check(part)
        elif isinstance(value, list | tuple):
            for part in value:
                check(part)
        else:
            assert value is None or isinstance(value, str | bool | int | float), type(value)
            assert not isinstance(value, float) or math.isfinite(value)

    check(study())
    assert json.loads(json.dumps(study(), allow_nan=False))["bikestab"]


def test_decisive_numbers():
    assert [bool(re.search(r"\d", decisive_numbers(record(), n))) for n in (1, 2, 3, 4)] == [True] * 4
