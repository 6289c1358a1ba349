"""What one task says and asks: the FlexPendant, and what it does not simulate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Journal


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

    def ask_number(self, prompt: str) -> float:
        """The operator's answer to a question."""
        self.clock.observe()
        answer = self.cell.operator.number(prompt)
        for violation in answer.findings:
            self.journal.finding(violation, self.clock.place)
        self.clock.event(
            EventKind.TEXT, f"{prompt} {answer.value:g}", prompt=prompt, answer=answer.value
        )
        return answer.value

    def ask_choice(self, prompt: str, choices: Sequence[str]) -> int:
        """Index of the key the operator presses; the first that is there, where nobody sits."""
        self.clock.observe()
        answer = self.cell.operator.choice(prompt, choices)
        for violation in answer.findings:
            self.journal.finding(violation, self.clock.place)
        pressed = choices[answer.value]
        self.clock.event(EventKind.TEXT, f"{prompt} {pressed}", prompt=prompt, answer=pressed)
        return answer.value

    def ask_text(self, prompt: str, proposal: str) -> str:
        """A text the operator types; the proposal, where nobody sits."""
        self.clock.observe()
        answer = self.cell.operator.text(prompt, proposal)
        for violation in answer.findings:
            self.journal.finding(violation, self.clock.place)
        self.clock.event(
            EventKind.TEXT, f"{prompt} {answer.value}", prompt=prompt, answer=answer.value
        )
        return answer.value


@dataclass(frozen=True, slots=True)
class TaskHonesty:
    """Implements `language.controller.Honesty`."""

    clock: TaskClock
    journal: Journal

    def not_simulated(self, routine: str, treated_as: str) -> None:
        """Report that a routine was not simulated and what was done instead."""
        self.journal.unsimulated(routine, treated_as, self.clock.place)
