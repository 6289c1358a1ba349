"""FlexPendant of one task: output, questions, and reports of unsimulated routines."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.operator import OperatorAnswer, OperatorDialog
from rapidsim.controller.cell.pendant import AnswerValue, Pendant
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Journal
from rapidsim.values import value_class

T = TypeVar("T")


@value_class(frozen=True, slots=True)
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

    @contextmanager
    def asking(self, instruction: str) -> Iterator[None]:
        """Context of an instruction that asks; its question is withdrawn at the end."""
        pendant, task = self.cell.pendant, self.journal.task
        if pendant is None:
            yield
            return
        pendant.begin(task, instruction)
        try:
            yield
        finally:
            pendant.withdraw(task)

    @property
    def has_answered(self) -> bool:
        """Whether the open question has been answered."""
        pendant = self.cell.pendant
        return pendant is not None and pendant.has_answer(self.journal.task)

    def ask_number(self, prompt: str, *, ends: bool = False) -> float | None:
        """Ask the operator for a number; None if the question ends without an answer."""
        return self._put_question(
            prompt,
            lambda there: there.number(prompt, ends=ends),
            lambda pendant: pendant.ask(self.journal.task, prompt, float),
            "{:g}".format,
        )

    def ask_choice(self, prompt: str, choices: Sequence[str], *, ends: bool = False) -> int | None:
        """Ask the operator for a key; return its index, the first key's without an answer."""
        return self._put_question(
            prompt,
            lambda there: there.choice(prompt, choices, ends=ends),
            lambda pendant: pendant.ask(self.journal.task, prompt, int, choices),
            lambda index: choices[index],
        )

    def ask_text(self, prompt: str, proposal: str, *, ends: bool = False) -> str | None:
        """Ask the operator for a text; return the proposal without an answer."""
        return self._put_question(
            prompt,
            lambda there: there.text(prompt, proposal, ends=ends),
            lambda pendant: pendant.ask(self.journal.task, prompt, str, (), proposal),
            str,
        )

    def _put_question(
        self,
        prompt: str,
        put_question: Callable[[OperatorDialog], OperatorAnswer[T] | None],
        on_pendant: Callable[[Pendant], AnswerValue | None],
        text: Callable[[T], str],
    ) -> T | None:
        """Ask at a known time; question and answer are recorded as an event."""
        self.clock.resolve_time()
        answer: OperatorAnswer[T] | None
        if self.cell.pendant is None:
            answer = put_question(self.cell.operator)
        else:
            value = on_pendant(self.cell.pendant)
            answer = None if value is None else OperatorAnswer(value)  # type: ignore[arg-type]
        if answer is None:
            self.clock.event(EventKind.TEXT, prompt, prompt=prompt)
            return None
        for violation in answer.findings:
            self.journal.finding(violation, self.clock.place)
        told = answer.value if isinstance(answer.value, float) else text(answer.value)
        message = f"{prompt} {text(answer.value)}"
        self.clock.event(EventKind.TEXT, message, prompt=prompt, answer=told)
        return answer.value


@value_class(frozen=True, slots=True)
class TaskFidelityReporter:
    """Implements `language.controller.FidelityReporter`."""

    clock: TaskClock
    journal: Journal

    def not_simulated(self, routine: str, treated_as: str, *, is_unknown: bool = False) -> None:
        """Report that a routine was not simulated and what was done instead."""
        self.journal.unsimulated(routine, treated_as, self.clock.place, is_unknown=is_unknown)
