"""Commands that copies of their process continue: the first process stays for who started it.

A debugger goes back by waking a copy of its process. The shell waits for the process that it has
started, so that one lends the terminal to its successors, and ends with the exit code of the last.
"""

from __future__ import annotations

import os
import signal
from contextlib import suppress

from rapidsim.cli.exit_codes import ExitCode

_outgoing: list[int] = []
"""Descriptor for the exit code, in a successor."""


def continue_in_successor() -> int:
    """Continue the command in a child process; this process waits for it and its successors.

    Returns:
        Descriptor of a pipe that closes when the command has ended.
    """
    code_reader, code_writer = os.pipe()
    alive_reader, alive_writer = os.pipe()
    if os.fork() == 0:
        os.close(code_reader)
        os.close(alive_writer)
        _outgoing.append(code_writer)
        return alive_reader
    os.close(code_writer)
    # The process that runs decides what Ctrl-C means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with os.fdopen(code_reader) as codes:
        code = codes.readline()
        os.close(alive_writer)
        # Whoever runs still has its end to write.
        codes.read()
    os._exit(int(code or ExitCode.DEFECT))


def send_exit_code(code: int) -> None:
    """Send the exit code to the first process, if this one is a successor."""
    with suppress(OSError):
        while _outgoing:
            os.write(_outgoing[-1], b"%d\n" % code)
            # It closes with the process.
            _outgoing.pop()
