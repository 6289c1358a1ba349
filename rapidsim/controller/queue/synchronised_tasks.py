"""Tasks whose robots move as one: the move that they submit part by part, and who stopped them.

A move consists of one move of each robot; it is appended to the path when the last task has
submitted its part.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error


@dataclass(slots=True, eq=False)
class PendingMove:
    """A move that waits for the parts of other tasks."""

    sync_id: float
    parts: dict[int, QueuedMove] = field(default_factory=dict)
    """By the robot's number in the team."""
    is_complete: bool = False


@dataclass(slots=True, eq=False)
class SynchronisedTasks:
    """The tasks of a team."""

    names: tuple[str, ...]
    """In the order of their robots."""
    pending: PendingMove | None = None
    """The next move; None until a task has submitted its part."""
    waiting: dict[int, int] = field(default_factory=dict)
    """Robots whose next move depends on another's, by number, with the number of that other."""
    holders: set[int] = field(default_factory=set)
    """Numbers of the robots whose tasks have stopped the team and not restarted it."""

    def submitted(self, number: int) -> QueuedMove | None:
        """A robot's part of the next move; None until its task has submitted it."""
        return None if self.pending is None else self.pending.parts.get(number)

    def submit(self, number: int, part: QueuedMove, sync_id: float) -> PendingMove:
        r"""Submit a task's part of the next move.

        Args:
            number: Of its robot in the team.
            part: Its move.
            sync_id: The argument \ID.

        Raises:
            RapidError: ERR_ARGVALERR, if another task has submitted another number.
        """
        if self.pending is None:
            self.pending = PendingMove(sync_id)
        pending = self.pending
        if pending.sync_id != sync_id:
            other, said = next(iter(pending.parts.items()))
            raise rapid_error(
                ERR_ARGVALERR,
                f"{self.names[number]} moves with \\ID:={sync_id:g} and {self.names[other]} with "
                f"\\ID:={pending.sync_id:g} at line {said.place.span.line}; moves that are made "
                "together need one number",
            )
        pending.parts[number] = part
        return pending

    def complete(self, pending: PendingMove) -> tuple[QueuedMove, ...]:
        """The parts of a move that all tasks have submitted, with one start, corner and ramp."""
        self.pending, pending.is_complete = None, True
        parts = tuple(pending.parts[number] for number in range(len(self.names)))
        stops = any(part.corner is CornerKind.STOP for part in parts)
        # One smoothing window for all, or they would not stay synchronised.
        ramp = min(part.segment.ramp for part in parts)
        stop_ramp = min(part.segment.stop_ramp for part in parts)
        for part in parts:
            part.started = parts[0].started
            part.corner = CornerKind.STOP if stops else CornerKind.FLY_BY
            zone = None if stops else part.segment.zone
            part.segment = replace(part.segment, zone=zone, ramp=ramp, stop_ramp=stop_ramp)
        return parts

    def hold(self, number: int) -> None:
        """Note that the task of a robot has stopped the team."""
        self.holders.add(number)

    def release(self, number: int) -> bool:
        """Note that the task of a robot restarts the team; return whether none holds it any more.

        A task that has not stopped the team restarts it for all.
        """
        if number not in self.holders:
            self.holders.clear()
        self.holders.discard(number)
        return not self.holders
