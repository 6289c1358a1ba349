"""Conversion from RAPID's frames to the arm's: the only module that converts mm to m.

Below this module everything is in SI units; above it in RAPID's mm and degrees. The chains are

    base_from_world @ world_from_user @ user_from_object @ object_from_tcp @ tcp_from_flange
    base_from_world @ world_from_tcp @ tcp_from_object @ object_from_user @ user_from_flange

for a tool held by the robot, and for a stationary tool with the work object held by the robot. A
track moves the base in the world; a positioner moves the user frame. If another robot holds
the work object, its flange (tool0) is the user frame.

Source: Technical reference manual RAPID Overview, "Coordinate systems"; data types tooldata and
    wobjdata: with `ufprog` FALSE the system defines the user frame. Application manual MultiMove,
    "Coordinated work objects". That the user frame of a robot is its flange is what programs for
    such robots rely on, which put the tool of that robot into `oframe`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from rapidsim.frames import rigid
from rapidsim.frames.moving_frames import ExternalCourse, Screw, carried, standing
from rapidsim.frames.quaternion import norm
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    UNUSED_AXIS,
    ExtJoint,
    JointTarget,
    Orient,
    Pos,
    Pose,
    RobJoint,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.single_precision import single
from rapidsim.motion.configurations import scalar_inverse
from rapidsim.motion.geometry.joint_mapping import JointMapper
from rapidsim.motion.geometry.segments import Carrier, CarrierRobot, Waypoint
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.motion.robot.external_axes import ExternalAxis, screws_of
from rapidsim.motion.robot.robot import Robot
from rapidsim.repeated_rows import Index
from rapidsim.values import value_class

MM = 1e-3
"""Metres per millimetre."""

TOLERATED_NORM_ERROR = 1e-4
"""Deviation of a norm that is rounding: quaternions are written with six or seven digits."""
REFUSED_NORM_ERROR = 1e-2
"""Deviation of a norm beyond which a quaternion cannot be meant as an orientation."""


_ROW = np.zeros(1, dtype=np.int64)


@value_class(frozen=True, slots=True)
class NotSimulatedFrame:
    """An unsupported frame set-up, with the reason."""

    reason: str


@value_class(frozen=True, slots=True, eq=False)
class CarrierMotion:
    """A robot that holds the work object of another, with its joints for one move of the team."""

    leader: CarrierRobot
    start: Array
    """Joints and external axes (l,) [rad, m] of that robot at the start of the move."""
    end: Array


@value_class(frozen=True, slots=True, eq=False)
class BeltMotion:
    """A belt that carries a work object, by the position of an axis that stands for it."""

    world_from_user: Transform
    """User frame of the work object with that axis at zero."""
    direction: Array
    """Shape (3,): direction of the belt in the world, unit length."""
    start: float
    """Position [m] of the axis at the start of the move."""
    end: float


def carrier_motion(
    number: int,
    robot: Robot,
    base_from_world: Transform,
    world_from_leader: Transform,
    endpoints: tuple[Waypoint, Waypoint],
    own_external: int,
) -> CarrierMotion:
    """Return the motion of the carrier of a robot's work object.

    Args:
        number: Index of the carrier in the team.
        robot: The carrier.
        base_from_world: Base of the robot whose work object is carried, with all external axes
            at zero.
        world_from_leader: Base of the carrier, with all external axes at zero.
        endpoints: Start and end of the carrier's move.
        own_external: Number of external axes of the robot whose work object is carried.
    """
    frame = (base_from_world.rotation, base_from_world.translation)
    on_track = [i for i, axis in enumerate(robot.external) if axis.carries == "robot"]
    count = robot.kinematics.joint_count
    screws = (
        replace(screw, axis=count + screw.axis)
        for screw in screws_of(robot.external, on_track, frame)
    )
    base_from_leader = base_from_world @ world_from_leader
    leader = CarrierRobot(number, robot.kinematics, base_from_leader, tuple(screws), own_external)
    start, end = (np.concatenate([at.joints, at.external]) for at in endpoints)
    return CarrierMotion(leader, start, end)


@value_class(frozen=True, eq=False)
class Placement:
    """Placement of targets by a tool and a work object, with all external axes at zero."""

    curve_from_object: Transform
    """base_from_object; for a stationary tool the identity, as curves are then in the object."""
    tcp_from_flange: Transform
    """tcp_from_flange; object_from_flange for a stationary tool."""
    carrier: Carrier | None = None
    """None for the plain set-up: tool on the robot, base and work object stationary."""
    carrier_axes: tuple[Array, Array] | None = None
    """Axes (l,) [rad, m] of the robot or belt that carries the work object along, at the start and
    at the end of the move; None if none does."""

    @cached_property
    def _curve_from_object(self) -> rigid.Rigid:
        return rigid.from_transform(self.curve_from_object)

    def curve_from_tcp(self, target: RobTarget) -> Transform:
        """Return a target's TCP pose on a curve; its quaternion may have any norm but 0."""
        x, y, z = target.trans
        object_from_tcp = rigid.from_quaternion(target.rot, (x * MM, y * MM, z * MM))
        return rigid.to_transform(rigid.composed(self._curve_from_object, object_from_tcp))

    def base_from_flange(
        self, kinematics: Kinematics, curve_from_tcp: Transform, external: Array
    ) -> Transform:
        """Return the flange pose for a TCP pose, with external axes (e,) [m or rad]."""
        if self.carrier is None:
            return curve_from_tcp @ self.tcp_from_flange
        wide = self._wide(np.zeros(kinematics.joint_count), external)
        motion = standing(curve_from_tcp, 1)
        return self._arms(kinematics).base_from_flange(motion, _ROW, wide)[0]

    def standing_at(
        self, kinematics: Kinematics, joints: Array, external: Array, *, at_start: bool = False
    ) -> Transform:
        """Return curve_from_tcp for joints (n,) [rad] and external axes (e,) [m or rad].

        If another robot or a belt carries the work object along: for the end of the move, or for
        its start.
        """
        if self.carrier is None:
            return scalar_inverse.base_from_tcp(kinematics, joints, self.tcp_from_flange)
        wide = self._wide(joints, external, at_start=at_start)
        return self._arms(kinematics).curve_from_tcp(wide, _ROW)[0]

    def base_from_tcp(self, kinematics: Kinematics, joints: Array, external: Array) -> Transform:
        """Return the TCP pose in base for joints (n,) [rad] and external axes (e,) [m or rad]."""
        wide = self._wide(joints, external)
        return self._arms(kinematics).base_from_tcp(wide, _ROW)[0]

    def _wide(self, joints: Array, external: Array, *, at_start: bool = False) -> Array:
        led = () if self.carrier_axes is None else (self.carrier_axes[0 if at_start else 1],)
        wide: Array = np.concatenate([joints, external, *led])[None]
        return wide

    def _arms(self, kinematics: Kinematics) -> JointMapper:
        return JointMapper(kinematics, _ROW, self.tcp_from_flange[None], (self.carrier,))


