"""The motion of one task: its robot's path queue, and where the robot is."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress

from rapidsim.controller.clock import TaskTime
from rapidsim.controller.journal.journal import Instant
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove
from rapidsim.controller.queue.path_planner import LOOK_AHEAD_SLACK_S, MAX_OPEN_MOVES
from rapidsim.findings.ramps import RampWaits
from rapidsim.frames.transform import Array
from rapidsim.language.data import JointTarget, RobTarget, ToolData, WobjData
from rapidsim.language.error_log import CORNER_PATH_FAILURE
from rapidsim.language.error_numbers import ERR_CONC_MAX, rapid_error
from rapidsim.language.moves import Move
from rapidsim.motion.configurations.targets import rob_joint

MAX_CONCURRENT_MOVES = 5
r"""So many moves with \Conc may follow each other."""


class TaskMotion(TaskTime):
    """Implements `language.controller.Motion`."""

    _concurrent = 0
    r"""Moves with \Conc since the last without."""

    def _put(self, move: Move, before: Callable[[QueuedMove], None], *, wait: bool = True) -> None:
        """Put a move on the path; returns when the program would go on.

        Args:
            move: Where to.
            before: Called with the move before the program waits for it.
            wait: Wait for the stop, where there is one.

        Raises:
            RapidError: When the end of the move cannot be reached.
            MotionError: When a move on the path cannot be made.
        """
        self._note_line()
        self._count_concurrent(move)
        queue = self._unit.queue
        queued = self._resolver.resolve(
            move, self.place, queue.end, self.settings, index=len(queue.moves)
        )
        self._time.settle(self.left)
        if not self._unit.queue.is_open or self._time.offset_s > LOOK_AHEAD_SLACK_S:
            self._observe()
        moment = self._moment()
        now_s = moment.time_s if moment.instant.time is not None else -math.inf
        last = self._unit.queue.moves[-1] if self._unit.queue.is_open else None
        self._unit.own.append(queued, now_s)
        if last is not None and last.corner is CornerKind.STOP_CORNER_PATH_FAILURE:
            self._interrupts.error_logged(CORNER_PATH_FAILURE, now_s)
        before(queued)
        self._note_ramp(queued)
        self._active = (move.tool, move.wobj)
        if queued.corner is CornerKind.STOP and wait and not move.concurrent:
            self._drive_to_stop()
            if move.stop and move.stop.program_waits:
                self._pass_time(self._observe() + move.stop.seconds)
            return
        self._time.follow(queued.started)
        if (
            self._interrupts.armed
            or self._zones.is_watching
            or self._marks.may_interrupt
            or self._unit.queue.open_moves > MAX_OPEN_MOVES
        ):
            self._keep_up()

    def _note_ramp(self, queued: QueuedMove) -> None:
        """Tell once of a ramp that is higher than that of the moves before, and has to wait."""
        wanted, kept = self.settings.ramp_percent, queued.segment.ramp
        if kept < wanted / 100.0:
            self._journal.finding(RampWaits(wanted, 100.0 * kept), self.place, once=RampWaits)

    def _count_concurrent(self, move: Move) -> None:
        r"""Refuse more moves with \Conc in succession than a controller takes.

        Raises:
            RapidError: ERR_CONC_MAX.
        """
        self._concurrent = self._concurrent + 1 if move.concurrent else 0
        if self._concurrent > MAX_CONCURRENT_MOVES:
            self._concurrent = 0
            raise rapid_error(
                ERR_CONC_MAX,
                rf"more than {MAX_CONCURRENT_MOVES} moves with \Conc in succession",
            )

    def current_joints(self) -> JointTarget:
        """Where the axes are now."""
        self._note_line()
        joints, external = self._stand_now()
        return JointTarget(rob_joint(joints), self._resolver.ext_joint(external))

    def current_target(self, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        """Where the TCP is now; None takes the tool or work object of the last move."""
        self._note_line()
        active_tool, active_wobj = self._active
        joints, external = self._stand_now()
        tool, wobj = tool or active_tool, wobj or active_wobj
        return self._resolver.target(joints, external, tool, wobj, self.place)

    def active_tool(self) -> ToolData:
        """The tool of the last move, tool0 before the first."""
        return self._active[0]

    def active_wobj(self) -> WobjData:
        """The work object of the last move, wobj0 before the first."""
        return self._active[1]

    def target_at(self, joints: JointTarget, tool: ToolData, wobj: WobjData) -> RobTarget:
        """Where the TCP would be with the axes at given positions."""
        external = self._resolver.external(joints.extax)
        return self._resolver.target(
            self._resolver.joints(joints), external, tool, wobj, self.place
        )

    def joints_at(self, target: RobTarget, tool: ToolData, wobj: WobjData) -> JointTarget:
        """Axis positions that reach a target in its configuration.

        Raises:
            RapidError: ERR_OUTSIDE_REACH or ERR_ROBLIMIT.
        """
        joints = self._resolver.reach(target, tool, wobj, self._unit.queue.end, self.place)
        return JointTarget(rob_joint(joints), target.extax)

    def finish(self) -> None:
        """Let the robot come to rest after the last statement."""
        if self._unit.queue.is_open and not self._unit.queue.is_halted:
            self._observe()
            self._drive_to_stop()
        self._pass_time(max(self._observe(), self._unit.queue.trajectory.duration))

    def abandon(self) -> None:
        """Let the robot make the moves it has before the program stopped with an error."""
        limit_s = self._cell.max_time_s
        if self._unit.queue.is_open and not self._unit.queue.is_halted:
            with suppress(MotionError):
                if self._unit.queue.preview().duration > limit_s:
                    self._unit.queue.halt(limit_s)
                else:
                    self._unit.queue.close()

    def _stand_now(self) -> tuple[Array, Array]:
        """Joints (n,) [rad] and external axes (e,) [m or rad] while the statement runs."""
        samples = self._unit.queue.samples_at(self._observe())
        return samples.joints[0], samples.external[0]

    def _keep_up(self) -> None:
        """Let interrupts happen on time although the program runs ahead of the robot.

        Planning after each move would be slow. Nothing is planned until the moves last, at their
        programmed speeds, until the next interrupt falls due and the arm could stop after it.
        """
        due_s = self._next_due_s()
        queue = self._unit.queue
        early = not self._marks.may_interrupt and not self._zones.is_watching
        early &= not self._cell.is_shared
        early &= due_s is None or queue.nominal_last_start() - queue.braking_s < due_s
        if early and queue.open_moves <= MAX_OPEN_MOVES:
            return
        fixed_s = queue.commit_ahead()
        if fixed_s is None:
            return
        self._serve_due(min(fixed_s, self._cell.max_time_s))
        if fixed_s > self._cell.max_time_s:
            self._time.follow(Instant())
            self._pass_time(fixed_s)
