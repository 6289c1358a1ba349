"""Resolution of move instructions to segments: their frames, starts and ends."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from rapidsim.controller.journal.journal import Instant, Journal
from rapidsim.controller.journal.stop_reasons import MoveImpossible
from rapidsim.controller.moves.arrival import Arrivals
from rapidsim.controller.moves.configuration_choice import rounded, stored_or_nearest
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.expected_lines import ExpectedLines
from rapidsim.controller.moves.first_start import start_above
from rapidsim.controller.moves.followed_belt import FollowedBelt
from rapidsim.controller.moves.move_data import (
    asked_circle_mode,
    can_turn_wrist_in_joints,
    wrist_asked_in_joints,
    wrist_circle_problem,
)
from rapidsim.controller.moves.move_request import (
    LocatedMoveRequest,
    MoveRequest,
    NotReachableError,
    target_name,
)
from rapidsim.controller.moves.queued_move import QueuedMove, ResolvedMove
from rapidsim.controller.moves.segments import segment_of
from rapidsim.controller.moves.target_checks import (
    check_orientation,
    external_end,
    frame_orientations,
    require_limits,
    require_orientation,
)
from rapidsim.controller.moves.target_labels import named_target
from rapidsim.controller.moves.work_object_holders import Holder, Holders
from rapidsim.findings.reach_and_motion_data import CoordinationImpossible, NothingMovesTool
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import (
    IDENTITY_POSE,
    ConfData,
    ExtJoint,
    JointTarget,
    RobJoint,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.error_numbers import ERR_OUTSIDE_REACH
from rapidsim.language.errors import Stopped
from rapidsim.language.moves import CirclePathMode, Interpolation, MotionSettings, Move, Place
from rapidsim.motion.configurations import targets
from rapidsim.motion.configurations.confdata import has_branches
from rapidsim.motion.configurations.short_lines import end_of_short_line
from rapidsim.motion.geometry.segments import WRIST_PAIRS, Waypoint
from rapidsim.motion.robot.robot import Robot

_MOST_REPEATS = 1000
_MOVES = "{}, which holds the work object, is moving, and the robots are not synchronised"
_TARGET = "the target"
"""The name of a target in functions that compute with it."""


@dataclass(frozen=True)
class Resolver:
    """Resolves a robot's moves."""

    robot: Robot
    journal: Journal
    base_from_world: Transform
    """With all external axes at zero."""
    payload_acceleration: float | None = None
    """See `MotionModel`."""
    nearest_configuration: bool = False
    """Whether the nearest working configuration replaces a stored one that does not work."""
    functions_fail: bool = False
    """Whether functions that compute with a target fail even then."""
    exact_configuration: bool = False
    """Whether a stored configuration is not met where an axis is one quarter turn off."""
    holders: Holders = field(default_factory=Holders)
    """The other robots and the conveyors, which may hold work objects."""
    guesses_frames: bool = True
    """See `RunOptions`."""
    _placements: dict[tuple[ToolData, WobjData], targets.Placement | targets.NotSimulatedFrame] = (
        field(default_factory=dict)
    )
    """Placements computed so far: programs use few tools and work objects, or ever new ones."""
    _repeats: dict[tuple[object, ...], QueuedMove] = field(default_factory=dict)
    """Moves without findings: a cycle repeats them from the same place."""

    def resolve(
        self,
        move: Move,
        place: Place,
        start: Waypoint,
        settings: MotionSettings,
        *,
        is_first: bool = False,
        starts_free: bool = False,
        lead: targets.CarrierMotion | None = None,
        belt: FollowedBelt | None = None,
    ) -> QueuedMove:
        """Resolve a move to a queued move with its segment.

        Args:
            move: With its arguments evaluated.
            place: Its place in the program.
            start: Its start.
            settings: Of the task.
            is_first: Whether it is the first move of the run.
            starts_free: Whether the position of the arm before it is unknown.
            lead: Motion of the robot of the team that carries the work object; None if none does.
            belt: The belts that the move follows; None if it follows none.

        Raises:
            MoveImpossible: When the arm cannot make it. As on a controller, no ERROR clause is
                called then.
        """
        try:
            if starts_free or belt is not None:
                return self._resolved(
                    *(move, place, start, settings, lead, belt),
                    is_first=is_first,
                    starts_free=starts_free,
                )
            return self._resolve(move, place, start, settings, lead, is_first=is_first)
        except NotReachableError as error:
            assumed = self._guesses_frame_of(move.wobj, lead)
            raise MoveImpossible(error.violation, assumed=assumed) from None
        except MoveImpossible as impossible:
            impossible.assumed |= self._guesses_frame_of(move.wobj, lead)
            raise

    def _resolve(
        self,
        move: Move,
        place: Place,
        start: Waypoint,
        settings: MotionSettings,
        lead: targets.CarrierMotion | None,
        *,
        is_first: bool,
    ) -> QueuedMove:
        """Return the move of an earlier cycle if nothing has changed; see `resolve`."""
        is_made_anew = is_first or lead is not None or self.may_have_carrier(move.wobj)
        if is_made_anew:
            return self._resolved(move, place, start, settings, lead, is_first=is_first)
        if place.row is not None:
            place_move = partial(self._placement_of, place=place, lead=None)
            row = self.expected.take(move, start, settings, place_move)
            if row is not None:
                return row
            queued = self._resolved(move, place, start, settings)
            self.expected.learn(move, settings, queued.segment)
            return queued
        aim = None if start.aim is None else start.aim.tobytes()
        stands = (start.joints.tobytes(), start.external.tobytes(), aim)
        key = (id(place), move, settings, *stands)
        known = self._repeats.get(key)
        if known is not None and known.place is place:
            return known.again()
        remarks = self.journal.remarks
        queued = self._resolved(move, place, start, settings)
        if self.journal.remarks == remarks:
            if len(self._repeats) == _MOST_REPEATS:
                self._repeats.clear()
            self._repeats[key] = queued.again()
        return queued

    def _resolved(
        self,
        move: Move,
        place: Place,
        start: Waypoint,
        settings: MotionSettings,
        lead: targets.CarrierMotion | None = None,
        belt: FollowedBelt | None = None,
        *,
        is_first: bool = False,
        starts_free: bool = False,
    ) -> QueuedMove:
        to = move.to
        request = MoveRequest(move, settings, self._placement_of(move, place, lead, belt))
        asked, placed = LocatedMoveRequest(request, place, is_first, starts_free), request.placed
        external = external_end(asked, to.extax, start.external, self.robot, self.journal)
        end, is_short = self._end(asked, start, external)
        self._report_unsimulated(asked)
        share = self.payload_acceleration
        segment = segment_of(request, start, end, self.robot, payload_acceleration=share)
        if belt is not None:
            segment = belt.put_on(segment)
        if isinstance(to, RobTarget):
            segment, arrival = self._arrivals.of(asked, to.robconf, segment, is_short=is_short)
        else:
            arrival = self._arrivals.configuration(segment.end.joints)
        base_from_tcp, tcp_from_flange = segment.end.base_from_tcp, segment.tcp_from_flange
        if segment.carrier is not None:
            base_from_tcp = placed.base_from_tcp(self.robot.kinematics, arrival.joints, external)
            tcp_from_flange = base_from_tcp.inverse() @ self.robot.forward(arrival.joints)
        conf = ConfData(*map(float, arrival.confdata))
        return QueuedMove(
            ResolvedMove(move, place, conf),
            segment,
            Instant(),
            CornerKind.STOP if segment.zone is None else CornerKind.FLY_BY,
            base_from_tcp,
            tcp_from_flange,
            settings.grip_load_kg,
        )

    def first_start(
        self, move: Move, place: Place, start: Waypoint, settings: MotionSettings
    ) -> Waypoint | None:
        """Start of a line or arc as the first move, if nothing else defines it; see `start_above`.

        None for other moves, and with external axes, other robots or a stationary tool.
        """
        if not isinstance(move.to, RobTarget) or not move.interpolation.leads_tcp:
            return None
        if self.robot.external or not has_branches(self.robot.kinematics):
            return None
        try:
            placed = self._placement_of(move, place, None)
            for target in (move.to, move.circle_point or move.to):
                require_orientation(_TARGET, target.rot)
        except (NotReachableError, Stopped):
            # Resolving the move itself reports the error.
            return None
        if placed.carrier is not None:
            return None
        end = placed.curve_from_tcp(move.to)
        via = None if move.circle_point is None else placed.curve_from_tcp(move.circle_point)
        tcp_from_flange, stored = placed.tcp_from_flange, rounded(move.to.robconf)
        joints = start_above(
            *(self.robot, end, via, tcp_from_flange, stored, start.joints),
            monitored=settings.conf_l,
        )
        if joints is None:
            return None
        return Waypoint(joints, self.robot.kinematics.forward(joints), start.external)

    def joints(self, target: JointTarget) -> Array:
        """Axis positions [deg, mm if the arm's axis slides] as joints (n,) [rad]."""
        return targets.joints(target, self.robot.kinematics)

    def rob_joint(self, joints: Array) -> RobJoint:
        """Joints (n,) [rad] in RAPID's units."""
        return targets.rob_joint(joints, self.robot.kinematics)

    def joint_target(self, joints: Array, external: Array) -> JointTarget:
        """Joints (n,) [rad] and external axes (e,) [m or rad] in RAPID's units."""
        return JointTarget(self.rob_joint(joints), self.ext_joint(external))

    def external(self, extax: ExtJoint) -> Array:
        """External axes (e,) [m or rad]; axes without a value are 0."""
        nothing = np.zeros(len(self.robot.external))
        return targets.external_values(extax, self.robot.external, nothing)[0]

    def ext_joint(self, external: Array) -> ExtJoint:
        """External axes (e,) [m or rad] in RAPID's units."""
        return targets.ext_joint(external, self.robot.external)

    def target(
        self,
        joints: Array,
        external: Array,
        tool: ToolData,
        wobj: WobjData,
        place: Place,
        time_s: float | None = None,
    ) -> RobTarget:
        """Robtarget of joints (n,) [rad] and external axes (e,) [m or rad], at a time [s]."""
        placed = self._placement(tool, wobj, place, self._holder(wobj, time_s))
        if isinstance(placed, targets.NotSimulatedFrame):
            placed = self._unmoved()
        curve_from_tcp = placed.standing_at(self.robot.kinematics, joints, external)
        pose = targets.pose(placed.curve_from_object.inverse() @ curve_from_tcp)
        conf = ConfData(*map(float, self._arrivals.configuration(joints).confdata))
        return RobTarget(pose.trans, pose.rot, conf, self.ext_joint(external))

    def reach(
        self,
        target: RobTarget,
        tool: ToolData,
        wobj: WobjData,
        near: Waypoint,
        place: Place,
        *,
        monitored: bool,
    ) -> Array:
        """Joints (n,) [rad] of a target in its configuration; if not monitored, in the nearest.

        Raises:
            RapidError: ERR_OUTSIDE_REACH or ERR_ROBLIMIT.
        """
        placed = self._placement(tool, wobj, place, self._holder(wobj))
        if isinstance(placed, targets.NotSimulatedFrame):
            raise NotReachableError(ERR_OUTSIDE_REACH, NothingMovesTool(_TARGET, placed.reason))
        require_orientation(_TARGET, target.rot)
        external, _ = targets.external_values(target.extax, self.robot.external, near.external)
        base_from_flange = placed.base_from_flange(
            self.robot.kinematics, placed.curve_from_tcp(target), external
        )
        stored = target.robconf
        if monitored:
            arrivals = self._arrivals
            if self.functions_fail:
                arrivals = replace(arrivals, uses_nearest=False)
            return arrivals.at_target(base_from_flange, _TARGET, stored, near.joints, place).joints
        working = self._arrivals.working(base_from_flange, _TARGET)
        return stored_or_nearest(working, stored, near.joints).joints

    @cached_property
    def expected(self) -> ExpectedLines:
        """Its announced moves."""
        return ExpectedLines(self.robot)

    @cached_property
    def _arrivals(self) -> Arrivals:
        return Arrivals(
            self.robot, self.journal, self.nearest_configuration, self.exact_configuration
        )

    def _end(
        self, request: LocatedMoveRequest, start: Waypoint, external: Array
    ) -> tuple[Waypoint, bool]:
        """End of a move, and whether the joints there are known.

        For a pose they are known only at the end of a short line; else those of the start are used.
        """
        move, placed = request.request.move, request.request.placed
        if isinstance(move.to, RobTarget):
            check_orientation(request, request.name, move.to.rot, self.journal)
            if move.circle_point is not None:
                name = named_target(request.place.arguments.get("cirpoint", "CirPoint"))
                check_orientation(request, name, move.circle_point.rot, self.journal)
            pose = placed.curve_from_tcp(move.to)
            joints = self._end_of_short_line(request.request, start, pose)
            if joints is None:
                return Waypoint(start.joints, pose, external), False
            return Waypoint(joints, pose, external), True
        of_arm = move.interpolation is Interpolation.AXES
        joints = self.joints(move.to) if of_arm else start.joints
        require_limits(request, joints, external, self.robot, self.journal)
        pose = placed.standing_at(self.robot.kinematics, joints, external)
        return Waypoint(joints, pose, external), True

    def _end_of_short_line(
        self, request: MoveRequest, start: Waypoint, pose: Transform
    ) -> Array | None:
        """Joints (n,) [rad] at the end of a line that turns no joint far; None for other moves."""
        placed, is_line = request.placed, request.move.interpolation is Interpolation.LINE
        if not is_line or placed.carrier or wrist_asked_in_joints(request.move, request.settings):
            return None
        branch = int(self.robot.kinematics.branch_of(start.joints))
        return end_of_short_line(self.robot, start.joints, pose, placed.tcp_from_flange, branch)

    def _placement_of(
        self,
        move: Move,
        place: Place,
        lead: targets.CarrierMotion | None,
        belt: FollowedBelt | None = None,
    ) -> targets.Placement:
        """Placement of the tool and the work object of a move."""
        if belt is not None and belt.motion is not None:
            return self._placement_on(belt.motion, move.tool, move.wobj)
        if move.interpolation is Interpolation.EXTERNAL_AXES:
            # The arm does not take part: its TCP keeps its pose on the robot.
            tcp_from_flange = targets.tcp_from_flange(move.tool)
            return targets.Placement(self.base_from_world, tcp_from_flange)
        holder = None if lead is not None else self._holder(move.wobj)
        if holder is not None and holder.moves:
            why = _MOVES.format(holder.unit)
            raise MoveImpossible(CoordinationImpossible(target_name(place, move), why))
        placed = self._placement(move.tool, move.wobj, place, holder, lead)
        if not isinstance(placed, targets.NotSimulatedFrame):
            return placed
        if isinstance(move.to, JointTarget):
            return self._unmoved()
        violation = NothingMovesTool(target_name(place, move), placed.reason)
        raise NotReachableError(ERR_OUTSIDE_REACH, violation)

    def _placement_on(
        self, belt: targets.BeltMotion, tool: ToolData, wobj: WobjData
    ) -> targets.Placement:
        """Placement of a tool on the robot and a work object on a belt."""
        for name, rotation in frame_orientations(tool, wobj._replace(uframe=IDENTITY_POSE), ()):
            require_orientation(name, rotation)
        axes = self.robot.external
        placed = targets.placement(tool, wobj, self.base_from_world, axes, belt=belt)
        assert isinstance(placed, targets.Placement)
        return placed

    def _unmoved(self) -> targets.Placement:
        """Placement without motion of the tool against the work object: a flange without a tool."""
        return targets.Placement(self.base_from_world, Transform.identity())

    def may_have_carrier(self, wobj: WobjData) -> bool:
        """Whether another robot or a conveyor may hold a work object."""
        if wobj.ufprog or wobj.robhold:
            return False
        return not targets.unit_of(wobj, self.robot.external)

    def _guesses_frame_of(self, wobj: WobjData, lead: targets.CarrierMotion | None) -> bool:
        """Whether the frame of a work object is a guess: its unit is missing from the run."""
        return lead is None and self.may_have_carrier(wobj) and not self.has_carrier(wobj)

    def has_carrier(self, wobj: WobjData) -> bool:
        """Whether another robot or a conveyor holds a work object."""
        return self._holder(wobj) is not None

    def _holder(self, wobj: WobjData, time_s: float | None = None) -> Holder | None:
        """The robot or conveyor that holds a work object, at a time [s]; None if none holds it."""
        return self.holders.find(wobj, time_s) if self.may_have_carrier(wobj) else None

    def _placement(
        self,
        tool: ToolData,
        wobj: WobjData,
        place: Place,
        holder: Holder | None = None,
        lead: targets.CarrierMotion | None = None,
    ) -> targets.Placement | targets.NotSimulatedFrame:
        """Placement of a tool and a work object; `place` is the place that needs it.

        Raises:
            NotReachableError: When one of their frames has no orientation.
            Stopped: When the frame of the work object is unknown, and guesses are not allowed.
        """
        if holder is not None or lead is not None:
            for name, rotation in frame_orientations(tool, wobj._replace(uframe=IDENTITY_POSE), ()):
                require_orientation(name, rotation)
            world_from_user = None if holder is None else holder.world_from_user
            axes = self.robot.external
            return targets.placement(
                tool, wobj, self.base_from_world, axes, world_from_user=world_from_user, lead=lead
            )
        placed = self._placements.get((tool, wobj))
        if placed is None:
            for name, rotation in frame_orientations(tool, wobj, self.robot.external):
                require_orientation(name, rotation)
            placed = targets.placement(tool, wobj, self.base_from_world, self.robot.external)
            if len(self._placements) == _MOST_REPEATS:
                self._placements.clear()
            self._placements[tool, wobj] = placed
        if isinstance(placed, targets.NotSimulatedFrame):
            return placed
        if self.may_have_carrier(wobj):
            if not self.guesses_frames:
                raise Stopped(f"{wobj.ufmec}, which moves the work object, is not in this run")
            self.journal.unsimulated(
                f"a work object moved by the mechanical unit {wobj.ufmec}",
                "its user frame is at `uframe`; no [[external_axis]] carries it",
                place,
            )
        return placed

    def _report_unsimulated(self, request: LocatedMoveRequest) -> None:
        """Report requests of SingArea and CirPathMode that a move does not fulfil."""
        move, settings = request.request.move, request.request.settings
        if asked_circle_mode(move, settings) in WRIST_PAIRS:
            why = wrist_circle_problem(move, request.request.placed.carrier, self.robot)
            if why is None:
                return
            name = f"CirPathMode {settings.circle_path.value} where {why}"
            instead = f"the tool turns as with CirPathMode {CirclePathMode.PATH_FRAME.value}"
            self.journal.unsimulated(name, instead, request.place)
        if wrist_asked_in_joints(move, settings) and not can_turn_wrist_in_joints(move, self.robot):
            with_what = "a seven-axis arm" if move.tool.robhold else "a stationary tool"
            self.journal.unsimulated(f"SingArea with {with_what}", r"SingArea \Off", request.place)
