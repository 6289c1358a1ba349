"""The configuration at the end of a move to a pose, with the turns of its axes.

With ConfJ or ConfL on the controller stops at a stored configuration that the arm cannot take. A
run stops, too, unless it has the option to take the nearest that works: programs are often run
against another work object than they were taught with, and the rest of the run is still
informative. `motion.configurations.compliance` decides which configurations match a stored one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rapidsim.controller.journal.failed_moves import failed_at_fraction, refused_move
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import MoveImpossible
from rapidsim.controller.moves.configuration_choice import (
    Quarters,
    by_stored,
    conf_text,
    is_switch,
    nearest,
    nearest_without_switch,
    not_as_stored,
    past_limit,
    replacement_finding,
    rounded,
    stored_or_nearest,
)
from rapidsim.controller.moves.first_start import first_configuration
from rapidsim.controller.moves.motion_findings import fault_violation, switched, wrist_turning_far
from rapidsim.controller.moves.move_request import LocatedMoveRequest, NotReachableError
from rapidsim.controller.moves.target_checks import excess_text
from rapidsim.findings.reach_and_motion_data import (
    CircleUncertain,
    ConfigurationChangesOnLine,
    ConfigurationNotReachable,
    JointOutOfRange,
    OrientationDeviates,
    UnreachableTarget,
)
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import ConfData
from rapidsim.language.error_numbers import ERR_OUTSIDE_REACH, ERR_ROBLIMIT
from rapidsim.language.moves import Place, SensorInfluence, SingularArea
from rapidsim.motion.configurations.compliance import TOLERATED_QUARTERS, Match, hold, match
from rapidsim.motion.configurations.confdata import (
    Configuration,
    configuration,
    configurations,
    has_branches,
    named,
)
from rapidsim.motion.configurations.reach_suggestions import reason_with_lengths
from rapidsim.motion.configurations.reachability import pose_excess, unreachable_reason
from rapidsim.motion.configurations.wrist_lock import AXIS_4, lock_axis_4
from rapidsim.motion.geometry.curves import Curves, circle_fault, curves_of
from rapidsim.motion.geometry.joint_mapping import JointMapper, arms_of
from rapidsim.motion.geometry.segments import Geometry, Segment, Waypoint
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.wrist_circle import end_of_circle, findings_on_pair, wrist_circle_error
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

CURVE_SAMPLES = 33
"""Poses along a line or arc at which joint turns are followed to its end."""
_ALONG = np.linspace(0.0, 1.0, CURVE_SAMPLES)
_ROWS = np.zeros(CURVE_SAMPLES, dtype=np.int64)
_TOLD_DEVIATION = np.radians(0.5)


@value_class(frozen=True, slots=True)
class Arrivals:
    """Finds the configurations of a robot at the ends of its moves."""

    robot: Robot
    journal: Journal
    uses_nearest: bool = False
    """Whether the nearest working configuration replaces a stored one that does not work."""
    exact: bool = False
    """Whether a stored configuration is not met where cf1, cf4 or cf6 is one quarter turn off."""

    def of(
        self, request: LocatedMoveRequest, stored: ConfData, segment: Segment, *, is_short: bool
    ) -> tuple[Segment, Configuration]:
        """A segment to a pose with the joints of its end.

        Args:
            request: The move.
            stored: The configuration in its target.
            segment: Ends at the pose.
            is_short: Whether it is a short line that arrives with the joints of its end; otherwise
                these are ignored.

        Raises:
            NotReachableError: When the end cannot be reached.
            MoveImpossible: When an arc defines no circle, or the end cannot be reached as stored.
        """
        if segment.wrist_pair is not None and circle_fault(segment) is None:
            return self._wrist_circle(request, segment)
        try:
            self._require_circle(request, segment)
            if is_short:
                arrival = self.configuration(segment.end.joints)
            else:
                arrival = self._chosen(request, stored, segment)
            self._hold_to_stored(request, stored, segment, arrival)
            if not is_short:
                self._report_far_turn(request, segment, arrival)
                self._report_past_limit(request, arrival)
            area = request.request.settings.singular_area
            if area is SingularArea.LOCK_AXIS_4 and _has_axis_4(segment):
                arrival = self._locked(request, arrival, segment)
        except (NotReachableError, MoveImpossible) as refused:
            if segment.carrier is None:
                violation = refused.violation
                self.journal.failed_move(
                    refused_move(request.place, violation, segment, self.robot)
                )
            raise
        if is_short:
            return segment, arrival
        pose, external = segment.end.base_from_tcp, segment.end.external
        if segment.wrist_in_joints:
            pose = request.request.placed.standing_at(
                self.robot.kinematics, arrival.joints, external
            )
        arrived = replace(segment, end=Waypoint(arrival.joints, pose, external))
        if segment.wrist_in_joints:
            self._report_wrist_deviation(request, arrived)
        return arrived, arrival

    def configuration(self, joints: Array) -> Configuration:
        """A joint vector (n,) [rad] with its confdata."""
        return configuration(self.robot.kinematics, joints)

    def working(self, base_from_flange: Transform, name: str) -> tuple[Configuration, ...]:
        """Every configuration that reaches a pose.

        Raises:
            NotReachableError: When no configuration reaches it.
        """
        working = configurations(self.robot, base_from_flange)
        if working:
            return working
        why = unreachable_reason(self.robot, base_from_flange)
        assert why is not None
        errno = ERR_OUTSIDE_REACH if why.joint is None else ERR_ROBLIMIT
        reason = reason_with_lengths(self.robot, base_from_flange, why)
        raise NotReachableError(errno, UnreachableTarget(name, self.robot.title, reason))

    def at_target(
        self, base_from_flange: Transform, target: str, stored: ConfData, near: Array, place: Place
    ) -> Configuration:
        """Configuration of the arm at a target by the rules of moves, without moving there.

        Raises:
            NotReachableError: When it has none, and the nearest is not to be taken.
        """
        if not has_branches(self.robot.kinematics):
            return stored_or_nearest(self.working(base_from_flange, target), stored, near)
        wanted = rounded(stored)
        held = self._best_configuration(base_from_flange, wanted, near)
        chosen = held or stored_or_nearest(self.working(base_from_flange, target), stored, near)
        if held is not None and self._meets(held, wanted):
            return held
        found = self._not_as_stored(target, base_from_flange, wanted, held)
        if not (found.continues or self.uses_nearest):
            raise NotReachableError(ERR_ROBLIMIT, found)
        key = ("configuration", place.span)
        self.journal.finding(found, place, once=key, assumed=True)
        return chosen

    def _require_circle(self, request: LocatedMoveRequest, segment: Segment) -> None:
        fault = circle_fault(segment)
        if fault is not None:
            raise MoveImpossible(CircleUncertain(request.name, fault))
        if len(segment.end.external):
            wide = np.concatenate([segment.start.joints, segment.end.external])
            over = excess_text(self.robot, wide)
            if over:
                raise MoveImpossible(JointOutOfRange(request.name, self.robot.title, over))

    def _chosen(
        self, request: LocatedMoveRequest, stored: ConfData, segment: Segment
    ) -> Configuration:
        """The configuration as stored, if that works; else the nearest."""
        near = segment.start.joints
        if not _in_joints(segment):
            arrived = end_of_curve(self.robot, segment)
            return arrived or nearest(self._working(request, segment), near)
        if not self._is_monitored(request, segment):
            if request.starts_free and has_branches(self.robot.kinematics):
                flange = self._base_from_flange(request, segment)
                wanted = rounded(stored)
                first = first_configuration(self.robot, flange, wanted, near, monitored=False)
                if first is not None:
                    return first
            before = self.configuration(near)
            chosen = nearest_without_switch(self._working(request, segment), before)
            self._report_switch(request, segment, before, chosen)
            return chosen
        wanted, flange = rounded(stored), self._base_from_flange(request, segment)
        return (
            self._best_configuration(flange, wanted, near)
            or self._by_stored(request, wanted, segment)[0]
        )

    def _best_configuration(
        self, base_from_flange: Transform, wanted: Quarters, near: Array
    ) -> Configuration | None:
        """The configuration that meets a stored one best, on its branch; None if there is none."""
        tolerated = 0 if self.exact else TOLERATED_QUARTERS
        met = named(self.robot, base_from_flange, wanted, tolerated)
        if met is not None:
            return met
        best = hold(self.robot, base_from_flange[None], np.array([wanted]), near)
        return self.configuration(best.joints[0]) if best.possible[0] else None

    def _not_as_stored(
        self,
        target: str,
        base_from_flange: Transform,
        wanted: Quarters,
        stored: Configuration | None,
    ) -> ConfigurationNotReachable:
        """Finding for a target not reached as stored; a match on its branch replaces it."""
        if stored is not None and not self.exact:
            (working,) = by_stored(self.robot, base_from_flange[None], [wanted])
            return replacement_finding(target, wanted, stored, working)
        (found,) = not_as_stored(self.robot, base_from_flange[None], [wanted], [target])
        return found

    def _report_switch(
        self,
        request: LocatedMoveRequest,
        segment: Segment,
        before: Configuration,
        chosen: Configuration,
    ) -> None:
        """Report a joint move that switches the configuration of the main axes."""
        key = ("main axes", request.written)
        is_told = segment.geometry is Geometry.JOINT and not request.is_first
        is_told &= has_branches(self.robot.kinematics) and is_switch(before, chosen)
        if not is_told or self.journal.has_finding(key):
            return
        flange = self._base_from_flange(request, segment)
        found = switched(request.name, self.robot, flange, before, chosen)
        self.journal.finding(found, request.place, once=key)

    def _report_far_turn(
        self, request: LocatedMoveRequest, segment: Segment, arrival: Configuration
    ) -> None:
        """Report a line or arc on which a wrist axis turns so far that a controller may stop."""
        if _in_joints(segment) or not self._is_monitored(request, segment):
            return
        found = wrist_turning_far(request.name, segment.start.joints, arrival.joints)
        if found is not None:
            self.journal.finding(found, request.place, once=("wrist turns", request.written))

    def _hold_to_stored(
        self, request: LocatedMoveRequest, stored: ConfData, segment: Segment, chosen: Configuration
    ) -> None:
        """Stop the run, or report it, if a controller would stop at the chosen configuration.

        Raises:
            MoveImpossible: When the nearest is not to be taken.
        """
        wanted = rounded(stored)
        if not self._is_monitored(request, segment):
            return
        if self._meets(chosen, wanted):
            return
        key = ("configuration", request.written)
        if self.uses_nearest and self.journal.has_finding(key):
            return
        flange = self._base_from_flange(request, segment)
        held = self._best_configuration(flange, wanted, segment.start.joints)
        found: ConfigurationNotReachable | ConfigurationChangesOnLine | None
        if _in_joints(segment):
            found = self._not_as_stored(request.name, flange, wanted, held)
        else:
            found = self._misses_on_curve(request, segment, wanted, held, chosen)
        if found is None:
            return
        if not (found.continues or self.uses_nearest):
            raise MoveImpossible(found)
        self.journal.finding(found, request.place, once=key, assumed=True)

    def _misses_on_curve(
        self,
        request: LocatedMoveRequest,
        segment: Segment,
        wanted: Quarters,
        stored: Configuration | None,
        arrival: Configuration,
    ) -> ConfigurationNotReachable | ConfigurationChangesOnLine | None:
        """Finding for the arrival of a line or arc; None if planning reports the failure."""
        if stored is None or (self.exact and self._match(stored, wanted) is not Match.EXACT):
            return self._not_as_stored(
                request.name, self._base_from_flange(request, segment), wanted, None
            )
        if end_of_curve(self.robot, segment) is None:
            return None
        goes_on = self._match(arrival, wanted) is Match.TURNED and not self.exact
        arrives = conf_text(arrival.confdata)
        return ConfigurationChangesOnLine(request.name, conf_text(wanted), arrives, goes_on)

    def _meets(self, chosen: Configuration, wanted: Quarters) -> bool:
        """Whether a configuration meets a stored one."""
        return chosen.confdata == wanted or self._match(chosen, wanted).meets(exact=self.exact)

    def _match(self, chosen: Configuration, wanted: Quarters) -> Match:
        return Match(int(match(self.robot.kinematics, chosen.joints, np.array(wanted))))

    def _report_past_limit(self, request: LocatedMoveRequest, arrival: Configuration) -> None:
        """Report an end past a limit by no more than poses are rounded."""
        found = past_limit(self.robot, request.name, arrival.joints)
        if found is not None:
            self.journal.finding(found, request.place, once=("past limit", request.written))

    def _is_monitored(self, request: LocatedMoveRequest, segment: Segment) -> bool:
        """Whether ConfJ or ConfL is on for a move of an arm whose solutions confdata names.

        The quarter turns at the end of a path that a sensor corrects cannot be predicted.
        """
        if request.request.move.sensed is not SensorInfluence.NEVER:
            return False
        in_joints = segment.geometry is Geometry.JOINT
        monitored = (
            request.request.settings.conf_j if in_joints else request.request.settings.conf_l
        )
        return monitored and has_branches(self.robot.kinematics)

    def _working(self, request: LocatedMoveRequest, segment: Segment) -> tuple[Configuration, ...]:
        """Every configuration at the end of a segment; raises as `working` does."""
        return self.working(self._base_from_flange(request, segment), request.name)

    def _by_stored(
        self, request: LocatedMoveRequest, wanted: Quarters, segment: Segment
    ) -> Sequence[Configuration]:
        """The configurations that reach the end of a segment, nearest to the stored one first."""
        flange = self._base_from_flange(request, segment)
        (found,) = by_stored(self.robot, flange[None], [wanted])
        return found or self._working(request, segment)

    def _base_from_flange(self, request: LocatedMoveRequest, segment: Segment) -> Transform:
        """Pose of the flange at the end of a segment."""
        end, placed = segment.end, request.request.placed
        return placed.base_from_flange(self.robot.kinematics, end.base_from_tcp, end.external)

    def _wrist_circle(
        self, request: LocatedMoveRequest, segment: Segment
    ) -> tuple[Segment, Configuration]:
        """Complete an arc of two wrist axes: its end follows from them, whatever is stored.

        Raises:
            MoveImpossible: If they cannot make it, or not within their limits.
        """
        kinematics, end = self.robot.kinematics, segment.end
        led = wrist_circle_error(kinematics, segment)
        taken = segment.start.joints if led is None else led.arrival
        arrived = replace(segment, end=end_of_circle(replace(end, joints=taken)))
        # Such a failure concerns only this arc; with the corners of its neighbours it would be
        # reported after them, and they start from its end.
        fault = build_path(self.robot, [replace(arrived, zone=None)], MotionModel())
        if isinstance(fault, PathFault):
            violation = fault_violation(fault, request.name)
            way = (request.place, violation, segment, fault.fraction, self.robot)
            self.journal.failed_move(failed_at_fraction(*way))
            raise MoveImpossible(violation)
        for found in () if led is None else findings_on_pair(led, segment, request.name):
            self.journal.finding(found, request.place, once=(found.code, request.written))
        return arrived, self.configuration(taken)

    def _locked(
        self, request: LocatedMoveRequest, arrival: Configuration, segment: Segment
    ) -> Configuration:
        r"""Return the arrival with axis 4 at 0 or half a turn; report the tool's deviation."""
        pose = segment.end.base_from_tcp
        kinematics = self.robot.kinematics
        joints = lock_axis_4(kinematics, pose, segment.tcp_from_flange, arrival.joints)
        if joints is None:
            why = r"with axis 4 locked (SingArea \LockAxis4) the TCP does not get there"
            raise MoveImpossible(UnreachableTarget(request.name, self.robot.title, why))
        taken = request.request.placed.standing_at(kinematics, joints, segment.end.external)
        turn = vector_from_rotation(taken.rotation @ pose.rotation.T)
        self._report_deviation(request, r"\LockAxis4", float(np.linalg.norm(turn)), "at")
        return self.configuration(joints)

    def _report_wrist_deviation(self, request: LocatedMoveRequest, segment: Segment) -> None:
        """Report how far a wrist that turns in joint space takes the tool off its orientation."""
        if self.journal.has_finding(("turned on the way to", request.written)):
            return
        curves, arms = _curve(self.robot, segment)
        x = _ALONG * curves.length[0]
        motion = curves.at(_ROWS, x)
        joints, exists = arms.joints(motion, _ROWS, curves.joints_at(_ROWS, x))
        taken = arms.curve_from_tcp(joints[exists], _ROWS[exists]).rotation
        turn = vector_from_rotation(taken @ np.swapaxes(motion.rotation[exists], -1, -2))
        angle = float(np.linalg.norm(turn, axis=-1).max(initial=0.0))
        locked = request.request.settings.singular_area is SingularArea.LOCK_AXIS_4
        self._report_deviation(
            request, r"\LockAxis4" if locked else r"\Wrist", angle, "on the way to"
        )

    def _report_deviation(
        self, request: LocatedMoveRequest, switch: str, angle: float, location: str
    ) -> None:
        if angle > _TOLD_DEVIATION:
            note = OrientationDeviates(request.name, switch, np.degrees(angle), location)
            self.journal.finding(note, request.place, once=(f"turned {location}", request.written))


