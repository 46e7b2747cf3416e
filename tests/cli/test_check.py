"""bikestab check on many files: no grid, per cent, JSON, JUnit, and the worst exit code."""

import json
import re
from pathlib import Path
from types import SimpleNamespace

import junitparser
import pytest
from bikestab_cli.check_words import problem_of
from ruamel.yaml import YAML
from wcwidth import wcswidth

from bikestab.config.expectations import nearest_interval
from bikestab.config.parts import Expectation
from bikestab.config.tolerance import allowance

ROOT = Path(__file__).parents[2]
SMALL = "bicycle: meijaard2007\nexpect: [{}]\n"


def write(name, *entries):
    Path(name).write_text(SMALL.format(", ".join(f"{{{entry}}}" for entry in entries)), "utf-8")


@pytest.mark.parametrize(
    ("entry", "code"),
    [
        ("V1: 4.33, V2: 5.97, within: 1%", 0),  # V1 within 0.0433
        ("V1: 4.34, within: 1%", 1),
        ("V1: 4.34, within: 1.2 %", 0),
        ("V1: 15.4km/h, within: 0.5km/h", 0),
        ("head_angle: 72deg, trail: 80mm, V1: 4.2924", 0),
        ("stable: never", 1),
        ("mB: 100kg, V1: 4.513, V2: 6.394", 0),
        ("mB: 100kg, V1: 4.2924", 1),
        ("mB: 100, offset: 40mm, V1: 4.402, V2: 6.124", 0),
        ("delta: 1, V1: 4.3735", 0),
        ("trail: 55mm, rF: 0.36, V1: 3.9, within: 10%", 0),
    ],
)
def test_a_file_without_a_grid(bikestab, entry, code):
    write("a.yaml", entry)
    assert bikestab("check", "a.yaml")[0] == code


def test_per_cent_are_of_what_is_expected():
    assert allowance("2.5%", 4.0) == pytest.approx(0.1)
    assert allowance(0.3, 4.0) == 0.3


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (SMALL.format("{V1: 4, within: 0%}"), "expect[0].within: 0% is out of range; allowed: above 0%"),
        (SMALL.format("{V1: 4, within: 1 per cent}"), "expect[0].within"),
        (SMALL.format("{V1: 4, within: a%}"), "'a%' is no percentage"),
        (SMALL.format("{mb: 3, V1: 4}"), "expect[0].mb: unknown key; did you mean 'mB'?"),
        (SMALL.format("{R1: -3, V1: 4}"), "expect[0].R1"),
        (SMALL.format("{m1: much, V1: 4}"), "expect[0].m1"),
        (SMALL.format("{mB: 90, lam: 0.2, trail: 1, offset: 1cm, V1: 4}"), "expect[0]"),
        (SMALL.format("{V1: 4}") + "grids: {}\n", "did you mean 'grid'?"),
        ("bicycle: meijaard2007\n", "has no expectations"),
        ("expect: [{V1: 4}]\n", "bicycle: missing"),
    ],
)
def test_mistakes_of_small_files(bikestab, text, words):
    Path("a.yaml").write_text(text, "utf-8")
    code, _, err = bikestab("check", "a.yaml")
    assert code == 2
    assert words in " ".join(err.replace("\n", ";").replace(";  ", "; ").split())


def test_all_files_are_looked_at_and_the_worst_code_is_returned(bikestab):
    write("good.yaml", "V1: 4.29, within: 1%", "lam: 0.1, sigma: 0.02, stable: never")
    write("bad.yaml", "V1: 5")
    code, out, err = bikestab("check", "none.yaml", "bad.yaml", "good.yaml")
    assert code == 2
    assert err.startswith("error: none.yaml: there is no such file\n")
    assert err.endswith("1 of 3 expectations failed, 1 file cannot be used\n")
    assert re.findall("holds|FAILED|ERROR", out) == ["ERROR", "FAILED", "holds", "holds"]
    assert bikestab("check", "bad.yaml", "good.yaml")[0] == 1
    found = json.loads(bikestab("check", "none.yaml", "bad.yaml", "good.yaml", "--json")[1])["results"]
    assert [each.get("holds") for each in found] == [None, False, True, True]
    assert found[0]["error"].startswith("none.yaml: there is no such file")
    assert found[2]["expected"] == {"V1": 4.29, "within": "1%"}
    assert found[2]["intervals"][0]["V1"] == pytest.approx(4.292382536341104, abs=1e-15)


