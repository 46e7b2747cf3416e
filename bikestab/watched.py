"""A check of a file from others, in a process that can be killed: HDF5 reads some damaged files for ever.

A copy of this process costs some milliseconds, where a fresh one would load numpy and HDF5 again. It ends
after LIMIT of processor time, however slow the disk is, and may crash without harm.
"""

from __future__ import annotations

import faulthandler
import os
import pickle
import signal
import traceback
import warnings
from collections.abc import Callable
from contextlib import suppress

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
        status = _ended(child)
        answer = os.read(ours, _MOST) if os.waitstatus_to_exitcode(status) == 0 else b""
    finally:
        os.close(ours)
        if status is None:  # Ctrl-C
            with suppress(ProcessLookupError):
                os.kill(child, signal.SIGKILL)
            _ended(child)
    if not answer:
        raise _lost(-os.waitstatus_to_exitcode(status))
    error = pickle.loads(answer)
    if error:
        raise error


def _ended(child: int) -> int:
    """The status of a child that has come to its end; 0 where only that is known, as SIGCHLD is ignored."""
    try:
        return os.waitpid(child, 0)[1]
    except ChildProcessError:
        return 0


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
        _, most = resource.getrlimit(resource.RLIMIT_CPU)  # beyond which nobody may go
        most = LIMIT + 1 if most == resource.RLIM_INFINITY else min(LIMIT + 1, most)
        resource.setrlimit(resource.RLIMIT_CPU, (min(LIMIT, most), most))
        os.write(pipe, _pickled(_outcome(check)))
        code = 0
    finally:
        os._exit(code)


def _outcome(check: Callable[[], None]) -> Exception | None:
    try:
        check()
    except Exception as error:  # whatever it is, the parent raises it
        return error
    return None


def _pickled(error: Exception | None) -> bytes:
    """The error as bytes; one that cannot go through a pipe in words."""
    try:
        answer = pickle.dumps(error)
        pickle.loads(answer)
    except Exception:  # whatever pickle makes of it
        answer = b""
    if 0 < len(answer) <= _MOST:
        return answer
    words = "".join(traceback.format_exception_only(error)).strip()
    return pickle.dumps(RuntimeError(words[: _MOST // 8]))


def _lost(number: int) -> InputError:
    if number in (signal.SIGXCPU, signal.SIGKILL):
        return InputError(f"is damaged: HDF5 does not come to an end with it in {LIMIT} s")
    return InputError("is damaged: HDF5 crashes over it")
