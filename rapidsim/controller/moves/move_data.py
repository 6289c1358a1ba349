"""Motion data of a move in SI units, without its target: speeds, zone, accelerations, modes."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rapidsim.language.moves import (
    LEAST_RAMP_PERCENT,
    CirclePathMode,
    Interpolation,
    MotionSettings,
    Move,
    SingularArea,
)
from rapidsim.motion.configurations.targets import MM
from rapidsim.motion.geometry.segments import (
    WRIST_PAIRS,
    Carrier,
    CircleMode,
    Geometry,
    Speed,
    Zone,
)
from rapidsim.motion.geometry.wrist_pair import wrist_meets
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import Robot

GEOMETRY = {
    Interpolation.JOINT: Geometry.JOINT,
    Interpolation.AXES: Geometry.JOINT,
    Interpolation.EXTERNAL_AXES: Geometry.JOINT,
    Interpolation.LINE: Geometry.LINE,
    Interpolation.CIRCLE: Geometry.ARC,
}
CIRCLE_MODES = {
    CirclePathMode.PATH_FRAME: CircleMode.PATH_FRAME,
    CirclePathMode.OBJECT_FRAME: CircleMode.OBJECT_FRAME,
    CirclePathMode.CIR_POINT_ORI: CircleMode.CIRCLE_POINT,
    CirclePathMode.WRIST45: CircleMode.WRIST_45,
    CirclePathMode.WRIST46: CircleMode.WRIST_46,
    CirclePathMode.WRIST56: CircleMode.WRIST_56,
}

_SLOWEST_M_S = 1e-5
_SLOWEST_RAD_S = 1e-4
"""Used for a programmed speed of 0, which never arrives: the run's time limit ends it."""
_UNHURRIED_M_S = 1.0
"""TCP speed, too high to limit anything, of moves whose TCP does not move on the robot."""


def speed_of(move: Move, settings: MotionSettings) -> Speed:
    """Programmed speeds of TCP and tool with VelSet applied."""
    share = settings.speed_share
    if move.interpolation is Interpolation.EXTERNAL_AXES:
        return Speed(_UNHURRIED_M_S, math.inf)
    tcp_mm_s = move.speed.v_tcp * share
    if settings.max_speed_mm_s is not None:
        tcp_mm_s = min(tcp_mm_s, settings.max_speed_mm_s)
    return Speed(
        tcp=max(tcp_mm_s * MM, _SLOWEST_M_S),
        reorientation=max(math.radians(move.speed.v_ori * share), _SLOWEST_RAD_S),
    )


def acceleration_share_of(
    move: Move, settings: MotionSettings, rated_kg: float | None, with_rated: float | None
) -> tuple[float, float]:
    """Share of the axis accelerations with AccSet and the load in the hand, and that load.

    Args:
        move: The move; its tool adds to the load.
        settings: AccSet and GripLoad.
        rated_kg: Payload of the arm [kg]; None if no source is known: loads then have no effect.
        with_rated: The share available with the rated payload, the minimum for greater loads. None
            if the load adds to the inertia of the arm.

    Returns:
        The share, and the load to be added to the inertia, in shares of the rated payload.
    """
    share = settings.acceleration_percent / 100.0
    if rated_kg is None:
        return share, 0.0
    load = max(0.0, move.tool.tload.mass + settings.grip_load_kg) / rated_kg
    if with_rated is None:
        return share, load
    return share * (1.0 - (1.0 - with_rated) * min(1.0, load)), 0.0


def stop_ramp_of(settings: MotionSettings) -> float:
    r"""Rate at which braking rises at stop points, as a share of the arm's maximum.

    It is AccSet's Ramp times its \FinePointRamp, and no less than the minimum of either.
    """
    both = settings.ramp_percent * settings.fine_ramp_percent / 100.0
    return max(both, LEAST_RAMP_PERCENT) / 100.0


def asked_circle_mode(move: Move, settings: MotionSettings) -> CircleMode:
    """Orientation mode of the tool on an arc by CirPathMode; the default for other moves."""
    on_arc = move.interpolation is Interpolation.CIRCLE
    return CIRCLE_MODES[settings.circle_path] if on_arc else CircleMode.PATH_FRAME


def wrist_circle_problem(move: Move, carrier: Carrier | None, robot: Robot) -> str | None:
    """Reason why no two wrist axes can guide a tool along arcs; None if they can."""
    if not wrist_meets(robot.kinematics, robot.start):
        return "this arm has no six axes of which 4, 5 and 6 meet in one point"
    if not move.tool.robhold:
        return "the tool is stationary"
    return None if carrier is None else "external axes move robot or work object"


def circle_mode_of(
    move: Move, settings: MotionSettings, carrier: Carrier | None, robot: Robot
) -> CircleMode:
    """Orientation mode on an arc: as programmed, or the default if the wrist cannot do it."""
    mode = asked_circle_mode(move, settings)
    if mode not in WRIST_PAIRS or wrist_circle_problem(move, carrier, robot) is None:
        return mode
    return CircleMode.PATH_FRAME


def wrist_asked_in_joints(move: Move, settings: MotionSettings) -> bool:
    """Whether SingArea makes the wrist turn in joint space."""
    asked = settings.singular_area is not SingularArea.OFF
    return asked and GEOMETRY[move.interpolation] is not Geometry.JOINT


def can_turn_wrist_in_joints(move: Move, robot: Robot) -> bool:
    """Whether an arm's wrist can turn in joint space while the other axes move the tool."""
    return move.tool.robhold and len(robot.joints) <= 6


def external_speeds_of(
    move: Move, settings: MotionSettings, axes: Sequence[ExternalAxis]
) -> tuple[float, ...]:
    """Speed of each external axis [m/s or rad/s] with VelSet, limited to its maximum.

    A speed of 0 for a kind of axis is ignored: data such as vlin100 have it for the other kind.
    """
    share = settings.speed_share
    return tuple(
        min((move.speed.v_leax if axis.linear else move.speed.v_reax) * share / axis.scale, top)
        or top
        for axis in axes
        for top in (axis.max_speed,)
    )


def zone_of(move: Move) -> Zone | None:
    """The zone of a fly-by point, of size 0 if the data are negative; None at a stop point."""
    zone = move.zone
    if zone.finep:
        return None
    position = max(0.0, zone.pzone_tcp)
    return Zone(
        position=position * MM,
        orientation=max(zone.pzone_ori, position) * MM,
        angle=math.radians(max(0.0, zone.zone_ori)),
        linear_axes=max(0.0, zone.zone_leax) * MM,
        rotating_axes=math.radians(max(0.0, zone.zone_reax)),
    )


def unbounded(limit_m_s2: float | None) -> float:
    """An acceleration limit [m/s2]; infinite if it is None."""
    return math.inf if limit_m_s2 is None else limit_m_s2
