"""From a move instruction to a segment: targets to joints, in the configuration that is meant.

The controller wants the stored configuration exactly when ConfJ or ConfL is on, and stops when it
does not work. We take the nearest that works and say so once for each target: programs are often
run against another work object than they were taught with, and the rest of them is worth seeing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rapidsim.diagnostics import Violation
from rapidsim.frames.quaternion import norm
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.controller import Interpolation, MotionSettings, Move, Place
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    ConfData,
    JointTarget,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.error_numbers import ERR_OUTSIDE_REACH, ERR_ROBLIMIT
from rapidsim.language.errors import RapidError
from rapidsim.motion import targets
from rapidsim.motion.confdata import Configuration, confdata_of, configurations, told_apart
from rapidsim.motion.curves import circle_fault, curves_of
from rapidsim.motion.reach import limit_excess, why_unreachable
from rapidsim.motion.robot import Robot
from rapidsim.motion.segments import Geometry, Segment, Speed, Waypoint, Zone
from rapidsim.motion.violations import (
    CircleUncertain,
    ConfigurationNotReachable,
    JointOutOfRange,
    QuaternionNotUnit,
    UnreachableTarget,
)
from rapidsim.simulation.journal import Instant, Journal
from rapidsim.simulation.path_queue import QueuedMove
from rapidsim.simulation.result import CornerKind

CURVE_SAMPLES = 33
"""Poses along a line or arc by which the whole turns of the joints are followed to its end."""


class MoveRefusedError(RapidError):
    """A move whose end cannot be reached, with the finding that says why."""

    def __init__(self, errno: float, violation: Violation) -> None:
        """Carry the finding along."""
        super().__init__(errno, violation.message, cf=violation.cf)
        self.violation = violation


@dataclass(frozen=True, slots=True)
class Resolver:
    """Resolves the moves of one robot."""

    robot: Robot
    journal: Journal
    base_from_world: Transform

    def resolve(
        self, move: Move, place: Place, start: Waypoint, settings: MotionSettings
    ) -> QueuedMove:
        """Work out where a move goes.

        Raises:
            RapidError: When the end cannot be reached, or the set-up is not simulated.
        """
        name = place.arguments.get("topoint", place.arguments.get("tojointpos", move.instruction))
        tcp_from_flange = targets.tcp_from_flange(move.tool)
        start = Waypoint(start.joints, self.robot.forward(start.joints) @ tcp_from_flange.inverse())
        if isinstance(move.to, JointTarget):
            joints = self._axes(move.to, name)
            end = Waypoint(joints, self.robot.forward(joints) @ tcp_from_flange.inverse())
        else:
            # Until the way there is known, its end stands in the joints of its start.
            base_from_tcp = self._pose(move.to, move.tool, move.wobj, name, place)
            end = Waypoint(start.joints, base_from_tcp)
        segment = Segment(
            index=0,
            geometry=_GEOMETRY[move.interpolation],
            start=start,
            end=end,
            tcp_from_flange=tcp_from_flange,
            branch=int(self.robot.kinematics.branch_of(start.joints)),
            speed=_speed(move, settings),
            zone=_zone(move),
            via=self._via(move, name, place),
            duration=move.duration_s,
            acceleration_share=settings.acceleration_percent / 100.0,
        )
        if isinstance(move.to, RobTarget):
            arrival = self._arrival(move, move.to, name, place, segment, settings)
            segment = replace(segment, end=Waypoint(arrival.joints, end.base_from_tcp))
        else:
            arrival = self._configuration(end.joints)
        conf = ConfData(*map(float, arrival.confdata))
        corner = CornerKind.STOP if segment.zone is None else CornerKind.FLY_BY
        return QueuedMove(move, place, segment, conf, Instant(), corner)

    def joints(self, target: JointTarget) -> Array:
        """Axis positions [deg] as joints (n,) [rad]."""
        return targets.joints(target, len(self.robot.joints))

    def target(self, joints: Array, tool: ToolData, wobj: WobjData) -> RobTarget:
        """The target that a joint vector (n,) [rad] stands at."""
        base_from_tcp = self.robot.forward(joints) @ targets.transform(tool.tframe)
        base_from_object = targets.base_from_object(wobj, self.base_from_world)
        pose = targets.pose(base_from_object.inverse() @ base_from_tcp)
        conf = ConfData(*map(float, self._configuration(joints).confdata))
        return RobTarget(pose.trans, pose.rot, conf, NO_EXTERNAL_AXES)

    def reach(self, target: RobTarget, tool: ToolData, wobj: WobjData, near: Array) -> Array:
        """Joints (n,) [rad] of a target in its configuration, or the nearest that works.

        Raises:
            RapidError: ERR_OUTSIDE_REACH or ERR_ROBLIMIT.
        """
        base_from_tcp = targets.base_from_tcp(target, wobj, self.base_from_world)
        base_from_flange = base_from_tcp @ targets.tcp_from_flange(tool)
        working = self._working(base_from_flange, "the target")
        return _choice(working, target.robconf, near).joints

    def _pose(
        self, target: RobTarget, tool: ToolData, wobj: WobjData, name: str, place: Place
    ) -> Transform:
        """Where a target puts the TCP, after checks of frames and orientation."""
        refused = targets.unsupported(tool, wobj)
        if refused is not None:
            raise RapidError(ERR_OUTSIDE_REACH, refused.reason)
        length = norm(target.rot)
        error = abs(length - 1.0)
        if error > targets.TOLERATED_NORM_ERROR:
            violation = QuaternionNotUnit(name, length)
            if error > targets.REFUSED_NORM_ERROR:
                raise MoveRefusedError(ERR_OUTSIDE_REACH, violation)
            self.journal.finding(violation, place, once=("norm", name))
        return targets.base_from_tcp(target, wobj, self.base_from_world)

    def _axes(self, target: JointTarget, name: str) -> Array:
        """The joints of an axis target, within their limits."""
        joints = self.joints(target)
        excess = limit_excess(self.robot, joints)
        if np.any(excess != 0.0):
            over = ", ".join(
                f"axis {i + 1} at {np.degrees(joints[i]):.1f} deg, "
                f"{np.degrees(abs(excess[i])):.1f} deg past its limit"
                for i in np.flatnonzero(excess)
            )
            raise MoveRefusedError(ERR_ROBLIMIT, JointOutOfRange(name, self.robot.title, over))
        return joints

    def _arrival(
        self,
        move: Move,
        to: RobTarget,
        name: str,
        place: Place,
        segment: Segment,
        settings: MotionSettings,
    ) -> Configuration:
        """How the arm stands after a move to a pose: as stored, where that works."""
        fault = circle_fault(segment)
        if fault is not None:
            raise MoveRefusedError(ERR_OUTSIDE_REACH, CircleUncertain(name, fault))
        base_from_flange = segment.end.base_from_tcp @ segment.tcp_from_flange
        near, stored = segment.start.joints, to.robconf
        wanted = _rounded(stored)
        if move.interpolation is Interpolation.JOINT:
            monitored = settings.conf_j and told_apart(self.robot.kinematics)
            working = self._working(base_from_flange, name)
            chosen = _choice(working, stored, near) if monitored else _nearest(working, near)
        else:
            monitored = settings.conf_l and told_apart(self.robot.kinematics)
            arrived = self._end_of_curve(segment)
            chosen = arrived or _nearest(self._working(base_from_flange, name), near)
        key = ("configuration", name)
        if monitored and chosen.confdata != wanted and not self.journal.has_found(key):
            working = self._working(base_from_flange, name)
            self.journal.finding(
                ConfigurationNotReachable(
                    name,
                    _conf_text(wanted),
                    _conf_text(chosen.confdata),
                    tuple(_conf_text(c.confdata) for c in _by_distance(working, chosen.joints)),
                ),
                place,
                once=key,
            )
        return chosen

    def _end_of_curve(self, segment: Segment) -> Configuration | None:
        """Where a line or arc arrives: on the branch it starts on, with the turns made on the way.

        None where that branch does not get there, or only past a joint limit; the planner then says
        where the path fails.
        """
        kinematics = self.robot.kinematics
        curves = curves_of((segment,), kinematics)
        rows = np.zeros(CURVE_SAMPLES, dtype=np.int64)
        motion = curves.at(rows, np.linspace(0.0, float(curves.length[0]), CURVE_SAMPLES))
        base_from_flange = Transform(motion.rotation, motion.position) @ segment.tcp_from_flange
        followed = kinematics.inverse_on_branch(
            base_from_flange, segment.branch, segment.start.joints
        )
        if not followed.exists[-1]:
            return None
        joints = followed.joints[-1]
        if np.any(limit_excess(self.robot, joints) != 0.0):
            return None
        return self._configuration(joints)

    def _configuration(self, joints: Array) -> Configuration:
        """A joint vector (n,) [rad] with its confdata."""
        cf1, cf4, cf6, cfx = confdata_of(self.robot.kinematics, joints).tolist()
        return Configuration(joints, (cf1, cf4, cf6, cfx))

    def _working(self, base_from_flange: Transform, name: str) -> tuple[Configuration, ...]:
        """Every configuration that reaches a pose.

        Raises:
            MoveRefusedError: When there is none.
        """
        working = configurations(self.robot, base_from_flange)
        if working:
            return working
        why = why_unreachable(self.robot, base_from_flange)
        assert why is not None
        errno = ERR_OUTSIDE_REACH if why.joint is None else ERR_ROBLIMIT
        raise MoveRefusedError(errno, UnreachableTarget(name, self.robot.title, why.message))

    def _via(self, move: Move, name: str, place: Place) -> Transform | None:
        if move.circle_point is None:
            return None
        return self._pose(move.circle_point, move.tool, move.wobj, name, place)


_GEOMETRY = {
    Interpolation.JOINT: Geometry.JOINT,
    Interpolation.AXES: Geometry.JOINT,
    Interpolation.LINE: Geometry.LINE,
    Interpolation.CIRCLE: Geometry.ARC,
}


def _speed(move: Move, settings: MotionSettings) -> Speed:
    """Programmed speeds with VelSet applied, in SI."""
    share = settings.speed_override_percent / 100.0
    tcp_mm_s = move.speed.v_tcp * share
    if settings.max_speed_mm_s is not None:
        tcp_mm_s = min(tcp_mm_s, settings.max_speed_mm_s)
    return Speed(tcp_mm_s * targets.MM, float(np.radians(move.speed.v_ori * share)))


def _zone(move: Move) -> Zone | None:
    """The zone of a fly-by point in SI; None at a stop point."""
    zone = move.zone
    if zone.finep:
        return None
    return Zone(
        position=zone.pzone_tcp * targets.MM,
        orientation=max(zone.pzone_ori, zone.pzone_tcp) * targets.MM,
        angle=float(np.radians(zone.zone_ori)),
    )


def _choice(working: Sequence[Configuration], stored: ConfData, near: Array) -> Configuration:
    """The stored configuration if it works, else the nearest on its branch, else the nearest."""
    wanted = _rounded(stored)
    for candidate in working:
        if candidate.confdata == wanted:
            return candidate
    same_branch = [candidate for candidate in working if candidate.confdata[3] == wanted[3]]
    return _nearest(same_branch or working, near)


def _nearest(working: Sequence[Configuration], near: Array) -> Configuration:
    """The configuration whose furthest-moving joint moves least."""
    return _by_distance(working, near)[0]


def _by_distance(working: Sequence[Configuration], near: Array) -> list[Configuration]:
    return sorted(working, key=lambda candidate: float(np.max(np.abs(candidate.joints - near))))


def _rounded(conf: ConfData) -> tuple[int, int, int, int]:
    return round(conf.cf1), round(conf.cf4), round(conf.cf6), round(conf.cfx)


def _conf_text(conf: tuple[int, int, int, int]) -> str:
    return f"[{','.join(map(str, conf))}]"
