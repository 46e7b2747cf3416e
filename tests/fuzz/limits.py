"""A case in a process of its own, which may hang, crash or be killed without harm to the others."""

import faulthandler
import os
import pickle
import resource
import signal
import traceback
import warnings

SECONDS = 10  # of processor time


def alone(case, *args):
    """What ``case(*args)`` returns; AssertionError where it raises, warns, crashes or takes too long."""
    ours, theirs = os.pipe()
    child = os.fork()
    if not child:
        _serve(theirs, case, args)
    os.close(theirs)
    with open(ours, "rb") as pipe:  # noqa: PTH123  # open already
        answer = pipe.read()
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    assert code != -signal.SIGXCPU, f"more than {SECONDS} s"
    assert answer, f"ended with {code}"
    result, problem = pickle.loads(answer)
    assert not problem, problem
    return result


def _serve(pipe, case, args):
    answer = None, "no answer"
    try:
        faulthandler.disable()
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
        with warnings.catch_warnings(action="error"):
            answer = case(*args), ""
    except BaseException:
        answer = None, traceback.format_exc()
    try:
        with open(pipe, "wb") as out:  # noqa: PTH123
            out.write(pickle.dumps(answer))
    finally:  # whatever happens: a copy that went on would be a second test run
        os._exit(0)
