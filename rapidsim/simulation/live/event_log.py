"""The event log of a controller that stays on.

Numbers and their meanings are those of the controller's event messages; those marked so are from
memory, and are defined here only.

Source: Operating manual Trouble shooting, "Event messages".
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Final

from rapidsim.diagnostics import Diagnostic
from rapidsim.language.error_log import ERROR, STATE, LoggedError
from rapidsim.library.arithmetic import MAX_STRING
from rapidsim.simulation.live.states import ControllerState, OperatingMode, SafetyStop
from rapidsim.values import value_class

MOST_ENTRIES: Final = 1000
"""Number of entries kept in a domain, as on a controller."""
COMMON: Final = 0
"""The domain that shows the entries of all others."""
DOMAINS: Final = (COMMON, 1, 2, 3, 4, 5, 7, 8, 9, 11, 12, 15)
_CF: Final = re.compile(r"\d+")

MOTORS_OFF, MOTORS_ON = 10010, 10011
GUARD_STOP, EMERGENCY_STOP = 10012, 10013
MANUAL, AUTOMATIC = 10015, 10017
WARM_STARTED, COLD_STARTED = 10045, 10046
OF_STATE: Final = {
    ControllerState.MOTORS_OFF: MOTORS_OFF,
    ControllerState.MOTORS_ON: MOTORS_ON,
    ControllerState.GUARD_STOP: GUARD_STOP,
    ControllerState.EMERGENCY_STOP: EMERGENCY_STOP,
}
OF_CHAIN: Final = {
    SafetyStop.EMERGENCY: LoggedError(2.0, 202.0, ERROR, "Emergency stop open"),
    SafetyStop.AUTOMATIC: LoggedError(2.0, 205.0, ERROR, "Automatic stop open"),
    SafetyStop.GENERAL: LoggedError(2.0, 206.0, ERROR, "General stop open"),
}
"""Entries about the safety chain; 20202 and 20206 are from memory."""
OF_MODE: Final = {one: AUTOMATIC if one is OperatingMode.AUTO else MANUAL for one in OperatingMode}
STARTED_FROM_MAIN, STARTED_AGAIN = 10150, 10151
STOPPED = 10125
STEPPED = 10123
EXECUTION_ERROR = 10020
_TITLES: Final = {
    MOTORS_OFF: "Motors OFF state",
    MOTORS_ON: "Motors ON state",
    GUARD_STOP: "Safety guard stop state",
    EMERGENCY_STOP: "Emergency stop state",
    WARM_STARTED: "System restarted",
    COLD_STARTED: "System cold started",
    MANUAL: "Manual mode selected",
    AUTOMATIC: "Automatic mode confirmed",
    STARTED_FROM_MAIN: "Program started",
    STARTED_AGAIN: "Program restarted",
    STOPPED: "Program stopped",
    STEPPED: "Program stopped",
    EXECUTION_ERROR: "Execution error state",
}


@value_class(frozen=True, slots=True)
class LogEntry:
    """One entry of the event log."""

    number: int
    """Ascends over all domains."""
    domain: int
    type: int
    """1 information, 2 warning, 3 error."""
    code: int
    time_s: float
    """Virtual time."""
    title: str
    text: str = ""
    arguments: tuple[str, ...] = ()
    rule: str = ""
    """Code of the rule of a finding."""
    remedy: str = ""
    """Advice on a finding."""
    file: str = ""
    line: int = 0
    """Place of a finding in a file; 0 without one."""


class EventLog:
    """The entries of all domains, the newest first."""

    def __init__(self, notify: Callable[[LogEntry], None]) -> None:
        """Create an empty log; `notify` is called with each entry."""
        self._notify = notify
        self._entries: dict[int, deque[LogEntry]] = {}
        self._last = 0

    def entries(self, domain: int) -> Iterator[LogEntry]:
        """Iterate over the entries of a domain, the newest first."""
        return reversed(self._entries.get(domain, ()))

    def clear(self, domain: int | None = None) -> None:
        """Delete the entries of a domain, or of all."""
        if domain in {None, COMMON}:
            self._entries.clear()
        else:
            self._entries.pop(domain or COMMON, None)

    def operational(self, code: int, time_s: float, text: str, *arguments: str) -> None:
        """Log an operation of the controller."""
        self._note(1, int(STATE), code, time_s, _TITLES[code], text, arguments)

    def execution_error(self, time_s: float, task: str, message: str) -> None:
        """Log that a task has stopped with an error, in one line."""
        title = _TITLES[EXECUTION_ERROR]
        text = f"The program of {task} has stopped: {message}"
        self._note(1, int(ERROR), EXECUTION_ERROR, time_s, title, text, (task,))

    def finding(self, diagnostic: Diagnostic, time_s: float, task: str) -> LoggedError:
        """Log the finding that stopped a program, under the controller's number if it has one.

        Returns:
            The error that traps receive, with texts no longer than a string of RAPID.
        """
        given = _CF.search(diagnostic.violation.cf or "")
        # Clients read this: no folder of the computer, only the name of the file.
        file = Path(diagnostic.file or "").name
        where = f" ({file}, line {diagnostic.line})" if file else ""
        rule = diagnostic.violation.rule.name.replace("-", " ")
        code = int(given[0]) if given else _WITHOUT_NUMBER
        title = rule[:1].upper() + rule[1:]
        domain, number = divmod(code, 10_000)
        text = diagnostic.message + where
        self._put(
            LogEntry(
                self._last + 1,
                domain,
                int(ERROR),
                code,
                time_s,
                title,
                text,
                rule=diagnostic.violation.code,
                remedy=diagnostic.help or "",
                file=diagnostic.file or "",
                line=diagnostic.line or 0,
            )
        )
        texts = (task, diagnostic.message[:MAX_STRING])
        return LoggedError(float(domain), float(number), ERROR, title, texts)

    def written(self, entry: LoggedError, time_s: float) -> None:
        """Log an entry that a program wrote, or an event of its motion."""
        domain, arguments = int(entry.domain), (entry.title, *entry.texts)
        code = domain * 10_000 + int(entry.number) % 10_000
        text = " ".join(entry.texts)
        self._note(domain, int(entry.type), code, time_s, entry.title, text, arguments)

    def _note(
        self,
        domain: int,
        type_: int,
        code: int,
        time_s: float,
        title: str,
        text: str,
        arguments: tuple[str, ...],
    ) -> None:
        self._put(LogEntry(self._last + 1, domain, type_, code, time_s, title, text, arguments))

    def _put(self, entry: LogEntry) -> None:
        self._last = entry.number
        domain = entry.domain
        for one in (COMMON, domain):
            self._entries.setdefault(one, deque(maxlen=MOST_ENTRIES)).append(entry)
        self._notify(entry)


_WITHOUT_NUMBER: Final = 40_000
"""Code of a program error for which rapidsim knows no number of the controller."""
