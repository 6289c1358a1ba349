"""Robots of the catalogue as records of JSON: mm, degrees, kg."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import Annotated, ClassVar

import numpy as np

from rapidsim.jobs.running.picking_cycle import PickingCycle
from rapidsim.json_records.declarations import OutputRecord, ValueForm
from rapidsim.motion.kinematics.axis_tables import dh_table_of, screws_of
from rapidsim.motion.robot.motion_constants import MotionConstants
from rapidsim.motion.robot.robot import Joint, Robot
from rapidsim.motion.workspace import ArmWorkspace
from rapidsim.report.tables.axis_tables import Matrix, matrix_in_mm, plain_numbers
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class JointRecord:
    """A joint; of one that slides, mm stand for degrees."""

    name: str
    slides: bool
    lower_deg: float
    upper_deg: float
    max_speed_deg_s: float | None
    """Null if no source gives it."""
    max_acceleration_deg_s2: float | None
    """Null unless it was measured."""


@value_class(frozen=True, slots=True)
class MotionRecord:
    """Constants of the motion model for an arm."""

    accelerations: str
    """Torques or accelerations, their basis and accuracy."""
    factor: float
    """Factor within which they are right."""
    cycle_percent: float | None
    """Percentage within which cycle times near these limits are right; null if unknown."""
    zone_share: float
    """Share of these limits that is used in a narrow zone."""
    filter_time_s: float
    """Width of the smoothing of the command."""
    fine_dwell_s: float
    """Duration of a stop point."""


@value_class(frozen=True, slots=True)
class RobotRecord:
    """An arm of the catalogue."""

    name: str
    title: str
    maker: str | None
    aliases: tuple[str, ...]
    payload_kg: float | None
    reach_mm: float | None
    axis_speeds_from: str | None
    """The arm whose axis speeds `joints` gives if no source gives those of this arm."""
    joints: tuple[JointRecord, ...]
    motion: MotionRecord
    sources: tuple[str, ...]
    checks: tuple[str, ...]
    """Comparisons of the model with published values."""
    notes: tuple[str, ...]
    not_modelled: tuple[str, ...]


@value_class(frozen=True, slots=True)
class CatalogueReport(OutputRecord):
    """The object that `rapidsim robots --format json` prints."""

    robots: tuple[RobotRecord, ...]


@value_class(frozen=True, slots=True)
class DhRow:
    """Denavit-Hartenberg parameters of a joint."""

    theta_deg: float
    d_mm: float
    a_mm: float
    alpha_deg: float
    slides: bool


@value_class(frozen=True, slots=True)
class DhRecord:
    """The Denavit-Hartenberg table of an arm."""

    form: ClassVar[str] = "standard"
    base: Matrix
    """Frame before the first row as a 4x4 matrix [mm]."""
    rows: Sequence[DhRow]
    flange: Matrix
    """Frame after the last row as a 4x4 matrix [mm]."""


@value_class(frozen=True, slots=True)
class ScrewAxis:
    """Axis of a joint with all joints at zero."""

    direction: Sequence[float]
    moment_mm: Sequence[float]
    point_mm: Sequence[float]
    """A point on the axis."""


@value_class(frozen=True, slots=True)
class ScrewRecord:
    """The axes of an arm with all joints at zero."""

    frame: ClassVar[str] = "base"
    axes: Sequence[ScrewAxis]
    flange_at_zero: Matrix
    """Pose of the flange as a 4x4 matrix [mm]."""


@value_class(frozen=True, slots=True)
class AxisTables:
    """Tables of the axes of an arm."""

    dh: DhRecord | None
    """With --table: the Denavit-Hartenberg table; null if rods couple the joints."""
    screws: ScrewRecord | None
    """With --table: the axes of the joints; null if rods couple the joints."""


@value_class(frozen=True, slots=True)
class WorkspaceRecord:
    """The volume that an arm reaches."""

    of: ClassVar[str] = "flange"
    volume_m3: float
    wrist_centre_m3: float | None
    """Volume that the wrist centre reaches; null for arms without a spherical wrist."""
    known_wrist_centre_m3: float | None
    """A figure for that from elsewhere; null if there is none."""
    from_axis_1_mm: tuple[float, ...]
    """Least and greatest distance."""
    height_mm: tuple[float, ...]
    """Least and greatest height."""
    around_deg: float
    """Angle about axis 1."""
    cell_mm: float
    """Size of the cells in which postures are counted."""


@value_class(frozen=True, slots=True)
class RequestedWorkspace:
    """The workspace of an arm, if requested."""

    workspace: WorkspaceRecord | None
    """With --workspace; null if it could not be computed."""


@value_class(frozen=True, slots=True)
class CycleRecord:
    """The picking cycle: 25 mm up, 300 mm across, 25 mm down, and back."""

    load_kg: float
    position_mm: tuple[float, ...]
    """Distance from axis 1 and height of its low points."""
    fly_by_s: float
    """Time with z10 at the low points."""
    stop_s: float
    """Time with `fine` at the low points."""
    reference_s: float | None
    """A figure to compare with; null if there is none."""
    source: str | None
    """Source of that figure; null if it has none."""


@value_class(frozen=True, slots=True)
class RequestedCycle:
    """The picking cycle of an arm, if requested."""

    cycle: CycleRecord
    """With --cycle."""


@value_class(frozen=True, slots=True)
class RobotPageRecord:
    """The object that `rapidsim robots NAME --format json` prints."""

    robot: Annotated[RobotRecord, ValueForm.INLINE]
    tables: Annotated[AxisTables | None, ValueForm.INLINE]
    requested: Annotated[RequestedWorkspace | None, ValueForm.INLINE]
    cycle: Annotated[RequestedCycle | None, ValueForm.INLINE]


def robot_page_record(
    robot: Robot,
    aliases: tuple[str, ...],
    tables: AxisTables | None,
    workspace: ArmWorkspace | str | None,
    of_wrist: ArmWorkspace | str | None,
    cycle: PickingCycle | None,
) -> RobotPageRecord:
    """The record of one arm, with its tables, its workspace and its cycle if requested."""
    requested = None if workspace is None else RequestedWorkspace(_workspace(workspace, of_wrist))
    cycled = None if cycle is None else RequestedCycle(_cycle(robot, cycle))
    return RobotPageRecord(robot_record(robot, aliases), tables, requested, cycled)


def robot_record(robot: Robot, aliases: tuple[str, ...]) -> RobotRecord:
    """The record of an arm."""
    return RobotRecord(
        name=robot.name,
        title=robot.title,
        maker=robot.maker,
        aliases=aliases,
        payload_kg=robot.payload_kg,
        reach_mm=None if robot.reach_m is None else robot.reach_m * 1000.0,
        axis_speeds_from=robot.axis_speeds_from,
        joints=tuple(map(_joint, robot.joints)),
        motion=_motion(robot.constants),
        sources=tuple(robot.sources),
        checks=tuple(robot.checks),
        notes=tuple(robot.notes),
        not_modelled=tuple(robot.not_modelled),
    )


def axis_tables(robot: Robot) -> AxisTables:
    """The DH table and the screws of an arm; null where rods couple its joints."""
    dh, screws = dh_table_of(robot.kinematics), screws_of(robot.kinematics)
    if dh is None or screws is None:
        return AxisTables(None, None)
    parameters = np.column_stack([dh.theta, dh.d, dh.a, dh.alpha]).tolist()
    rows = [
        DhRow(degrees(theta), 1000.0 * d, 1000.0 * a, degrees(alpha), slides)
        for (theta, d, a, alpha), slides in zip(parameters, dh.slides.tolist(), strict=True)
    ]
    lines = (
        plain_numbers(screws.turns),
        plain_numbers(screws.moments_mm),
        plain_numbers(1000.0 * screws.points),
    )
    axes = [ScrewAxis(*line) for line in zip(*lines, strict=True)]
    return AxisTables(
        DhRecord(
            plain_numbers(matrix_in_mm(dh.base)), rows, plain_numbers(matrix_in_mm(dh.flange))
        ),
        ScrewRecord(axes, plain_numbers(matrix_in_mm(screws.base_from_flange))),
    )


def _cycle(robot: Robot, cycle: PickingCycle) -> CycleRecord:
    known = robot.picking
    return CycleRecord(
        load_kg=cycle.load_kg,
        position_mm=cycle.position_mm,
        fly_by_s=cycle.fly_by_s,
        stop_s=cycle.stop_s,
        reference_s=None if known is None else known.time_s,
        source=None if known is None else known.source,
    )


def _motion(constants: MotionConstants) -> MotionRecord:
    return MotionRecord(
        accelerations=constants.limits_text,
        factor=constants.factor,
        cycle_percent=constants.cycle_percent,
        zone_share=constants.zone_share,
        filter_time_s=constants.filter_time,
        fine_dwell_s=constants.fine_dwell,
    )


def _joint(joint: Joint) -> JointRecord:
    return JointRecord(
        name=joint.name,
        slides=joint.slides,
        lower_deg=degrees(joint.lower),
        upper_deg=degrees(joint.upper),
        max_speed_deg_s=_in_degrees(joint.max_speed),
        max_acceleration_deg_s2=_in_degrees(joint.max_acceleration),
    )


def _workspace(
    workspace: ArmWorkspace | str, of_wrist: ArmWorkspace | str | None
) -> WorkspaceRecord | None:
    if isinstance(workspace, str):
        return None
    near, far, low, high = (1000.0 * value for value in workspace.extent)
    known = workspace.robot.wrist_centre_volume
    return WorkspaceRecord(
        volume_m3=workspace.volume,
        wrist_centre_m3=of_wrist.volume if isinstance(of_wrist, ArmWorkspace) else None,
        known_wrist_centre_m3=known.volume_m3 if known else None,
        from_axis_1_mm=(near, far),
        height_mm=(low, high),
        around_deg=degrees(workspace.swept),
        cell_mm=1000.0 * workspace.cell,
    )


def _in_degrees(value: float | None) -> float | None:
    return None if value is None else degrees(value)
