"""The short way to read flat YAML against the whole of it, and that held against ruamel's."""

import math
import sys
import time
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ruamel.yaml import YAML

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.presets import preset_names, preset_text
from bikestab.yamlnodes import resolved

CONFIGS = Path(__file__).parents[1] / "configs"
LINES = [
    "", "# a comment: 1", "# \x07", "\t", "---", "...", "- 1", "  2", "  two: words # here", "   deeper",
    "  µ", "  - and: two", "  end ", "  \x07", "c: 1.04", "c:   2", "l1: -0.4  # ahead", "h1: -0",
    "m1: 010", "g: -0.0", "lam: 18deg", "name: bike2", "name: e10", "source: >-", "source: >",
    "source: µ", "µ: 1", "null: 1", "True: 1", "trues: 1", "y: 2", "A1: no", "B1: 1e3", "C1: .5",
    "D1: 0x10", "R: 1_000", "w: +1", "rR: ~", "m2: '2'", "f: 1 #", "a: [1]", "b: &x 1", "d: *x", "e:",
    "k: 1#one", "t: 1 ", "h2: 1.", "o: 0o17", "R1: 12:30:45", "R2: 2001-01-01",
    "2: 1", "n: ٣", "B2: true", "C2: null",
]  # fmt: skip


def typed(values):
    """Each value with its plain type."""
    return [(key, next(t for t in (int, float, str) if isinstance(v, t)), v) for key, v in values.items()]


def assert_same(text, values):
    assert repr(typed(values)) == repr(typed(yamltext.parse(text, "a.yaml").data))


@pytest.mark.parametrize("name", preset_names())
def test_presets_are_plain(name):
    values = yamltext.plain(preset_text(name))
    assert "source" in values
    assert_same(preset_text(name), values)


def test_what_is_plain_is_what_is_read():
    """Every two lines, and every two after the start of a text."""
    texts = ["\n".join(lines) + "\n" for lines in product(LINES, repeat=2)]
    texts += ["source: >-\n" + text for text in texts]
    read = {text: values for text in texts if (values := yamltext.plain(text))}
    assert len(read) > 200
    for text, values in read.items():
        assert_same(text, values)


@pytest.mark.parametrize("line", ["c: 1.05", "m2: [1]", "m3: 1", "---", "g: 9.8 \x07"])
def test_what_is_not_plain_is_told_by_the_other(tmp_path, line):
    """A second value, what is no number, no parameter, a second document and what YAML forbids."""
    text = preset_text("dikarev1981") + line + "\n"
    path = tmp_path / "mine.yaml"
    path.write_text(text, "utf-8")
    with pytest.raises(InputError) as told:
        Bicycle.from_file(path)
    assert told.value.place.startswith(str(path))


def test_a_file_need_not_be_plain(tmp_path):
    text = preset_text("dikarev1981")
    path = tmp_path / "mine.yaml"
    path.write_text(text.replace("name: dikarev1981", "name: 'dikarev1981'"), "utf-8")
    assert yamltext.plain(path.read_text("utf-8")) is None
    assert Bicycle.from_file(path) == Bicycle.preset("dikarev1981")


# --- what is read


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        ("-0", 0), ("010", 10), ("0o17", 15), ("0x1F", 31), ("1.", 1.0), (".5", 0.5), ("1e-3", 1e-3),
        ("-1E+3", -1e3), (".inf", math.inf), ("-.INF", -math.inf), ("~", None), ("", None), ("null", None),
        ("true", True), ("FALSE", False), ("no", "no"), ("yes", "yes"), ("on", "on"), ("Off", "Off"),
        ("tRue", "tRue"),
        ("1_000", "1_000"), ("12:30:45", "12:30:45"), ("2001-01-01", "2001-01-01"), ("18deg", "18deg"),
        ("+", "+"),
        (".", "."), ("1e", "1e"), ("0o8", "0o8"), ("'1'", "1"), ('"\\x41"', "A"), ("!!str 1", "1"),
        ("! 1", "1"),
        ("!!float 1", 1.0), ("!!int 0x1f", 31), ("!!bool true", True), ("[]", []), ("!!seq [1]", [1]),
        ("{}", {}),
    ],
)  # fmt: skip
def test_values_of_yaml_1_2(text, value):
    found = yamltext.parse(f"a: {text}\n", "a.yaml").data["a"]
    assert (type(found), found) == (type(value), value)
    try:
        assert resolved(text) == (value if text[:1] not in tuple("'\"![{") else text)
    except ValueError:
        pytest.fail("no number is that long")


