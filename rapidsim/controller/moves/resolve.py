"""From a move instruction to a segment: where its frames are, where it starts and ends."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from rapidsim.controller.journal.journal import Instant, Journal
from rapidsim.controller.moves.arrival import Arrivals
from rapidsim.controller.moves.configuration_choice import stored_or_nearest
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.move_data import (
    GEOMETRY,
    acceleration_share_of,
    circle_mode_of,
    external_speeds_of,
    speed_of,
    stop_ramp_of,
    unbounded,
    zone_of,
)
from rapidsim.controller.moves.move_request import AskedMove, MoveRefusedError, target_name
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.target_checks import (
    check_orientation,
    external_end,
    require_limits,
    require_orientation,
)
from rapidsim.controller.moves.target_words import named_target
from rapidsim.findings.reach_and_motion_data import NothingMovesTool
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import ConfData, ExtJoint, JointTarget, RobTarget, ToolData, WobjData
from rapidsim.language.error_numbers import ERR_OUTSIDE_REACH
from rapidsim.language.moves import (
    CirclePathMode,
    Interpolation,
    MotionSettings,
    Move,
    Place,
    SingularArea,
)
from rapidsim.motion.configurations import targets
from rapidsim.motion.configurations.short_lines import end_of_short_line
from rapidsim.motion.geometry.segments import WRIST_PAIRS, CircleMode, Geometry, Segment, Waypoint
from rapidsim.motion.geometry.wrist_pair import wrist_meets
from rapidsim.motion.path.wrist_circle import start_on_circle
from rapidsim.motion.robot.robot import Robot

_TARGET = "the target"
"""What functions that compute with a target call it."""


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
        self,
        move: Move,
        place: Place,
        start: Waypoint,
        settings: MotionSettings,
        *,
        index: int = 0,
    ) -> QueuedMove:
        """Work out where a move goes.

        Args:
            move: With its arguments evaluated.
            place: Where it stands in the program.
            start: Where it starts.
            settings: Of the task.
            index: Its number on the path, as far as that is known.

        Raises:
            RapidError: When the end cannot be reached, or the set-up is not simulated.
        """
        to, kinematics = move.to, self.robot.kinematics
        asked = AskedMove(move, settings, place, self._placement_of(move, place))
        external = external_end(asked, to.extax, start.external, self.robot, self.journal)
        branch = int(kinematics.branch_of(start.joints))
        end, is_short = self._end(asked, start, branch, external)
        segment = self._segment(asked, start, end, branch, index)
        if isinstance(to, RobTarget):
            segment, arrival = self._arrivals.of(asked, to.robconf, segment, is_short=is_short)
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

    def target(
        self, joints: Array, external: Array, tool: ToolData, wobj: WobjData, place: Place
    ) -> RobTarget:
        """The target that joints (n,) [rad] and external axes (e,) [m or rad] stand at."""
        placed = self._placement(tool, wobj, place)
        if isinstance(placed, targets.NotSimulatedFrame):
            placed = self._unmoved()
        curve_from_tcp = placed.standing_at(self.robot.kinematics, joints, external)
        pose = targets.pose(placed.curve_from_object.inverse() @ curve_from_tcp)
        conf = ConfData(*map(float, self._arrivals.configuration(joints).confdata))
        return RobTarget(pose.trans, pose.rot, conf, self.ext_joint(external))

    def reach(
        self, target: RobTarget, tool: ToolData, wobj: WobjData, near: Waypoint, place: Place
    ) -> Array:
        """Joints (n,) [rad] of a target in its configuration, or the nearest that works.

        Raises:
            RapidError: ERR_OUTSIDE_REACH or ERR_ROBLIMIT.
        """
        placed = self._placement(tool, wobj, place)
        if isinstance(placed, targets.NotSimulatedFrame):
            raise MoveRefusedError(ERR_OUTSIDE_REACH, NothingMovesTool(_TARGET, placed.reason))
        require_orientation(_TARGET, target.rot)
        external, _ = targets.external_values(target.extax, self.robot.external, near.external)
        base_from_flange = placed.base_from_flange(
            self.robot.kinematics, placed.curve_from_tcp(target), external
        )
        working = self._arrivals.working(base_from_flange, _TARGET)
        return stored_or_nearest(working, target.robconf, near.joints).joints

    @cached_property
    def _arrivals(self) -> Arrivals:
        return Arrivals(self.robot, self.journal)

    def _segment(
        self, asked: AskedMove, start: Waypoint, end: Waypoint, branch: int, index: int
    ) -> Segment:
        """The segment of a move."""
        move, settings, placed = asked.move, asked.settings, asked.placed
        axes = self.robot.external
        begin = placed.standing_at(self.robot.kinematics, start.joints, start.external)
        mode = self._circle_mode(asked)
        if mode in WRIST_PAIRS:
            begin = start_on_circle(begin, start.aim)
        return Segment(
            index=index,
            geometry=GEOMETRY[move.interpolation],
            start=Waypoint(start.joints, begin, start.external),
            end=end,
            tcp_from_flange=placed.tcp_from_flange,
            branch=branch,
            speed=speed_of(move, settings),
            zone=zone_of(move),
            via=self._circle_point(asked),
            duration=move.duration_s,
            acceleration_share=acceleration_share_of(
                move, settings, self.robot.payload_kg, self.payload_acceleration
            ),
            ramp=settings.ramp_percent / 100.0,
            stop_ramp=stop_ramp_of(settings),
            carrier=placed.carrier,
            wrist_in_joints=mode not in WRIST_PAIRS and self._wrist_in_joints(asked),
            circle_mode=mode,
            tcp_acceleration=unbounded(settings.tcp_acceleration_m_s2),
            tcp_deceleration=unbounded(settings.tcp_deceleration_m_s2),
            world_acceleration=unbounded(settings.world_acceleration_m_s2),
            external_linear=tuple(axis.linear for axis in axes),
            external_speeds=external_speeds_of(move, settings, axes),
        )

    def _end(
        self, asked: AskedMove, start: Waypoint, branch: int, external: Array
    ) -> tuple[Waypoint, bool]:
        """Where a move ends, and whether its joints there are known.

        To a pose they are known at the end of a short line only; else they are those of its start.
        """
        to, placed = asked.move.to, asked.placed
        if isinstance(to, RobTarget):
            pose = self._pose(asked, asked.name, to)
            joints = self._end_of_short_line(asked, start, branch, pose)
            if joints is None:
                return Waypoint(start.joints, pose, external), False
            return Waypoint(joints, pose, external), True
        of_arm = asked.move.interpolation is Interpolation.AXES
        joints = self.joints(to) if of_arm else start.joints
        require_limits(asked, joints, external, self.robot, self.journal)
        pose = placed.standing_at(self.robot.kinematics, joints, external)
        return Waypoint(joints, pose, external), True

    def _end_of_short_line(
        self, asked: AskedMove, start: Waypoint, branch: int, pose: Transform
    ) -> Array | None:
        """Joints (n,) [rad] at the end of a line that turns no joint far; None for other moves."""
        placed, settings = asked.placed, asked.settings
        is_line = asked.move.interpolation is Interpolation.LINE
        if not is_line or placed.carrier or settings.singular_area is not SingularArea.OFF:
            return None
        return end_of_short_line(self.robot, start.joints, pose, placed.tcp_from_flange, branch)

    def _circle_point(self, asked: AskedMove) -> Transform | None:
        """Where the circle point of a move puts the TCP; None without one."""
        target = asked.move.circle_point
        if target is None:
            return None
        name = named_target(asked.place.arguments.get("cirpoint", "CirPoint"))
        return self._pose(asked, name, target)

    def _pose(self, asked: AskedMove, name: str, target: RobTarget) -> Transform:
        """Where a target puts the TCP on its curve, after a check of its orientation."""
        check_orientation(asked, name, target.rot, self.journal)
        return asked.placed.curve_from_tcp(target)

    def _placement_of(self, move: Move, place: Place) -> targets.Placement:
        """Where tool and work object of a move are."""
        if move.interpolation is Interpolation.EXTERNAL_AXES:
            # Nothing that the arm does: its TCP stays where it is on the robot.
            tcp_from_flange = targets.tcp_from_flange(move.tool)
            return targets.Placement(self.base_from_world, tcp_from_flange)
        placed = self._placement(move.tool, move.wobj, place)
        if not isinstance(placed, targets.NotSimulatedFrame):
            return placed
        if isinstance(move.to, JointTarget):
            return self._unmoved()
        violation = NothingMovesTool(target_name(place, move), placed.reason)
        raise MoveRefusedError(ERR_OUTSIDE_REACH, violation)

    def _unmoved(self) -> targets.Placement:
        """Where nothing moves the tool against the work object: as of a flange without a tool."""
        return targets.Placement(self.base_from_world, Transform.identity())

    def _placement(
        self, tool: ToolData, wobj: WobjData, place: Place
    ) -> targets.Placement | targets.NotSimulatedFrame:
        """Where a tool and a work object are; `place` asks.

        Raises:
            MoveRefusedError: When one of their frames has no orientation.
        """
        placed = self._placements.get((tool, wobj))
        if placed is None:
            require_orientation("tframe of the tool", tool.tframe.rot)
            if not targets.unit_of(wobj, self.robot.external):
                require_orientation("uframe of the work object", wobj.uframe.rot)
            require_orientation("oframe of the work object", wobj.oframe.rot)
            placed = targets.placement(tool, wobj, self.base_from_world, self.robot.external)
            self._placements[tool, wobj] = placed
        if isinstance(placed, targets.NotSimulatedFrame):
            return placed
        moved = not wobj.ufprog and not wobj.robhold
        if moved and not targets.unit_of(wobj, self.robot.external):
            self.journal.unsimulated(
                f"a work object moved by the mechanical unit `{wobj.ufmec}`",
                "its user frame stands where `uframe` says; no [[external_axis]] carries it",
                place,
            )
        return placed

    def _wrist_in_joints(self, asked: AskedMove) -> bool:
        move = asked.move
        if asked.settings.singular_area is SingularArea.OFF:
            return False
        if GEOMETRY[move.interpolation] is Geometry.JOINT:
            return False
        possible = move.tool.robhold and len(self.robot.joints) <= 6
        if not possible:
            with_what = "a seven-axis arm" if move.tool.robhold else "a stationary tool"
            self.journal.unsimulated(f"SingArea with {with_what}", r"SingArea \Off", asked.place)
        return possible

    def _circle_mode(self, asked: AskedMove) -> CircleMode:
        mode = circle_mode_of(asked.move, asked.settings)
        if mode not in WRIST_PAIRS:
            return mode
        why = "external axes move robot or work object" if asked.placed.carrier else None
        if not asked.move.tool.robhold:
            why = "the tool is stationary"
        if not wrist_meets(self.robot.kinematics, self.robot.start):
            why = "this arm has no six axes of which 4, 5 and 6 meet in one point"
        if why is None:
            return mode
        name = f"CirPathMode {asked.settings.circle_path.value} where {why}"
        default = CirclePathMode.PATH_FRAME.value
        instead = f"the tool turns as with CirPathMode {default}"
        self.journal.unsimulated(name, instead, asked.place)
        return CircleMode.PATH_FRAME
