"""Search for the first statement at a virtual time, in a copy of the process.

The program runs ahead of the robot: the time of a statement may be known only when later moves have
been planned. So a copy runs on without stopping, notes the moment of each statement, and reports
the first one whose time turns out to be late enough.
"""

from __future__ import annotations

import os
import select
import signal
import sys
from collections import deque
from typing import NoReturn

from rapidsim.controller.journal.journal import Moment
from rapidsim.dap.checkpoints import HAS_COPIES, ObservationError

_NONE = b"none"
_PATIENCE_S = 30.0
"""Real time [s] for the search: a program may never get there."""


class TimeSearch:
    """The search, in the copy."""

    def __init__(self, time_s: float, writer: int) -> None:
        """Begin; the number goes to a pipe."""
        self._time_s, self._writer = time_s, writer
        self._waiting: deque[tuple[int, Moment]] = deque()

    @classmethod
    def start(cls, time_s: float) -> TimeSearch | int | None:
        """Return the search in a copy, and its result in this process; None if there is none.

        Raises:
            ObservationError: If there are no copies.
        """
        if not HAS_COPIES:
            raise ObservationError("this system has no copies of processes")
        reader, writer = os.pipe()
        process = os.fork()
        if process == 0:
            os.close(reader)
            return cls(time_s, writer)
        os.close(writer)
        ready, _, _ = select.select([reader], [], [], _PATIENCE_S)
        data = os.read(reader, 100) if ready else b""
        os.close(reader)
        if not ready:
            os.kill(process, signal.SIGKILL)
            raise ObservationError("the program does not get there soon")
        return int(data) if data.isdigit() else None

    def note(self, number: int, moment: Moment) -> None:
        """Take the moment of a statement; ends the process when the search is over."""
        self._waiting.append((number, moment))
        while self._waiting and self._waiting[0][1].is_known:
            first, known = self._waiting.popleft()
            if known.time_s >= self._time_s:
                self._report(b"%d" % first)

    def end(self) -> NoReturn:
        """The run is over, and all moments are known."""
        for number, moment in self._waiting:
            if moment.is_known and moment.time_s >= self._time_s:
                self._report(b"%d" % number)
        self._report(_NONE)

    def _report(self, data: bytes) -> NoReturn:
        os.write(self._writer, data)
        sys.stdout.flush()
        os._exit(0)
