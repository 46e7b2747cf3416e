"""Copies of this process: what they hold of its files, and where there are none."""

import os
import subprocess
import sys
import textwrap

import pytest

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="copies are made on Linux alone")


def output(text, **env):
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(text)],
        capture_output=True, text=True, timeout=60, env={**os.environ, **env},
    )  # fmt: skip
    return done.stdout.split(), done.stderr


def test_a_copy_has_no_file_of_the_first_process_however_many_it_has():
    out, err = output(
        """
        import os, resource
        from bikestab.scan.processes import in_processes
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (min(hard, 3000), hard))
        read, write = os.pipe()
        numbers = [os.dup2(write, number) for number in (50, 1023, 1024, min(hard, 3000) - 1)]
        def still_open(numbers):
            return [number for number in numbers if os.path.exists(f"/proc/self/fd/{number}")], os.getppid()
        ((_, (left, parent)),) = in_processes([(0, numbers)], 1, still_open)
        print(left, parent == os.getpid())
        """,
        OPENBLAS_NUM_THREADS="1",
    )
    assert (out, err) == (["[]", "True"], "")


def test_beside_a_thread_that_python_does_not_know_of_none_is_made():
    out, err = output(
        """
        import ctypes, time
        from bikestab.scan.processes import in_processes
        def forked():
            print("forked")
        import os
        os.register_at_fork(before=forked)
        body = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p)(lambda _: time.sleep(0.3) or 0)
        thread = ctypes.c_ulong()
        ctypes.CDLL(None).pthread_create(ctypes.byref(thread), None, body, None)
        print([*in_processes([(0, -7)], 1, abs)])
        """,
        OPENBLAS_NUM_THREADS="1",
    )
    assert (" ".join(out), err) == ("[(0, 7)]", "")
