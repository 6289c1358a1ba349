"""The operator at the FlexPendant: answers from a file, a terminal, or none.

A run in CI must never hang on a question, so without an answer a default is taken and reported. A
question that has a time limit remains unanswered instead.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Generic, TypeVar

from rapidsim.controller.cell.inputs import Answers
from rapidsim.diagnostics import Violation
from rapidsim.findings.runs import AnswerNotAChoice, AnswerNotANumber, QuestionUnanswered
from rapidsim.values import value_class

DEFAULT_NUMBER = 0.0


T = TypeVar("T")


@value_class(frozen=True, slots=True)
class OperatorAnswer(Generic[T]):
    """An answer, with the findings about it."""

    value: T
    findings: tuple[Violation, ...] = ()


@value_class(frozen=True, slots=True)
class OperatorDialog:
    """Asks questions of the source of answers."""

    answers: Answers | None
    is_interactive: bool = False
    """Whether a person answers, who can correct an answer; lines of a file cannot."""

    def number(self, prompt: str, *, ends: bool = False) -> OperatorAnswer[float] | None:
        """The number that answers a question; None if the question `ends` without an answer."""
        text = self._read_answer(prompt)
        default = f"{DEFAULT_NUMBER:g}"
        while text is not None:
            value = parse_number(text)
            if value is not None:
                return OperatorAnswer(value)
            if not self.is_interactive:
                return OperatorAnswer(DEFAULT_NUMBER, (AnswerNotANumber(prompt, text, default),))
            text = self._read_answer(f"`{text}` is not a number, such as 12 or -0.5. {prompt}")
        if ends:
            return None
        return OperatorAnswer(DEFAULT_NUMBER, (QuestionUnanswered(prompt, default),))

    def choice(
        self, prompt: str, choices: Sequence[str], *, ends: bool = False
    ) -> OperatorAnswer[int] | None:
        """The index of a key, answered by its text or by its number from 1; "" is no key."""
        # All before the first key are "".
        first = choices.index(next(filter(None, choices), choices[0]))
        offered = f"{prompt} {' / '.join(filter(None, choices))}"
        text = self._read_answer(offered)
        while text is not None:
            index = parse_key(text, choices)
            if index is not None:
                return OperatorAnswer(index)
            if not self.is_interactive:
                return OperatorAnswer(first, (AnswerNotAChoice(prompt, text, choices[first]),))
            text = self._read_answer(f"`{text}` is not one of the keys. {offered}")
        if ends:
            return None
        return OperatorAnswer(first, (QuestionUnanswered(prompt, choices[first]),))

    def text(self, prompt: str, proposal: str, *, ends: bool = False) -> OperatorAnswer[str] | None:
        """The text that answers a question; without one the proposal, or None if it `ends`."""
        text = self._read_answer(prompt)
        if text is None and ends:
            return None
        if text is None:
            return OperatorAnswer(proposal, (QuestionUnanswered(prompt, proposal),))
        return OperatorAnswer(text)

    def _read_answer(self, prompt: str) -> str | None:
        return self.answers(prompt) if self.answers else None


def parse_number(text: str) -> float | None:
    """The finite number in a text; None if it is not one."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def parse_key(text: str, choices: Sequence[str]) -> int | None:
    """The index of the key that a text means, by its text or its number from 1; "" is no key."""
    said = text.strip().lower()
    for index, choice in enumerate(choices):
        if choice and said in (choice.strip().lower(), str(index + 1)):
            return index
    return None