# what the schema of Jenkins allows and needs, and others read: attributes, and what may stand within
ALLOWED = {
    "testsuites": ({"name", "tests", "failures", "errors", "time"}, {"testsuite"}),
    "testsuite": (
        {"name", "tests", "failures", "errors", "time", "skipped", "timestamp"}, {"testcase"}
    ),
    "testcase": ({"name", "classname", "time"}, {"failure", "error", "system-out"}),
    "failure": ({"type", "message"}, set()),
    "error": ({"type", "message"}, set()),
    "system-out": (set(), set()),
}  # fmt: skip


def test_junit(bikestab):
    write("good.yaml", "V1: 4.29, within: 1%", "V2: 6.02, within: 1%")
    write("bad & <odd>.yaml", "V1: 5")
    files = ("good.yaml", "bad & <odd>.yaml", "none\x01.yaml")
    code, out, _ = bikestab("check", *files, "--junit", "results.xml")
    assert (code, out.splitlines()[-1]) == (2, "results.xml")
    read = junitparser.JUnitXml.fromfile("results.xml")
    assert (read.tests, read.failures, read.errors) == (4, 1, 1)
    suites = list(read)
    assert [suite.name for suite in suites] == [*files[:2], "none\N{REPLACEMENT CHARACTER}.yaml"]
    assert [[case.is_passed for case in suite] for suite in suites] == [[True, True], [False], [False]]
    (failure,) = next(iter(suites[1])).result
    assert isinstance(failure, junitparser.Failure)
    assert failure.message == "V1 is 4.292382536341, not 5 within 0.001: -0.7076 m/s, -14.15%"
    (error,) = next(iter(suites[2])).result
    assert isinstance(error, junitparser.Error)
    text = "expected [m/s]: 5 any within 0.001\nfound [m/s]: 4.292382536341 6.024262015388"
    assert failure.text == f"{text}\nat bad & <odd>.yaml, line 2"
    assert error.message == error.text.replace("\n", "; ")
    assert error.message.startswith(
        "none\N{REPLACEMENT CHARACTER}.yaml: there is no such file; YAML files in"
    )

    def look(element):
        attributes, inner = ALLOWED[element.tag]
        assert set(element.attrib) == attributes
        assert {child.tag for child in element} <= inner
        assert all(re.fullmatch(r"\d*(\.\d{1,3})?", element.get("time", "0")) for _ in "x")
        for child in element:
            look(child)

    look(read._elem)
    assert read.time == pytest.approx(sum(suite.time for suite in suites), abs=2e-3)  # rounded to 1 ms
    assert suites[0].time > 0
    for suite in suites:
        assert 0 <= sum(case.time for case in suite) <= suite.time + 2e-3


def test_junit_that_cannot_be_written(bikestab):
    write("good.yaml", "V1: 4.29, within: 1%")
    code, out, err = bikestab("check", "good.yaml", "--junit", "no/results.xml")
    assert (code, out) == (2, "")
    assert "no/results.xml: cannot be written" in err


def jobs():
    """The YAML examples of docs/ci.md that are jobs, by the lines that they run.

    A checkout of another repository stands as the line that does the same.
    """
    text = (ROOT / "docs" / "ci.md").read_text("utf-8")
    for block in re.findall(r"^```yaml\n(# \.git.*?)^```", text, re.M | re.S):
        for job in [*YAML(typ="safe", pure=True).load(block).values()]:
            steps = job.get("check", job) if isinstance(job, dict) else {}
            if "steps" in steps:
                other = "git clone https://github.com/{repository} {path}"
                yield [
                    step["run"] if "run" in step else other.format(**step["with"])
                    for step in steps["steps"]
                    if "run" in step or "repository" in step.get("with", {})
                ]
            elif "script" in steps:
                yield steps["script"]


