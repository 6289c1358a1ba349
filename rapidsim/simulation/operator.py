"""The person at the FlexPendant: answers from a file, a terminal, or nobody.

A run in CI must never hang on a question, so where nobody answers a default is taken and said.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from rapidsim.diagnostics import Violation
from rapidsim.simulation.options import Answers
from rapidsim.simulation.violations import (
    AnswerNotAChoice,
    AnswerNotANumber,
    QuestionUnanswered,
)

DEFAULT_NUMBER = 0.0


T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Answer(Generic[T]):
    """What was answered, and what was wrong with getting it."""

    value: T
    findings: tuple[Violation, ...] = ()


@dataclass(frozen=True, slots=True)
class Operator:
    """Asks whoever answers."""

    answers: Answers | None

    def number(self, prompt: str) -> Answer[float]:
        """The answer to a question for a number."""
        text = self._ask(prompt)
        default = f"{DEFAULT_NUMBER:g}"
        if text is None:
            return Answer(DEFAULT_NUMBER, (QuestionUnanswered(prompt, default),))
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            return Answer(DEFAULT_NUMBER, (AnswerNotANumber(prompt, text, default),))
        return Answer(value)

    def choice(self, prompt: str, choices: Sequence[str]) -> Answer[int]:
        """The index of a key, answered by its text or by its number from 1; "" is no key."""
        keys = [index for index, text in enumerate(choices) if text]
        first = keys[0] if keys else 0
        text = self._ask(f"{prompt} {' / '.join(choices[index] for index in keys)}")
        if text is None:
            return Answer(first, (QuestionUnanswered(prompt, choices[first]),))
        for index in keys:
            if text.strip().lower() in (choices[index].strip().lower(), str(index + 1)):
                return Answer(index)
        return Answer(first, (AnswerNotAChoice(prompt, text, choices[first]),))

    def text(self, prompt: str, proposal: str) -> Answer[str]:
        """A text; the proposal where nobody answers."""
        text = self._ask(prompt)
        if text is None:
            return Answer(proposal, (QuestionUnanswered(prompt, proposal),))
        return Answer(text)

    def _ask(self, prompt: str) -> str | None:
        return self.answers(prompt) if self.answers else None
