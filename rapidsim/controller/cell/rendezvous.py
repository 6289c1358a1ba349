"""Synchronization points of tasks: WaitSyncTask, SyncMoveOn and SyncMoveOff."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error


@dataclass(slots=True, eq=False)
class Rendezvous:
    """Tasks that wait at one synchronization point."""

    name: str
    """The name of the point, as the program writes it."""
    tasks: frozenset[str]
    """Folded names of the tasks that must arrive."""
    arrived: list[str] = field(default_factory=list)
    """Folded names of the tasks that have arrived, in order."""
    outcome: object = None
    """Shared result of the rendezvous, such as a team."""

    @property
    def is_complete(self) -> bool:
        """Whether all have arrived."""
        return len(self.arrived) == len(self.tasks)


@dataclass(slots=True)
class RendezvousTable:
    """The synchronization points at which tasks wait, by kind and name."""

    _open: dict[tuple[str, str], Rendezvous] = field(default_factory=dict)

    def arrive(self, instruction: str, name: str, task: str, tasks: Iterable[str]) -> Rendezvous:
        """Let a task arrive at a synchronization point.

        Args:
            instruction: Such as `WaitSyncTask`; points of different instructions are different.
            name: Of the point, as the program writes it.
            task: The task that arrives.
            tasks: The tasks that must arrive.

        Raises:
            RapidError: ERR_ARGVALERR, if others wait there with a different list of tasks.
        """
        key = (instruction, name.lower())
        wanted = frozenset(one.lower() for one in tasks)
        meeting = self._open.setdefault(key, Rendezvous(name, wanted))
        if meeting.tasks != wanted:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{instruction} {name}: {meeting.arrived[0].upper()} waits there for "
                f"{_listed(meeting.tasks)}, {task} for {_listed(wanted)}; the lists must be equal",
            )
        meeting.arrived.append(task.lower())
        if meeting.is_complete:
            del self._open[key]
        return meeting

    def leave(self, instruction: str, rendezvous: Rendezvous, task: str) -> None:
        """Let a task stop waiting."""
        rendezvous.arrived.remove(task.lower())
        if not rendezvous.arrived:
            del self._open[instruction, rendezvous.name.lower()]


def _listed(tasks: Iterable[str]) -> str:
    return ", ".join(sorted(task.upper() for task in tasks))
