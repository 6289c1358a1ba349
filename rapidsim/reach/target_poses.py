"""Tool poses of known moves, computed together, in the robot's base."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rapidsim.frames.moving_frames import standing
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import UNUSED_AXIS, ExtJoint, JointTarget, ToolData, WobjData
from rapidsim.language.moves import AXES_IN_USE, Interpolation
from rapidsim.motion.configurations import targets
from rapidsim.motion.geometry.joint_mapping import JointMapper
from rapidsim.motion.kinematics.arm import Kinematics, Mask
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.circle_modes import is_wrist_driven
from rapidsim.reach.dataflow.known_moves import KnownMove, KnownMoves
from rapidsim.repeated_rows import Index
from rapidsim.syntax.tree.bulk_statements import EXTAX, ROT, TRANS

FRAME_WITHOUT_ORIENTATION = "the frame of the tool or the work object has no orientation"
"""Reason for skipping moves that no run can place either."""
_PASSIVE = "a mechanical unit is not active, or an axis independent; only a run tells"
_NO_POSE = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
_CERTAINLY_UNIT = 0.5 * targets.REFUSED_NORM_ERROR
"""Error of the norm of a quaternion up to which it is not looked at by itself."""
_BLOCK = 1 << 16
"""Number of moves that are placed at once."""


@dataclass(frozen=True, eq=False)
class PosedMoves:
    """Known moves with their ends as poses; one row per move."""

    moves: KnownMoves
    curve_from_tcp: Transform
    """base_from_tcp; of a move with a carrier in the frame of that, see `segments.Carrier`."""
    base_from_flange: Transform
    axes: Array
    """Shape (k, n) [rad]: joints of MoveAbsJ targets; 0 for moves to poses."""
    to_axes: Mask
    """Whether a move ends at joints rather than at a pose."""
    external: Array
    """Shape (k, e) [m or rad]: external axes at the end."""
    placements: tuple[targets.Placement, ...]
    """Poses of tools and work objects; identities if they are not simulated."""
    frame: Index
    """Shape (k,): index of the placement of each move."""
    left_out: Mapping[int, str]
    """Reasons for skipping rows: an unsupported set-up, an invalid orientation."""

    @cached_property
    def carried(self) -> Mask:
        """Whether external axes move the base or the work object, or the tool is stationary."""
        return np.array([one.carrier is not None for one in self.placements], dtype=bool)[
            self.frame
        ]

    @cached_property
    def is_placed(self) -> Mask:
        """Shape (k,): the rows that are not left out."""
        placed = np.ones(len(self.moves), dtype=bool)
        placed[list(self.left_out)] = False
        return placed

    def placed(self, row: int) -> targets.Placement:
        """Return the placement of a move."""
        return self.placements[int(self.frame[row])]


def posed(
    moves: KnownMoves,
    robot: Robot,
    base_from_world: Transform,
    external: Sequence[ExternalAxis] = (),
) -> PosedMoves:
    """Compute the end poses of known moves.

    Args:
        moves: The moves.
        robot: The arm.
        base_from_world: The world frame in the robot's base.
        external: External axes; moves to targets without their values are skipped.
    """
    count = len(moves)
    frames: dict[tuple[ToolData, WobjData], int] = {}
    placements: list[targets.Placement | targets.NotSimulatedFrame] = []
    for known in moves.of_tree:
        pair = (known.move.tool, known.move.wobj)
        if frames.setdefault(pair, len(placements)) == len(placements):
            placements.append(_placement(*pair, base_from_world, external))
    frame = moves.each(lambda known: frames[known.move.tool, known.move.wobj], np.int64)
    plain = tuple(
        targets.Placement(Transform.identity(), Transform.identity())
        if isinstance(one, targets.NotSimulatedFrame)
        else one
        for one in placements
    )
    to_axes = moves.each(
        lambda known: (
            isinstance(known.move.to, JointTarget)
            and known.move.interpolation is not Interpolation.EXTERNAL_AXES
        )
    )
    axes = np.zeros((count, len(robot.joints)))
    for row in np.flatnonzero(to_axes).tolist():
        to = moves[row].move.to
        assert isinstance(to, JointTarget)
        axes[row] = targets.joints(to, robot.kinematics)
    values = np.zeros((count, len(external)))
    left_out: dict[int, str] = {}
    ends = PosedMoves(
        moves,
        Transform(np.empty((count, 3, 3)), np.empty((count, 3))),
        Transform(np.empty((count, 3, 3)), np.empty((count, 3))),
        axes,
        to_axes,
        values,
        plain,
        frame,
        left_out,
    )
    reasons = _SkipReasons(moves, robot, placements, frame, external)
    for first in range(0, count, _BLOCK):
        rows = slice(first, first + _BLOCK)
        numbers = moves.numbers(rows)
        values[rows], unknown = _external_values(numbers, external)
        skipped = reasons.of(numbers, rows, values[rows], unknown)
        left_out |= skipped
        numbers[[row - first for row in skipped], : ROT.stop] = _NO_POSE
        numbers[np.isnan(numbers[:, 0]), : ROT.stop] = _NO_POSE
        _place(ends, robot.kinematics, rows, numbers)
    return ends


def _place(ends: PosedMoves, kinematics: Kinematics, rows: slice, numbers: Array) -> None:
    """Compute the poses of a block of rows, from the numbers (m, 17) of their targets."""
    plain, frame = ends.placements, ends.frame[rows]
    curve_from_object = Transform.stacked([one.curve_from_object for one in plain])[frame]
    pose = Transform.from_quaternion(numbers[:, ROT], numbers[:, TRANS] * targets.MM)
    curve_from_tcp = curve_from_object @ pose
    carriers = tuple(one.carrier for one in plain)
    arms = JointMapper(
        kinematics,
        np.zeros(len(plain), dtype=np.int64),
        Transform.stacked([one.tcp_from_flange for one in plain]),
        carriers if any(carriers) else (),
    )
    wide = np.concatenate([ends.axes[rows], ends.external[rows]], axis=1)
    base_from_flange = arms.base_from_flange(standing(curve_from_tcp, len(frame)), frame, wide)
    to_axes = np.flatnonzero(ends.to_axes[rows])
    if len(to_axes):
        flange = kinematics.forward(wide[to_axes, : kinematics.joint_count])
        tcp = arms.curve_from_tcp(wide[to_axes], frame[to_axes])
        base_from_flange.rotation[to_axes] = flange.rotation
        base_from_flange.translation[to_axes] = flange.translation
        curve_from_tcp.rotation[to_axes] = tcp.rotation
        curve_from_tcp.translation[to_axes] = tcp.translation
    for stored, of_block in (
        (ends.curve_from_tcp, curve_from_tcp),
        (ends.base_from_flange, base_from_flange),
    ):
        stored.rotation[rows] = of_block.rotation
        stored.translation[rows] = of_block.translation


def _external_values(numbers: Array, external: Sequence[ExternalAxis]) -> tuple[Array, Index]:
    """External axes (m, e) [m or rad] of targets, and the first without a value (m,); else -1."""
    values = np.zeros((len(numbers), len(external)))
    unknown = np.full(len(numbers), -1)
    for number, axis in reversed(list(enumerate(external))):
        column = numbers[:, EXTAX.start + ExtJoint._fields.index(axis.component)]
        unknown[column >= UNUSED_AXIS] = number
        values[:, number] = column / axis.scale
    return values, unknown


class _SkipReasons:
    """Reasons to leave moves out, whose ends are then not computed."""

    def __init__(
        self,
        moves: KnownMoves,
        robot: Robot,
        placements: Sequence[targets.Placement | targets.NotSimulatedFrame],
        frame: Index,
        external: Sequence[ExternalAxis],
    ) -> None:
        """Look at what moves have in common."""
        self._moves, self._robot = moves, robot
        self._placements, self._frame, self._external = placements, frame, external
        self._may_be = moves.each(self._may_be_skipped)
        of_frame = np.array([isinstance(one, targets.NotSimulatedFrame) for one in placements])
        if len(moves):
            self._may_be |= of_frame[frame]

    def _may_be_skipped(self, known_move: KnownMove) -> bool:
        arc = known_move.move.interpolation is Interpolation.CIRCLE
        alone = known_move.move.interpolation is Interpolation.EXTERNAL_AXES
        return arc or alone or (bool(self._external) and self._is_passive(known_move))

    def of(self, numbers: Array, rows: slice, values: Array, unknown: Index) -> dict[int, str]:
        """Return the reasons of a block, by row; external axes that are not known become 0.

        Args:
            numbers: Numbers (m, 17) of the targets.
            rows: Rows of the block.
            values: External axes (m, e).
            unknown: First axis (m,) without a value; -1 if all have one.
        """
        with np.errstate(invalid="ignore"):
            off = np.abs(np.linalg.norm(numbers[:, ROT], axis=1) - 1.0) > _CERTAINLY_UNIT
        skipped: dict[int, str] = {}
        for at in np.flatnonzero(self._may_be[rows] | off | (unknown >= 0)).tolist():
            row = rows.start + at
            known = self._moves[row]
            reason = _skip_reason(known, self._placements[self._frame[row]], self._robot)
            if self._external and self._is_passive(known):
                values[at] = 0.0
                reason = reason or _PASSIVE
            elif unknown[at] >= 0:
                values[at] = 0.0
                component = self._external[unknown[at]].component
                reason = reason or f"its target has no value of {component}"
            if reason is not None:
                skipped[row] = reason
        return skipped

    def _is_passive(self, known_move: KnownMove) -> bool:
        settings = known_move.settings
        passive = settings.inactive_units or settings.independent_axes
        return bool(passive) or not known_move.uncertain.isdisjoint(AXES_IN_USE)


def _skip_reason(
    known_move: KnownMove,
    placement: targets.Placement | targets.NotSimulatedFrame,
    robot: Robot,
) -> str | None:
    """Reason to leave a move out; None if its end is computed."""
    move = known_move.move
    if not isinstance(move.to, JointTarget):
        if known_move.previous is None and is_wrist_driven(known_move, robot):
            return "two wrist axes lead it from where the arm stands, which a run tells"
        for target in (move.to, *(() if move.circle_point is None else (move.circle_point,))):
            if targets.is_no_orientation(target.rot):
                return "its orientation is not a unit quaternion"
    if move.interpolation is Interpolation.EXTERNAL_AXES:
        return "only external axes move"
    if isinstance(placement, targets.NotSimulatedFrame):
        return placement.reason
    return None


def _placement(
    tool: ToolData,
    wobj: WobjData,
    base_from_world: Transform,
    external: Sequence[ExternalAxis],
) -> targets.Placement | targets.NotSimulatedFrame:
    for frame in (tool.tframe, wobj.uframe, wobj.oframe):
        if targets.is_no_orientation(frame.rot):
            return targets.NotSimulatedFrame(FRAME_WITHOUT_ORIENTATION)
    if not wobj.ufprog and not wobj.robhold and not targets.unit_of(wobj, external):
        why = f"`{wobj.ufmec}` moves its work object; only a run can tell where"
        return targets.NotSimulatedFrame(why)
    return targets.placement(tool, wobj, base_from_world, external)
