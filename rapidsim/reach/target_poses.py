"""Tool poses of known moves, computed together, in the robot's base."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from rapidsim.frames.moving_frames import standing
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import JointTarget, ToolData, WobjData
from rapidsim.language.moves import AXES_IN_USE, Interpolation
from rapidsim.motion.configurations import targets
from rapidsim.motion.geometry.joint_mapping import JointMapper
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.circle_modes import is_wrist_driven
from rapidsim.reach.dataflow.known_moves import KnownMove
from rapidsim.values import value_class

FRAME_WITHOUT_ORIENTATION = "the frame of the tool or the work object has no orientation"
"""Reason for skipping moves that no run can place either."""


@value_class(frozen=True, slots=True, eq=False)
class PosedMoves:
    """Known moves with their ends as poses; one row per move."""

    moves: Sequence[KnownMove]
    curve_from_tcp: Transform
    """base_from_tcp; of a move with a carrier in the frame of that, see `segments.Carrier`."""
    tcp_from_flange: Transform
    base_from_flange: Transform
    axes: Array
    """Shape (k, n) [rad]: joints of MoveAbsJ targets; 0 for moves to poses."""
    to_axes: Mask
    """Whether a move ends at joints rather than at a pose."""
    external: Array
    """Shape (k, e) [m or rad]: external axes at the end."""
    placed: Sequence[targets.Placement]
    """Poses of tool and work object of each; identities if they are not simulated."""
    carried: Mask
    """Whether external axes move the base or the work object, or the tool is stationary."""
    left_out: Mapping[int, str]
    """Reasons for skipping rows: an unsupported set-up, an invalid orientation."""


def posed(
    moves: Sequence[KnownMove],
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
    position, quaternion = np.zeros((count, 3)), np.tile([1.0, 0.0, 0.0, 0.0], (count, 1))
    axes = np.zeros((count, len(robot.joints)))
    to_axes = np.zeros(count, dtype=bool)
    values = np.zeros((count, len(external)))
    left_out: dict[int, str] = {}
    frames: dict[tuple[ToolData, WobjData], int] = {}
    placements: list[targets.Placement | targets.NotSimulatedFrame] = []
    frame = np.zeros(count, dtype=np.int64)
    for row, known in enumerate(moves):
        move = known.move
        pair = (move.tool, move.wobj)
        at = frames.setdefault(pair, len(placements))
        if at == len(placements):
            placements.append(_placement(*pair, base_from_world, external))
        frame[row] = at
        reason = _skip_reason(known, placements[at], robot)
        if external:
            values[row], unknown = _external_values(known, external)
            reason = reason or unknown
        if reason is not None:
            left_out[row] = reason
        if isinstance(move.to, JointTarget):
            if move.interpolation is not Interpolation.EXTERNAL_AXES:
                axes[row] = targets.joints(move.to, robot.kinematics)
                to_axes[row] = True
        elif reason is None:
            position[row], quaternion[row] = move.to.trans, move.to.rot
    plain = [
        targets.Placement(Transform.identity(), Transform.identity())
        if isinstance(one, targets.NotSimulatedFrame)
        else one
        for one in placements
    ]
    curve_from_object = Transform.stacked([one.curve_from_object for one in plain])[frame]
    pose = Transform.from_quaternion(quaternion, position * targets.MM)
    curve_from_tcp = curve_from_object @ pose
    tcp_from_flange = Transform.stacked([one.tcp_from_flange for one in plain])
    carriers = tuple(one.carrier for one in plain)
    arms = JointMapper(
        robot.kinematics,
        np.zeros(len(plain), dtype=np.int64),
        tcp_from_flange,
        carriers if any(carriers) else (),
    )
    wide = np.concatenate([axes, values], axis=1)
    base_from_flange = arms.base_from_flange(standing(curve_from_tcp, count), frame, wide)
    if to_axes.any():
        rows = np.flatnonzero(to_axes)
        flange = robot.forward(axes[rows])
        tcp = arms.curve_from_tcp(wide[rows], frame[rows])
        base_from_flange.rotation[rows] = flange.rotation
        base_from_flange.translation[rows] = flange.translation
        curve_from_tcp.rotation[rows] = tcp.rotation
        curve_from_tcp.translation[rows] = tcp.translation
    placed = [plain[at] for at in frame.tolist()]
    return PosedMoves(
        moves,
        curve_from_tcp,
        tcp_from_flange[frame],
        base_from_flange,
        axes,
        to_axes,
        values,
        placed,
        np.array([one is not None for one in carriers], dtype=bool)[frame],
        left_out,
    )


def _external_values(
    known_move: KnownMove, external: Sequence[ExternalAxis]
) -> tuple[Array, str | None]:
    """External axes (e,) [m or rad] at the end of a move, and why they are not known."""
    unknown = np.zeros(len(external))
    settings, uncertain = known_move.settings, known_move.uncertain
    passive = settings.inactive_units or settings.independent_axes
    if passive or not uncertain.isdisjoint(AXES_IN_USE):
        return unknown, "a mechanical unit is not active, or an axis independent; only a run tells"
    values, missing = targets.external_values(known_move.move.to.extax, external, unknown)
    if missing:
        return unknown, f"its target has no value of {missing[0].component}"
    return values, None


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
