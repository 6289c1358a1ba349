r"""Search instructions: a move during which a signal or a persistent is watched.

A hit is exact: the position is that of the arm at the instant of the flank. A persistent has no
instant of change; it is read every few milliseconds.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SearchL".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field, replace

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.task_moves import EnqueueMove
from rapidsim.language.data import FINE, JointTarget, Pose, RobTarget
from rapidsim.language.error_numbers import (
    ERR_PERSSUPSEARCH,
    ERR_SIGSUPSEARCH,
    ERR_WHLSEARCH,
    rapid_error,
)
from rapidsim.language.moves import Flank, Move, SearchStop
from rapidsim.motion.timing.braking import PATH_STOP_S, SOFT_STOP_S
from rapidsim.values import value_class

LOOK_S = 0.012
"""Period [s] at which a persistent is read."""
_AT_START = {Flank.RISING: True, Flank.FALLING: False}
"""Value (as bool) that is an error at the start of the search."""
_RISING = (Flank.RISING, Flank.ONLY_RISING, Flank.EITHER)
_FALLING = (Flank.FALLING, Flank.ONLY_FALLING, Flank.EITHER)
_BRAKES_IN_S = {
    SearchStop.STIFFLY: 0.0,
    SearchStop.SOFTLY: SOFT_STOP_S,
    SearchStop.ON_PATH: PATH_STOP_S,
}


@value_class(slots=True)
class _Watch:
    """Records the times at which a value makes the flank of the search."""

    signal: str
    flank: Flank
    hits: list[float] = field(default_factory=list)

    def listens_to(self, signal: str) -> bool:
        return signal.lower() == self.signal

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        del signal
        rises = old == 0.0 and value != 0.0
        falls = old != 0.0 and value == 0.0
        if (rises and self.flank in _RISING) or (falls and self.flank in _FALLING):
            self.hits.append(now_s)


@value_class(frozen=True, slots=True)
class TaskSearch:
    """Implements `language.path_control.Searches`."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver
    put: EnqueueMove
    state: MotionState

    def search(
        self,
        move: Move,
        stop_condition: Callable[[], float] | str,
        flank: Flank,
        stop: SearchStop,
    ) -> RobTarget:
        """Make a move to a stop point and watch a signal, or a persistent, during it."""
        arm = self.unit.at_past(self._hit_s(move, stop_condition, flank, stop))
        return self.resolver.target(
            arm.joints[0], arm.external[0], move.tool, move.wobj, self.clock.place
        )

    def search_joints(
        self,
        move: Move,
        stop_condition: Callable[[], float] | str,
        flank: Flank,
        stop: SearchStop,
    ) -> JointTarget:
        """Make a move as `search` does, but return the positions of all axes at the first hit."""
        arm = self.unit.at_past(self._hit_s(move, stop_condition, flank, stop))
        return self.resolver.joint_target(arm.joints[0], arm.external[0])

    def part_pose(self, search: str) -> Pose | None:
        """Pose of the part that a torch searches; see `language.path_control.Searches`."""
        wobj = self.clock.place.arguments.get("wobj", "wobj0")
        parts = self.cell.parts
        return next((one.pose for one in parts if one.applies_to(wobj, search)), None)

    def _hit_s(
        self,
        move: Move,
        stop_condition: Callable[[], float] | str,
        flank: Flank,
        stop: SearchStop,
    ) -> float:
        """Make the move and return the time [s] of the first hit."""
        signal = stop_condition.lower() if isinstance(stop_condition, str) else ""
        watch = _Watch(signal, flank)
        self.clock.resolve_time()
        self.put(replace(move, zone=FINE), lambda queued: None, wait=False)
        self.clock.go_to(self.unit.queue.commit_last_start())
        self._refuse_at_start(move, stop_condition, flank)
        self.cell.listeners.append(watch)
        self.state.searches = True
        try:
            self._watch(watch, stop_condition, stop)
        finally:
            self.cell.listeners.remove(watch)
            self.state.searches = False
        if stop is SearchStop.GO_ON_ONCE and len(watch.hits) > 1:
            raise rapid_error(
                ERR_WHLSEARCH, f"{move.instruction} found {len(watch.hits)} hits, and one is wanted"
            )
        if not watch.hits:
            raise rapid_error(ERR_WHLSEARCH, f"{move.instruction} came to its end without a hit")
        return watch.hits[0]

    def _refuse_at_start(
        self, move: Move, stop_condition: Callable[[], float] | str, flank: Flank
    ) -> None:
        if flank not in _AT_START:
            return
        value = (
            self.cell.signals.read(stop_condition)
            if isinstance(stop_condition, str)
            else stop_condition()
        )
        if (value != 0.0) is not _AT_START[flank]:
            return
        what, number = "the persistent", ERR_PERSSUPSEARCH
        if isinstance(stop_condition, str):
            what, number = f"`{stop_condition}`", ERR_SIGSUPSEARCH
        self._stop_on_path(in_s=0.0)
        raise rapid_error(
            number, f"{move.instruction}: {what} is {value:g} already when the search begins"
        )

    def _watch(
        self, watch: _Watch, stop_condition: Callable[[], float] | str, stop: SearchStop
    ) -> None:
        """Let the robot move until it is at rest: at the end, or where a hit stops it."""
        while self.unit.queue.is_open:
            self.clock.await_restart()
            reached_s = self.unit.seen_s(self.unit.queue.close())
            while (now_s := self.clock.resolve_time()) < reached_s and not self.unit.queue.is_open:
                if isinstance(stop_condition, str):
                    self.clock.await_event(reached_s)
                else:
                    old = stop_condition()
                    self.clock.await_event(min(reached_s, now_s + LOOK_S))
                    watch.signal_changed("", old, stop_condition(), self.clock.resolve_time())
                if watch.hits and stop in _BRAKES_IN_S:
                    self._stop_on_path(_BRAKES_IN_S[stop])
                    return

    def _stop_on_path(self, in_s: float) -> None:
        """Stop on the path within a time [s] and discard the rest of it."""
        rest_s = self.unit.halt(self.clock.resolve_time(), in_s)
        self.clock.pass_time(max(self.clock.resolve_time(), self.unit.seen_s(rest_s)))
        self.unit.clear()
        self.unit.resume(self.clock.resolve_time())
