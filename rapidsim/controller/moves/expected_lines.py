"""Lines to targets that are known before their statements execute, resolved as rows of arrays.

A generated program announces the targets of thousands of moves that differ in nothing else. Their
ends are computed together, from the position of the arm on. A move takes its row only if it is the
announced one, with the parameters of the move before it, from the waypoint at which the row starts.
Rows end before the first move of which more has to be decided: one that turns a joint far, passes a
limit or a branch, or differs from its stored configuration. That one is resolved by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields
from functools import partial
from operator import attrgetter

import numpy as np

from rapidsim.controller.journal.journal import Instant
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.line_rows import LineRow, LineRows
from rapidsim.controller.moves.move_data import wrist_asked_in_joints
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.frames.quaternion import norm
from rapidsim.frames.transform import Transform, matrix_from_quaternion
from rapidsim.language.data import NO_EXTERNAL_AXES, RobTarget
from rapidsim.language.moves import (
    AnnouncedTargets,
    Interpolation,
    MotionSettings,
    Move,
    SensorInfluence,
)
from rapidsim.motion.configurations.confdata import confdata_of, has_branches
from rapidsim.motion.configurations.short_lines import SHORT_TURN
from rapidsim.motion.configurations.targets import MM, TOLERATED_NORM_ERROR, Placement
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.robot.robot import Robot
from rapidsim.repeated_rows import shared_row

_FIRST_ROWS = 64
_MOST_ROWS = 1000
_FEWEST_ROWS = 8
"""Fewer rows are not worth their arrays."""
_MOST_FAILURES = 16
"""Number of times that there are fewer, after which the other targets are resolved one by one."""
_NAME = attrgetter("name")
_parameters_of = attrgetter(*(name for name in map(_NAME, fields(Move)) if name != "to"))
_SHARED = tuple(name for name in map(_NAME, fields(Segment)) if name not in ("start", "end"))


class ExpectedLines:
    """The announced targets of a task, and the rows of those that come next."""

    def __init__(self, robot: Robot) -> None:
        """Expect nothing."""
        self._robot = robot
        self._targets: AnnouncedTargets
        self._count = 0
        """Number of announced targets."""
        self._next = 0
        """Number of the first target that has not been moved to."""
        self._known: tuple[object, ...] = ()
        """Parameters of the last announced move that was resolved by itself, and its settings."""
        self._segment_of: Callable[..., Segment] = Segment
        """Makes the segment of such a move from its ends."""
        self._branch: int | None = None
        """Branch of the arm in such a move; None before the first."""
        self._rows: LineRows | None = None
        self._first = 0
        """Number of the target of the first row."""
        self._from: Waypoint | None = None
        """Start of the next row."""
        self._most = _FIRST_ROWS
        self._failures = 0
        self.remarks = -1
        """Number of remarks of the task after the last move."""

    def expect(self, targets: AnnouncedTargets) -> None:
        """Announce the targets of the next moves."""
        self._targets, self._count = targets, len(targets)
        self._next = self._failures = 0
        self._rows, self.remarks = None, -1

    def take(
        self,
        move: Move,
        start: Waypoint,
        settings: MotionSettings,
        placed_of: Callable[[Move], Placement],
    ) -> QueuedMove | None:
        """Return an announced move, resolved; None if it has to be resolved by itself."""
        while self._next < self._count and self._targets[self._next] is not move.to:
            self._next += 1
        if self._next == self._count:
            return None
        if (*_parameters_of(move), settings) != self._known:
            return None
        at = self._next - self._first
        if self._rows is None or at >= len(self._rows) or self._from is not start:
            self._rows = self._rows_from(move, start, settings, placed_of(move))
            self._first, at = self._next, 0
            if self._rows is None:
                self._failures += 1
                if self._failures == _MOST_FAILURES:
                    self._next = self._count
                return None
        return self._queued(self._rows, at, 1)[0]

    def more(self, last: QueuedMove, most: int) -> Sequence[QueuedMove]:
        """Return announced moves after the last one, resolved: those of its rows, at most so many.

        They have its parameters and settings.
        """
        rows, row = self._rows, last.row
        at = self._next - self._first
        if rows is None or row is None or row.rows is not rows or row.at != at - 1:
            return ()
        return self._queued(rows, at, max(0, min(most, len(rows) - at)))

    def learn(self, move: Move, settings: MotionSettings, segment: Segment) -> None:
        """Note an announced move that was resolved by itself, with its segment."""
        if self._next < self._count and self._targets[self._next] is move.to:
            self._next += 1
            self._known = (*_parameters_of(move), settings)
            shared = {name: getattr(segment, name) for name in _SHARED}
            self._segment_of, self._branch = partial(Segment, **shared), segment.branch
            self._rows = None

    def _queued(self, rows: LineRows, at: int, count: int) -> Sequence[QueuedMove]:
        """Return the moves of some rows, the next ones."""
        start = self._from if at and self._from is not None else rows.start
        queued = []
        for row in range(at, at + count):
            end = rows.end(row)
            segment = rows.segment_of(start=start, end=end)
            queued.append(
                QueuedMove(
                    LineRow(rows, row, segment),
                    segment,
                    Instant(),
                    CornerKind.STOP if segment.zone is None else CornerKind.FLY_BY,
                    end.base_from_tcp,
                    segment.tcp_from_flange,
                    rows.grip_load_kg,
                )
            )
            start = end
        self._from = start
        self._next += count
        return queued

    def _rows_from(
        self, move: Move, start: Waypoint, settings: MotionSettings, placed: Placement
    ) -> LineRows | None:
        """Return the next rows; None if there are too few, or these are no plain lines."""
        kinematics = self._robot.kinematics
        branch = int(kinematics.branch_of(start.joints))
        if (
            move.interpolation is not Interpolation.LINE
            or move.sensed is not SensorInfluence.NEVER
            or wrist_asked_in_joints(move, settings)
            or placed.carrier is not None
            or self._robot.external
            or branch != self._branch
        ):
            return None
        until = min(self._next + self._most, self._count)
        targets = [self._targets[number] for number in range(self._next, until)]
        ends = _poses(targets, placed)
        joints = kinematics.inverse_on_branch(ends @ placed.tcp_from_flange, branch, start.joints)
        before = np.concatenate([start.joints[None], joints.joints[:-1]])
        confdata = confdata_of(kinematics, joints.joints)
        plain = joints.exists & (np.abs(joints.joints - before) <= SHORT_TURN).all(axis=1)
        plain &= (self._robot.lower <= joints.joints).all(axis=1)
        plain &= (joints.joints <= self._robot.upper).all(axis=1)
        plain &= confdata[:, 3] == branch
        plain &= [one.extax == NO_EXTERNAL_AXES for one in targets]
        plain &= [abs(norm(one.rot) - 1.0) <= TOLERATED_NORM_ERROR for one in targets]
        if settings.conf_l and has_branches(kinematics):
            plain &= (confdata == [one.robconf for one in targets]).all(axis=1)
        count = len(targets) if plain.all() else int(plain.argmin())
        if count < min(_FEWEST_ROWS, self._count - self._next):
            self._most = _FIRST_ROWS
            return None
        self._most = min(2 * count, _MOST_ROWS)
        begin = placed.standing_at(kinematics, start.joints, start.external)
        first = Waypoint(start.joints, begin, start.external)
        return LineRows(
            joints.joints[:count].copy(),
            Transform(shared_row(ends.rotation[:count].copy()), ends.translation[:count].copy()),
            first,
            confdata[:count].astype(np.int16),
            move,
            self._segment_of,
            settings.grip_load_kg,
            self._targets,
            self._next,
        )


def _poses(targets: Sequence[RobTarget], placed: Placement) -> Transform:
    """Return the TCP poses (k,) of targets on a curve."""
    rotation = matrix_from_quaternion(np.array([target.rot for target in targets]))
    translation = MM * np.array([target.trans for target in targets])
    return placed.curve_from_object @ Transform(rotation, translation)
