"""What one task says and asks: the FlexPendant, and what it does not simulate."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.operator import Operator, OperatorAnswer
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Journal

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class TaskOperator:
    """Implements `language.controller.Operator`."""

    clock: TaskClock
    cell: Cell
    journal: Journal

    def show(self, text: str) -> None:
        """Write a line on the FlexPendant."""
        self.clock.event(EventKind.TEXT, text)

    def clear_screen(self) -> None:
        """Remove all lines from the FlexPendant."""
        self.clock.event(EventKind.TEXT, "", cleared=True)

    def ask_number(self, prompt: str, *, ends: bool = False) -> float | None:
        """The operator's answer to a question; None where nobody sits and it ends otherwise."""
        return self._told(prompt, self._operator().number(prompt, ends=ends), "{:g}".format)

    def ask_choice(self, prompt: str, choices: Sequence[str], *, ends: bool = False) -> int | None:
        """Index of the key the operator presses; the first that is there, where nobody sits."""
        answer = self._operator().choice(prompt, choices, ends=ends)
        return self._told(prompt, answer, lambda index: choices[index])

    def ask_text(self, prompt: str, proposal: str, *, ends: bool = False) -> str | None:
        """A text the operator types; the proposal, where nobody sits."""
        return self._told(prompt, self._operator().text(prompt, proposal, ends=ends), str)

    def _operator(self) -> Operator:
        """Whoever answers, asked at a time that is known."""
        self.clock.observe()
        return self.cell.operator

    def _told(
        self, prompt: str, answer: OperatorAnswer[T] | None, text: Callable[[T], str]
    ) -> T | None:
        """The answer; question and answer are an event."""
        if answer is None:
            self.clock.event(EventKind.TEXT, prompt, prompt=prompt)
            return None
        for violation in answer.findings:
            self.journal.finding(violation, self.clock.place)
        told = answer.value if isinstance(answer.value, float) else text(answer.value)
        message = f"{prompt} {text(answer.value)}"
        self.clock.event(EventKind.TEXT, message, prompt=prompt, answer=told)
        return answer.value


@dataclass(frozen=True, slots=True)
class TaskHonesty:
    """Implements `language.controller.Honesty`."""

    clock: TaskClock
    journal: Journal

    def not_simulated(self, routine: str, treated_as: str) -> None:
        """Report that a routine was not simulated and what was done instead."""
        self.journal.unsimulated(routine, treated_as, self.clock.place)