def test_the_jobs_of_the_page_run(bikestab, monkeypatch):
    found = list(jobs())
    assert len(found) == 2
    Path("configs").symlink_to(ROOT / "configs")
    from bikestab.bicycle import Bicycle

    given = Bicycle.preset("meijaard2007").given
    Path("measured.txt").write_text(
        "".join(f"{k} = {v} +/- {abs(v) / 100}\n" for k, v in given.items()), "utf-8"
    )
    for lines in found:
        fetched, installed = lines[:2]  # bikestab, into the folder that is installed: not the reader's own
        assert re.fullmatch(r"git clone .*/OWNER/bikestab(\.git)? bikestab", fetched)
        assert installed == "pip install ./bikestab"
        for line in lines[2:]:
            words = line.split()
            assert words.pop(0) == "bikestab"
            args = [
                str(path) for word in words for path in (sorted(Path().glob(word)) if "*" in word else [word])
            ]
            code, out, _ = bikestab(*args)
            assert (code, bool(out)) == (0, True), line
        assert junitparser.JUnitXml.fromfile("results.xml").failures == 0


def test_a_config_given_twice_is_looked_at_once(bikestab):
    """Globs may overlap; the exit code is that of its expectations."""
    write("good.yaml", "V1: 4.29, within: 1%")
    write("bad.yaml", "V1: 5")
    code, out, err = bikestab("check", "good.yaml", "./good.yaml", str(Path("good.yaml").absolute()))
    assert (code, err) == (0, "")
    assert out == bikestab("check", "good.yaml")[1]
    code, out, err = bikestab("check", "good.yaml", "bad.yaml", "good.yaml")
    assert (code, err) == (1, "1 of 2 expectations failed\n")
    assert out == bikestab("check", "good.yaml", "bad.yaml")[1]


@pytest.mark.parametrize(
    "more",
    [
        "sweep: {mB: [60, 85]}", "slices: [{lam: 0.1}]", "output: out", "fast: true",
        "ensemble: {samples: 9, mB: {normal: [85, 2]}}", "fields: [stable]\ntitle: x",
        "sweep: {delta: {start: 0, stop: 2, num: 3}}\nensemble: {samples: 9, mB: {normal: [85, 2]}}",
    ],
)  # fmt: skip
def test_keys_of_a_scan_without_a_grid(bikestab, more):
    write("a.yaml", "V1: 4.2924", "mB: 100, V1: 4.513")
    Path("a.yaml").write_text(f"{Path('a.yaml').read_text('utf-8')}{more}\n", "utf-8")
    code, out, err = bikestab("check", "a.yaml", "--json")
    assert (code, err) == (0, "")
    assert [each["holds"] for each in json.loads(out)["results"]] == [True, True]
    at = ["--at", "mB=85"] if "sweep: {mB" in more else ["--at", "delta=0"] if "sweep" in more else []
    assert bikestab("compare", "meijaard2007", "a.yaml", *at, "--within", "1%")[0] == 0
    assert not at or bikestab("compare", "meijaard2007", "a.yaml")[0] == 2  # which machine?


@pytest.mark.parametrize("more", ["sweep: {mBB: [60]}", "ensemble: {samples: few}", "fields: [growth]"])
def test_their_mistakes_are_told_all_the_same(bikestab, more):
    Path("a.yaml").write_text(f"{SMALL.format('{V1: 4.2924}')}{more}\n", "utf-8")
    code, _, err = bikestab("check", "a.yaml")
    assert (code, "line 3" in err, "grid" in err) == (2, True, False)


