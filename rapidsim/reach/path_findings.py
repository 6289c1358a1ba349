"""Findings about the paths between known moves: failures, speed-limiting axes, zones."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.controller.moves.configuration_choice import conf_text
from rapidsim.controller.moves.motion_findings import fault_violation
from rapidsim.controller.moves.move_data import zone_of
from rapidsim.diagnostics import Diagnostic, Related, Violation
from rapidsim.findings.reach_and_motion_data import CircleUncertain, ConfigurationChangesOnLine
from rapidsim.findings.reachability import (
    AxisSpeedLimits,
    NearSingularity,
    ZeroLengthMove,
    ZoneTooLarge,
)
from rapidsim.frames.transform import Array
from rapidsim.language.moves import Interpolation, SingularArea
from rapidsim.motion.configurations.compliance import Match, match
from rapidsim.motion.configurations.confdata import confdata_of, has_branches
from rapidsim.motion.geometry.curves import circle_fault
from rapidsim.motion.geometry.segment_rows import of_each
from rapidsim.motion.geometry.segments import Geometry, Segment, Waypoint
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_feasibility import SpeedBottleneck, survey_curves
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.wrist_circle import findings_on_pair, wrist_circle_error
from rapidsim.motion.robot.robot import Robot, RobotError
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.reach.arm_configurations import (
    Beginning,
    EndConfigurations,
    EndSolutions,
    is_monitored,
    stances_of,
    stored_confdata,
)
from rapidsim.reach.dataflow.known_moves import KnownMove
from rapidsim.reach.move_segments import segment_of_row, segments_of
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.reach.wording import confdata_fix, target_span, target_text
from rapidsim.repeated_rows import Index
from rapidsim.values import value_class

_SAME_JOINTS = 1e-3
_STANDSTILL = 1e-5
_NO_TURN = 1e-3
_REDUCED = 0.99
_SMALL_ZONE_MM = 1.1
"""Zones up to this size are not reported: z0 and z1 on close points form dense paths."""
_HARDLY = 0.5
"""Share of the programmed speed below which a singularity is a warning."""
_SLOWER = 0.95
_PASSES = 3
_BLOCK = 2000
"""Number of paths that are surveyed at once."""


@dataclass(frozen=True, eq=False)
class SurveyedPaths:
    """Surveyed paths of a program, by row of its moves (k,)."""

    stances: EndConfigurations
    make: Callable[[int], Segment]
    """Returns the segment of a row: few are needed, and each consists of many arrays."""
    is_surveyed: Mask
    travel: Array
    """Path length [m] of the TCP; 0 for rows that were not surveyed."""
    turned: Array
    """Reorientation [rad]."""
    arrival: Array
    """Joints (k, n) [rad] at the end of the path."""
    arrives: Mask
    """Whether these are known."""
    is_broken: Mask
    """The rows whose path cannot be followed to its end."""
    bottlenecks: dict[int, SpeedBottleneck]
    circle_faults: dict[int, str]
    strays: Mapping[int, Array]
    """Joints (n,) [rad] of rows that arrive elsewhere than in the solution for their end alone."""

    @cached_property
    def broken(self) -> frozenset[int]:
        """The rows whose path cannot be followed to its end."""
        return frozenset(np.flatnonzero(self.is_broken).tolist())

    def driven(self, row: int) -> Segment:
        """Return the segment of a path as in a run, with the joints at its end if known."""
        segment = self.make(row)
        if not self.arrives[row]:
            return segment
        return replace(segment, end=replace(segment.end, joints=self.arrival[row]))


@value_class(frozen=True, eq=False)
class PathSurvey:
    """Survey of the paths between the known moves of one program, with its findings."""

    program: Program
    posed: PosedMoves
    ends: EndSolutions
    robot: Robot
    model: MotionModel
    known_joints: Mapping[int, Array]
    """Joints (n,) [rad] of rows that a run has determined."""
    exact: bool = False
    """Whether a stored configuration is not met if an axis is one quarter turn off."""
    beginning: Beginning | None = None
    """Start of a run of main; None if unknown."""
    _max_speed: Array | None = field(init=False)

    def __post_init__(self) -> None:
        """Determine the speed limits of the axes; without them no speed is checked."""
        try:
            speed = limits_of(self.robot, self.model).max_speed[: len(self.robot.joints)]
        except RobotError:
            speed = None
        object.__setattr__(self, "_max_speed", speed)

    def survey(self) -> SurveyedPaths:
        """Survey all lines and arcs whose start is known.

        If a line arrives in a configuration other than its end alone implies, the next path starts
        from there; if it fails, the start of the next is unknown. So the survey is repeated.
        """
        ways, lost = self._surveyed({}, frozenset()), frozenset[int]()
        for _ in range(_PASSES):
            strays = self._strays(ways)
            failing = ways.broken
            if not strays and failing <= lost:
                break
            lost |= failing
            ways = self._surveyed({**ways.strays, **strays}, lost)
        return ways

    def _surveyed(self, strays: Mapping[int, Array], lost: frozenset[int]) -> SurveyedPaths:
        robot, posed, count = self.robot, self.posed, len(self.posed.moves)
        arrivals = {**self.known_joints, **strays}
        stances = stances_of(posed, self.ends, robot, self.model, arrivals, lost, self.beginning)
        ways = SurveyedPaths(
            stances,
            partial(segment_of_row, posed, stances.joints, robot, self.model),
            np.zeros(count, dtype=bool),
            np.zeros(count),
            np.zeros(count),
            np.zeros_like(stances.joints),
            np.zeros(count, dtype=bool),
            np.zeros(count, dtype=bool),
            {},
            {},
            strays,
        )
        rows = np.flatnonzero(self._is_followed(stances))
        for first in range(0, len(rows), _BLOCK):
            self._survey_block(rows[first : first + _BLOCK], ways)
        return ways

    def _is_followed(self, stances: EndConfigurations) -> Mask:
        """Shape (k,): whether a move is a line or arc whose start is known."""
        if not has_branches(self.robot.kinematics):
            return np.zeros(len(self.posed.moves), dtype=bool)
        previous = self.posed.moves.previous
        followed = self.posed.moves.each(
            lambda known: (
                known.move.interpolation.leads_tcp
                and known.settings.singular_area is SingularArea.OFF
                and not {"singular_area", "circle_path"} & known.uncertain
            )
        )
        followed &= (previous >= 0) & stances.sure[previous]
        return followed & self.ends.looked_at & self.ends.reachable

    def _survey_block(self, rows: Index, surveyed: SurveyedPaths) -> None:
        """Survey the paths of some rows."""
        joints, robot = surveyed.stances.joints, self.robot
        segments = segments_of(self.posed, joints, robot, self.model, rows)
        is_sound = np.ones(len(rows), dtype=bool)
        arcs = of_each(segments, lambda segment: segment.geometry is Geometry.ARC)
        for at in np.flatnonzero(arcs).tolist():
            if (fault := circle_fault(segments[at])) is not None:
                surveyed.circle_faults[int(rows[at])] = fault
                is_sound[at] = False
        if not is_sound.all():
            sound = np.flatnonzero(is_sound)
            rows, segments = rows[sound], segments.at(sound)
        if not len(rows):
            return
        found = survey_curves(robot, segments, self._max_speed)
        surveyed.is_surveyed[rows] = True
        surveyed.travel[rows], surveyed.turned[rows] = found.travel, found.turned
        surveyed.arrival[rows], surveyed.arrives[rows] = found.arrival, found.arrives
        surveyed.is_broken[rows] = found.broken
        surveyed.bottlenecks.update((int(rows[at]), one) for at, one in found.bottlenecks.items())

    def _strays(self, surveyed: SurveyedPaths) -> dict[int, Array]:
        """Return joints (n,) [rad] of rows that newly arrive elsewhere than their end implies."""
        arrive = np.flatnonzero(surveyed.arrives & ~surveyed.is_broken & surveyed.stances.sure)
        off = surveyed.arrival[arrive]
        off -= surveyed.stances.joints[arrive]
        rows = arrive[np.abs(off, out=off).max(axis=-1, initial=0.0) > _SAME_JOINTS].tolist()
        return {row: surveyed.arrival[row] for row in rows if row not in surveyed.strays}

    def _requires_stored(self, row: int) -> bool:
        """Whether a move requires a stored configuration in which the arm could arrive."""
        known = self.posed.moves[row]
        return bool(self.ends.on_stored_branch[row]) and is_monitored(known, self.robot)

    def findings(self, surveyed: SurveyedPaths) -> Iterator[Diagnostic]:
        """Yield all findings about the paths."""
        faults: dict[bytes, PathFault | None] = {}
        for row, fault in surveyed.circle_faults.items():
            name = target_text(self.program, self.posed.moves[row])
            yield self._finding(row, CircleUncertain(name, fault))
        zones = self._reduced_zones(surveyed)
        stands = (surveyed.travel < _STANDSTILL) & (surveyed.turned < _NO_TURN)
        of_interest = self._may_have_findings(surveyed) | (stands & surveyed.is_surveyed) | zones
        for row in np.flatnonzero(of_interest).tolist():
            if surveyed.is_broken[row]:
                fault_found = self._fault(row, surveyed, faults)
                if fault_found is not None:
                    yield self._finding(row, fault_found)
                continue
            yield from self._wrist_circle_findings(row, surveyed)
            arrival = surveyed.strays.get(row)
            if arrival is None and surveyed.arrives[row] and not self.ends.stored_works[row]:
                arrival = surveyed.arrival[row]
            if arrival is not None and self._requires_stored(row):
                yield from self._changed(row, arrival)
            bottleneck = surveyed.bottlenecks.get(row)
            if bottleneck is not None and not self._speed_unknown(row):
                held = self._held_up(row, bottleneck)
                if held is not None:
                    yield self._finding(row, held)
            if stands[row] and not self._moves_axes(row):
                name = target_text(self.program, self.posed.moves[row])
                yield self._finding(row, ZeroLengthMove(name))
            if zones[row]:
                yield self._finding(row, self._reduced_zone(row, surveyed))

    def _may_have_findings(self, surveyed: SurveyedPaths) -> Mask:
        """Shape (k,): the surveyed paths that are looked at one by one."""
        asked = self.posed.moves.each(lambda known: is_monitored(known, self.robot))
        found: Mask = asked & self.ends.on_stored_branch & ~self.ends.stored_works
        found &= surveyed.arrives
        found |= self.posed.moves.each(
            lambda known: known.move.interpolation is Interpolation.CIRCLE
        )
        found |= surveyed.is_broken
        found[[*surveyed.strays, *surveyed.bottlenecks]] = True
        found &= surveyed.is_surveyed
        return found

    def _wrist_circle_findings(self, row: int, surveyed: SurveyedPaths) -> Iterator[Diagnostic]:
        """Yield the findings about an arc that two wrist axes orient."""
        if self.posed.moves.like(row).move.interpolation is not Interpolation.CIRCLE:
            return
        segment = surveyed.make(row)
        if segment.wrist_pair is None:
            return
        led = wrist_circle_error(self.robot.kinematics, segment)
        name = target_text(self.program, self.posed.moves[row])
        for violation in () if led is None else findings_on_pair(led, segment, name):
            yield self._finding(row, violation)

    def _finding(self, row: int, violation: Violation) -> Diagnostic:
        known = self.posed.moves[row]
        related: tuple[Related, ...] = ()
        if known.previous is not None and not isinstance(violation, ZoneTooLarge | ZeroLengthMove):
            start = target_span(self.program, self.posed.moves[known.previous])
            related = (Related(start, "the path starts here"),)
        span = target_span(self.program, known)
        return Diagnostic(violation, span, related, routine=known.routine)

    def _moves_axes(self, row: int) -> bool:
        """Whether external axes move."""
        before, external = self.posed.moves[row].previous, self.posed.external
        return before is not None and not np.array_equal(external[before], external[row])

    def _speed_unknown(self, row: int) -> bool:
        return "speed_override_percent" in self.posed.moves[row].uncertain

    @cached_property
    def _by_start(self) -> Index:
        """Shape (k,): rows in the order of the moves at whose ends they start."""
        return np.argsort(self.posed.moves.previous, kind="stable")

    def _following(self, row: int) -> list[int]:
        """Return the moves that start at the end of a move."""
        previous, order = self.posed.moves.previous, self._by_start
        first, stop = (
            int(previous.searchsorted(row, side, sorter=order)) for side in ("left", "right")
        )
        following: list[int] = order[first:stop].tolist()
        return following

    def _fault(
        self, row: int, surveyed: SurveyedPaths, faults: dict[bytes, PathFault | None]
    ) -> Violation | None:
        """Return the fault of a path as in planning; None if corner paths avoid it.

        Turns of a loop often repeat a path: `faults` keeps those of the paths so far.
        """
        segment = surveyed.driven(row)
        around = self._around(row, segment, surveyed)
        # Two paths may have the same around them: each other.
        key = pickle.dumps((segment, around))
        if key not in faults:
            faults[key] = self._built_fault(segment, around)
        fault = faults[key]
        if fault is None:
            return None
        return fault_violation(fault, target_text(self.program, self.posed.moves[row]))

    def _built_fault(self, segment: Segment, around: Sequence[Segment]) -> PathFault | None:
        """Return the fault of a path, unless corner paths between those around it avoid it."""
        fault = build_path(self.robot, [replace(segment, zone=None)], self.model)
        if not isinstance(fault, PathFault):
            return None
        # The wrist must be able to follow the whole arc, as in a run.
        if segment.wrist_pair is not None or len(around) == 1:
            return fault
        linked = [around[0]]
        for one in around[1:]:
            linked.append(
                replace(one, start=Waypoint(linked[-1].end.joints, one.start.base_from_tcp))
            )
        return fault if isinstance(build_path(self.robot, linked, self.model), PathFault) else None

    def _around(self, row: int, segment: Segment, surveyed: SurveyedPaths) -> list[Segment]:
        """Return the path of a row, with those before and after it that have a corner with it."""
        before = int(self.posed.moves.previous[row])
        around = [segment]
        if surveyed.is_surveyed[before] and surveyed.make(before).zone:
            around.insert(0, surveyed.driven(before))
        after = [one for one in self._following(row) if surveyed.is_surveyed[one]]
        if segment.zone is not None and len(after) == 1:
            around.append(surveyed.driven(after[0]))
        return around

    def _changed(self, row: int, arrival: Array) -> Iterator[Diagnostic]:
        """K606: a line that arrives in another configuration than the stored one."""
        known, kinematics = self.posed.moves[row], self.robot.kinematics
        stored = stored_confdata(self.posed.moves, row)
        how = Match(int(match(kinematics, arrival, np.array(stored))))
        if how.meets(exact=self.exact):
            return
        arrives = conf_text(confdata_of(kinematics, arrival).tolist())
        goes_on = how is Match.TURNED and not self.exact
        name = target_text(self.program, known)
        found = ConfigurationChangesOnLine(name, conf_text(stored), arrives, goes_on)
        fix = confdata_fix(self.program, known, arrives)
        yield replace(self._finding(row, found), fix=fix)

    def _held_up(self, row: int, hold_up: SpeedBottleneck) -> Violation | None:
        known = self.posed.moves[row]
        name = target_text(self.program, known)
        if hold_up.singularity is not None and hold_up.share < _HARDLY:
            return NearSingularity(
                name,
                hold_up.singularity,
                100.0 * hold_up.fraction,
                hold_up.axis,
                100.0 * hold_up.share,
            )
        if hold_up.share > _SLOWER:
            return None
        programmed = known.move.speed.v_tcp * known.settings.speed_share
        return AxisSpeedLimits(
            name, hold_up.axis, programmed, hold_up.share * programmed, 100.0 * hold_up.fraction
        )

    def _travel_after(self, surveyed: SurveyedPaths) -> Array:
        """Shape (k,): shortest surveyed path [m] that starts at an end; infinite without one."""
        rows = np.flatnonzero(surveyed.is_surveyed)
        after = np.full(len(surveyed.travel), np.inf)
        np.minimum.at(after, self.posed.moves.previous[rows], surveyed.travel[rows])
        return after

    def _reduced_zones(self, surveyed: SurveyedPaths) -> Mask:
        """Shape (k,): the surveyed paths that are too short for their zones."""
        size = self.posed.moves.each(_zone_size, np.float64)
        after = self._travel_after(surveyed)
        length = np.minimum(surveyed.travel, after)
        reduced: Mask = (length >= _STANDSTILL) & (0.5 * length < _REDUCED * size)
        return reduced & surveyed.is_surveyed & ~surveyed.is_broken & np.isfinite(after)

    def _reduced_zone(self, row: int, surveyed: SurveyedPaths) -> ZoneTooLarge:
        size = _zone_size(self.posed.moves.like(row))
        after = [one for one in self._following(row) if surveyed.is_surveyed[one]]
        sides = (surveyed.travel[row], "before"), (surveyed.travel[after].min(), "after")
        length, which = min((float(travel), side) for travel, side in sides)
        return ZoneTooLarge(1e3 * size, 1e3 * length, which, 500.0 * length)


def _zone_size(known_move: KnownMove) -> float:
    """Size [m] of the zone at the end of a move; 0 if it is small, or there is none."""
    move = known_move.move
    zone = None if move.zone.pzone_tcp <= _SMALL_ZONE_MM else zone_of(move)
    return 0.0 if zone is None else zone.position