def end_of_curve(robot: Robot, segment: Segment) -> Configuration | None:
    """Configuration at the end of a line or arc: the branch of its start, with the turns made.

    Axes that the pose at the end does not determine stay as they arrive. None if that branch does
    not reach the end, or only past a joint limit; the planner then reports where the path fails.
    """
    curves, arms = _curve(robot, segment)
    x = _ALONG * curves.length[0]
    base_from_flange = arms.base_from_flange(curves.at(_ROWS, x), _ROWS, curves.joints_at(_ROWS, x))
    followed = robot.kinematics.inverse_on_branch(
        base_from_flange, segment.branch, segment.start.joints
    )
    joints = followed.joints[-1]
    if not followed.exists[-1] or np.any(pose_excess(robot, joints) != 0.0):
        return None
    return configuration(robot.kinematics, joints)


def _curve(robot: Robot, segment: Segment) -> tuple[Curves, JointMapper]:
    kinematics = robot.kinematics
    curves = curves_of((segment,), kinematics)
    return curves, arms_of((segment,), kinematics, curves.joint_travel, curves.length)


def _in_joints(segment: Segment) -> bool:
    """Whether a segment ends in the chosen configuration instead of one continued along a curve."""
    return segment.geometry is Geometry.JOINT or segment.wrist_in_joints


def _has_axis_4(segment: Segment) -> bool:
    """Whether axis 4 can be locked on a segment: six axes, the wrist in joints."""
    return segment.wrist_in_joints and len(segment.start.joints) > AXIS_4 + 2
