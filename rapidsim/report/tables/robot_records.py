"""Robots of the catalogue as records of JSON: mm, degrees, kg."""

from __future__ import annotations

from math import degrees
from typing import Annotated, ClassVar

from rapidsim.json_records.declarations import OutputRecord, ValueForm
from rapidsim.motion.robot.robot import Joint, Robot
from rapidsim.motion.waypoints.workspace import ArmWorkspace
from rapidsim.report.tables.kin_json import AxisTables
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
class WorkspaceRecord:
    """The volume that an arm reaches."""

    of: ClassVar[str] = "flange"
    volume_m3: float
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
class RobotPageRecord:
    """The object that `rapidsim robots NAME --format json` prints."""

    robot: Annotated[RobotRecord, ValueForm.INLINE]
    tables: Annotated[AxisTables | None, ValueForm.INLINE]
    requested: Annotated[RequestedWorkspace | None, ValueForm.INLINE]


def robot_page_record(
    robot: Robot,
    aliases: tuple[str, ...],
    tables: AxisTables | None,
    workspace: ArmWorkspace | str | None,
) -> RobotPageRecord:
    """The record of one arm, with its tables and its workspace if requested."""
    requested = None if workspace is None else RequestedWorkspace(_workspace(workspace))
    return RobotPageRecord(robot_record(robot, aliases), tables, requested)


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
        sources=tuple(robot.sources),
        checks=tuple(robot.checks),
        notes=tuple(robot.notes),
        not_modelled=tuple(robot.not_modelled),
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


def _workspace(workspace: ArmWorkspace | str) -> WorkspaceRecord | None:
    if isinstance(workspace, str):
        return None
    near, far, low, high = (1000.0 * value for value in workspace.extent)
    return WorkspaceRecord(
        volume_m3=workspace.volume,
        from_axis_1_mm=(near, far),
        height_mm=(low, high),
        around_deg=degrees(workspace.swept),
        cell_mm=1000.0 * workspace.cell,
    )


def _in_degrees(value: float | None) -> float | None:
    return None if value is None else degrees(value)
