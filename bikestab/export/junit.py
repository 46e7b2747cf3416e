"""Results of checks → JUnit XML, which CI servers show."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

from bikestab.files import written

# what XML 1.0 cannot hold, not even escaped
_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


class Case(NamedTuple):
    """One check: its name, what is wrong (nothing where it passed), expected and found, and its time [s].

    ``unusable`` says that there was nothing to check.
    """

    name: str
    problem: str
    text: str
    seconds: float
    unusable: bool = False


class Suite(NamedTuple):
    """The checks of one file, and how many seconds all of it took, the file's reading among it."""

    name: str
    cases: Sequence[Case]
    seconds: float


def save_junit(suites: Sequence[Suite], path: str | Path) -> None:
    """Write the suites in the dialect that Jenkins, GitLab and GitHub's reporters read.

    Raises as ``files.written``.
    """
    root = ElementTree.Element("testsuites", {"name": "bikestab check", **_counts(suites)})
    now = datetime.now(UTC).isoformat(timespec="seconds").removesuffix("+00:00")
    for suite in suites:
        head = {"name": _text(suite.name), "timestamp": now, "skipped": "0", **_counts([suite])}
        element = ElementTree.SubElement(root, "testsuite", head)
        for case in suite.cases:
            whose = {"name": _text(case.name), "classname": _text(suite.name)}
            shown = ElementTree.SubElement(element, "testcase", whose, time=f"{case.seconds:.3f}")
            if case.problem:
                kind, of = ("error", "input") if case.unusable else ("failure", "check")
                problem = ElementTree.SubElement(shown, kind, type=of, message=_text(case.problem))
                problem.text = _text(case.text)
            else:
                ElementTree.SubElement(shown, "system-out").text = _text(case.text)
    ElementTree.indent(root)
    with written(path) as part:
        part.write_bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")


def _counts(suites: Sequence[Suite]) -> dict[str, str]:
    cases = [case for suite in suites for case in suite.cases]
    errors = sum(case.unusable for case in cases)
    failures = sum(bool(case.problem) for case in cases) - errors
    counts = {"tests": len(cases), "failures": failures, "errors": errors}
    seconds = sum(suite.seconds for suite in suites)
    return {**{name: str(number) for name, number in counts.items()}, "time": f"{seconds:.3f}"}


def _text(text: str) -> str:
    return _FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text)
