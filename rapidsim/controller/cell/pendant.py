"""Questions of tasks that stay on the FlexPendant until a client answers, for a live controller."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from typing import TypeAlias

from rapidsim.controller.cell.operator import parse_key, parse_number
from rapidsim.values import value_class

AnswerValue: TypeAlias = float | int | str
"""A number, the index of a key, or a text."""


@value_class(frozen=True, slots=True)
class Question:
    """A question of a task."""

    task: str
    instruction: str
    prompt: str
    answer_type: type[AnswerValue]
    """`float` for a number, `int` for one of the choices, `str` for a text."""
    choices: tuple[str, ...] = ()
    """Keys from 1; a key with the text "" is not shown."""
    proposal: str = ""

    def read(self, text: str) -> AnswerValue:
        """The answer that a text means: for keys, their texts or numbers.

        Raises:
            ValueError: If it is invalid; the message is for the person who answers.
        """
        if self.answer_type is str:
            return text
        if self.answer_type is float:
            value = parse_number(text)
            if value is None:
                raise ValueError(f"`{text}` is not a number")
            return value
        index = parse_key(text, self.choices)
        if index is None:
            raise ValueError(f"`{text}` is none of {' / '.join(filter(None, self.choices))}")
        return index


@value_class(slots=True)
class Pendant:
    """The open question of each task, and the answers that tasks have not taken yet."""

    questions: dict[str, Question] = field(default_factory=dict)
    """By name of the task, in the order of the questions."""
    _answers: dict[str, AnswerValue] = field(default_factory=dict)
    _instructions: dict[str, str] = field(default_factory=dict)

    def begin(self, task: str, instruction: str) -> None:
        """Note the instruction of a task that will ask a question."""
        self._instructions[task] = instruction

    def withdraw(self, task: str) -> None:
        """Withdraw the question of a task."""
        for table in (self.questions, self._answers, self._instructions):
            table.pop(task, None)

    def ask(
        self,
        task: str,
        prompt: str,
        answer_type: type[AnswerValue],
        choices: Sequence[str] = (),
        proposal: str = "",
    ) -> AnswerValue | None:
        """Take the answer to a question, posting the question first; None until it is answered."""
        if task in self._answers:
            return self._answers.pop(task)
        name = self._instructions.get(task, "")
        self.questions[task] = Question(task, name, prompt, answer_type, tuple(choices), proposal)
        return None

    def answer(self, task: str, text: str) -> None:
        """Answer the question of a task.

        Raises:
            LookupError: If the task has no question.
            ValueError: If the text is not a valid answer.
        """
        question = self.questions[task]
        self._answers[task] = question.read(text)
        del self.questions[task]

    def has_answer(self, task: str) -> bool:
        """Whether there is an answer that a task has not taken yet."""
        return task in self._answers