def placement(
    tool: ToolData,
    wobj: WobjData,
    base_from_world: Transform,
    external: Sequence[ExternalAxis] = (),
    *,
    world_from_user: Transform | None = None,
    lead: CarrierMotion | None = None,
    belt: BeltMotion | None = None,
) -> Placement | NotSimulatedFrame:
    """Return the placement of targets for a tool and a work object.

    Args:
        tool: The tool.
        wobj: The work object.
        base_from_world: Base frame with all external axes at zero.
        external: The external axes.
        world_from_user: User frame of the work object, if another robot holds it at rest.
        lead: The robot that carries the work object along.
        belt: The belt that carries it along.

    Returns:
        A reason if nothing moves the tool relative to the work object: the robot must hold one of
        them.
    """
    if tool.robhold is wobj.robhold:
        both = "both tool and" if tool.robhold else "neither tool nor"
        return NotSimulatedFrame(f"the robot holds {both} work object (robhold)")
    frame = (base_from_world.rotation, base_from_world.translation)
    on_track = [i for i, axis in enumerate(external) if axis.carries == "robot"]
    base_screws = screws_of(external, on_track, frame)
    if wobj.robhold:
        base_from_tool = base_from_world @ transform(tool.tframe)
        flange_from_object = transform(wobj.uframe) @ transform(wobj.oframe)
        carrier = Carrier(base_from_tool=base_from_tool, base_screws=base_screws)
        return Placement(Transform.identity(), flange_from_object.inverse(), carrier)
    if lead is not None:
        carrier = Carrier(base_screws=base_screws, robot=lead.leader)
        object_frame = transform(wobj.oframe)
        return Placement(object_frame, tcp_from_flange(tool), carrier, (lead.start, lead.end))
    if belt is not None:
        along = Screw(len(external), base_from_world.rotation @ belt.direction, None)
        carrier = Carrier(object_screws=(along,), base_screws=base_screws)
        base_from_object = base_from_world @ belt.world_from_user @ transform(wobj.oframe)
        axes = np.array([belt.start]), np.array([belt.end])
        return Placement(base_from_object, tcp_from_flange(tool), carrier, axes)
    unit = unit_of(wobj, external)
    on_unit = [i for i, axis in enumerate(external) if axis.unit in unit and axis.carries == "wobj"]
    object_screws = screws_of(external, on_unit, frame)
    if on_unit:
        world_from_user = external[on_unit[-1]].world_from_user
        base_from_object = base_from_world @ world_from_user @ transform(wobj.oframe)
    else:
        world_from_user = world_from_user or transform(wobj.uframe)
        base_from_object = base_from_world @ world_from_user @ transform(wobj.oframe)
    carried = Carrier(object_screws=object_screws, base_screws=base_screws)
    carrier_or_none = carried if object_screws or base_screws else None
    return Placement(base_from_object, tcp_from_flange(tool), carrier_or_none)


