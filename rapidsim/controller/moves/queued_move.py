"""A move on the path, and what becomes of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rapidsim.controller.journal.journal import Instant
from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Transform
from rapidsim.language.data import ConfData, ToolData, WobjData
from rapidsim.language.moves import Move, Place
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.path.curve_following import PathFault

_TOO_LATE = "the next move was not known when the robot reached the zone"


@dataclass(slots=True, eq=False)
class QueuedMove:
    """A move on the path and what becomes of it."""

    move: Move
    place: Place
    segment: Segment
    conf: ConfData
    started: Instant
    """When the robot starts the move, in command time."""
    corner: CornerKind
    base_from_tcp: Transform
    """At the programmed end, wherever tracks and positioners are by then."""
    tcp_from_flange: Transform
    """At the programmed end; with a stationary tool it changes along the way."""
    grip_load_kg: float = 0.0
    """The mass that GripLoad says the gripper holds."""
    number: int = 0
    """Its number among all moves the robot was ever given."""
    level: int = 0
    """How many paths were stored when the robot was given the move."""
    corner_reason: str = ""
    """Why the zone is not the programmed one, or why the arm stops."""
    zone_m: float = 0.0
    start_place_m: float = 0.0
    end_place_m: float = 0.0
    """Where the move begins and ends on the path of the whole run."""
    length_m: float = 0.0
    command_start_s: float | None = None
    """Command time of the start, for the first move of a block only."""
    ended_s: float | None = None
    """Command time of the end, as far as it is planned."""
    was_stopped: bool = False
    """StopMove or a search stopped the robot on its way."""

    def is_over(self, before_s: float) -> bool:
        """Whether the robot was done with it before a time [s], as far as it made it."""
        times = (self.started.time, self.ended_s or self.started.time)
        return all(one is not None and one < before_s for one in times)

    def again(self) -> QueuedMove:
        """The same move to be made once more, with nothing done of it yet."""
        return QueuedMove(
            self.move,
            self.place,
            self.segment,
            self.conf,
            Instant(),
            CornerKind.STOP if self.segment.zone is None else CornerKind.FLY_BY,
            self.base_from_tcp,
            self.tcp_from_flange,
            self.grip_load_kg,
        )


def executed_move(
    index: int, task: str, queued: QueuedMove, start_s: float, end_s: float
) -> ExecutedMove:
    """The move as it was carried out, seen from `start_s` to `end_s`."""
    if queued.command_start_s is not None:
        # The arm may have stood at this place for a while.
        start_s = queued.command_start_s
    failed = queued.corner is CornerKind.STOP_CORNER_PATH_FAILURE
    return ExecutedMove(
        index=index,
        task=task,
        move=queued.move,
        place=queued.place,
        corner=queued.corner,
        zone_m=queued.zone_m,
        start_s=start_s,
        end_s=max(start_s, end_s),
        length_m=queued.length_m,
        base_from_tcp=queued.base_from_tcp,
        tcp_from_flange=queued.tcp_from_flange,
        joints=queued.segment.end.joints,
        conf=queued.conf,
        corner_reason=_TOO_LATE if failed else queued.corner_reason,
        external=queued.segment.end.external,
        grip_load_kg=queued.grip_load_kg,
    )


def nominal_s(segment: Segment) -> float:
    """Time [s] of a move at its programmed speeds, straight from start to end."""
    if segment.duration is not None:
        return segment.duration
    start, end = segment.start.base_from_tcp, segment.end.base_from_tcp
    way = float(np.linalg.norm(end.translation - start.translation))
    turn = float(np.linalg.norm(vector_from_rotation(end.rotation @ start.rotation.T)))
    return max(way / segment.speed.tcp, turn / segment.speed.reorientation)


def frames_of(queued: QueuedMove) -> tuple[ToolData, WobjData]:
    """Tool and work object; where they change, a corner is made in joint space."""
    return queued.move.tool, queued.move.wobj


class MotionError(Exception):
    """The path cannot be travelled; the robot stops before the move that is to blame."""

    def __init__(self, queued: QueuedMove, fault: PathFault) -> None:
        """Name the move and what is wrong with it."""
        super().__init__(fault.reason)
        self.queued = queued
        self.fault = fault
