"""``python tests/references/mutate.py [NUMBER [SEED]]``: which mistakes put into the core tests notice.

A mutant is one operator, comparison, sign or number of a module changed. Each is tried in a fork of this
process, which has everything imported but bikestab itself: the tests that noticed the most before first, then
the shortest. It is noticed where a test fails, or where all of them take more than SECONDS of processor time;
others are told, with the line as Python writes it. Those of ``equal_mutants.txt`` change no answer, and
are left out. More mutants of a seed are the fewer ones first. An interrupt ends the run with its counts.
"""

import ast
import importlib
import importlib.machinery
import os
import pickle
import random
import resource
import signal
import sys
from collections import Counter
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import Phase, settings

ROOT = Path(__file__).parents[2]
EQUAL = Path(__file__).with_name("equal_mutants.txt")
SECONDS = 90
REWRITTEN = "ignore::pytest.PytestAssertRewriteWarning"  # of what is imported before it is
TESTS = {
    "model": ["test_model.py", "test_routh.py"],
    "polynomials": ["test_polynomials.py", "test_routh.py", "test_roots.py"],
    "routh": ["test_routh.py"],
    "roots": ["test_polynomials.py", "test_roots.py"],
    "speeds": ["test_isolation.py", "test_speeds.py"],
}
SHARED = ["test_stability.py", "test_bounds.py", "test_unordered.py", "test_machines.py", "test_motion.py"]
_SWAPPED = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Pow: ast.Mult,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd, ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip


def mutants(text):
    """The line and the text of each mutant of a module."""
    for place in range(sum(1 for _ in _places(ast.parse(text)))):
        tree = ast.parse(text)
        node, change = list(_places(tree))[place]
        change()
        yield node.lineno, ast.unparse(tree)


def _places(tree):
    """Where a module can be changed, without annotations and texts, and a function that does it."""
    hidden = {id(part) for node in ast.walk(tree) for a in ("annotation", "returns") if getattr(node, a, None)
              for part in ast.walk(getattr(node, a))}  # fmt: skip
    for node in ast.walk(tree):
        if id(node) in hidden:
            continue
        if isinstance(node, (ast.BinOp, ast.BoolOp, ast.AugAssign)) and type(node.op) in _SWAPPED:
            yield node, lambda node=node: setattr(node, "op", _SWAPPED[type(node.op)]())
        elif isinstance(node, ast.Compare) and type(node.ops[0]) in _SWAPPED:
            yield node, lambda node=node: node.ops.__setitem__(0, _SWAPPED[type(node.ops[0])]())
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            yield node, lambda node=node: setattr(node, "op", ast.UAdd())
        elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
            yield node, lambda node=node: setattr(node, "value", node.value + 1)


class Order:
    """A plugin of pytest: what noticed more comes first, then what is shorter; knows the first that fails."""

    def __init__(self, seconds, kills):
        self.seconds, self.kills, self.killer = seconds, kills, ""

    def pytest_collection_modifyitems(self, items):
        items.sort(key=lambda item: (-self.kills[item.nodeid], self.seconds.get(item.nodeid, 0)))

    def pytest_runtest_logreport(self, report):
        self.seconds[report.nodeid] = self.seconds.get(report.nodeid, 0) + report.duration
        if report.failed and not self.killer:
            self.killer = report.nodeid


def _in_a_fork(task, *args):
    """What ``task(*args)`` returns in a copy of this process; None where it takes too long or crashes."""
    ours, theirs = os.pipe()
    child = os.fork()
    if not child:
        with suppress(BaseException):
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            os.dup2(1, 2)
            answer = pickle.dumps(task(*args))
            with open(theirs, "wb") as out:  # noqa: PTH123  # open already
                out.write(answer)
        os.kill(os.getpid(), signal.SIGKILL)
    os.close(theirs)
    with open(ours, "rb") as pipe:  # noqa: PTH123
        answer = pipe.read()
    os.waitpid(child, 0)
    return pickle.loads(answer) if answer else None


def _tested(tests, order):
    """The exit code of pytest, and what the plugin knows then."""
    options = ["-x", "-q", "-n0", "-p", "no:cacheprovider", "-W", REWRITTEN]
    code = pytest.main([*options, *(f"tests/{test}" for test in tests)], plugins=[order])
    return int(code), order.killer, order.seconds, [name for name in sys.modules if _foreign(name)]


def _foreign(name):
    return name.split(".")[0] not in (
        "bikestab",
        "bikestab_cli",
        "tests",
        "conftest",
        "__main__",
        "__mp_main__",
    )


def _mutant(name, text, tests, order):
    """The tests of a module whose text is another."""
    plain = importlib.machinery.SourceFileLoader.get_code

    def get_code(self, fullname):
        if fullname == f"bikestab.{name}":
            return compile(text, str(ROOT / f"bikestab/{name}.py"), "exec")
        return plain(self, fullname)

    importlib.machinery.SourceFileLoader.get_code = get_code
    return _tested(tests, order)


def _difference(before, text):
    pairs = zip(before.split("\n"), text.split("\n"), strict=True)
    was, now = next(pair for pair in pairs if pair[0] != pair[1])
    return f"{was.strip()} -> {now.strip()}"


def main(number=10_000, seed=0):
    """Try so many mutants, drawn at random."""
    os.chdir(ROOT)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which shells ignore in what runs behind them
    settings.register_profile(
        "mutants", database=None, deadline=None, phases=(Phase.explicit, Phase.generate)
    )
    settings.load_profile("mutants")
    texts = {name: (ROOT / f"bikestab/{name}.py").read_text("utf-8") for name in TESTS}
    every = [(name, *mutant) for name in TESTS for mutant in mutants(texts[name])]
    drawn, counts = random.Random(seed).sample(every, len(every))[:number], Counter()
    equal = {line for line in EQUAL.read_text("utf-8").splitlines() if not line.startswith("#")}
    with suppress(KeyboardInterrupt):
        _try(drawn, texts, equal, counts)
    for name in TESTS:
        noticed, left, same = (counts[name, what] for what in ("noticed", "not noticed", "equal"))
        print(f"{name}: {noticed} noticed, {left} not noticed, {same} equal")
    tried, used = sum(counts.values()), sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    print(f"all: {len(every)} mutants, {tried} tried in {used:.0f} s of processor time")


def _try(drawn, texts, equal, counts):
    """Count by module and end, and tell of those that are not noticed."""
    plain = {name: ast.unparse(ast.parse(text)) for name, text in texts.items()}
    times, kills = _as_it_stands()
    for name, line, text in drawn:
        difference = _difference(plain[name], text)
        if f"{name}: {difference}" in equal:
            counts[name, "equal"] += 1
            continue
        answer = _in_a_fork(_mutant, name, text, [*TESTS[name], *SHARED], Order(times, kills))
        found = answer is None or bool(answer[0])
        counts[name, "noticed" if found else "not noticed"] += 1
        if answer:
            kills[answer[1]] += 1
        if not found:
            print(f"not noticed: {name}.py, line {line}: {difference}", flush=True)


def _as_it_stands():
    """How long each test takes; what they import is imported here, so that no fork has to."""
    every = sorted({test for tests in TESTS.values() for test in tests} | set(SHARED))
    code, killer, times, foreign = _in_a_fork(_tested, every, Order({}, Counter()))
    assert code == 0, f"{killer} fails as it stands"
    for module in foreign:
        with suppress(Exception):
            importlib.import_module(module)
    return times, Counter()


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
