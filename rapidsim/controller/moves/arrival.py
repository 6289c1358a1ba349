"""The configuration at the end of a move to a pose, with the turns of its axes.

With ConfJ or ConfL on the controller stops at a stored configuration that the arm cannot take. So
does a run, unless it is told to take the nearest that works: programs are often run against another
work object than they were taught with, and the rest of them is worth seeing. What meets a stored
configuration is decided in `motion.configurations.compliance`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rapidsim.controller.journal.failed_moves import failed_on_the_way, refused_move
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
    rounded,
    stored_or_nearest,
    taken_instead,
)
from rapidsim.controller.moves.first_start import first_configuration
from rapidsim.controller.moves.motion_findings import fault_violation, switched, wrist_turning_far
from rapidsim.controller.moves.move_request import AskedMove, NotReachableError
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
from rapidsim.language.moves import Place, Sensed, SingularArea
from rapidsim.motion.configurations.compliance import TOLERATED_QUARTERS, Match, hold, match
from rapidsim.motion.configurations.confdata import (
    Configuration,
    configuration,
    configurations,
    named,
    told_apart,
)
from rapidsim.motion.configurations.reach_cures import reason_with_lengths
from rapidsim.motion.configurations.reachability import pose_excess, why_unreachable
from rapidsim.motion.configurations.wrist_lock import AXIS_4, lock_axis_4
from rapidsim.motion.geometry.curves import Curves, circle_fault, curves_of
from rapidsim.motion.geometry.joint_mapping import Arms, arms_of
from rapidsim.motion.geometry.segments import Geometry, Segment, Waypoint
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.wrist_circle import end_of_circle, findings_on_pair, led_by_pair
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import dataclass

CURVE_SAMPLES = 33
"""Poses along a line or arc at which joint turns are followed to its end."""
_ALONG = np.linspace(0.0, 1.0, CURVE_SAMPLES)
_ROWS = np.zeros(CURVE_SAMPLES, dtype=np.int64)
_TOLD_DEVIATION = np.radians(0.5)


@dataclass(frozen=True, slots=True)
class Arrivals:
    """Finds how a robot stands at the ends of its moves."""

    robot: Robot
    journal: Journal
    takes_nearest: bool = False
    """Whether a stored configuration that does not work gives way to the nearest that does."""
    exact: bool = False
    """Whether a stored configuration is not met where cf1, cf4 or cf6 is one quarter turn off."""

    def of(
        self, asked: AskedMove, stored: ConfData, segment: Segment, *, is_short: bool
    ) -> tuple[Segment, Configuration]:
        """A segment to a pose with the joints of its end.

        Args:
            asked: The move.
            stored: The configuration in its target.
            segment: Ends at the pose.
            is_short: It is a short line, and the joints of its end are those it arrives with; else
                they do not count.

        Raises:
            NotReachableError: When the end cannot be reached.
            MoveImpossible: When an arc defines no circle, or the end cannot be reached as stored.
        """
        if segment.wrist_pair is not None and circle_fault(segment) is None:
            return self._led(asked, segment)
        try:
            self._require_circle(asked, segment)
            if is_short:
                arrival = self.configuration(segment.end.joints)
            else:
                arrival = self._chosen(asked, stored, segment)
            self._hold_to_stored(asked, stored, segment, arrival)
            if not is_short:
                self._tell_far_turn(asked, segment, arrival)
                self._tell_past_limit(asked, arrival)
            area = asked.request.settings.singular_area
            if area is SingularArea.LOCK_AXIS_4 and _has_axis_4(segment):
                arrival = self._locked(asked, arrival, segment)
        except (NotReachableError, MoveImpossible) as refused:
            if segment.carrier is None:
                violation = refused.violation
                self.journal.failed_move(refused_move(asked.place, violation, segment, self.robot))
            raise
        if is_short:
            return segment, arrival
        pose, external = segment.end.base_from_tcp, segment.end.external
        if segment.wrist_in_joints:
            pose = asked.request.placed.standing_at(self.robot.kinematics, arrival.joints, external)
        arrived = replace(segment, end=Waypoint(arrival.joints, pose, external))
        if segment.wrist_in_joints:
            self._tell_turn_on_the_way(asked, arrived)
        return arrived, arrival

    def configuration(self, joints: Array) -> Configuration:
        """A joint vector (n,) [rad] with its confdata."""
        return configuration(self.robot.kinematics, joints)

    def working(self, base_from_flange: Transform, name: str) -> tuple[Configuration, ...]:
        """Every configuration that reaches a pose.

        Raises:
            NotReachableError: When there is none.
        """
        working = configurations(self.robot, base_from_flange)
        if working:
            return working
        why = why_unreachable(self.robot, base_from_flange)
        assert why is not None
        errno = ERR_OUTSIDE_REACH if why.joint is None else ERR_ROBLIMIT
        reason = reason_with_lengths(self.robot, base_from_flange, why)
        raise NotReachableError(errno, UnreachableTarget(name, self.robot.title, reason))

    def at_target(
        self, base_from_flange: Transform, target: str, stored: ConfData, near: Array, place: Place
    ) -> Configuration:
        """How the arm would stand at a target without moving there, by the rules of moves.

        Raises:
            NotReachableError: When it cannot, and the nearest is not taken.
        """
        if not told_apart(self.robot.kinematics):
            return stored_or_nearest(self.working(base_from_flange, target), stored, near)
        wanted = rounded(stored)
        held = self._held(base_from_flange, wanted, near)
        chosen = held or stored_or_nearest(self.working(base_from_flange, target), stored, near)
        if held is not None and self._meets(held, wanted):
            return held
        found = self._not_as_stored(target, base_from_flange, wanted, held)
        if not (found.goes_on or self.takes_nearest):
            raise NotReachableError(ERR_ROBLIMIT, found)
        key = ("configuration", place.span)
        self.journal.finding(found, place, once=key, assumed=True)
        return chosen

    def _require_circle(self, asked: AskedMove, segment: Segment) -> None:
        fault = circle_fault(segment)
        if fault is not None:
            raise MoveImpossible(CircleUncertain(asked.name, fault))
        if len(segment.end.external):
            wide = np.concatenate([segment.start.joints, segment.end.external])
            over = excess_text(self.robot, wide)
            if over:
                raise MoveImpossible(JointOutOfRange(asked.name, self.robot.title, over))

    def _chosen(self, asked: AskedMove, stored: ConfData, segment: Segment) -> Configuration:
        """The configuration as stored, where that works; else the nearest."""
        near = segment.start.joints
        if not _in_joints(segment):
            arrived = self._end_of_curve(segment)
            return arrived or nearest(self._working(asked, segment), near)
        if not self._is_monitored(asked, segment):
            if asked.starts_free and told_apart(self.robot.kinematics):
                flange = self._base_from_flange(asked, segment)
                wanted = rounded(stored)
                first = first_configuration(self.robot, flange, wanted, near, monitored=False)
                if first is not None:
                    return first
            before = self.configuration(near)
            chosen = nearest_without_switch(self._working(asked, segment), before)
            self._tell_switch(asked, segment, before, chosen)
            return chosen
        wanted, flange = rounded(stored), self._base_from_flange(asked, segment)
        return self._held(flange, wanted, near) or self._by_stored(asked, wanted, segment)[0]

    def _held(
        self, base_from_flange: Transform, wanted: Quarters, near: Array
    ) -> Configuration | None:
        """The configuration that holds best to a stored one, on its branch; None if none can."""
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
        held: Configuration | None,
    ) -> ConfigurationNotReachable:
        """Why a target is not reached as stored; a run goes on with what holds to its branch."""
        if held is not None and not self.exact:
            (working,) = by_stored(self.robot, base_from_flange[None], [wanted])
            return taken_instead(target, wanted, held, working)
        (found,) = not_as_stored(self.robot, base_from_flange[None], [wanted], [target])
        return found

    def _tell_switch(
        self, asked: AskedMove, segment: Segment, before: Configuration, chosen: Configuration
    ) -> None:
        """Report a joint move that switches the configuration of the main axes."""
        key = ("main axes", asked.written)
        is_told = segment.geometry is Geometry.JOINT and not asked.is_first
        is_told &= told_apart(self.robot.kinematics) and is_switch(before, chosen)
        if not is_told or self.journal.has_found(key):
            return
        flange = self._base_from_flange(asked, segment)
        found = switched(asked.name, self.robot, flange, before, chosen)
        self.journal.finding(found, asked.place, once=key)

    def _tell_far_turn(self, asked: AskedMove, segment: Segment, arrival: Configuration) -> None:
        """Report a line or arc on which a wrist axis turns so far that a controller may stop."""
        if _in_joints(segment) or not self._is_monitored(asked, segment):
            return
        found = wrist_turning_far(asked.name, segment.start.joints, arrival.joints)
        if found is not None:
            self.journal.finding(found, asked.place, once=("wrist turns", asked.written))

    def _hold_to_stored(
        self, asked: AskedMove, stored: ConfData, segment: Segment, chosen: Configuration
    ) -> None:
        """Stop the run, or report it, where a controller would stop: at another configuration.

        Raises:
            MoveImpossible: When the nearest is not to be taken.
        """
        wanted = rounded(stored)
        if not self._is_monitored(asked, segment):
            return
        if self._meets(chosen, wanted):
            return
        key = ("configuration", asked.written)
        if self.takes_nearest and self.journal.has_found(key):
            return
        flange = self._base_from_flange(asked, segment)
        held = self._held(flange, wanted, segment.start.joints)
        found: ConfigurationNotReachable | ConfigurationChangesOnLine | None
        if _in_joints(segment):
            found = self._not_as_stored(asked.name, flange, wanted, held)
        else:
            found = self._misses_on_curve(asked, segment, wanted, held, chosen)
        if found is None:
            return
        if not (found.goes_on or self.takes_nearest):
            raise MoveImpossible(found)
        self.journal.finding(found, asked.place, once=key, assumed=True)

    def _misses_on_curve(
        self,
        asked: AskedMove,
        segment: Segment,
        wanted: Quarters,
        held: Configuration | None,
        arrival: Configuration,
    ) -> ConfigurationNotReachable | ConfigurationChangesOnLine | None:
        """What is wrong with the arrival of a line or arc; None if planning says where it fails."""
        if held is None or (self.exact and self._match(held, wanted) is not Match.EXACT):
            return self._not_as_stored(
                asked.name, self._base_from_flange(asked, segment), wanted, None
            )
        if self._end_of_curve(segment) is None:
            return None
        goes_on = self._match(arrival, wanted) is Match.TURNED and not self.exact
        arrives = conf_text(arrival.confdata)
        return ConfigurationChangesOnLine(asked.name, conf_text(wanted), arrives, goes_on)

    def _meets(self, chosen: Configuration, wanted: Quarters) -> bool:
        """Whether a configuration meets a stored one."""
        return chosen.confdata == wanted or self._match(chosen, wanted).meets(exact=self.exact)

    def _match(self, chosen: Configuration, wanted: Quarters) -> Match:
        return Match(int(match(self.robot.kinematics, chosen.joints, np.array(wanted))))

    def _tell_past_limit(self, asked: AskedMove, arrival: Configuration) -> None:
        """Report an end past a limit by no more than poses are rounded."""
        found = past_limit(self.robot, asked.name, arrival.joints)
        if found is not None:
            self.journal.finding(found, asked.place, once=("past limit", asked.written))

    def _is_monitored(self, asked: AskedMove, segment: Segment) -> bool:
        """Whether ConfJ or ConfL is on for a move of an arm whose solutions confdata names.

        Nobody knows beforehand in which quarter turns a path ends that a sensor corrects.
        """
        if asked.request.move.sensed is not Sensed.NEVER:
            return False
        in_joints = segment.geometry is Geometry.JOINT
        monitored = asked.request.settings.conf_j if in_joints else asked.request.settings.conf_l
        return monitored and told_apart(self.robot.kinematics)

    def _working(self, asked: AskedMove, segment: Segment) -> tuple[Configuration, ...]:
        """Every configuration at the end of a segment; raises as `working` does."""
        return self.working(self._base_from_flange(asked, segment), asked.name)

    def _by_stored(
        self, asked: AskedMove, wanted: Quarters, segment: Segment
    ) -> Sequence[Configuration]:
        """The configurations that reach the end of a segment, nearest to the stored one first."""
        flange = self._base_from_flange(asked, segment)
        (found,) = by_stored(self.robot, flange[None], [wanted])
        return found or self._working(asked, segment)

    def _base_from_flange(self, asked: AskedMove, segment: Segment) -> Transform:
        """Where the flange has to be at the end of a segment."""
        end, placed = segment.end, asked.request.placed
        return placed.base_from_flange(self.robot.kinematics, end.base_from_tcp, end.external)

    def _end_of_curve(self, segment: Segment) -> Configuration | None:
        """Where a line or arc arrives: on the branch it starts on, with the turns made on the way.

        None where that branch does not get there, or only past a joint limit; the planner then says
        where the path fails.
        """
        curves, arms = self._curve(segment)
        x = _ALONG * curves.length[0]
        base_from_flange = arms.base_from_flange(
            curves.at(_ROWS, x), _ROWS, curves.joints_at(_ROWS, x)
        )
        followed = self.robot.kinematics.inverse_on_branch(
            base_from_flange, segment.branch, segment.start.joints
        )
        joints = followed.joints[-1]
        if not followed.exists[-1] or np.any(pose_excess(self.robot, joints) != 0.0):
            return None
        return self.configuration(joints)

    def _curve(self, segment: Segment) -> tuple[Curves, Arms]:
        kinematics = self.robot.kinematics
        curves = curves_of((segment,), kinematics)
        return curves, arms_of((segment,), kinematics, curves.joint_travel, curves.length)

    def _led(self, asked: AskedMove, segment: Segment) -> tuple[Segment, Configuration]:
        """An arc that two wrist axes lead: it ends where they take the tool, whatever is stored.

        Raises:
            MoveImpossible: Where they cannot, or not within their limits.
        """
        kinematics, end = self.robot.kinematics, segment.end
        led = led_by_pair(kinematics, segment)
        taken = segment.start.joints if led is None else led.arrival
        arrived = replace(segment, end=end_of_circle(replace(end, joints=taken)))
        # Such a failure is of this arc alone; with the corners of its neighbours it would be told
        # only after they have been looked at, and they start from where it ends.
        fault = build_path(self.robot, [replace(arrived, zone=None)], MotionModel())
        if isinstance(fault, PathFault):
            violation = fault_violation(fault, asked.name)
            way = (asked.place, violation, segment, fault.fraction, self.robot)
            self.journal.failed_move(failed_on_the_way(*way))
            raise MoveImpossible(violation)
        for found in () if led is None else findings_on_pair(led, segment, asked.name):
            self.journal.finding(found, asked.place, once=(found.code, asked.written))
        return arrived, self.configuration(taken)

    def _locked(self, asked: AskedMove, arrival: Configuration, segment: Segment) -> Configuration:
        r"""The arrival with axis 4 at 0 or half a turn; tells how far that turns the tool."""
        pose = segment.end.base_from_tcp
        kinematics = self.robot.kinematics
        joints = lock_axis_4(kinematics, pose, segment.tcp_from_flange, arrival.joints)
        if joints is None:
            why = r"with axis 4 locked (SingArea \LockAxis4) the TCP does not get there"
            raise MoveImpossible(UnreachableTarget(asked.name, self.robot.title, why))
        taken = asked.request.placed.standing_at(kinematics, joints, segment.end.external)
        turn = vector_from_rotation(taken.rotation @ pose.rotation.T)
        self._tell_turn(asked, r"\LockAxis4", float(np.linalg.norm(turn)), "at")
        return self.configuration(joints)

    def _tell_turn_on_the_way(self, asked: AskedMove, segment: Segment) -> None:
        """Report how far a wrist that turns in joint space takes the tool off its orientation."""
        if self.journal.has_found(("turned on the way to", asked.written)):
            return
        curves, arms = self._curve(segment)
        x = _ALONG * curves.length[0]
        motion = curves.at(_ROWS, x)
        joints, exists = arms.joints(motion, _ROWS, curves.joints_at(_ROWS, x))
        taken = arms.curve_from_tcp(joints[exists], _ROWS[exists]).rotation
        turn = vector_from_rotation(taken @ np.swapaxes(motion.rotation[exists], -1, -2))
        angle = float(np.linalg.norm(turn, axis=-1).max(initial=0.0))
        locked = asked.request.settings.singular_area is SingularArea.LOCK_AXIS_4
        self._tell_turn(asked, r"\LockAxis4" if locked else r"\Wrist", angle, "on the way to")

    def _tell_turn(self, asked: AskedMove, switch: str, angle: float, where: str) -> None:
        if angle > _TOLD_DEVIATION:
            note = OrientationDeviates(asked.name, switch, np.degrees(angle), where)
            self.journal.finding(note, asked.place, once=(f"turned {where}", asked.written))


def _in_joints(segment: Segment) -> bool:
    """Whether a segment ends in the configuration that is chosen, not where its way leads."""
    return segment.geometry is Geometry.JOINT or segment.wrist_in_joints


def _has_axis_4(segment: Segment) -> bool:
    """Whether axis 4 can be locked on a segment: six axes, the wrist in joints."""
    return segment.wrist_in_joints and len(segment.start.joints) > AXIS_4 + 2
