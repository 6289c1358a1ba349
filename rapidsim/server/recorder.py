"""Recorder of a served controller, whose recording grows during the run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Final

import numpy as np

from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.files import InputError
from rapidsim.frames.transform import Array
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.recording.live_recording import LiveArm, LiveRecording
from rapidsim.server.messages import ErrorAnswer, Reply, Request
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.event_log import LogEntry
from rapidsim.simulation.live.live_task import LiveTask

_EVERY_S: Final = 0.25
"""Period [s] at which motion is written."""
_SAMPLE_S: Final = 0.024
_MOST_SAMPLES: Final = 2000
"""Largest number of samples at once: longer steps are sampled more coarsely."""
_LEVELS: Final = {1: "INFO", 2: "WARN", 3: "ERROR"}


@dataclass(eq=False)
class LiveRecorder:
    """Recorder without effect on the run; if writing fails, the recording ends, not the run."""

    live: LiveController
    recording: LiveRecording
    failed: Callable[[str], None]
    """Called with a line if recording ends early."""
    _arms: list[tuple[LiveTask, str]] = field(default_factory=list)
    _shown_s: float = 0.0
    _is_on: bool = True

    def begin(self) -> None:
        """Start with the current positions of the arms.

        Raises:
            InputError: If nothing can be written, or no viewer opens.
        """
        tasks = [one for one in self.live.tasks.values() if one.setup.robot is not None]
        self._arms = [(one, one.name if len(tasks) > 1 else "") for one in tasks]
        self.recording.begin(
            [(self._arm(one, name, np.zeros(1)), one.setup.place) for one, name in self._arms]
        )
        self.update()

    def update(self) -> None:
        """Write the motion since the last call, unless that was less than `_EVERY_S` ago."""
        now_s = self.live.now_s
        if now_s - self._shown_s >= _EVERY_S:
            self._do(self._moved)
        for task in self.live.tasks.values():
            state = "runs" if task.executes else "stands" if task.has_pointer else "failed"
            self._do(partial(self.recording.state, now_s, task.name, state))

    def on_request(self, now_s: float, request: Request, reply: Reply) -> None:
        """Record a request of a client that changes the state."""
        if request.method == "GET":
            return
        action = f"?action={request.action}" if request.action else ""
        what = " ".join(f"{key}={value}" for key, value in request.form.items())
        text = f"{request.method} {request.path}{action} {what}".rstrip()
        refused = isinstance(reply, ErrorAnswer)
        text, level = (f"{text}: {reply.status}", "WARN") if refused else (text, "DEBUG")
        self._do(lambda: self.recording.log_text(now_s, "requests", text[:500], level))

    def on_event(self, event: Event) -> None:
        """Record a text that a program has written."""
        if event.kind is EventKind.TEXT and event.message:
            self._do(lambda: self.recording.log_text(event.time_s, "texts", event.message))

    def on_log_entry(self, entry: LogEntry) -> None:
        """Record an entry of the event log."""
        text, level = f"{entry.code} {entry.title}: {entry.text}", _LEVELS[entry.type]
        self._do(lambda: self.recording.log_text(entry.time_s, "events", text, level))

    def on_sensor_answer(self, time_s: float, answer: SensorAnswer) -> None:
        """Record the goal of a sensor for the robot."""
        for name in ("joints", "position", "correction"):
            values = getattr(answer, name)
            if values:
                self._do(partial(self.recording.wanted, time_s, name, np.array(values)))

    def close(self) -> None:
        """Write the remaining motion and move the file into place."""
        self._do(self._moved)
        try:
            self.recording.close()
        except InputError as error:
            self.failed(f"error: {error}")

    def _moved(self) -> None:
        begin_s, self._shown_s = self._shown_s, self.live.now_s
        count = int((self._shown_s - begin_s) / _SAMPLE_S)
        if count > 0:
            times = np.linspace(begin_s, self._shown_s, min(count, _MOST_SAMPLES) + 1)[1:]
            for task, name in self._arms:
                self.recording.moved(self._arm(task, name, times))

    def _arm(self, task: LiveTask, name: str, times: Array) -> LiveArm:
        return LiveArm(name, task.unit.member.robot, task.unit.foreseen().at(times))

    def _do(self, write: Callable[[], None]) -> None:
        if not self._is_on:
            return
        try:
            write()
        except (RuntimeError, OSError, ValueError, InputError) as error:
            self._is_on = False
            self.failed(f"error: nothing more is recorded: {error}")