@pytest.mark.parametrize(
    ("text", "ours", "theirs"),
    [
        ("0b1", "0b1", 1), ("-0x1F", "-0x1F", -31), ("+0o17", "+0o17", 15), ("1_000", "1_000", 1000),
        ("0x1_F", "0x1_F", 31), ("1_0.5", "1_0.5", 10.5), (".5e1", 5.0, ".5e1"),
    ],
)  # fmt: skip
def test_where_another_reader_leaves_the_core_schema(text, ours, theirs):
    """YAML 1.2, section 10.3.2: no base of two, no sign before 0x and 0o, no underscores; a leading point."""
    assert yamltext.parse(f"a: {text}\n", "a.yaml").data == {"a": ours}
    assert YAML(typ="safe", pure=True).load(f"a: {text}\n") == {"a": theirs}


@pytest.mark.parametrize("name", sorted(path.name for path in CONFIGS.glob("*.yaml")))
def test_configs_are_what_another_reader_finds(name):
    text = (CONFIGS / name).read_text("utf-8")
    document = yamltext.parse(text, name)
    other = YAML().load(text)
    assert document.data == other
    for key in ("bicycle", "grid", "output"):
        assert document.line((key,)) == other.lc.data[key][0] + 1
    assert document.line(("grid", "V", "num")) == other["grid"]["V"].lc.data["num"][0] + 1


def test_merged_keys_and_aliases():
    text = "a: &x {p: 1, q: 2}\nb: {<<: *x, q: 3}\nc: {<<: [{q: 4}, *x]}\nd: *x\n"
    document = yamltext.parse(text, "a.yaml")
    other = YAML(typ="safe", pure=True).load(text)
    assert document.data == other
    assert document.line(("b", "p")) == 1
    assert document.line(("b", "q")) == 2
    assert document.line(("d", "none")) == 4


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a: !!bool maybe", "line 1, column 4: 'maybe' is no !!bool"),
        ("b: 1\na: !!int 1.5", "line 2, column 4: '1.5' is no !!int"),
        ("a: !!python/object:os.system x", "line 1, column 4: the tag '!!python/object:os.system'"),
        ("a: !own {b: 1}", "line 1, column 4: the tag '!own' is not known"),
        ("a: &a\n  <<: *a\n", "line 2, column 7: *a stands in what it is an alias of"),
        ("&a {b: [*a]}", "line 1, column 9: *a stands in what it is an alias of"),
        ("a: *b", "line 1, column 4: not valid YAML: there is no anchor &b before *b"),
        ("a: {<<: 1}", "line 1, column 5: << stands for the keys of a mapping"),
        ("? [1]\n: 2", "line 1, column 3: a key is text, and no list"),
        ("{{a: 1}: 2}", "line 1, column 2: a key is text, and no list"),
        ("a: {? {? {b: 1} : 2} : 3}", "line 1, column 7: a key is text"),
        ("a: &a 1\n*a : 2", "line 2, column 1: a key is text"),
        ("%YAML 3.7\n---\na: 1", "line 1, column 1: not valid YAML: found incompatible YAML document"),
        ("%WHAT\n---\na: 1", "line 1, column 6: not valid YAML: found unknown directive name"),
        ("a: 1\nb: " + "9" * 5000, "line 2, column 4: not valid YAML: a number of 5000 characters"),
        ("a: 1." + "9" * 5000, "line 1, column 4: not valid YAML: a number of 5002 characters"),
        ("b: 1\na: 'x\x1b[2J'", "line 2: not valid YAML: unacceptable character #x001b"),
        ("a: 1\nb: \udc80", "'\\udc80' is a character that no file can hold"),
        ('a: "\\ud800"', "line 1, column 7: not valid YAML: found invalid Unicode character"),
        ("a: [1", "line 1: not valid YAML: did not find expected ',' or ']'"),
    ],
)  # fmt: skip
def test_what_is_refused(text, told):
    with pytest.raises(InputError) as error:
        yamltext.parse(text, "a.yaml")
    assert str(error.value).startswith(f"a.yaml{', ' if told.startswith('line') else ': '}{told}")
    assert len(str(error.value)) < 200


