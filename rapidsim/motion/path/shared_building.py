"""Building of one path from the segments of one or more robots, also with carried work objects.

The path of a robot whose work object another carries (`CarrierRobot`) depends on the carrier's
position, which is known from the carrier's path. Paths are therefore built in that order; the
progress of each robot at a value of the common parameter depends only on lengths and stops, and is
known before.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rapidsim.frames.moving_frames import ExternalCourse
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Segment, with_carrier_axes
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import Outline, build_path, outline_of, path_along
from rapidsim.motion.path.curve_following import FaultKind, PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.shared_path import joined, shared_path
from rapidsim.motion.path.shared_progress import MemberProgress, shared_progress
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class CarrierPathAxes:
    """Implementation of `parameterisation.CarrierAxes`: axes of carriers, from their paths."""

    own: MemberProgress
    """Progress of the robot whose work object is carried."""
    leaders: tuple[tuple[Path, MemberProgress], ...]

    def course(self, s: Array, inside: Array) -> ExternalCourse:
        """Return the axes of all carriers (k, l), with derivatives by the s (k,) of this robot."""
        piece = self.own.at_own(inside)[1]
        common, middle = self.own.in_piece(s, piece), self.own.in_piece(inside, piece)
        own_rate, own_bend = self.own.rate(common, piece), self.own.bend[piece]
        columns = []
        for path, progress in self.leaders:
            on = progress.piece_at(middle)
            place = progress.place(common, on)
            rates = path.rates(place, path.layout.piece_at(progress.place(middle, on)))
            rate = progress.rate(common, on) / own_rate
            bend = (progress.bend[on] - rate * own_bend) / own_rate**2
            axes = slice(path.own_axis_count)
            first, second = rates.first[:, axes], rates.second[:, axes]
            columns.append(
                (
                    path.joints_at(place)[:, axes],
                    first * rate[:, None],
                    second * rate[:, None] ** 2 + first * bend[:, None],
                )
            )
        return ExternalCourse(*(np.concatenate(one, axis=1) for one in zip(*columns, strict=True)))

    @property
    def breakpoints(self) -> Array:
        """Positions [m] on this robot's path at which the motion of a carrier is not smooth."""
        common = [self.own.bounds]
        for path, progress in self.leaders:
            common += [progress.bounds, progress.at_own(path.breakpoints)[0]]
        places = np.concatenate(common)
        return self.own.place(places, self.own.piece_at(places))


def build_shared_path(
    robots: Sequence[Robot],
    rows: Sequence[Sequence[Segment]],
    model: MotionModel,
    check_deadline: Look = undisturbed,
) -> Path | PathFault:
    """Join the segments of robots, equally many each, to a path.

    Args:
        robots: The arms.
        rows: The segments of each; `CarrierRobot.number` is an index of these.
        model: Shape of corners.
        check_deadline: Called regularly.

    Returns:
        The path, for a robot alone its own; or the first point where one of the arms cannot follow.
    """
    leaders = [_leaders(row) for row in rows]
    order = _order(leaders)
    if isinstance(order, PathFault):
        return order
    stopping = _stopping(robots, rows, leaders, model, check_deadline) if order else rows
    if isinstance(stopping, PathFault):
        return stopping
    rows = stopping
    paths: dict[int, Path] = {}
    outlines: dict[int, Outline] = {}
    for number, (robot, row) in enumerate(zip(robots, rows, strict=True)):
        found: Path | Outline | PathFault
        if leaders[number]:
            found = outline_of(robot, _wide(row, leaders[number], rows), model, check_deadline)
        else:
            found = build_path(robot, row, model, check_deadline)
        if isinstance(found, PathFault):
            return replace(found, robot=number)
        if isinstance(found, Path):
            paths[number] = found
        else:
            outlines[number] = found
    if not outlines:
        return shared_path(list(paths.values()))
    stops = [_stops(path) for path in paths.values()] + [*map(_led_stops, outlines.values())]
    all_of_them = [paths.get(number) or outlines[number] for number in range(len(rows))]
    progress = shared_progress(
        [one.segments for one in all_of_them],
        [one.segment_bounds for one in all_of_them],
        [one.nominal for one in all_of_them],
        np.any(stops, axis=0),
    )
    for number in order:
        pairs = ((paths[leader], progress.members[leader]) for leader in leaders[number])
        led = CarrierPathAxes(progress.members[number], tuple(pairs))
        path = path_along(outlines[number], check_deadline, led, led.breakpoints)
        if isinstance(path, PathFault):
            return replace(path, robot=number)
        paths[number] = path
    return joined([paths[number] for number in range(len(rows))], progress)


