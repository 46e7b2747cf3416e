"""A check of a file from others, in a process that can be killed: HDF5 reads some damaged files for ever.

A copy of this process costs some milliseconds, where a fresh one would load numpy and HDF5 again. It ends
after LIMIT of processor time, however slow the disk is, and may crash without harm.
"""

from __future__ import annotations

import faulthandler
import os
import pickle
import signal
import warnings
from collections.abc import Callable

from bikestab.errors import InputError

try:
    import resource
except ImportError:  # pragma: no cover  # Windows, where nothing watches
    resource = None  # type: ignore[assignment]

LIMIT = 5  # s of processor time, whole ones: some 500 times what a whole volume takes
_MOST = 4096  # bytes of an answer, so that no pipe is ever full


def watched(check: Callable[[], None]) -> None:
    """Call ``check`` in a process of its own. Raises what it raises, and InputError where it does not end."""
    if resource is None or not hasattr(os, "fork"):  # pragma: no cover
        check()
        return
    ours, theirs = os.pipe()
    with warnings.catch_warnings():  # Python 3.12 warns of forks beside threads: here none of them is needed
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if not child:
        _answer(check, theirs)
    os.close(theirs)
    status = None
    try:
        _, status = os.waitpid(child, 0)
        answer = os.read(ours, _MOST) if os.waitstatus_to_exitcode(status) == 0 else b""
    finally:
        os.close(ours)
        if status is None:  # Ctrl-C
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
    if not answer:
        raise _lost(-os.waitstatus_to_exitcode(status))
    error = pickle.loads(answer)
    if error:
        raise error


def _answer(check: Callable[[], None], pipe: int) -> None:
    """What the child does: nothing of the parent's is closed, flushed or told of twice."""
    code = 1
    try:
        faulthandler.disable()
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in (1, 2):
            os.dup2(nowhere, stream)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 1))
        os.write(pipe, pickle.dumps(_outcome(check)))
        code = 0
    finally:
        os._exit(code)


def _outcome(check: Callable[[], None]) -> Exception | None:
    try:
        check()
    except Exception as error:  # whatever it is, the parent raises it
        return error
    return None


def _lost(number: int) -> InputError:
    if number in (signal.SIGXCPU, signal.SIGKILL):
        return InputError(f"is damaged: HDF5 does not come to an end with it in {LIMIT} s")
    return InputError("is damaged: HDF5 crashes over it")
