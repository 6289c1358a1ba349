"""The virtual controller of one task: all that `language.controller.Controller` asks for.

Each concern has its file in `task/`; what tasks share is the `Cell`.
"""

from __future__ import annotations

from rapidsim.simulation.task.interrupts import TaskInterrupts
from rapidsim.simulation.task.operator import TaskOperator
from rapidsim.simulation.task.search import TaskSearch
from rapidsim.simulation.task.signals import TaskSignals
from rapidsim.simulation.task.sockets import TaskSockets
from rapidsim.simulation.task.team import TaskTeam
from rapidsim.simulation.task.zones import TaskZones


class VirtualController(
    TaskTeam, TaskSearch, TaskZones, TaskSignals, TaskInterrupts, TaskSockets, TaskOperator
):
    """Implements `language.controller.Controller` for one task with one robot."""
