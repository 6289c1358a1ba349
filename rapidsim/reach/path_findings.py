"""Findings about the paths between known moves: failures, speed-limiting axes, zones."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import partial

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
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_feasibility import SpeedBottleneck, SurveyedCurve, survey_curves
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
from rapidsim.reach.move_segments import segments_of
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.reach.wording import confdata_fix, target_span, target_text
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


class _Segments(Mapping[int, Segment]):
    """Segments of rows, created on access: few are used, and each consists of many arrays."""

    def __init__(
        self, rows: Mapping[int, object], make: Callable[[Sequence[int]], tuple[Segment, ...]]
    ) -> None:
        self._rows = rows
        self._make = make

    def __getitem__(self, row: int) -> Segment:
        if row not in self._rows:
            raise KeyError(row)
        return self._make([row])[0]

    def __iter__(self) -> Iterator[int]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def __contains__(self, row: object) -> bool:
        return row in self._rows


@value_class(frozen=True, slots=True, eq=False)
class SurveyedPaths:
    """Surveyed paths of a program, by row of its moves."""

    stances: EndConfigurations
    segments: Mapping[int, Segment]
    surveyed: Mapping[int, SurveyedCurve]
    circle_faults: Mapping[int, str]
    strays: Mapping[int, Array]
    """Joints (n,) [rad] of rows that arrive elsewhere than in the solution for their end alone."""

    @property
    def broken(self) -> frozenset[int]:
        """The rows whose path cannot be followed to its end."""
        return frozenset(row for row, way in self.surveyed.items() if way.broken)

    def driven(self, row: int) -> Segment:
        """Return the segment of a path as in a run, with the joints at its end if known."""
        segment, way = self.segments[row], self.surveyed[row]
        if way.arrival is None:
            return segment
        return replace(segment, end=replace(segment.end, joints=way.arrival))


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
            strays = {
                row: way.arrival
                for row, way in ways.surveyed.items()
                if way.arrival is not None and self._strays(row, way, ways)
            }
            failing = ways.broken
            if not strays and failing <= lost:
                break
            lost |= failing
            ways = self._surveyed({**ways.strays, **strays}, lost)
        return ways

    def _surveyed(self, strays: Mapping[int, Array], lost: frozenset[int]) -> SurveyedPaths:
        robot = self.robot
        arrivals = {**self.known_joints, **strays}
        stances = stances_of(
            self.posed, self.ends, robot, self.model, arrivals, lost, self.beginning
        )
        if not has_branches(robot.kinematics):
            return SurveyedPaths(stances, {}, {}, {}, strays)
        rows = [
            row
            for row, known in enumerate(self.posed.moves)
            if known.move.interpolation.leads_tcp
            and known.previous is not None
            and stances.sure[known.previous]
            and self.ends.looked_at[row]
            and self.ends.reachable[row]
            and known.settings.singular_area is SingularArea.OFF
            and not {"singular_area", "circle_path"} & known.uncertain
        ]
        make = partial(segments_of, self.posed, stances.joints, robot, self.model)
        faults: dict[int, str] = {}
        surveyed: dict[int, SurveyedCurve] = {}
        for first in range(0, len(rows), _BLOCK):
            block = rows[first : first + _BLOCK]
            by_row = dict(zip(block, make(block), strict=True))
            for row, segment in tuple(by_row.items()):
                if (fault := circle_fault(segment)) is not None:
                    faults[row] = fault
                    del by_row[row]
            ways = survey_curves(robot, list(by_row.values()), self._max_speed)
            surveyed.update(zip(by_row, ways, strict=True))
        return SurveyedPaths(stances, _Segments(surveyed, make), surveyed, faults, strays)

    def _strays(self, row: int, curve: SurveyedCurve, surveyed: SurveyedPaths) -> bool:
        if (
            curve.broken
            or curve.arrival is None
            or not surveyed.stances.sure[row]
            or row in surveyed.strays
        ):
            return False
        return bool(np.abs(curve.arrival - surveyed.stances.joints[row]).max() > _SAME_JOINTS)

    def _requires_stored(self, row: int) -> bool:
        """Whether a move requires a stored configuration in which the arm could arrive."""
        known = self.posed.moves[row]
        return bool(self.ends.on_stored_branch[row]) and is_monitored(known, self.robot)

    def findings(self, surveyed: SurveyedPaths) -> Iterator[Diagnostic]:
        """Yield all findings about the paths."""
        for row, fault in surveyed.circle_faults.items():
            name = target_text(self.program, self.posed.moves[row])
            yield self._finding(row, CircleUncertain(name, fault))
        following = self._following()
        for row, way in surveyed.surveyed.items():
            if way.broken:
                fault_found = self._fault(row, surveyed, following)
                if fault_found is not None:
                    yield self._finding(row, fault_found)
                continue
            yield from self._wrist_circle_findings(row, surveyed)
            arrival = surveyed.strays.get(row)
            if arrival is None and not self.ends.stored_works[row]:
                arrival = way.arrival
            if arrival is not None and self._requires_stored(row):
                yield from self._changed(row, arrival)
            if way.hold_up is not None and not self._speed_unknown(row):
                held = self._held_up(row, way.hold_up)
                if held is not None:
                    yield self._finding(row, held)
            if way.travel < _STANDSTILL and way.turned < _NO_TURN and not self._moves_axes(row):
                name = target_text(self.program, self.posed.moves[row])
                yield self._finding(row, ZeroLengthMove(name))
            reduced = self._reduced_zone(row, surveyed, following)
            if reduced is not None:
                yield self._finding(row, reduced)

    def _wrist_circle_findings(self, row: int, surveyed: SurveyedPaths) -> Iterator[Diagnostic]:
        """Yield the findings about an arc that two wrist axes orient."""
        if self.posed.moves[row].move.interpolation is not Interpolation.CIRCLE:
            return
        segment = surveyed.segments[row]
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

    def _following(self) -> Mapping[int, list[int]]:
        """Return the moves that start at the end of each move."""
        following: dict[int, list[int]] = {}
        for row, known in enumerate(self.posed.moves):
            if known.previous is not None:
                following.setdefault(known.previous, []).append(row)
        return following

    def _fault(
        self, row: int, surveyed: SurveyedPaths, following: Mapping[int, list[int]]
    ) -> Violation | None:
        """Return the fault of a path as in planning; None if corner paths avoid it."""
        segment = surveyed.driven(row)
        fault = build_path(self.robot, [replace(segment, zone=None)], self.model)
        if not isinstance(fault, PathFault):
            return None
        # The wrist must be able to follow the whole arc, as in a run.
        led = segment.wrist_pair is not None
        if not led and not self._fails_with_corners(row, segment, surveyed, following):
            return None
        return fault_violation(fault, target_text(self.program, self.posed.moves[row]))

    def _fails_with_corners(
        self,
        row: int,
        segment: Segment,
        surveyed: SurveyedPaths,
        following: Mapping[int, list[int]],
    ) -> bool:
        before = self.posed.moves[row].previous
        around = [segment]
        if before is not None and before in surveyed.segments and surveyed.segments[before].zone:
            around.insert(0, surveyed.driven(before))
        after = [one for one in following.get(row, ()) if one in surveyed.segments]
        if segment.zone is not None and len(after) == 1:
            around.append(surveyed.driven(after[0]))
        if len(around) == 1:
            return True
        linked = [around[0]]
        for one in around[1:]:
            linked.append(
                replace(one, start=Waypoint(linked[-1].end.joints, one.start.base_from_tcp))
            )
        return isinstance(build_path(self.robot, linked, self.model), PathFault)

    def _changed(self, row: int, arrival: Array) -> Iterator[Diagnostic]:
        """K606: a line that arrives in another configuration than the stored one."""
        known, kinematics = self.posed.moves[row], self.robot.kinematics
        stored = stored_confdata(known)
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

    def _reduced_zone(
        self, row: int, surveyed: SurveyedPaths, following: Mapping[int, list[int]]
    ) -> ZoneTooLarge | None:
        move = self.posed.moves[row].move
        if move.zone.pzone_tcp <= _SMALL_ZONE_MM:
            return None
        zone = zone_of(move)
        after = [
            surveyed.surveyed[one].travel
            for one in following.get(row, ())
            if one in surveyed.surveyed
        ]
        if zone is None or not after:
            return None
        sides = [(surveyed.surveyed[row].travel, "before"), (min(after), "after")]
        length, which = min(sides)
        if length < _STANDSTILL or 0.5 * length >= _REDUCED * zone.position:
            return None
        return ZoneTooLarge(1e3 * zone.position, 1e3 * length, which, 500.0 * length)