def _leaders(row: Sequence[Segment]) -> tuple[int, ...]:
    """Return the robots that carry work objects of some segments."""
    carriers = (segment.carrier for segment in row if segment.carrier is not None)
    return tuple(sorted({one.robot.number for one in carriers if one.robot is not None}))


def _order(leaders: Sequence[Sequence[int]]) -> list[int] | PathFault:
    """Return the robots with carriers, each after its carriers."""
    order: list[int] = []
    waiting = [number for number, one in enumerate(leaders) if one]
    while waiting:
        ready = [n for n in waiting if not set(leaders[n]) & set(waiting)]
        if not ready:
            circle = PathFault(0, 0.0, 0.0, 0.0, _IN_A_CIRCLE, FaultKind.SET_UP)
            return replace(circle, robot=waiting[0])
        order += ready
        waiting = [number for number in waiting if number not in ready]
    return order


_IN_A_CIRCLE = (
    "robots that carry each other's work objects on one path are not simulated; a stop point "
    "between the moves parts the path"
)


def _wide(
    row: Sequence[Segment], leaders: Sequence[int], rows: Sequence[Sequence[Segment]]
) -> Sequence[Segment]:
    """Return segments with the axes of all robots that carry any of their work objects."""
    if not leaders:
        return row
    columns, count = {}, len(row[0].start.external)
    for number in leaders:
        columns[number] = count
        count += len(rows[number][0].start.joints) + len(rows[number][0].start.external)
    wide = []
    for k, segment in enumerate(row):
        ends = (
            np.concatenate([part for at in points for part in (at.joints, at.external)])
            for points in (
                [rows[number][k].start for number in leaders],
                [rows[number][k].end for number in leaders],
            )
        )
        carrier = segment.carrier
        if carrier is not None and carrier.robot is not None:
            leader = replace(carrier.robot, column=columns[carrier.robot.number])
            segment = replace(segment, carrier=replace(carrier, robot=leader))
        start, end = ends
        wide.append(with_carrier_axes(segment, start, end))
    return wide


def _stopping(
    robots: Sequence[Robot],
    rows: Sequence[Sequence[Segment]],
    leaders: Sequence[Sequence[int]],
    model: MotionModel,
    check_deadline: Look,
) -> Sequence[Sequence[Segment]] | PathFault:
    """Return the segments, with stops of all other robots where one with a carrier has to stop.

    It stops where its programmed point is while the carriers are at their programmed points.
    """
    own = np.zeros((len(rows), len(rows[0]) - 1), dtype=bool)
    for number, row in enumerate(rows):
        if leaders[number]:
            found = outline_of(
                robots[number], _wide(row, leaders[number], rows), model, check_deadline
            )
            if isinstance(found, PathFault):
                return replace(found, robot=number)
            own[number] = _led_stops(found)
    others = own.any(axis=0) & ~own
    return [
        [*map(_stopped, row, stops), row[-1]]
        for row, stops in zip(rows, others.tolist(), strict=True)
    ]


def _stopped(segment: Segment, stops: bool) -> Segment:
    return replace(segment, zone=None) if stops else segment


def _stops(path: Path) -> Mask:
    """Return a mask (segments - 1,) of the stops of a robot on a path."""
    return np.array([corner.stops for corner in path.corners[:-1]], dtype=bool)


def _led_stops(outline: Outline) -> Mask:
    """Return a mask (segments - 1,) of the stops of a robot with carriers; see `Path.stops`."""
    stops = np.ones(len(outline.segments) - 1, dtype=bool)
    stops[outline.active[:-1]] = outline.corners.radius == 0.0
    return stops
