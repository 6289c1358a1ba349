"""Stopping the robot on its path, starting it again, and what happens at places of the path.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "StopMove",
"StartMove", "StorePath", "ClearPath", "TriggIO". That a program goes on after StopMove when the
robot stands is our reading of the examples, which ask for the position right after it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rapidsim.controller.cell.cell import Cause
from rapidsim.controller.interrupt_table import Due
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.controller.motion import TaskMotion
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.queue.path_marks import PathMark
from rapidsim.language.error_numbers import ERR_PATH, ERR_PATHDIST, rapid_error
from rapidsim.language.moves import Move
from rapidsim.language.path_events import (
    CallProcedure,
    CheckSignal,
    RaiseInterrupt,
    RampOutput,
    SetOutput,
    Trigger,
)

_MM = 1e-3
RAMP_STEP_S = 0.012
"""A ramp of an analog output is written in steps of this time."""
PROCEDURE_NUMBER = 0.0
"""INTNO of a procedure that runs at a place of the path."""


class TaskPathControl(TaskMotion):
    """Implements `language.controller.PathControl`, but for searching."""

    path_level = 1.0

    def move(self, move: Move, triggers: tuple[Trigger, ...] = ()) -> None:
        """Put a move on the path, with what happens on the way."""
        self._put(move, lambda queued: self._mark(queued, triggers))

    def stop_move(self) -> None:
        """Stop the robot on its path; returns when it stands."""
        self._note_line()
        now_s = self._observe()
        if not self._unit.queue.is_halted:
            rest_s = self._unit.queue.halt(now_s)
            self._pass_time(max(now_s, self._unit.queue.trajectory.seen_s(rest_s)))

    def start_move(self) -> None:
        """Let the robot go on.

        Raises:
            RapidError: ERR_PATHDIST, when it stands too far from where it left its path.
        """
        self._note_line()
        now_s = self._observe()
        away_deg = self._unit.queue.away_deg()
        if away_deg > 0.0:
            raise rapid_error(
                ERR_PATHDIST,
                f"the robot stands {away_deg:.3g} deg off where it left its path; move it back "
                "before RestoPath",
            )
        self._unit.queue.resume(now_s)

    def is_stopped(self) -> bool:
        """Whether StopMove keeps the robot where it is."""
        return self._unit.queue.is_halted

    def clear_path(self) -> None:
        """Forget the rest of the path of a robot that was stopped.

        Raises:
            RapidError: ERR_PATH, while the robot moves.
        """
        self._note_line()
        self._require_standstill("ClearPath")
        self._unit.queue.clear()
        self._marks.clear()

    def store_path(self) -> None:
        """Keep the rest of the path and begin another.

        Raises:
            RapidError: ERR_PATH, while the robot moves.
        """
        self._note_line()
        self._require_standstill("StorePath")
        self._unit.queue.store()
        self.path_level += 1.0

    def restore_path(self) -> None:
        """Take up the path that was kept; the robot goes on with it after `start_move`.

        Raises:
            RapidError: ERR_PATH, if none is kept.
        """
        self._note_line()
        if self.path_level <= 1.0:
            raise rapid_error(ERR_PATH, "RestoPath without StorePath: no path is kept")
        self._come_to_rest()
        self._unit.queue.restore()
        self.path_level -= 1.0

    def _require_standstill(self, instruction: str) -> None:
        now_s = self._observe()
        if self._unit.queue.is_open and not self._unit.queue.is_halted:
            raise rapid_error(ERR_PATH, f"{instruction} while the robot moves; StopMove first")
        self._pass_time(max(now_s, self._unit.queue.trajectory.duration))

    def _mark(self, queued: QueuedMove, triggers: tuple[Trigger, ...]) -> None:
        """Put the places of triggers on the path of a move."""
        for trigger in triggers:
            by_time = trigger.by_time
            self._marks.add(
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
        """What a trigger does at its time [s]."""
        cause = Cause(self._journal, self.place)

        def act(now_s: float) -> None:
            if trigger.inhibited is not None and trigger.inhibited.value:
                self._write_inhibited(cause, trigger, now_s)
                return
            match trigger.action:
                case SetOutput(signal=signal, value=value, delay_s=delay_s):
                    self._set_at(cause, now_s + delay_s, signal, value)
                case RaiseInterrupt(interrupt=number):
                    self._interrupts.raise_now(number, now_s)
                case CheckSignal() as check:
                    self._check(check, now_s)
                case RampOutput() as ramp:
                    self._ramp(cause, ramp, now_s)
                case CallProcedure(name=name):
                    self._call_at(name, now_s)
                case None:
                    pass

        return act

    def _write_inhibited(self, cause: Cause, trigger: Trigger, now_s: float) -> None:
        if trigger.inhibited_value is not None and isinstance(trigger.action, SetOutput):
            value = float(trigger.inhibited_value.value)  # type: ignore[arg-type]
            self._set_at(cause, now_s, trigger.action.signal, value)

    def _set_at(self, cause: Cause, time_s: float, signal: str, value: float) -> None:
        self._cell.schedule(cause, Moment(Instant(time_s)), {signal: value})

    def _check(self, check: CheckSignal, now_s: float) -> None:
        if check.wanted(self._cell.signals.read(check.signal)):
            return
        if check.stops and not self._unit.queue.is_halted:
            self._unit.queue.halt(now_s)
        self._interrupts.raise_now(check.interrupt, now_s)

    def _ramp(self, cause: Cause, ramp: RampOutput, now_s: float) -> None:
        """Write a ramp step by step: evenly over time, or over the way the robot makes."""
        start = self._cell.signals.read(ramp.signal)
        preview = self._unit.queue.preview()
        here_m = float(preview.place_at(np.array([now_s]))[0])
        length_m = min(ramp.length * _MM, preview.length - here_m)
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
            self.call_procedure(name)

        self._interrupts.post(Due(PROCEDURE_NUMBER, now_s, run, name, is_trap=False))
