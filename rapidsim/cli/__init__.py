"""The command line: one file a family of commands; the only package that prints and exits."""

from __future__ import annotations

import os
import sys

_INTERRUPTED = 130


def main() -> None:
    """Run the command line and end the process with its exit code.

    Ctrl-C ends it without a traceback, whenever it comes. Loading takes a tenth of a second, in
    which an exception could come up in the middle of somebody else's module; nothing is written
    yet, so the process ends there and then. Commands get an exception and tidy up after themselves.
    """
    try:
        import signal

        # A command in the background of a shell is deaf to Ctrl-C, and stays so.
        hears = signal.getsignal(signal.SIGINT) is signal.default_int_handler
        if hears:
            signal.signal(signal.SIGINT, lambda *_: _leave())
            sys.unraisablehook = _unraisable
        from rapidsim.cli.boundary import run_commands

        if hears:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        code = run_commands(sys.argv[1:])
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    except KeyboardInterrupt:
        _leave()
    _end(code)


def _end(code: int) -> NoReturn:
    """End the process without taking down what the system takes back as a whole.

    Python would free object by object, which is a third of a check of a small file and seconds of a
    large one. Where others still have something to do at the end, Python ends as it does.
    """
    import atexit
    import threading

    if threading.active_count() == 1 and not (sys.getprofile() or sys.gettrace()):
        atexit._run_exitfuncs()
        try:
            sys.stdout.flush()
            sys.stderr.flush()
        except (AttributeError, OSError, ValueError):
            pass  # Streams that are closed, or were never there: below, as Python deals with them.
        else:
            os._exit(code)
    sys.exit(code)


def _leave() -> NoReturn:
    os.write(2, b"interrupted\n")
    os._exit(_INTERRUPTED)


def _unraisable(unraisable: UnraisableHookArgs) -> None:
    """Hear Ctrl-C where Python would only complain of it: while an object is taken down.

    What `--max-wall` raises is another class, and comes again.
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
