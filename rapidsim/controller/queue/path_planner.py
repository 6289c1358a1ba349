"""Planning of the moves of a queue: the path of its robots, and the fastest motion along it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from time import process_time

from rapidsim.controller.moves.planned_segments import segments_of
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove
from rapidsim.controller.queue.belt_planning import BlockStart, follows_belt, plan_on_belt
from rapidsim.controller.queue.member import Member
from rapidsim.controller.queue.plan_cache import PlanCache
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.interruption import Look
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.shared_building import build_shared_path
from rapidsim.motion.timing.axis_limits import Limits, combined_limits
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class PlanStart:
    """State of motion at which a plan starts."""

    move: int
    """Index of the move, among those planned."""
    distance_m: float
    """Distance [m] past the start of that move."""
    speed_m_s: float
    """Path speed [m/s]."""
    spent_s: float | None
    """Time [s] that the move has taken so far; None if it was stopped."""
    time_s: float = 0.0
    """Command time [s], which counts on a belt alone."""

    @property
    def fixed(self) -> int:
        """Number of moves that the robots have begun."""
        return self.move + (self.distance_m > 0.0 or self.speed_m_s > 0.0)

    @property
    def is_beginning(self) -> bool:
        """Whether the robots rest at the start of a block."""
        return self.fixed == 0 and self.spent_s == 0.0


_AT_REST = PlanStart(0, 0.0, 0.0, 0.0)


class PathPlanner:
    """Plans moves of one robot, or of several that move as one."""

    def __init__(self, members: Sequence[Member], check_deadline: Look) -> None:
        """Plan for these robots.

        Args:
            members: The robots; the first determines the shape of corners.
            check_deadline: Called while planning; raises to interrupt it.
        """
        lead = members[0]
        self.limits: Limits = combined_limits([one.limits for one in members])
        """Axis speeds and accelerations of all robots, side by side."""
        self.check_deadline = check_deadline
        self._model, self._lead = lead.model, lead
        self._robots = [one.robot for one in members]
        self._costs = lead.costs
        self._repeats = lead.repeats if len(members) == 1 else PlanCache()

    def forget(self) -> None:
        """See `PlanCache.forget`."""
        self._repeats.forget()

    def plan(
        self,
        rows: Sequence[Sequence[QueuedMove]],
        start: PlanStart = _AT_REST,
        lost_corner: int | None = None,
    ) -> tuple[Path, TimeScaling]:
        """Plan moves up to a stop at the last one.

        Args:
            rows: Moves of each robot, equally many.
            start: Where and how fast the motion starts.
            lost_corner: Index of moves that end with a stop although they have a zone.

        Raises:
            MotionError: If a robot cannot make one of its moves.
        """
        segments: list[Sequence[Segment]] = [segments_of(row) for row in rows]
        if lost_corner is not None:
            for number, own in enumerate(segments):
                late = replace(own[lost_corner], zone=None)
                segments[number] = (*own[:lost_corner], late, *own[lost_corner + 1 :])

        if follows_belt(segments[0]):
            return self._plan_on_belt(rows, segments[0], start)

        def make_plan() -> tuple[Path, TimeScaling]:
            began_s = process_time()
            path = self._path(rows, segments)
            self._costs.solving_s += process_time() - began_s
            return self._timed(path, start)

        if lost_corner is not None:
            return make_plan()
        of_start = (start.move, start.distance_m, start.speed_m_s, start.spent_s)
        return self._repeats.plan(segments, of_start, make_plan)

    def _timed(self, path: Path, start: PlanStart) -> tuple[Path, TimeScaling]:
        began_s = process_time()
        timing = plan(
            path,
            self.limits,
            start=float(path.segment_starts[start.move]) + start.distance_m,
            start_speed=start.speed_m_s,
            spent_s=start.spent_s,
            check_deadline=self.check_deadline,
        )
        self._costs.planning_s += process_time() - began_s
        return path, timing

    def _plan_on_belt(
        self, rows: Sequence[Sequence[QueuedMove]], segments: Sequence[Segment], start: PlanStart
    ) -> tuple[Path, TimeScaling]:
        """Plan moves of a robot alone, of which some follow a belt."""

        def make_plan(moved: Sequence[Segment]) -> tuple[Path, TimeScaling] | PathFault:
            began_s = process_time()
            path = build_shared_path(self._robots, [moved], self._model, self.check_deadline)
            self._costs.solving_s += process_time() - began_s
            return path if isinstance(path, PathFault) else self._timed(path, start)

        first = BlockStart(
            start.time_s,
            rows[0][0].number,
            start.fixed,
            start.is_beginning,
            start.move,
            start.distance_m,
        )
        planned = plan_on_belt(self._lead, segments, first, make_plan)
        if isinstance(planned, PathFault):
            raise MotionError(rows[0][planned.segment], planned)
        return planned

    def _path(
        self, rows: Sequence[Sequence[QueuedMove]], segments: Sequence[Sequence[Segment]]
    ) -> Path:
        path = build_shared_path(self._robots, segments, self._model, self.check_deadline)
        if isinstance(path, PathFault):
            raise MotionError(rows[path.robot][path.segment], path)
        return path
