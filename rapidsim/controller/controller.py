"""The virtual controller of one task: all that `language.controller.Controller` asks for.

Each concern has its file in `task/`; what tasks share is the `Cell`.
"""

from __future__ import annotations

from rapidsim.controller.interrupts import TaskInterrupts
from rapidsim.controller.operator import TaskOperator
from rapidsim.controller.search import TaskSearch
from rapidsim.controller.signals import TaskSignals
from rapidsim.controller.sockets import TaskSockets
from rapidsim.controller.synchronisation import TaskTeam
from rapidsim.controller.zones import TaskZones


class VirtualController(
    TaskTeam, TaskSearch, TaskZones, TaskSignals, TaskInterrupts, TaskSockets, TaskOperator
):
    """Implements `language.controller.Controller` for one task with one robot."""
