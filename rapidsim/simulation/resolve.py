"""From a move instruction to a segment: where its frames are, where it starts and ends."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.language.controller import (
    CirclePathMode,
    Interpolation,
    MotionSettings,
    Move,
    Place,
    SingularArea,
)
from rapidsim.language.data import (
    ConfData,
    ExtJoint,
    JointTarget,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.error_numbers import ERR_OUTSIDE_REACH
from rapidsim.motion import targets
from rapidsim.motion.robot import Robot
from rapidsim.motion.segments import CircleMode, Geometry, Segment, Waypoint
from rapidsim.motion.violations import NothingMovesTool
from rapidsim.simulation.arrival import Arrivals
from rapidsim.simulation.asked_move import AskedMove, MoveRefusedError, target_name
from rapidsim.simulation.configuration_choice import stored_or_nearest
from rapidsim.simulation.journal import Instant, Journal
from rapidsim.simulation.move_data import (
    CIRCLE_MODES,
    GEOMETRY,
    acceleration_share_of,
    external_speeds_of,
    speed_of,
    unbounded,
    zone_of,
)
from rapidsim.simulation.queued_move import QueuedMove
from rapidsim.simulation.result import CornerKind
from rapidsim.simulation.target_checks import check_orientation, external_end, require_limits


@dataclass(frozen=True)
class Resolver:
    """Resolves the moves of one robot."""

    robot: Robot
    journal: Journal
    base_from_world: Transform
    """With all external axes at zero."""
    payload_acceleration: float = 1.0
    """See `MotionModel`."""
    _placements: dict[tuple[ToolData, WobjData], targets.Placement | targets.NotSimulatedFrame] = (
        field(default_factory=dict)
    )
    """What was worked out before: programs use few tools and work objects."""

    def resolve(
        self, move: Move, place: Place, start: Waypoint, settings: MotionSettings
    ) -> QueuedMove:
        """Work out where a move goes.

        Raises:
            RapidError: When the end cannot be reached, or the set-up is not simulated.
        """
        to, kinematics = move.to, self.robot.kinematics
        asked = AskedMove(move, settings, place, self._placement_of(move, place))
        external = external_end(asked, to.extax, start.external, self.robot, self.journal)
        segment = self._segment(asked, start, external)
        if isinstance(to, RobTarget):
            segment, arrival = self._arrivals.of(asked, to.robconf, segment)
        else:
            arrival = self._arrivals.configuration(segment.end.joints)
        base_from_tcp, tcp_from_flange = segment.end.base_from_tcp, segment.tcp_from_flange
        if segment.carrier is not None:
            base_from_tcp = asked.placed.base_from_tcp(kinematics, arrival.joints, external)
            tcp_from_flange = base_from_tcp.inverse() @ self.robot.forward(arrival.joints)
        return QueuedMove(
            move,
            place,
            segment,
            ConfData(*map(float, arrival.confdata)),
            Instant(),
            CornerKind.STOP if segment.zone is None else CornerKind.FLY_BY,
            base_from_tcp,
            tcp_from_flange,
        )

    def joints(self, target: JointTarget) -> Array:
        """Axis positions [deg] as joints (n,) [rad]."""
        return targets.joints(target, len(self.robot.joints))

    def external(self, extax: ExtJoint) -> Array:
        """External axes (e,) [m or rad]; those that are not given are 0."""
        nothing = np.zeros(len(self.robot.external))
        return targets.external_values(extax, self.robot.external, nothing)[0]

    def ext_joint(self, external: Array) -> ExtJoint:
        """External axes (e,) [m or rad] in RAPID's units."""
        return targets.ext_joint(external, self.robot.external)

    def target(self, joints: Array, external: Array, tool: ToolData, wobj: WobjData) -> RobTarget:
        """The target that joints (n,) [rad] and external axes (e,) [m or rad] stand at."""
        placed = self._placement(tool, wobj, "the position", anywhere=True)
        curve_from_tcp = placed.standing_at(self.robot.kinematics, joints, external)
        pose = targets.pose(placed.curve_from_object.inverse() @ curve_from_tcp)
        conf = ConfData(*map(float, self._arrivals.configuration(joints).confdata))
        return RobTarget(pose.trans, pose.rot, conf, self.ext_joint(external))

    def reach(self, target: RobTarget, tool: ToolData, wobj: WobjData, near: Waypoint) -> Array:
        """Joints (n,) [rad] of a target in its configuration, or the nearest that works.

        Raises:
            RapidError: ERR_OUTSIDE_REACH or ERR_ROBLIMIT.
        """
        placed = self._placement(tool, wobj, "the target", anywhere=False)
        external, _ = targets.external_values(target.extax, self.robot.external, near.external)
        base_from_flange = placed.base_from_flange(
            self.robot.kinematics, placed.curve_from_tcp(target), external
        )
        working = self._arrivals.working(base_from_flange, "the target")
        return stored_or_nearest(working, target.robconf, near.joints).joints

    @cached_property
    def _arrivals(self) -> Arrivals:
        return Arrivals(self.robot, self.journal)

    def _segment(self, asked: AskedMove, start: Waypoint, external: Array) -> Segment:
        """The segment of a move; to a pose, its end stands in the joints of its start."""
        move, settings, placed = asked.move, asked.settings, asked.placed
        kinematics, axes = self.robot.kinematics, self.robot.external
        begin = placed.standing_at(kinematics, start.joints, start.external)
        return Segment(
            index=0,
            geometry=GEOMETRY[move.interpolation],
            start=Waypoint(start.joints, begin, start.external),
            end=self._end(asked, start, external),
            tcp_from_flange=placed.tcp_from_flange,
            branch=int(kinematics.branch_of(start.joints)),
            speed=speed_of(move, settings),
            zone=zone_of(move),
            via=None if move.circle_point is None else self._pose(asked, move.circle_point),
            duration=move.duration_s,
            acceleration_share=acceleration_share_of(
                move, settings, self.robot.payload_kg, self.payload_acceleration
            ),
            carrier=placed.carrier,
            wrist_in_joints=self._wrist_in_joints(move, settings),
            circle_mode=self._circle_mode(move, settings),
            tcp_acceleration=unbounded(settings.tcp_acceleration_m_s2),
            tcp_deceleration=unbounded(settings.tcp_deceleration_m_s2),
            world_acceleration=unbounded(settings.world_acceleration_m_s2),
            external_linear=tuple(axis.linear for axis in axes),
            external_speeds=external_speeds_of(move, settings, axes),
        )

    def _end(self, asked: AskedMove, start: Waypoint, external: Array) -> Waypoint:
        to, placed = asked.move.to, asked.placed
        if isinstance(to, RobTarget):
            return Waypoint(start.joints, self._pose(asked, to), external)
        of_arm = asked.move.interpolation is Interpolation.AXES
        joints = self.joints(to) if of_arm else start.joints
        require_limits(asked, joints, external, self.robot, self.journal)
        pose = placed.standing_at(self.robot.kinematics, joints, external)
        return Waypoint(joints, pose, external)

    def _pose(self, asked: AskedMove, target: RobTarget) -> Transform:
        """Where a target puts the TCP on its curve, after a check of its orientation."""
        check_orientation(asked, target.rot, self.journal)
        return asked.placed.curve_from_tcp(target)

    def _placement_of(self, move: Move, place: Place) -> targets.Placement:
        """Where tool and work object of a move are."""
        if move.interpolation is Interpolation.EXTERNAL_AXES:
            # Nothing that the arm does: its TCP stays where it is on the robot.
            tcp_from_flange = targets.tcp_from_flange(move.tool)
            return targets.Placement(self.base_from_world, tcp_from_flange)
        anywhere = isinstance(move.to, JointTarget)
        return self._placement(move.tool, move.wobj, target_name(place, move), anywhere=anywhere)

    def _placement(
        self, tool: ToolData, wobj: WobjData, name: str, *, anywhere: bool
    ) -> targets.Placement:
        """Where a tool and a work object are; `anywhere`: also where neither moves the other."""
        placed = self._placements.get((tool, wobj))
        if placed is None:
            placed = targets.placement(tool, wobj, self.base_from_world, self.robot.external)
            self._placements[tool, wobj] = placed
        if isinstance(placed, targets.NotSimulatedFrame):
            if not anywhere:
                raise MoveRefusedError(ERR_OUTSIDE_REACH, NothingMovesTool(name, placed.reason))
            return targets.Placement(self.base_from_world, Transform.identity())
        moved = not wobj.ufprog and not wobj.robhold
        if moved and not targets.unit_of(wobj, self.robot.external):
            self.journal.unsimulated(
                f"a work object moved by the mechanical unit `{wobj.ufmec}`",
                "its user frame stands where `uframe` says; no [[external_axis]] carries it",
            )
        return placed

    def _wrist_in_joints(self, move: Move, settings: MotionSettings) -> bool:
        asked = settings.singular_area is not SingularArea.OFF
        if not asked or GEOMETRY[move.interpolation] is Geometry.JOINT:
            return False
        possible = move.tool.robhold and len(self.robot.joints) <= 6
        if not possible:
            with_what = "a seven-axis arm" if move.tool.robhold else "a stationary tool"
            self.journal.unsimulated(f"SingArea with {with_what}", r"SingArea \Off")
        return possible

    def _circle_mode(self, move: Move, settings: MotionSettings) -> CircleMode:
        if move.interpolation is not Interpolation.CIRCLE:
            return CircleMode.PATH_FRAME
        mode = CIRCLE_MODES.get(settings.circle_path)
        if mode is None:
            name = f"CirPathMode {settings.circle_path.value}"
            default = CirclePathMode.PATH_FRAME.value
            self.journal.unsimulated(name, f"the tool turns as with CirPathMode {default}")
            return CircleMode.PATH_FRAME
        return mode
