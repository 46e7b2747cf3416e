"""The short way to read flat YAML against ruamel's."""

from itertools import product

import pytest

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.presets import preset_names, preset_text

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
    """Each value with its plain type: ruamel's are subclasses."""
    return [(key, next(t for t in (int, float, str) if isinstance(v, t)), v) for key, v in values.items()]


def assert_same(text, values):
    assert repr(typed(values)) == repr(typed(yamltext.parse(text, "a.yaml").data))


@pytest.mark.parametrize("name", preset_names())
def test_presets_are_plain(name):
    values = yamltext.plain(preset_text(name))
    assert "source" in values
    assert_same(preset_text(name), values)


def test_what_is_plain_is_what_ruamel_reads():
    """Every two lines, and every two after the start of a text."""
    texts = ["\n".join(lines) + "\n" for lines in product(LINES, repeat=2)]
    texts += ["source: >-\n" + text for text in texts]
    read = {text: values for text in texts if (values := yamltext.plain(text))}
    assert len(read) > 200
    for text, values in read.items():
        assert_same(text, values)


@pytest.mark.parametrize("line", ["c: 1.05", "m2: [1]", "m3: 1", "---", "g: 9.8 \x07"])
def test_what_is_not_plain_is_told_by_ruamel(tmp_path, line):
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


@pytest.mark.parametrize("text", ["a: !!bool maybe\n", "a: &a\n  <<: *a\n", "a: &a {<<: *a}\n"])
def test_what_the_parser_stumbles_over(text):
    with pytest.raises(InputError, match=r"^a\.yaml: not valid YAML: something in it cannot be built"):
        yamltext.parse(text, "a.yaml")
