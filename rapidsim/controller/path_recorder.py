r"""The path recorder: moving back along the path that was made, and forward again.

The recorder records the moves of the path level on which it was started. Backwards each move is
made in reverse, from the position of the robot on it: a line as a line, an arc as an arc (an
interrupted arc as a line), a joint move as one to the joints of its start. Configurations are not
monitored during this.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "PathRecStart",
"PathRecMoveBwd", "PathRecMoveFwd". The point meant without \ID is our reading: backwards the place
where the recorder was started, forwards the place where the last backward motion began.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rapidsim.controller.clock import TaskClock
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.task_moves import EnqueueMove
from rapidsim.frames import quaternion
from rapidsim.language.data import FINE, JointTarget, Pos, RobTarget, SpeedData
from rapidsim.language.error_numbers import ERR_PATH, rapid_error
from rapidsim.language.errors import NotAllowed
from rapidsim.language.moves import Interpolation, Move
from rapidsim.motion.geometry.segments import Waypoint

_SAME_JOINTS = 1e-4
"""Joint distance [rad] up to which an arm counts as at the end of a move."""


@dataclass(slots=True, eq=False)
class TaskPathRecorder:
    """Implements `language.path_control.PathRecorder`."""

    clock: TaskClock
    unit: MechanicalUnit
    resolver: Resolver
    state: MotionState
    put: EnqueueMove
    _ids: dict[int, int] = field(default_factory=dict)
    """For each identifier, the number of moves that the robot had got when it was set."""
    _level: int = 0
    _last: int | None = None
    """One past the last recorded move; None while the recorder is running."""
    _queued: list[QueuedMove] = field(default_factory=list)
    """The moves to be made backwards, in recorded order."""
    _origin: Waypoint | None = None
    """Start of the last backward motion; None if the robot is there."""
    _executed: list[QueuedMove] = field(default_factory=list)
    """The moves made backward and forward, which are not recorded."""
    _departures: int = 0
    """Number of `_queued` moves along which the robot has not moved back."""

    @property
    def first(self) -> int | None:
        """Number of the first recorded move; None if nothing is recorded."""
        return min(self._ids.values(), default=None)

    def start_recording(self) -> int:
        """Record the moves from here on; returns the number of the identifier of this place."""
        self.clock.note_line()
        if not self._ids or self._last is not None:
            self._forget()
            self._level = self.unit.member.level
        number = len(self._ids) + 1
        self._ids[number] = len(self.unit.moves)
        return number

    def stop_recording(self, *, clear: bool) -> None:
        """Stop recording; with `clear`, discard the record."""
        self.clock.note_line()
        self._last = len(self.unit.moves)
        if clear:
            self._forget()

    def can_move_backward(self, identifier: int | None) -> bool:
        """Whether there is a recorded path back to a place."""
        if not self._ids or (identifier is not None and identifier not in self._ids):
            return False
        return bool(self._moves_back_to(identifier))

    def can_move_forward(self, identifier: int | None) -> bool:
        """Whether the robot has moved back, and can move forward to a place."""
        if self._origin is None:
            return False
        return identifier is None or self._place_of(identifier) > self._departures

    def move_backward(
        self, identifier: int | None, offset: Pos | None, speed: SpeedData | None
    ) -> None:
        """Move back along the recorded path to a place.

        Args:
            identifier: Of the place; None for the first.
            offset: Of the TCP from the path [mm], in the tool's frame.
            speed: None for the recorded speeds.

        Raises:
            RapidError: ERR_PATH, if no such path is recorded.
        """
        self._require_stored_path()
        way = self._moves_back_to(identifier) if self._ids else []
        if not way or (identifier is not None and identifier not in self._ids):
            raise rapid_error(ERR_PATH, "no path is recorded that leads back there")
        self.clock.bring_to_rest()
        if self._origin is None:
            self._origin = self.unit.member.standing()
            self._queued = self._started_moves()
            self._departures = len(self._queued)
        for queued in reversed(way):
            target = self._standing_at(queued, queued.segment.start, offset)
            is_last = queued is way[0]
            before = self._queued.index(queued) - 1
            zone = FINE if is_last or before < 0 else self._queued[before].move.zone
            self._make(queued, replace(queued.move, to=target, zone=zone), speed)
        self._departures = self._queued.index(way[0])

    def move_forward(
        self, identifier: int | None, offset: Pos | None, speed: SpeedData | None
    ) -> None:
        """Move forward again to a place, or to the start of the backward motion.

        Args:
            identifier: Of the place; None for the start of the backward motion.
            offset: Of the TCP from the path [mm], in the tool's frame.
            speed: None for the recorded speeds.

        Raises:
            RapidError: ERR_PATH, if the robot has not moved back.
        """
        self._require_stored_path()
        if not self.can_move_forward(identifier):
            raise rapid_error(ERR_PATH, "the robot has not gone back on a recorded path")
        self.clock.bring_to_rest()
        to = len(self._queued) if identifier is None else self._place_of(identifier)
        for number in range(self._departures, to):
            queued = self._queued[number]
            is_end = number == len(self._queued) - 1
            assert self._origin is not None
            end = self._origin if is_end else queued.segment.end
            target = self._standing_at(queued, end, offset)
            zone = FINE if number == to - 1 else queued.move.zone
            self._make(queued, replace(queued.move, to=target, zone=zone), speed)
        self._departures = to
        if to == len(self._queued):
            self._origin = None

    def _require_stored_path(self) -> None:
        self.clock.note_line()
        if not self.unit.member.level:
            raise NotAllowed("a recorded path is not travelled on the base level; StorePath first")

    def _started_moves(self) -> list[QueuedMove]:
        """The recorded moves that the robot has started."""
        first, executed = min(self._ids.values()), {one.number for one in self._executed}
        return [
            one
            for number, one in self.unit.moves.numbered(first, self._last)
            if one.level == self._level and one.started.time is not None and number not in executed
        ]

    def _moves_back_to(self, identifier: int | None) -> Sequence[QueuedMove]:
        """The moves from a place to the position of the robot, in recorded order."""
        given = self._started_moves() if self._origin is None else self._queued[: self._departures]
        first = min(self._ids.values()) if identifier is None else self._ids.get(identifier, 0)
        return [one for one in given if one.number >= first]

    def _place_of(self, identifier: int) -> int:
        """Number of moves of the backward motion that lie before a place."""
        first = self._ids.get(identifier, 0)
        return sum(one.number < first for one in self._queued)

    def _standing_at(
        self, queued: QueuedMove, waypoint: Waypoint, offset: Pos | None
    ) -> RobTarget | JointTarget:
        """Convert a waypoint of a recorded move to a target."""
        move = queued.move
        external = self.resolver.ext_joint(waypoint.external)
        if move.interpolation is Interpolation.AXES and offset is None:
            return JointTarget(self.resolver.rob_joint(waypoint.joints), external)
        target = self.resolver.target(
            waypoint.joints, waypoint.external, move.tool, move.wobj, queued.place
        )
        if offset is None:
            return target
        x, y, z = quaternion.rotate(quaternion.normalised(target.rot), offset)
        trans = target.trans
        return target._replace(trans=Pos(trans.x + x, trans.y + y, trans.z + z))

    def _make(self, of: QueuedMove, move: Move, speed: SpeedData | None) -> None:
        """Make a move along a recorded one, whatever configuration results."""
        assert self._origin is not None
        is_last = of is self._queued[-1]
        off = np.abs(of.segment.end.joints - self._origin.joints).max()
        if move.interpolation is Interpolation.CIRCLE and is_last and off > _SAME_JOINTS:
            move = replace(move, interpolation=Interpolation.LINE, circle_point=None)
        if isinstance(move.to, RobTarget) and move.interpolation is Interpolation.AXES:
            move = replace(move, interpolation=Interpolation.JOINT)
        settings = self.state.settings
        self.state.settings = replace(settings, conf_j=False, conf_l=False)
        try:
            move = replace(move, duration_s=None, concurrent=False, sync_id=None, stop=None)
            self.put(replace(move, speed=speed or move.speed), self._executed.append)
        finally:
            self.state.settings = settings

    def _forget(self) -> None:
        self._ids, self._last = {}, None
        self._queued, self._origin, self._departures = [], None, 0