def bomb(levels, start="[", end="]", value="x"):
    lines = [f"a0: &a0 {start}{value}, {value}{end}"]
    lines += [f"a{i + 1}: &a{i + 1} {start}*a{i}, *a{i}{end}" for i in range(levels)]
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (bomb(30), "more than 200000 values, those behind aliases counted each time"),
        (bomb(30, "{<<: [", "]}", "{}"), "more than 200000 values"),
        ("a: [" + "1," * 900_000 + "]", "more than 200000 values"),
        ("a: " + "[" * 900_000, "exceeded maximum nesting depth|nested too deeply"),
        ("a: " + "{a: " * 500_000, "is nested too deeply"),
        ("a: " + "{? " * 500_000, "a key is text"),
        ("- " * 900_000, "is nested too deeply"),
        ("".join(" " * i + "a:\n" for i in range(1900)), "is nested too deeply"),
        ("a: '" + " " * 1_900_000, "not valid YAML"),
        ("&a " * 600_000, "not valid YAML"),
        ("#" * 1_900_000, "holds an empty document"),
        ("a: !<" + "x" * 1_900_000 + "> 1", "is not known"),
        ("a" * 900_000 + ": 1\n" + "a" * 900_000 + ": 1", "not valid YAML"),
    ],
    ids=[
        "aliases", "merges", "long list", "lists", "mappings", "keys", "dashes", "indented", "blanks",
        "anchors", "remark", "tag", "long key",
    ],
)  # fmt: skip
def test_time_is_bounded(text, told):
    """Two seconds are hundreds of times what the texts need that are in proportion to their length."""
    begin = time.process_time()
    with pytest.raises(InputError, match=told) as error:
        yamltext.parse(text, "a.yaml")
    assert time.process_time() - begin < (2 if sys.gettrace() is None else 20)  # coverage traces each line
    assert len(str(error.value)) < 300


def test_what_is_allowed_is_read_in_time():
    text = "a: [" + ", ".join(f"{i}.5" for i in range(190_000)) + "]\nb: " + "[" * 30 + "]" * 30
    begin = time.process_time()
    assert len(yamltext.parse(text, "a.yaml").data["a"]) == 190_000
    assert time.process_time() - begin < 5


# --- what is put in


@pytest.mark.parametrize(
    ("text", "key", "value", "expected"),
    [
        ("a: 1  # one\nb: 2\n", "a", 3, "a: 3  # one\nb: 2\n"),
        ("a: {b: [1, 2]}  # c\n", "a.b.1", "x y", 'a: {b: [1, "x y"]}  # c\n'),
        ("a:\n  b: 1\n\n# c\nd: 2\n", "a", [1], "a:\n  [1]\n\n# c\nd: 2\n"),
        ("a:\n  b: 1  # c\n", "a.e", True, "a:\n  {b: 1, e: true}  # c\n"),
        ("a: 1  # one", "b.c", None, "a: 1  # one\nb: {c: null}\n"),
        ("a:\nb: 2\n", "a", 1e-7, "a: 1e-07\nb: 2\n"),
        ("{a: 1}\n", "b", 2, "{a: 1, b: 2}\n"),
        ("a: &x {b: 1}\nc: *x  # d\n", "c.b", 2, "a: &x {b: 1}\nc: {b: 2}  # d\n"),
        ("a: &x {b: 1}  # lost\nc: *x\n", "a", 2, "a: 2\nc:\n  b: 1\n"),
        ("a: |\n  text\nb: 1\n", "a", "true", 'a: "true"b: 1\n'),
    ],
)
def test_a_value_is_replaced_where_it_stands(text, key, value, expected):
    document = yamltext.parse(text, "a.yaml")
    path = [int(part) if part.isdigit() else part for part in key.split(".")]
    found = document.replaced(path, value)
    wanted = yamltext.copied(document.data)
    node = wanted
    for part in path[:-1]:
        node = node.setdefault(part, {}) if isinstance(node, dict) else node[part]
    node[path[-1]] = value
    assert found.data == wanted == YAML(typ="safe", pure=True).load(found.text)
    if expected.endswith('"b: 1\n'):  # no YAML: all is written anew
        expected = 'a: "true"\nb: 1\n'
    assert found.text == expected


TEXT = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)
DATA = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**300), 10**300) | st.floats(allow_nan=False)
    | TEXT | st.sampled_from(["null", "1", ".5", "a b", "~", "- a"]),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=12,
)  # fmt: skip


@settings(max_examples=50, deadline=None)
@given(st.dictionaries(TEXT, DATA, min_size=1, max_size=5))
def test_what_is_written_is_read_again(data):
    assert yamltext.parse(yamltext.dumped(data), "a.yaml").data == data
