"""Long messages: what the user needs of them stays."""

import string
import time
from pathlib import Path

import pytest
from bikestab_cli.messages import LINES, LONGEST, cut, folded
from hypothesis import given
from hypothesis import strategies as st

from bikestab.notation import MEIJAARD

WORDS = st.lists(
    st.text(string.ascii_letters + "/_'", min_size=1, max_size=300) | st.sampled_from(["a,", "bb,", "c:"]),
    max_size=80,
)


@given(WORDS, st.sampled_from(["", "see 'bikestab --help'"]))
def test_no_message_is_too_long_and_short_ones_are_as_they_were(words, hint):
    line = " ".join(["error:", *words])
    lines = folded(line, hint)
    assert all(len(part) <= LONGEST for part in lines)
    assert len(lines) <= LINES
    assert lines[0].startswith("error:")
    assert not hint or lines[-1] == f"  {hint}"
    if len(line) <= LONGEST:
        assert lines == [line, *([f"  {hint}"] if hint else [])]
    assert len(cut(line)) <= LONGEST
    assert cut(line) == line or len(line) > LONGEST


@given(st.lists(st.text(string.ascii_letters, min_size=1, max_size=60), min_size=20, max_size=60))
def test_what_there_is_room_for_is_wrapped_and_all_there(words):
    line = " ".join(words)
    lines = folded(line)
    if len(line) <= 2 * LONGEST:
        assert " ".join(part.strip() for part in lines) == line


def test_paths_lose_their_middle_and_sentences_nothing():
    path = "/home/me/" + "/".join(["very_long_folder"] * 12) + "/volume.h5"
    line = (
        f"error: scan.yaml, line 7: output: {path} exists, and was made from another config (other: grid.lam)"
    )
    found = cut(line)
    assert found.startswith("error: scan.yaml, line 7: output: /home/me/very_long_folder")
    assert found.endswith("/volume.h5 exists, and was made from another config (other: grid.lam)")


def test_lists_lose_their_end_and_say_so():
    names = [f"name{i}" for i in range(100)]
    line = f"error: there is no parameter 'foo'; known: {', '.join(names)}; see the manual"
    found = cut(line)
    kept = found.partition("known: ")[2].partition(" and ")[0].split(", ")
    assert kept == names[: len(kept)]
    assert found.endswith(f" and {100 - len(kept)} more; see the manual")
    assert len(found) > LONGEST - 10


def test_the_longest_list_takes_no_time():
    """Of a megabyte: where each word that goes costs all others, this takes twenty minutes."""
    start = time.process_time()
    *_, line = folded("error: " + ", ".join(["ab"] * 250_000))
    assert line.endswith(" more")
    assert time.process_time() - start < 10


def test_what_is_neither_path_nor_list_loses_its_middle():
    assert cut("a " * 200, 21) == "a a a a  ... a a a a "


def test_all_names_of_parameters_are_told(bikestab):
    _, _, err = bikestab("vrange", "--bicycle", "meijaard2007", "--sd", "foo=1")
    lines = err.splitlines()
    told = " ".join(line.strip() for line in lines[:2]).partition("known: ")[2].split(", ")
    assert set(MEIJAARD) | {"head_angle", "sigma", "trail", "offset"} <= set(told)
    assert lines[2] == "  see 'bikestab vrange --help'"


@pytest.mark.parametrize("depth", [1, 4])
def test_whose_output_is_there_is_told_in_any_folder(bikestab, depth):
    folder = Path(*["folder_of_a_long_name"] * 2 * depth)
    folder.mkdir(parents=True)
    config = folder / "scan.yaml"
    axes = "grid: {lam: {values: [0.1, 0.2]}, sigma: {values: [0, 0.1]}, V: {values: [1, 5]}}"
    config.write_text(
        f"bicycle: meijaard2007\n{axes}\noutput: {folder.absolute() / 'out'}\n", encoding="utf-8"
    )
    assert bikestab("scan", config)[0] == 0
    code, _, err = bikestab("scan", config, "--set", "grid.lam.values=[0.1,0.3]")
    told = " ".join(line.strip() for line in err.splitlines())
    assert code == 2
    assert "scan.yaml" in told
    assert "exists, and was made from another config" in told
    assert "replace it with --force" in told
