"""Exit codes; scripts rely on them."""

from __future__ import annotations

from enum import IntEnum


class ExitCode(IntEnum):
    """Exit code of a command."""

    CLEAN = 0
    FINDINGS = 1
    """`check` found something, or the program of `run` stopped with an error."""
    USAGE = 2
    """A wrong option, a missing file, no input; output to a closed pipe."""
    LIMIT = 3
    """A limit ended the run before the program or the requested cycles had ended."""
    FAILED = 4
    """The run ended, and an assertion or the cycle budget does not hold."""
    DEFECT = 70
    """rapidsim itself failed."""
    INTERRUPTED = 130
    """Ctrl-C."""
    TERMINATED = 143
    """SIGTERM."""
