"""What the exit codes mean; scripts rely on them."""

from __future__ import annotations

from enum import IntEnum


class ExitCode(IntEnum):
    """How a command ended."""

    CLEAN = 0
    FINDINGS = 1
    """`check` found something, or the program of `run` stopped with an error."""
    USAGE = 2
    """A wrong option, a missing file, no input; output that nobody takes."""
    LIMIT = 3
    """A limit ended the run before the program, or the cycles asked for, came to their end."""
    FAILED = 4
    """The run ended, and an assertion or the cycle budget does not hold."""
    DEFECT = 70
    """rapidsim itself failed."""
    INTERRUPTED = 130
    """Ctrl-C."""
    TERMINATED = 143
    """SIGTERM."""
