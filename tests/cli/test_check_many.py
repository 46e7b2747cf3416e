"""bikestab check on twenty files, most of them broken, each in its own way: none hides another."""

import json
from pathlib import Path

import junitparser
import pytest

GOOD = "bicycle: meijaard2007\nexpect: [{V1: 4.2924}]\n"
FAILS = GOOD.replace("4.2924", "4.2")
ONE = b"\nexpect: [{V1: 4}]\n"
NO_UTF8 = "line 1: is not a text file in UTF-8"
HOLD = {
    "good.yaml": GOOD.encode(), "bom.yaml": b"\xef\xbb\xbf" + GOOD.encode(),
    "crlf.yaml": GOOD.replace("\n", "\r\n").encode(),
    "json.json": b'{"bicycle": "meijaard2007", "expect": [{"V1": 4.2924}]}',
}  # fmt: skip
BROKEN = {  # what is in the file, what is said of it, and what to do
    "not_yaml.yaml": (b"a: [1, 2\nb: }", "line 2, column 2: not valid YAML", ""),
    "tab.yaml": (b"bicycle: meijaard2007\nexpect:\n\t- {V1: 4}\n", "a tab, where YAML has blanks", ""),
    "nul.yaml": (b"title: a\0b\n", "unacceptable character #x0000", ""),
    "key.yaml": (GOOD.replace("expect", "expct").encode(), "line 2: expct: unknown key", "'expect'?"),
    "no_bicycle.yaml": (b"expect: [{V1: 4}]\n", "bicycle: missing", "for example 'bicycle: meijaard2007'"),
    "other.yaml": (b"bicycle: meijard" + ONE, "line 1: bicycle: there is no", "'meijaard2007'?"),
    "no_file.yaml": (b"bicycle: x.txt" + ONE, "x.txt: there is no such file", "in no_file.yaml, line 1"),
    "no_design.yaml": (b"bicycle: dikarev1981" + ONE, "expect[0]: the bicycle", "give lam and"),
    "nothing.yaml": (b"bicycle: meijaard2007\nexpect: []\n", "has no expectations", "add 'expect:'"),
    "empty.yaml": (b"", "holds an empty document", "a valid file has lines such as"),
    "list.yaml": (b"- 1\n- 2\n", "holds a list", "a valid file has lines such as"),
    "latin.yaml": ("title: Müller\n".encode("latin-1"), NO_UTF8, "iconv -f latin1"),
    "utf16.yaml": (GOOD.encode("utf-16"), NO_UTF8, "it is in UTF-16"),
    "noise.yaml": (b"\x80\1\2" * 999, NO_UTF8, "it is no text at all"),
    "picture.yaml": (b"\x89PNG\r\n\x1a\n" + b"\0" * 99, "is a picture, not a scan's config", ""),
    "bicycle.yaml": (b"w: 1.02\nmB: 85\n", "is a bicycle's file", "'bicycle:' in a config"),
    "in_place.yaml": (b"bicycle: {w: 1.02, lamm: 18deg}" + ONE, "bicycle.lamm: unknown", "'lam'?"),
    "folder": (None, "is a folder, not a file", "YAML files in 'folder': inner.yaml"),
    "none.yaml": (None, "there is no such file", "did you mean 'noise.yaml'?"),
}  # fmt: skip


@pytest.fixture
def files():
    for name, content in HOLD.items():
        Path(name).write_bytes(content)
    for name, (content, _, _) in BROKEN.items():
        if content is not None:
            Path(name).write_bytes(content)
    Path("fails.yaml").write_text(FAILS, "utf-8")
    Path("folder").mkdir()
    Path("folder", "inner.yaml").write_text(GOOD, "utf-8")
    return [*BROKEN, "fails.yaml", *HOLD]


def test_each_is_told_of(bikestab, files):
    code, out, err = bikestab("check", *files, "--junit", "results.xml")
    assert code == 2
    rows = {line.split()[0]: line.split()[-1] for line in out.splitlines() if line.split("  ")[0] in files}
    assert rows == dict.fromkeys(BROKEN, "ERROR") | {"fails.yaml": "FAILED"} | dict.fromkeys(HOLD, "holds")
    assert all(len(line) <= 80 for line in out.splitlines())
    files_and_entries = "18 files and 1 entry cannot be used"
    told = err.removesuffix(f"1 of 5 expectations failed, {files_and_entries}\n").split("error: ")[1:]
    assert len(told) == len(BROKEN)
    cases = {suite.name: next(iter(suite)) for suite in junitparser.JUnitXml.fromfile("results.xml")}
    for (name, (_, problem, hint)), text in zip(BROKEN.items(), told, strict=True):
        words = "; ".join(line.strip() for line in text.splitlines())
        assert problem in words.split("; ")[0], name
        assert hint in words, name
        assert name in words, name
        (error,) = cases[name].result
        assert isinstance(error, junitparser.Error)
        assert words == error.message
    assert [cases[name].is_passed for name in HOLD] == [True] * len(HOLD)


def test_and_in_json(bikestab, files):
    code, out, _ = bikestab("check", *files, "--json")
    found = {each["config"]: each for each in json.loads(out)["results"]}
    assert code == 2
    assert [*found] == files
    for name, (_, problem, hint) in BROKEN.items():
        assert problem in found[name]["error"]
        assert hint in found[name]["error"]
        assert found[name]["mistakes"] == [found[name]["error"]]
    assert [found[name]["holds"] for name in ("fails.yaml", *HOLD)] == [False] + [True] * len(HOLD)


def test_all_mistakes_of_a_file_are_in_json_and_junit(bikestab):
    Path("a.yaml").write_text("titel: x\nbicycle: meijaard2007\nmodle: x\nexpect: [{V1: a}, {V2: b}]\n")
    code, out, err = bikestab("check", "a.yaml", "--json", "--junit", "a.xml")
    assert code == 2
    assert len(err.splitlines()) == 3
    assert err.splitlines()[-1] == "  and 2 more: line 4 expect[0].V1, line 4 expect[1].V2"
    (record,) = json.loads(out)["results"]
    assert [text.splitlines()[0].partition(": ")[2].partition(":")[0] for text in record["mistakes"]] == [
        "titel", "modle", "expect[0].V1", "expect[1].V2",
    ]  # fmt: skip
    ((case,),) = junitparser.JUnitXml.fromfile("a.xml")
    assert case.result[0].text.strip().splitlines() == "\n".join(record["mistakes"]).splitlines()
