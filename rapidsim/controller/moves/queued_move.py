"""A move on the path, with its planned and executed state."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rapidsim.controller.journal.journal import Instant
from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.line_rows import LineRow
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import ConfData, ToolData, WobjData
from rapidsim.language.moves import Move, Place
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.values import value_class

_TOO_LATE = "the next move was not known when the robot reached the zone"


@value_class(frozen=True, slots=True, eq=False)
class ResolvedMove:
    """A move with the configuration at its end."""

    move: Move
    place: Place
    conf: ConfData

    @property
    def like(self) -> Move:
        """The move."""
        return self.move


@dataclass(slots=True, eq=False)
class QueuedMove:
    """A move on the path, with its planned and executed state."""

    of: ResolvedMove | LineRow
    """The move; its row, if it was resolved together with others."""
    segment: Segment
    started: Instant
    """Instant at which the robot starts the move, in command time."""
    corner: CornerKind
    base_from_tcp: Transform
    """Pose at the programmed end, whatever the positions of tracks and positioners by then."""
    tcp_from_flange: Transform
    """Pose at the programmed end; with a stationary tool it changes along the move."""
    grip_load_kg: float = 0.0
    """Mass that the gripper holds, by GripLoad."""
    number: int = 0
    """Its number among all moves that the robot ever got."""
    level: int = 0
    """Number of stored paths when the robot got the move."""
    corner_reason: str = ""
    """Reason why the zone is not the programmed one, or why the arm stops."""
    zone_m: float = 0.0
    start_place_m: float = 0.0
    end_place_m: float = 0.0
    """Positions [m] of the start and the end of the move on the path of the whole run."""
    length_m: float = 0.0
    command_start_s: float | None = None
    """Command time of the start; set only for the first move of a block."""
    ended_s: float | None = None
    """Command time of the end, as far as it is planned."""
    was_stopped: bool = False
    """Whether StopMove or a search stopped the robot during the move."""

    @property
    def move(self) -> Move:
        """The move as programmed."""
        return self.of.move

    @property
    def place(self) -> Place:
        """Place of its statement."""
        return self.of.place

    @property
    def conf(self) -> ConfData:
        """Configuration at the programmed end."""
        return self.of.conf

    @property
    def row(self) -> LineRow | None:
        """Its row, if that describes its segment; None for other moves."""
        of = self.of
        return of if isinstance(of, LineRow) and of.segment is self.segment else None

    @property
    def joints(self) -> Array:
        """Joints (n,) [rad] at the programmed end."""
        return self.segment.end.joints

    @property
    def external(self) -> Array:
        """External axes (e,) [m or rad] at the programmed end."""
        return self.segment.end.external

    def is_over(self, before_s: float) -> bool:
        """Whether the executed part of the move ended before a time [s]."""
        times = (self.started.time, self.ended_s or self.started.time)
        return all(one is not None and one < before_s for one in times)

    def again(self) -> QueuedMove:
        """Copy of the move without its state, to be made once more."""
        return QueuedMove(
            self.of,
            self.segment,
            Instant(),
            CornerKind.STOP if self.segment.zone is None else CornerKind.FLY_BY,
            self.base_from_tcp,
            self.tcp_from_flange,
            self.grip_load_kg,
        )


def executed_move(
    index: int, task: str, queued: QueuedMove, start_s: float, end_s: float
) -> ExecutedMove:
    """The executed move, from `start_s` to `end_s` of the arm."""
    failed = queued.corner is CornerKind.STOP_CORNER_PATH_FAILURE
    return ExecutedMove(
        index=index,
        task=task,
        move=queued.move,
        place=queued.place,
        corner=queued.corner,
        zone_m=queued.zone_m,
        start_s=start_s,
        end_s=end_s,
        length_m=queued.length_m,
        base_from_tcp=queued.base_from_tcp,
        tcp_from_flange=queued.tcp_from_flange,
        joints=queued.joints,
        conf=queued.conf,
        corner_reason=_TOO_LATE if failed else queued.corner_reason,
        external=queued.external,
        grip_load_kg=queued.grip_load_kg,
        conveyor=next((one.course.name for one in queued.segment.rides if one.end == 1.0), None),
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
    """Tool and work object; if they change, the corner path is joint interpolated."""
    return queued.of.like.tool, queued.of.like.wobj


class MotionError(Exception):
    """The path cannot be travelled; the robot stops before the move that causes it."""

    def __init__(self, queued: QueuedMove, fault: PathFault) -> None:
        """Store the move and its fault."""
        super().__init__(fault.reason)
        self.queued = queued
        self.fault = fault
