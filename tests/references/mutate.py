"""``python tests/references/mutate.py [NUMBER [SEED]]``: which mistakes put into the core tests notice.

A mutant is one operator, comparison, sign or number of a module changed, in a copy of the repository. It is
noticed where the tests named beside the module fail or take more than SECONDS of processor time; others are
told, with the line as Python writes it. More mutants of the same seed are the fewer ones first.
"""

import ast
import functools
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[2]
SECONDS = 60
TESTS = {
    "model": ["test_model.py", "test_routh.py"],
    "polynomials": ["test_polynomials.py", "test_routh.py", "test_roots.py"],
    "routh": ["test_routh.py"],
    "roots": ["test_polynomials.py", "test_roots.py"],
    "speeds": ["test_isolation.py", "test_speeds.py"],
}
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


def noticed(folder, name):
    """Whether the tests of a module fail in a copy of the repository."""
    tests = [f"tests/{test}" for test in TESTS[name]]
    environment = {**os.environ, "PYTHONPATH": f"{folder}:{folder}/cli", "PYTHONDONTWRITEBYTECODE": ""}
    limits = functools.partial(resource.setrlimit, resource.RLIMIT_CPU, (SECONDS, SECONDS))
    options = {"cwd": folder, "env": environment, "capture_output": True, "preexec_fn": limits}
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider", *tests]
    return bool(subprocess.run(command, **options).returncode)


def main(number=100, seed=0):
    """Try so many mutants, drawn at random."""
    every = [(name, *mutant) for name in TESTS
             for mutant in mutants((ROOT / f"bikestab/{name}.py").read_text("utf-8"))]  # fmt: skip
    drawn, counts = random.Random(seed).sample(every, len(every))[:number], Counter()
    with tempfile.TemporaryDirectory() as folder:
        for part in ("bikestab", "cli", "tests", "configs", "docs"):
            shutil.copytree(ROOT / part, Path(folder, part))
        shutil.copy(ROOT / "pyproject.toml", folder)
        for name in TESTS:
            assert not noticed(folder, name), f"the tests of {name} fail as it stands"
        for name, line, text in drawn:
            path = Path(folder, f"bikestab/{name}.py")
            whole = path.read_text("utf-8")
            before = ast.unparse(ast.parse(whole))
            path.write_text(text, "utf-8")
            found = noticed(folder, name)
            path.write_text(whole, "utf-8")
            counts[name, found] += 1
            if not found:
                was, now = next(pair for pair in zip(before.split("\n"), text.split("\n"), strict=True)
                                if pair[0] != pair[1])  # fmt: skip
                print(f"not noticed: {name}.py, line {line}: {was.strip()} -> {now.strip()}", flush=True)
    for name in TESTS:
        tried = counts[name, True] + counts[name, False]
        print(f"{name}: {counts[name, True]} of {tried} noticed")
    used = sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    print(f"all: {len(every)} mutants, {len(drawn)} tried in {used:.0f} s of processor time")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