def standing_at(
    placements: Sequence[Placement],
    which: Index,
    kinematics: Kinematics,
    joints: Array,
    external: Array,
) -> Transform:
    """Return curve_from_tcp (k,) for joints (k, n) [rad] and external axes (k, e) [m or rad].

    Args:
        placements: Placements.
        which: Index (k,) of the placement of each row.
        kinematics: The arm.
        joints: Joints of each row.
        external: External axes of each row.
    """
    tcp_from_flange = Transform.stacked([one.tcp_from_flange for one in placements])
    carriers = tuple(one.carrier for one in placements)
    arms = JointMapper(kinematics, np.arange(len(placements)), tcp_from_flange, carriers)
    return arms.curve_from_tcp(np.concatenate([joints, external], axis=1), which)


def world_from_base_at(
    external: Sequence[ExternalAxis], world_from_base: Transform, values: Array
) -> Transform:
    """Return base frames (k,) for external axes (k, e) [m or rad]: tracks move the base.

    Args:
        external: The external axes.
        world_from_base: The base frame with all of them at zero.
        values: External axes, as in `Samples.external`.
    """
    base_from_world = world_from_base.inverse()
    frame = (base_from_world.rotation, base_from_world.translation)
    on_track = [i for i, axis in enumerate(external) if axis.carries == "robot"]
    still = np.zeros_like(values)
    moved = carried(screws_of(external, on_track, frame), ExternalCourse(values, still, still))
    return world_from_base @ moved.base_from_tcp


def world_from_unit_at(
    external: Sequence[ExternalAxis], on_unit: Sequence[int], values: Array
) -> Transform:
    """Return the frame (k,) that axes of a positioner carry, with external axes (k, e) [m or rad].

    Args:
        external: The external axes.
        on_unit: Indices of those axes, the outermost first; the frame is that of the last.
        values: External axes, as in `Samples.external`.
    """
    world = (np.eye(3), np.zeros(3))
    still = np.zeros_like(values)
    moved = carried(screws_of(external, on_unit, world), ExternalCourse(values, still, still))
    return moved.base_from_tcp @ external[on_unit[-1]].world_from_user


