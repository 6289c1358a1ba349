"""The error a RAPID program can catch.

`RapidError` is what instructions raise and ERROR clauses handle. `Stopped` is what nothing in the
program can catch: EXIT, a limit of the run, a fatal error.
"""

from __future__ import annotations


class RapidError(Exception):
    """A recoverable error: sets ERRNO and goes to the nearest ERROR clause."""

    def __init__(
        self, errno: float, message: str, *, cf: str | None = None, name: str | None = None
    ) -> None:
        """Name the error.

        Args:
            errno: The number ERRNO takes.
            message: One line for the user: what is wrong and by how much.
            cf: The controller's event for the same thing, such as "ABB 40194".
            name: The number as the program writes it, if that is not one of RAPID's names.
        """
        super().__init__(message)
        self.errno = errno
        self.message = message
        self.cf = cf
        self.name = name


class RaisedError(RapidError):
    """An error that an instruction raises on purpose: out of an ERROR clause it goes on up."""


class RaisedToUser(RapidError):  # noqa: N818 - it says where to
    """An error that leaves all routines of modules that are NOSTEPIN: RaiseToUser."""


class Stopped(BaseException):
    """Execution ends and no ERROR clause runs: EXIT, Stop, a limit of the run."""

    def __init__(self, reason: str) -> None:
        """Say why, in one line for the user."""
        super().__init__(reason)
        self.reason = reason


class RunLimitReached(Stopped):
    """A limit of the run is reached: no clause of the program runs any more, UNDO neither."""


class NotAllowed(Stopped):
    """A controller stops here with an error that no ERROR clause is asked about.

    Source: the event log messages of RobotWare 5.15; those that name no recovery.
    """


class NotDeclared(Stopped):
    """The run reaches something that no given file declares; a controller may well have it."""


class NotSimulated(Stopped):
    """The run reaches something that is not simulated, and any substitute would be wrong."""


class CycleEnded(Stopped):
    """ExitCycle: the cycle ends here and the next one begins with main."""
