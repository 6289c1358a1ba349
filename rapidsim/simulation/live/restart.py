"""Restart of a controller, which takes no virtual time.

A warm restart keeps programs, pointers, data and the values of signals; programs stop, the motors
are off, files and connections are closed, and semistatic tasks begin again. A cold one also begins
with the initial values of data and signals, pointers at main. Static tasks continue only after a
warm one.

Source: Operating manual IRC5 with FlexPendant, "Restart"; System parameters, "Task: Type".
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.rendezvous import RendezvousTable
from rapidsim.simulation.live import event_log
from rapidsim.simulation.live.event_log import EventLog
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.panel import Panel
from rapidsim.simulation.live.states import Cycle, Motors, StopMode
from rapidsim.station.task_kind import TaskKind


class Restartable(Protocol):
    """The controller."""

    cell: Cell
    panel: Panel
    log: EventLog
    tasks: dict[str, LiveTask]
    cycle: Cycle

    @property
    def now_s(self) -> float:
        """The virtual time [s]."""
        ...

    def stop(self, how: StopMode) -> None:
        """Stop the programs."""
        ...

    def begin_tasks(self, tasks: Iterable[LiveTask], *, keeps_data: bool = True) -> None:
        """Set the pointers of tasks to main."""
        ...

    def change_signal(self, name: str, value: float) -> None:
        """Change a signal now."""
        ...


def restart(live: Restartable, *, cold: bool) -> None:
    """Restart a controller."""
    live.stop(StopMode.QUICK)
    live.panel.set_motors(Motors.OFF)
    for task in live.tasks.values():
        task.run.controller.sockets.close_all(live.now_s)
        task.run.controller.guidance.forget_all()
    live.cell.home.close_all()
    code = event_log.COLD_STARTED if cold else event_log.WARM_STARTED
    live.log.operational(code, live.now_s, "")
    if cold:
        live.panel.speed_ratio, live.cycle = 100, Cycle.FOREVER
        live.cell.rendezvous = RendezvousTable()
        live.begin_tasks(live.tasks.values(), keeps_data=False)
        live.panel.owner.apply_speed_ratio()
        for signal in live.cell.declared:
            if signal.status is None and signal.name.lower() not in live.cell.connected:
                live.change_signal(signal.name, signal.value)
    else:
        kinds = (task for task in live.tasks.values() if task.setup.kind is TaskKind.SEMISTATIC)
        live.begin_tasks(tuple(kinds))
    for task in live.tasks.values():
        if not task.is_normal and not task.executes:
            task.start()
