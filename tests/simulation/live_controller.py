"""A controller that stays on, and tests that hold its clock."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from rapidsim.controller.cell.description import CellIo, SignalDeclaration, SignalKind, Status
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.live import symbols
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.event_log import LogEntry
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.station.task_kind import TaskEvent, TaskKind

SIGNALS = (
    SignalDeclaration("diGo", SignalKind.DI),
    SignalDeclaration("diPart", SignalKind.DI),
    SignalDeclaration("doDone", SignalKind.DO),
    SignalDeclaration("doRuns", SignalKind.DO, status=Status.CYCLE_ON),
    SignalDeclaration("doFault", SignalKind.DO, status=Status.ERROR),
    SignalDeclaration("doStands", SignalKind.DO, 1.0, status=Status.UNIT_NOT_MOVING),
    SignalDeclaration("aoFlow", SignalKind.AO, lowest=0.0, highest=10.0),
)


class Live:
    """An IRB 1600 and its programs, a task each; the first one has the robot."""

    def __init__(
        self,
        *programs: str,
        io: CellIo | None = None,
        background: str = "",
        home: Path | None = None,
        events: tuple[tuple[TaskEvent, str], ...] = (),
    ) -> None:
        robot = load_robot("irb1600")
        setups = [
            TaskSetup(
                f"T_ROB{number}", _program(text), robot if number == 1 else None, events=events
            )
            for number, text in enumerate(programs, start=1)
        ]
        if background:
            setups.append(TaskSetup("T_BACK", _program(background), kind=TaskKind.STATIC))
        self.entries: list[LogEntry] = []
        options = RunOptions(io=io or CellIo(signals=SIGNALS), home=home)
        self.controller = LiveController(tuple(setups), options, self.entries.append)

    def value(self, name: str, task: str = "T_ROB1") -> str:
        found = self.controller.task(task)
        return symbols.read(found, symbols.find(found, name))

    def write(self, name: str, value: str, task: str = "T_ROB1") -> None:
        found = self.controller.task(task)
        symbols.write(found, symbols.find(found, name), value)
        self.controller.wake_programs()

    def after(self, seconds: float) -> None:
        """Let so much time pass."""
        self.controller.advance(self.controller.now_s + seconds)

    def axis_1(self, at_s: float | None = None) -> float:
        """Where axis 1 is now, or was at a time [rad]."""
        task = self.controller.task("T_ROB1")
        now_s = self.controller.now_s
        samples = task.unit.seen(now_s, np.array([now_s if at_s is None else at_s]))
        return float(samples.joints[0, 0])

    @property
    def line(self) -> int:
        """The last statement of the first task that reported."""
        return self.controller.task("T_ROB1").place.span.line


def module(body: str, data: str = "", more: str = "") -> str:
    """A module with a main; its first line is line 4."""
    return f"MODULE Tried\n{data}\nPROC main()\n{body}\nENDPROC\n{more}\nENDMODULE\n"


def _program(text: str):  # type: ignore[no-untyped-def]
    found = load([SourceFile("tried.mod", text, "utf-8")])
    assert found.program is not None, found.diagnostics
    return found.program
