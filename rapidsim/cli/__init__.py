"""The command line: one file a family of commands; the only package that prints and exits."""

from __future__ import annotations

import os
import sys

_INTERRUPTED = 130

# Matrices are small: a thread on each core would only wait for the others, which costs a short run
# a sixth of its processor time. NumPy reads this when it is loaded; whoever has set it, decides.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def main() -> None:
    """Run the command line and end the process with its exit code.

    Ctrl-C ends it without a traceback at any time. While modules are loaded, which takes a tenth of
    a second, the process exits at once, for nothing is written yet and an exception would be raised
    within a module of another package. Commands receive an exception and clean up.
    """
    try:
        import signal

        # A shell has its background commands ignore Ctrl-C; they go on ignoring it.
        handles_interrupt = signal.getsignal(signal.SIGINT) is signal.default_int_handler
        if handles_interrupt:
            signal.signal(signal.SIGINT, lambda *_: _leave())
            sys.unraisablehook = _unraisable
        from rapidsim.cli.boundary import run_commands

        if handles_interrupt:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        code = run_commands(sys.argv[1:])
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    except KeyboardInterrupt:
        _leave()
    _end(code)


def _end(code: int) -> NoReturn:
    """Exit without freeing objects one by one; the system frees the memory of the process.

    Freeing takes a third of the time of a check of a small file, and seconds for a large one. With
    other threads, a profiler or a tracer the interpreter exits as usual.
    """
    import atexit
    import threading

    if threading.active_count() == 1 and not (sys.getprofile() or sys.gettrace()):
        atexit._run_exitfuncs()
        try:
            sys.stdout.flush()
            sys.stderr.flush()
        except (AttributeError, OSError, ValueError):
            pass  # Closed or missing streams: the interpreter handles them below.
        else:
            os._exit(code)
    sys.exit(code)


def _leave() -> NoReturn:
    os.write(2, b"interrupted\n")
    os._exit(_INTERRUPTED)


def _unraisable(unraisable: UnraisableHookArgs) -> None:
    """Exit at Ctrl-C while an object is finalised, where Python would only print a message.

    `--max-wall` raises another class, and raises it again.
    """
    if type(unraisable.exc_value) is KeyboardInterrupt:
        _leave()
    if isinstance(unraisable.exc_value, KeyboardInterrupt):
        return
    sys.__unraisablehook__(unraisable)


TYPE_CHECKING = False  # Importing typing takes longer than all the above.
if TYPE_CHECKING:
    from sys import UnraisableHookArgs
    from typing import NoReturn
