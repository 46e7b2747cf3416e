"""The public names: what there is, what it costs to import, and that its examples are true."""

import doctest
import inspect
import pkgutil
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import bikestab

CONFIGS = Path(__file__).parents[1] / "configs"
PUBLIC = [getattr(bikestab, name) for name in bikestab.__all__]
FUNCTIONS = [value for value in PUBLIC if inspect.isfunction(value)]


def in_a_new_process(program):
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return run.stdout.split()


def test_importing_it_imports_nothing_else():
    program = "import sys; old = set(sys.modules); import bikestab; print(*sorted(set(sys.modules) - old))"
    assert in_a_new_process(program) in (["__future__", "bikestab"], ["bikestab"])


def test_no_module_stands_where_a_public_name_is():
    modules = [module.name for module in pkgutil.walk_packages(bikestab.__path__, "bikestab.")]
    assert "bikestab.scan.run" in modules
    program = (
        f"import bikestab as bs, {', '.join(modules)}\n"
        "print(*(type(getattr(bs, name)).__name__ for name in bs.__all__))"
    )
    kinds = in_a_new_process(program)
    assert len(kinds) == len(bikestab.__all__)
    assert "module" not in kinds


def test_dir_shows_just_the_public_names():
    assert sorted(dir(bikestab)) == sorted([*bikestab.__all__, "__version__"])
    namespace = {}
    exec("from bikestab import *", namespace)
    assert set(bikestab.__all__) <= set(namespace)


def test_type_checkers_see_the_same_names():
    source = inspect.getsource(bikestab)
    block = source.partition("if TYPE_CHECKING:")[2].partition("\n\n")[0]
    namespace = {}
    exec(inspect.cleandoc(block), namespace)
    for name in bikestab.__all__:
        assert namespace[name] is getattr(bikestab, name)


def test_unknown_names():
    with pytest.raises(AttributeError, match="no attribute 'speeds_of_light'"):
        bikestab.speeds_of_light  # noqa: B018  # the access is the test


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.__name__)
def test_docstrings_say_all(function):
    text = inspect.getdoc(function)
    for heading in ("Parameters", "Returns", "Raises", "Notes", "Examples"):
        assert f"\n{heading}\n{'-' * len(heading)}\n" in text, heading
    head = text.partition("Parameters")[2].partition("Returns")[0]
    for name in inspect.signature(function).parameters:
        assert name in head


@pytest.mark.parametrize("value", [v for v in PUBLIC if callable(v)], ids=lambda v: v.__name__)
def test_examples(value, tmp_path, in_an_empty_folder):
    shutil.copytree(CONFIGS, tmp_path / "configs")
    if inspect.isclass(value) and issubclass(value, Exception):
        return  # an error needs none
    (test,) = doctest.DocTestFinder(recurse=False).find(value, value.__name__)
    assert test.examples
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    runner.run(test)
    assert runner.summarize(verbose=False).failed == 0
