"""A task in a second process: what it gives, and what becomes of it whatever happens."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest


def run(text):
    """What a program of its own prints, whose process has no thread but the first."""
    start = "import os, signal, time\nfrom bikestab import aside\nfrom bikestab.aside import meanwhile\n"
    start += "aside.cores = lambda: 2\nhere = os.getpid()\n"
    done = subprocess.run(
        [sys.executable, "-c", start + textwrap.dedent(text)], capture_output=True, text=True, timeout=60
    )
    return done.stdout.split(), done.stderr


linux = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="elsewhere there is no second process"
)


@linux
def test_it_runs_beside_the_block():
    out, err = run("""
        def task():
            print("no word of it")
            return os.getpid(), b"x" * (1 << 20)
        with meanwhile(task) as result:
            number, content = result()
        print(number != here, len(content))
        """)
    assert (out, err) == (["True", str(1 << 20)], "")


@linux
def test_one_core_does_it_here():
    out, _ = run("""
        aside.cores = lambda: 1
        with meanwhile(os.getpid) as result:
            print(result() == here)
        """)
    assert out == ["True"]


@linux
@pytest.mark.parametrize("end", ["os.kill(os.getpid(), signal.SIGKILL)", "os._exit(0)", "raise ValueError"])
def test_what_ends_it_costs_no_result(end):
    out, err = run(f"""
        def task():
            if os.getpid() != here:
                {end}
            return "done"
        with meanwhile(task) as result:
            print(result())
        """)
    assert (out, err) == (["done"], "")


@linux
def test_its_error_is_raised():
    out, _ = run("""
        try:
            with meanwhile(lambda: 1 / 0) as result:
                result()
        except ZeroDivisionError:
            print("divided")
        """)
    assert out == ["divided"]


@linux
def test_nobody_waits_for_what_is_not_wanted():
    out, err = run("""
        start = time.monotonic()
        try:
            with meanwhile(lambda: time.sleep(50)):
                raise ValueError
        except ValueError:
            print(time.monotonic() - start < 10)
        try:
            os.waitpid(-1, 0)
        except ChildProcessError:
            print("none left")
        """)
    assert (out, err) == (["True", "none", "left"], "")


@linux
def test_beside_another_thread_it_is_done_here():
    out, _ = run("""
        import threading
        threading.Thread(target=time.sleep, args=(0.2,)).start()
        with meanwhile(os.getpid) as result:
            print(result() == here)
        """)
    assert out == ["True"]


@linux
def test_beside_a_thread_that_python_does_not_know_of():
    out, err = run("""
        import ctypes
        body = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p)(lambda _: time.sleep(0.5) or 0)
        thread = ctypes.c_ulong()
        ctypes.CDLL(None).pthread_create(ctypes.byref(thread), None, body, None)
        with meanwhile(os.getpid) as result:
            print(result() == here)
        """)
    assert (out, err) == (["True"], "")


@linux
def test_where_no_process_can_be_made_it_is_done_here():
    out, err = run("""
        def refused():
            raise BlockingIOError
        before = os.listdir("/proc/self/fd")
        os.fork = refused
        with meanwhile(os.getpid) as result:
            print(result() == here)
        print(os.listdir("/proc/self/fd") == before)
        """)
    assert (out, err) == (["True", "True"], "")


@linux
@pytest.mark.parametrize("change", ["os.memfd_create = refused", "del os.memfd_create"])
def test_turns_without_a_file_in_memory_are_all_had_here(change):
    out, err = run(f"""
        def refused(name):
            raise OSError
        {change}
        with aside.turns(5) as numbers, meanwhile(lambda: list(numbers)) as others:
            print(others(), list(numbers))
        """)
    assert (" ".join(out), err) == ("[] [0, 1, 2, 3, 4]", "")


def test_cores():
    from bikestab.aside import cores

    assert 1 <= cores() <= os.cpu_count()


@linux
@pytest.mark.parametrize("end", ["SIGTERM", "SIGKILL"])
def test_it_ends_with_the_first_process_however_that_ends(end):
    """In the middle of its task, which else would go on for nobody."""
    out, _ = run(f"""
        first = os.fork()
        if not first:
            with meanwhile(lambda: time.sleep(30)) as result:
                with open("/proc/self/task/%d/children" % os.getpid()) as file:
                    os.write(1, file.read().encode())
                os.kill(os.getpid(), signal.{end})
        os.waitpid(first, 0)
        time.sleep(0.7)
        """)
    assert len(out) == 1
    state = Path("/proc", out[0], "stat")
    assert not state.exists() or " Z " in state.read_text()


@linux
def test_turns():
    """Two processes get each number once, and both get some."""
    out, err = run("""
        def task():
            return [number for number in numbers if not time.sleep(0.01)]
        with aside.turns(60) as numbers, meanwhile(task) as others:
            mine = task()
            theirs = others()
        print(sorted(mine + theirs) == list(range(60)), bool(mine), bool(theirs))
        """)
    assert (out, err) == (["True"] * 3, "")
