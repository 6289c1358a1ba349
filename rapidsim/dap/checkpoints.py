"""Copies of the process to which a debugger goes back.

A copy is made by fork before a statement and waits. To go back, the running process wakes the last
copy before the wanted statement, hands over and ends; the copy leaves a copy of itself in its
place, so that it can be woken again, and runs to the statement. A run is a function of its inputs,
so it gets there as the first time.

Copies are dense near the present and sparse in the past. Without fork, as on Windows, there are
none: then the run is repeated from its start, in a new process.
"""

from __future__ import annotations

import gc
import json
import os
import select
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NoReturn

HAS_COPIES = sys.platform != "win32"

_MOST = 24
"""Copies that wait at the same time."""
_INTERVAL_S = 0.05
"""Processor time [s] between two copies; a process needs about as long to go back."""
_PATIENCE_S = 10.0
"""Time [s] for an observation in a copy."""


class ObservationError(Exception):
    """A copy could not observe; the message has the reason."""


@dataclass(frozen=True, slots=True)
class _Copy:
    """A process that waits before a statement."""

    number: int
    wake: int
    """Descriptor of the pipe by which it is woken."""


@dataclass(eq=False)
class Checkpoints:
    """The copies of one run."""

    alive: int
    """Descriptor of a pipe that closes when the debugger has ended, with all copies."""
    _copies: list[_Copy] = field(default_factory=list)
    _last_copy_s: float = -_INTERVAL_S

    def is_due(self) -> bool:
        """Whether enough has happened since the last copy."""
        return time.process_time() - self._last_copy_s > _INTERVAL_S

    def take(self, number: int) -> Any:
        """Make a copy before a statement.

        Returns:
            None in the running process; in a copy that has been woken, the message.
        """
        if not self._copies:
            # Children end by themselves, and the collector should not touch shared pages.
            signal.signal(signal.SIGCHLD, signal.SIG_IGN)
            gc.freeze()
        own, wake = os.pipe()
        if os.fork() != 0:
            os.close(own)
            self._add(_Copy(number, wake))
            self._last_copy_s = time.process_time()
            return None
        # Ctrl-C at a terminal is meant for the process that runs.
        on_interrupt = signal.signal(signal.SIGINT, signal.SIG_IGN)
        while True:
            message = self._awaited(own)
            if os.fork() == 0:
                signal.signal(signal.SIGINT, on_interrupt)
                os.close(own)
                self._add(_Copy(number, wake))
                self._last_copy_s = time.process_time()
                return message

    def before(self, number: int) -> int:
        """Number of the last copy that is not after a statement; 0 without one."""
        return max((one.number for one in self._copies if one.number <= number), default=0)

    def go_back(self, number: int, message: object) -> NoReturn:
        """Hand over to the last copy that is not after a statement, and end."""
        copy = max(
            (one for one in self._copies if one.number <= number), key=lambda one: one.number
        )
        for other in self._copies:
            if other.number > copy.number:
                _send(other.wake, None)
        _send(copy.wake, message)
        os._exit(0)

    def forget_after(self, number: int) -> None:
        """End the copies after a statement: what was to come has changed."""
        for one in [one for one in self._copies if one.number > number]:
            self._drop(one)

    def _add(self, copy: _Copy) -> None:
        self._copies.append(copy)
        if len(self._copies) > _MOST:
            # The one whose absence is felt least, as seen from the present. The first one stays.
            numbers = [one.number for one in self._copies]
            now = numbers[-1] + 1
            gaps = [
                ((after - before) / (now - before), k)
                for k, (before, after) in enumerate(
                    zip(numbers[:-2], numbers[2:], strict=True), start=1
                )
            ]
            self._drop(self._copies[min(gaps)[1]])

    def _drop(self, copy: _Copy) -> None:
        _send(copy.wake, None)
        os.close(copy.wake)
        self._copies.remove(copy)

    def _awaited(self, own: int) -> Any:
        """Wait for a message; end the process if it is told to, or the debugger has ended."""
        data = b""
        while not data.endswith(b"\n"):
            ready, _, _ = select.select([own, self.alive], [], [])
            if self.alive in ready:
                os._exit(0)
            data += os.read(own, 65536)
        message = json.loads(data)
        if message is None:
            os._exit(0)
        return message


def observed_in_copy(observe: Callable[[], object], patience_s: float = _PATIENCE_S) -> Any:
    """Return the JSON value of a function that is called in a copy of this process.

    Whatever it does to the run is forgotten with the copy.

    Args:
        observe: The function.
        patience_s: Real time [s] that it may take.

    Raises:
        ObservationError: If it raises, takes too long, or there are no copies.
    """
    if not HAS_COPIES:
        raise ObservationError("this system has no copies of processes")
    reader, writer = os.pipe()
    process = os.fork()
    if process == 0:
        sys.settrace(None)
        try:
            result: dict[str, object] = {"value": observe()}
        except BaseException as error:
            result = {"error": str(error) or type(error).__name__}
        data = json.dumps(result).encode()
        while data:
            data = data[os.write(writer, data) :]
        os._exit(0)
    os.close(writer)
    data, until_s = b"", time.monotonic() + patience_s
    try:
        while True:
            left_s = max(until_s - time.monotonic(), 0.0)
            ready, _, _ = select.select([reader], [], [], left_s)
            if not ready:
                os.kill(process, signal.SIGKILL)
                raise ObservationError("it takes too long")
            piece = os.read(reader, 65536)
            if not piece:
                break
            data += piece
    finally:
        os.close(reader)
        if signal.getsignal(signal.SIGCHLD) is not signal.SIG_IGN:
            os.waitpid(process, 0)
    if not data:
        raise ObservationError("the copy ended")
    found = json.loads(data)
    if "error" in found:
        raise ObservationError(found["error"])
    return found["value"]


def _send(wake: int, message: object) -> None:
    data = json.dumps(message).encode() + b"\n"
    try:
        while data:
            data = data[os.write(wake, data) :]
    except BrokenPipeError:
        return
