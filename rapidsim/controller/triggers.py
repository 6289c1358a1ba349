"""Actions at places of the path: outputs, interrupts, ramps, procedures.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TriggIO",
"TriggCheckIO", "TriggRampAO", "TriggInt", "TriggSpeed".
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rapidsim.controller.cell.cell import Cause, Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.interrupt_table import Due
from rapidsim.controller.interrupts import TaskInterrupts
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.path_marks import PathMark, PathMarks
from rapidsim.controller.queue.speed_outputs import SpeedOutputs
from rapidsim.language.path_events import (
    CallProcedure,
    CheckSignal,
    FollowSpeed,
    RaiseInterrupt,
    RampOutput,
    SetOutput,
    Trigger,
)
from rapidsim.values import value_class

_MM = 1e-3
RAMP_STEP_S = 0.012
"""Interval [s] at which a ramp of an analog output is written."""
PROCEDURE_NUMBER = 0.0
"""INTNO of a procedure that runs at a place of the path."""


@value_class(frozen=True, slots=True)
class Triggers:
    """Marks the places of a move's triggers on the path."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    marks: PathMarks
    interrupts: TaskInterrupts
    speeds: SpeedOutputs

    def mark(self, queued: QueuedMove, triggers: tuple[Trigger, ...]) -> None:
        """Add marks for triggers to the path of a move."""
        for trigger in triggers:
            by_time = trigger.by_time
            self.marks.add(
                PathMark(
                    queued,
                    0.0 if by_time else trigger.distance * _MM,
                    trigger.from_start,
                    (trigger.distance if by_time else 0.0) + trigger.lag_s,
                    self._action(trigger),
                    isinstance(trigger.action, RaiseInterrupt | CheckSignal | CallProcedure),
                )
            )

    def _action(self, trigger: Trigger) -> Callable[[float], None]:
        """The action of a trigger, to be called with its time [s]."""
        cause = self.clock.cause()

        def act(now_s: float) -> None:
            if trigger.inhibited is not None and trigger.inhibited.value:
                self._write_inhibited(cause, trigger, now_s)
                return
            match trigger.action:
                case SetOutput(signal=signal, value=value, delay_s=delay_s):
                    self._set_at(cause, now_s + delay_s, signal, value)
                case RaiseInterrupt(interrupt=number):
                    self.interrupts.table.raise_now(number, now_s)
                case CheckSignal() as check:
                    self._check(check, now_s)
                case RampOutput() as ramp:
                    self._ramp(cause, ramp, now_s)
                case CallProcedure(name=name):
                    self._call_at(name, now_s)
                case FollowSpeed() as follow:
                    self.speeds.follow(cause, now_s, follow.signal, follow.per_mm_s, follow.lag_s)

        return act

    def _write_inhibited(self, cause: Cause, trigger: Trigger, now_s: float) -> None:
        if trigger.inhibited_value is not None and isinstance(trigger.action, SetOutput):
            value = float(trigger.inhibited_value.value)  # type: ignore[arg-type]
            self._set_at(cause, now_s, trigger.action.signal, value)

    def _set_at(self, cause: Cause, time_s: float, signal: str, value: float) -> None:
        self.cell.schedule(cause, Moment(Instant(time_s)), {signal: value})

    def _check(self, check: CheckSignal, now_s: float) -> None:
        if check.wanted(self.cell.signals.read(check.signal)):
            return
        if check.stops and not self.unit.queue.is_halted:
            self.unit.halt(now_s)
        self.interrupts.table.raise_now(check.interrupt, now_s)

    def _ramp(self, cause: Cause, ramp: RampOutput, now_s: float) -> None:
        """Write a ramp in steps: evenly over time, or over the distance that the robot travels."""
        start = self.cell.signals.read(ramp.signal)
        preview = self.unit.preview()
        now = np.array([now_s])
        here_m = float(preview.place_at(now)[0])
        active = self.unit.moves[int(preview.at(now).move[0])]
        length_m = ramp.length * _MM * self.unit.path_ratio(active)
        length_m = min(length_m, preview.length - here_m)
        by_time = ramp.by_time or length_m <= 0.0
        end_s = now_s + (ramp.length if ramp.by_time else 0.0)
        if not by_time:
            end_s = max(now_s, preview.time_at_place(here_m + length_m))
        count = max(1, round((end_s - now_s) / RAMP_STEP_S))
        times = np.linspace(now_s, end_s, count + 1)[1:]
        shares = np.linspace(0.0, 1.0, count + 1)[1:]
        if not by_time:
            shares = np.clip((preview.place_at(times) - here_m) / length_m, 0.0, 1.0)
            shares[-1] = 1.0
        for time_s, share in zip(times.tolist(), shares.tolist(), strict=True):
            value = start + share * (ramp.value - start)
            self._set_at(cause, time_s, ramp.signal, value)

    def _call_at(self, name: str, now_s: float) -> None:
        def run() -> None:
            self.interrupts.call_procedure(name)

        self.interrupts.table.post(Due(PROCEDURE_NUMBER, now_s, run, name, is_trap=False))
