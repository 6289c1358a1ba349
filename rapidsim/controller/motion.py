"""Motion of one task: its moves and the position of its robot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.position_reading import HOLDS_S, PositionReader, Reading
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.task_moves import EnqueueMove
from rapidsim.controller.triggers import Triggers
from rapidsim.frames.vectors import length, minus
from rapidsim.language.data import JointTarget, Pos, RobTarget, ToolData, WobjData
from rapidsim.language.moves import AnnouncedTargets, MotionSettings, Move
from rapidsim.language.path_events import Trigger

_LOOKS_BACK_S = 1e-3
_ROUNDING_S = 1e-9
_ARRIVED_MM = 0.01
"""A path that ends this close to its target was not cut short."""


@dataclass(slots=True, eq=False)
class TaskMotion:
    """Implements `language.controller.Motion`."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver
    state: MotionState
    triggers: Triggers
    put: EnqueueMove
    again: Callable[[AnnouncedTargets, int, int], int]
    reader: PositionReader

    @property
    def corrections(self) -> dict[int, Pos]:
        """Offset of the path [mm] by each connected correction generator."""
        return self.state.corrections

    @property
    def settings(self) -> MotionSettings:
        """The settings of the next moves."""
        return self.state.settings

    @settings.setter
    def settings(self, settings: MotionSettings) -> None:
        self.state.settings = settings

    def move(self, move: Move, triggers: tuple[Trigger, ...] = ()) -> None:
        """Append a move to the path, with the triggers along it."""
        self.put(move, lambda queued: self.triggers.mark(queued, triggers))

    def expect(self, targets: AnnouncedTargets) -> None:
        """Announce the targets of the next moves."""
        self.resolver.expected.expect(targets)

    def repeat(self, targets: AnnouncedTargets, number: int, most: int) -> int:
        """Make moves to announced targets like the last one, from a number on, at most so many."""
        return self.again(targets, number, most)

    def current_joints(self) -> JointTarget:
        """Current positions of the axes."""
        self.clock.note_line()
        reading = self._reading()
        return self.resolver.joint_target(reading.joints, reading.external)

    def current_speeds(self) -> JointTarget:
        """Current speeds of the axes [deg/s or mm/s]: their change in the last millisecond."""
        self.clock.note_line()
        now_s = self.clock.resolve_time()
        seen = self.unit.seen(now_s, np.array([max(0.0, now_s - _LOOKS_BACK_S), now_s]))
        joints = (seen.joints[1] - seen.joints[0]) / _LOOKS_BACK_S
        external = (seen.external[1] - seen.external[0]) / _LOOKS_BACK_S
        return self.resolver.joint_target(joints, external)

    def is_moving(self) -> bool:
        """Whether the robot is moving."""
        is_guided = self.unit.member.guided is not None
        if is_guided or self.unit.queue.is_open:
            return True
        return self.unit.trajectory.duration - self.clock.resolve_time() > _ROUNDING_S

    def current_target(self, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        """Current robtarget of the TCP; None selects the tool or work object of the last move."""
        self.clock.note_line()
        tool, wobj = tool or self.state.tool, wobj or self.state.wobj
        reading = self._reading(holds_on=not self.resolver.may_have_carrier(wobj))
        return self.reader.target(reading, tool, wobj, self.clock.place)

    def active_tool(self) -> ToolData:
        """The tool of the last move, tool0 before the first."""
        return self.state.tool

    def active_wobj(self) -> WobjData:
        """The work object of the last move, wobj0 before the first."""
        return self.state.wobj

    def active_names(self) -> tuple[str, str]:
        """The names of the active tool and work object in the program."""
        return self.state.tool_name, self.state.wobj_name

    def activate(self, data: ToolData | WobjData, name: str) -> None:
        """Make a tool or a work object the active one."""
        if isinstance(data, ToolData):
            self.state.tool, self.state.tool_name = data, name
        else:
            self.state.wobj, self.state.wobj_name = data, name

    def programmed_end(self, tool: ToolData, wobj: WobjData) -> RobTarget:
        """Robtarget of the end of the path so far, without the offsets of correction generators."""
        end = self.unit.end
        stands = self.resolver.target(end.joints, end.external, tool, wobj, self.clock.place)
        last = self.unit.moves[-1].move if self.unit.moves else None
        if last is None or last.programmed is None or (last.tool, last.wobj) != (tool, wobj):
            return stands
        assert isinstance(last.to, RobTarget)
        came = length(minus(stands.trans, last.to.trans)) < _ARRIVED_MM
        return last.programmed if came else stands

    def target_at(self, joints: JointTarget, tool: ToolData, wobj: WobjData) -> RobTarget:
        """Robtarget of the TCP with the axes at other positions."""
        external = self.resolver.external(joints.extax)
        given = self.resolver.joints(joints)
        return self.resolver.target(given, external, tool, wobj, self.clock.place)

    def joints_at(self, target: RobTarget, tool: ToolData, wobj: WobjData) -> JointTarget:
        """Axis positions that reach a target in its configuration; with ConfJ off, near it.

        Raises:
            RapidError: ERR_OUTSIDE_REACH or ERR_ROBLIMIT.
        """
        end, monitored = self.unit.end, self.settings.conf_j
        joints = self.resolver.reach(target, tool, wobj, end, self.clock.place, monitored=monitored)
        return JointTarget(self.resolver.rob_joint(joints), target.extax)

    def finish(self) -> None:
        """Bring the robot to rest after the last statement.

        Raises:
            WaitsForever: If StopMove keeps it from the rest of its path.
        """
        self.unit.end_guidance()
        if self.unit.queue.is_open:
            self.clock.resolve_time()
            self.clock.drive_to_stop()
        self.clock.pass_time(max(self.clock.resolve_time(), self.unit.trajectory.duration))

    def abandon(self) -> MotionError | None:
        """Let the robot finish the moves it has before the program stops with an error.

        Returns:
            The reason if it cannot finish them, else None. That error precedes the one that stops
            the program, which runs ahead of the robot.
        """
        self.unit.end_guidance()
        queue = self.unit.queue
        if queue.is_open and not queue.is_halted:
            with self.unit.ending():
                try:
                    queue.close()
                except MotionError as error:
                    return error
        return None

    def end_with_the_run(self) -> None:
        """Stop the robot at the time limit if it still moves then: later motion is not in the run.

        A failure of a move before it was already reported; it does not prevent the stop.
        """
        limit_s = self.cell.max_time_s
        if not self.unit.queue.is_halted and self.unit.trajectory.command_end > limit_s:
            with self.unit.ending():
                self.unit.halt(limit_s)

    def _reading(self, *, holds_on: bool = True) -> Reading:
        """Reading of the robot's position for the current statement, which only polls.

        Args:
            holds_on: Whether the reading stays valid while the robot is at rest.
        """
        reading = self.reader.read(self.clock.resolve_time())
        until_s = self.reader.stays_until(reading)
        self.clock.hold_until(until_s if holds_on else min(until_s, reading.time_s + HOLDS_S))
        return reading
