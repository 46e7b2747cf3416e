"""scipy's root finder without the rest: it is scipy's, and leaves no half of it behind."""

import subprocess
import sys

ALONE = """
import sys
from bikestab.scan.rootfinder import find_root
find = find_root()
print("scipy.optimize" in sys.modules, "scipy.linalg" in sys.modules)
result = find(lambda x, a: x**2 - a, (0.0, 4.0), args=([2.0, 9.0],))
print(bool(result.success.all()), result.x.round(12).tolist())
from scipy.optimize import brentq, elementwise
print(find.__code__ == elementwise.find_root.__code__, find_root() is elementwise.find_root)
"""
MOVED = """
import sys
class Nowhere:
    def find_spec(self, name, path=None, target=None):
        if name == "scipy.optimize._elementwise" and not hasattr(sys.modules["scipy.optimize"], "brentq"):
            raise ImportError(name)
sys.meta_path.insert(0, Nowhere())
from bikestab.scan.rootfinder import find_root
find = find_root()
from scipy.optimize import elementwise
print(find is elementwise.find_root)
"""
EMPTY = """
import sys
from importlib.machinery import ModuleSpec
class Empty:
    def find_spec(self, name, path=None, target=None):
        if name in ("scipy.optimize._elementwise", "scipy.ndimage._morphology") and name not in met:
            met.append(name)
            return ModuleSpec(name, self)
    def create_module(self, spec):
        pass
    def exec_module(self, module):
        pass
met = []
sys.meta_path.insert(0, Empty())
from bikestab.lean import alone
from bikestab.scan.rootfinder import find_root
find, edt = find_root(), alone("scipy.ndimage", "_morphology", "distance_transform_edt")
from scipy.ndimage import distance_transform_edt
from scipy.optimize import elementwise
print(len(met), find is elementwise.find_root, edt is distance_transform_edt)
"""


def output(program):
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    return done.stdout.splitlines(), done.stderr


def test_alone():
    assert output(ALONE) == (["False False", "True [1.414213562373, 3.0]", "True True"], "")


def test_where_it_is_elsewhere():
    assert output(MOVED) == (["True"], "")


def test_where_its_module_has_it_no_more():
    assert output(EMPTY) == (["2 True True"], "")


LEAN = """
import sys
import numpy as np
from bikestab.lean import lean_numpy
with lean_numpy():
    from scipy.spatial import Delaunay
    kept = np.testing
print("numpy.testing" in sys.modules, "numpy.f2py" in sys.modules)
np.testing.assert_equal(1, 1)
print(kept.assert_equal is np.testing.assert_equal, np.f2py.__name__)
from scipy.optimize import elementwise
print(Delaunay(np.array([[0.0, 0], [1, 0], [0, 1]])).simplices.shape)
"""


def test_parts_of_numpy_that_are_left_out_come_when_asked_for():
    assert output(LEAN) == (["False False", "True numpy.f2py", "(1, 3)"], "")