def is_no_orientation(rotation: Orient) -> bool:
    """Whether a quaternion is too far from unit length to be an orientation."""
    return abs(norm(rotation) - 1.0) > REFUSED_NORM_ERROR


def unit_of(wobj: WobjData, external: Sequence[ExternalAxis]) -> tuple[str, ...]:
    """Declared mechanical unit that moves the user frame of a work object; empty if none."""
    if wobj.ufprog:
        return ()
    names = dict.fromkeys(axis.unit for axis in external if axis.carries == "wobj")
    return tuple(name for name in names if name.lower() == wobj.ufmec.lower())


def transform(pose: Pose) -> Transform:
    """Return a frame [mm] as a transform [m]; the orientation is normalised."""
    return Transform.from_quaternion(pose.rot, np.array(pose.trans) * MM)


def pose(a_from_b: Transform) -> Pose:
    """Return a transform [m] as a frame [mm]."""
    x, y, z = (a_from_b.translation / MM).tolist()
    return Pose(Pos(x, y, z), Orient(*a_from_b.quaternion.tolist()))


def base_from_object(wobj: WobjData, base_from_world: Transform) -> Transform:
    """Return the frame of the work object in the robot's base."""
    return base_from_world @ transform(wobj.uframe) @ transform(wobj.oframe)


def base_from_tcp(target: RobTarget, wobj: WobjData, base_from_world: Transform) -> Transform:
    """Return the TCP pose of a target."""
    object_from_tcp = transform(Pose(target.trans, target.rot))
    return base_from_object(wobj, base_from_world) @ object_from_tcp


def tcp_from_flange(tool: ToolData) -> Transform:
    """Return the inverse of the tool frame."""
    return transform(tool.tframe).inverse()


def joints(target: JointTarget, kinematics: Kinematics) -> Array:
    """Return axis positions [deg, mm for a sliding axis] of a target as joints (n,) [rad].

    The additional joint of seven-axis arms is `eax_a`, or 0 if that is 9E9.
    """
    axes = np.array([*target.robax, _programmed(target.extax.eax_a)], dtype=np.float64)
    radians: Array = np.radians(axes[list(kinematics.rapid_axes)])
    return radians


def rob_joint(joints: Array, kinematics: Kinematics) -> RobJoint:
    """Return joints (n,) [rad] as axis positions [deg, mm if sliding]; missing axes are 0."""
    axes = [0.0] * 7
    for axis, angle in zip(kinematics.rapid_axes, np.degrees(joints).tolist(), strict=True):
        axes[axis] = angle
    return RobJoint(*axes[:6])


def external_values(
    extax: ExtJoint, external: Sequence[ExternalAxis], near: Array
) -> tuple[Array, tuple[ExternalAxis, ...]]:
    """Return external axes (e,) [m or rad] of a target, and the axes for which it has no value.

    Axes without a value keep that in `near` (e,).
    """
    values, missing = near.copy(), []
    for i, axis in enumerate(external):
        value = getattr(extax, axis.component)
        if value >= UNUSED_AXIS:
            missing.append(axis)
        else:
            values[i] = value / axis.scale
    return values, tuple(missing)


def ext_joint(values: Array, external: Sequence[ExternalAxis]) -> ExtJoint:
    """Return external axes (e,) [m or rad] in RAPID's form; axes that do not exist are 9E9."""
    given = {a.component: single(float(v) * a.scale) for a, v in zip(external, values, strict=True)}
    return NO_EXTERNAL_AXES._replace(**given)


def _programmed(external_axis: float) -> float:
    """Return the value of an external axis, 0 if it is 9E9 (not programmed)."""
    return 0.0 if external_axis >= UNUSED_AXIS else external_axis