UNUSABLE = {  # entries that cannot be used, and what is said of them
    "V1: much": "expect[1].V1: 'much' is not",
    "mb: 3, V1: 4": "expect[1].mb: unknown key",
    "R1: -3, V1: 4": "expect[1].R1",
    "lam: 0.1, within: 0%, V1: 4": "expect[1].within: 0% is out of range",
    "head_angle: 70deg, trail: 1, offset: 1cm, V1: 4": "expect[1]",
}


@pytest.mark.parametrize("entry", UNUSABLE)
def test_an_entry_that_cannot_be_used_hides_no_other(bikestab, entry):
    """The others are judged, in the table, in JSON and in JUnit, at their own lines and numbers."""
    entries = ["V1: 4.2924", entry, "V1: 5", "trail: 80mm, head_angle: 72deg, V1: 4.2924"]
    text = "".join(f"  - {{{each}}}\n" for each in entries)
    Path("a.yaml").write_text(f"bicycle: meijaard2007\nexpect:\n{text}", "utf-8")
    code, out, err = bikestab("check", "a.yaml", "--junit", "a.xml")
    assert code == 2
    assert re.findall("holds|FAILED|ERROR", out) == ["holds", "ERROR", "FAILED", "holds"]
    assert re.search(r"^line 4: expect\[1\]", out, re.M)
    assert "a.yaml, line 5: expect[2]: V1 is 4.29" in out
    assert err.startswith("error: a.yaml, line 4: ")
    assert UNUSABLE[entry] in err
    assert err.endswith("1 of 3 expectations failed, 1 entry cannot be used\n")
    assert all(len(line) <= 80 for line in out.splitlines())
    ((good, bad, failed, last),) = junitparser.JUnitXml.fromfile("a.xml")
    assert [good.is_passed, bad.is_passed, failed.is_passed, last.is_passed] == [True, False, False, True]
    assert isinstance(bad.result[0], junitparser.Error)
    assert isinstance(failed.result[0], junitparser.Failure)
    assert UNUSABLE[entry] in bad.result[0].message
    found = json.loads(bikestab("check", "a.yaml", "--json")[1])["results"]
    assert [each["line"] for each in found] == [3, 4, 5, 6]
    assert [each.get("holds") for each in found] == [True, None, False, True]
    assert UNUSABLE[entry] in found[1]["error"]
    assert found[1]["mistakes"]


def test_the_last_line_counts_what_cannot_be_used(bikestab):
    write("good.yaml", "V1: 4.29, within: 1%")
    write("bad.yaml", "V1: 5")
    code, _, err = bikestab("check", "none.yaml", "bad.yaml", "good.yaml", "nothing.yaml")
    assert (code, err.splitlines()[-1]) == (2, "1 of 2 expectations failed, 2 files cannot be used")
    code, _, err = bikestab("check", "none.yaml", "good.yaml")
    assert (code, err.splitlines()[-1]) == (2, "0 of 1 expectations failed, 1 file cannot be used")


def test_names_that_terminals_show_otherwise_keep_the_columns(bikestab):
    """A control character, one that is two columns wide, and bytes that are no text."""
    names = ["a.yaml", "b\x01.yaml", "自転車.yaml", "c\udcff.yaml"]
    for name in names:
        write(name, "V1: 4.2924")
    lines = bikestab("check", *names)[1].splitlines()
    assert len({wcswidth(line.rpartition("holds")[0]) for line in lines if "holds" in line}) == 1
    assert all(0 < wcswidth(line) <= 80 for line in lines if line)


def test_other_parameters_are_told_of(bikestab):
    write("a.yaml", "mB: 100, V1: 4.513, V2: 6.394", "V1: 4.2924")
    code, out, _ = bikestab("check", "a.yaml", "--junit", "a.xml", "--json")
    first, second = json.loads(out)["results"]
    assert (code, first["over"], "over" in second) == (0, {"mB": 100}, False)
    assert "mB = 100 kg" in bikestab("check", "a.yaml")[1]
    names = [case.name for suite in junitparser.JUnitXml.fromfile("a.xml") for case in suite]
    assert names[0].endswith(", mB = 100 kg")
    texts = [case.system_out for suite in junitparser.JUnitXml.fromfile("a.xml") for case in suite]
    assert texts[0].startswith(
        "with mB = 100 kg\nexpected [m/s]: 4.513 6.394 within 0.001\nfound [m/s]: 4.51"
    )
    assert texts[1].startswith("expected [m/s]: 4.2924 any")
    # what vrange says of the same machine
    _, out, _ = bikestab("vrange", "--bicycle", "meijaard2007", "--set", "mB=100", "--json")
    assert json.loads(out)["results"][0]["intervals"] == first["intervals"]


