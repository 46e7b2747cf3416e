"""Mistakes that are told of together: all are there, and a message stays short."""

import pickle

import pytest

from bikestab.errors import InputError, Mistakes, together


def mistake(i, place="a.yaml, line {}"):
    return InputError(f"{i} is odd", key=("grid", f"x{i}"), hint="allowed: even", place=place.format(i))


def test_one_mistake_is_told_as_ever():
    assert together([mistake(3)]).others == ()
    assert str(together([mistake(3)])) == "a.yaml, line 3: grid.x3: 3 is odd\nallowed: even"


def test_three_have_a_line_each_and_the_file_is_named_once():
    other = InputError("there is no such file", place="b.yaml")
    assert str(together([mistake(1), mistake(3), other])).split("\n") == [
        "a.yaml, line 1: grid.x1: 1 is odd; allowed: even",
        "line 3: grid.x3: 3 is odd; allowed: even",
        "b.yaml: there is no such file",
    ]


@pytest.mark.parametrize(("number", "named"), [(4, 2), (9, 7), (99, 9)])
def test_of_more_two_are_told_and_where_the_others_are(number, named):
    *first, last = str(together([mistake(i) for i in range(number)])).split("\n")
    assert [line[-29:] for line in first] == [f"grid.x{i}: {i} is odd; allowed: even"[-29:] for i in (0, 1)]
    assert last.startswith(f"and {number - 2} more: line 2 grid.x2, line 3 grid.x3")
    assert last.count("line") == named
    assert last.endswith(", ...") is (named < number - 2)


def test_all_of_them_keep_place_key_and_what_is_allowed():
    error = together([mistake(i, "") for i in range(5)])
    copy = pickle.loads(pickle.dumps(error))
    for one in (error, copy, error.at("c.yaml", under=("in",)), error.renamed({"grid": "net"})):
        assert [each.problem for each in one.mistakes] == [f"{i} is odd" for i in range(5)]
        assert all(not each.others for each in one.mistakes)
    placed = error.at("c.yaml", under=("in",)).mistakes
    assert [each.key for each in placed] == [("in", "grid", f"x{i}") for i in range(5)]
    assert {each.place for each in placed} == {"c.yaml"}
    assert error.renamed({"grid": "net"}).mistakes[4].key == ("net", "x4")


def test_what_is_kept_is_told_in_the_end():
    mistakes = Mistakes()
    mistakes.tell()
    with mistakes.kept():
        raise together([mistake(1), mistake(3)])
    with mistakes.kept():
        raise mistake(5)
    with pytest.raises(KeyError), mistakes.kept():
        raise KeyError
    with pytest.raises(InputError) as caught:
        mistakes.tell()
    assert [each.key[1] for each in caught.value.mistakes] == ["x1", "x3", "x5"]
