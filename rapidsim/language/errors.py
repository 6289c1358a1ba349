"""The error a RAPID program can catch.

`RapidError` is an error that instructions raise and ERROR clauses handle. `Stopped` is an end of
execution that the program cannot catch: EXIT, a limit of the run, a fatal error.
"""

from __future__ import annotations


class RapidError(Exception):
    """A recoverable error: sets ERRNO and is passed to the nearest ERROR clause."""

    def __init__(
        self, errno: float, message: str, *, cf: str | None = None, name: str | None = None
    ) -> None:
        """Store the number and the text of the error.

        Args:
            errno: The value of ERRNO.
            message: One line for the user: what is wrong and by how much.
            cf: The controller's event for the same error, such as "ABB 40194".
            name: The number as the program writes it, if it is not one of RAPID's names.
        """
        super().__init__(message)
        self.errno = errno
        self.message = message
        self.cf = cf
        self.name = name


class RaisedError(RapidError):
    """An error that ErrRaise raises: from an ERROR clause it is passed to the caller."""


class RaisedToUser(RapidError):  # noqa: N818 - it says where to
    """An error that leaves all routines of modules that are NOSTEPIN: RaiseToUser."""


class Stopped(BaseException):
    """End of execution without ERROR clauses: EXIT, Stop, a limit of the run."""

    def __init__(self, reason: str) -> None:
        """Store the reason, in one line for the user."""
        super().__init__(reason)
        self.reason = reason


class AllStopped(Stopped):
    """Stop of all normal tasks, as the program of one requests."""


class ProgramReset(Stopped):
    """The program pointer leaves all active routines: by EXIT, or as an operator sets it.

    This alone runs their UNDO clauses. A program that stops at a statement, for an error or for a
    wait that never ends, is still in its routines.

    Source: Technical reference manual RAPID Overview, "UNDO".
    """


class NotAllowed(Stopped):
    """Stop of the controller by an error that ERROR clauses cannot handle.

    Source: the event log messages of RobotWare 5.15; those that name no recovery.
    """

    def __init__(self, reason: str, cf: str | None = None) -> None:
        """Store the reason, in one line for the user, and the controller's event if known."""
        super().__init__(reason)
        self.cf = cf


class NotDeclared(Stopped):
    """The run reaches a name that none of its files declares; a controller may well have it."""


class NotConnected(Stopped):
    """A move needs the place of an object on a conveyor, and none is connected."""


class CycleEnded(ProgramReset):
    """ExitCycle: the cycle ends here and the next one begins with main."""