FAILURES = [  # an entry, what is said of it, and its ends: found, difference, tolerance
    (
        "V1: 4.3, V2: unbounded, within: 1%",
        "V2 is 6.024262015388, not unbounded within 1%",
        [(4.292382536341104, -0.007617463658896, 0.043), (6.024262015388358, None, None)],
    ),
    (
        "V1: 5, within: 2%",
        "V1 is 4.292382536341, not 5 within 2% (0.1 m/s): -0.7076 m/s, -14.15%",
        [(4.292382536341104, -0.707617463658896, 0.1)],
    ),
    (
        "stable: never",
        "stable speeds were found, and none expected: 4.29238 ... 6.02426 m/s",
        [],
    ),
    (
        "lam: 0.1, sigma: 0.02, V1: 5, V2: unbounded",
        "no stable speed was found, and V1 5, V2 unbounded expected",
        [(None, None, 0.001), (None, None, None)],
    ),
]  # fmt: skip


@pytest.mark.parametrize(("entry", "message", "ends"), FAILURES)
def test_what_is_wrong_is_said_in_numbers(bikestab, entry, message, ends):
    """In the same words everywhere; the ends are those of the benchmark's published 4.2924 and 6.0243 m/s."""
    write("a.yaml", "V1: 4.2924", entry)
    code, out, _ = bikestab("check", "a.yaml", "--junit", "a.xml", "--json")
    record = json.loads(out)["results"][1]
    assert (code, record["problem"], record["line"]) == (1, message, 2)
    assert len(record["edges"]) == len(ends)
    for edge, (found, difference, tolerance) in zip(record["edges"], ends, strict=True):
        told = (edge["found"], edge["difference"], edge["tolerance"])
        assert told == pytest.approx((found, difference, tolerance), abs=1e-12)
        assert edge["within"] is (difference is not None and abs(difference) <= tolerance)
        assert edge["percent"] == (
            difference and pytest.approx(100 * difference / edge["expected"], abs=1e-9)
        )
    (suite,) = junitparser.JUnitXml.fromfile("a.xml")
    assert [failure.message for case in suite for failure in case.result] == [message]
    lines = bikestab("check", "a.yaml")[1].splitlines()
    assert all(len(line) <= 80 for line in lines)
    (first,) = (i for i, line in enumerate(lines) if line.startswith("a.yaml, line"))
    assert " ".join(line.strip() for line in lines[first:]) == f"a.yaml, line 2: expect[1]: {message}"


def test_which_of_several_intervals_is_nearest_is_told():
    """The one that misses the fewest ends, and among such the one that is nearest."""
    expected = Expectation(V1=3, V2=8, within=0.5)
    found = [{"V1": a, "V2": b} for a, b in ((1, 2), (3.1, 9), (2, 7), (20, None))]
    number, edges = nearest_interval(expected, found)
    assert (number, [edge.holds for edge in edges]) == (1, [True, False])
    assert nearest_interval(Expectation(V2="unbounded"), found)[0] == 3
    assert nearest_interval(Expectation(V2="unbounded"), found[:3])[0] == 0
    outcome = SimpleNamespace(holds=False, expected=expected, nearest=number, edges=edges, found=found)
    assert problem_of(outcome) == (
        "V2 is 9, not 8 within 0.5: +1 m/s, +12.50% "
        "(nearest of 4 intervals: 1 ... 2, 3.1 ... 9, 2 ... 7, 20 ... unbounded m/s)"
    )
