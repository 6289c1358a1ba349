"""Conditions on signals, as a station file writes them: `doGrip = 1 and not diFault`.

Terms are joined by `and` or by `or`; a station file never mixes them, so precedence does not
matter. A signal alone means that it is not 0.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

from rapidsim.values import value_class

_RELATIONS: Mapping[str, Callable[[float, float], bool]] = MappingProxyType(
    {
        "=": operator.eq,
        "<>": operator.ne,
        "<": operator.lt,
        "<=": operator.le,
        ">": operator.gt,
        ">=": operator.ge,
    }
)
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_TERM = re.compile(
    rf"(?P<not>not\s+)?(?P<signal>[A-Za-z]\w*)(?:\s*(?P<relation><>|<=|>=|=|<|>)\s*(?P<value>{_NUMBER}))?",
    re.IGNORECASE,
)
_JOINT = re.compile(r"\s+(and|or)\s+", re.IGNORECASE)


class ConditionError(ValueError):
    """A text that is not a valid condition; the message contains the reason."""


@value_class(frozen=True, slots=True)
class Term:
    """One signal compared with a number."""

    signal: str
    relation: str
    value: float
    negated: bool = False

    def holds(self, read: Callable[[str], float]) -> bool:
        """Whether the term is true for the values that `read` returns."""
        return _RELATIONS[self.relation](read(self.signal), self.value) != self.negated


@value_class(frozen=True, slots=True)
class Condition:
    """Terms with the operators between them."""

    text: str
    terms: tuple[Term, ...]
    joints: tuple[str, ...]
    """`and` or `or` before each term but the first. Both have the same precedence and are evaluated
    from left to right, as a controller evaluates a cross connection."""

    def holds(self, read: Callable[[str], float]) -> bool:
        """Whether the condition is true for the values that `read` returns."""
        truth = self.terms[0].holds(read)
        for joint, term in zip(self.joints, self.terms[1:], strict=True):
            if truth is (joint == "and"):
                truth = term.holds(read)
        return truth

    def signals(self) -> tuple[str, ...]:
        """Names of the signals that the condition reads, as written."""
        return tuple(dict.fromkeys(term.signal for term in self.terms))


def read_condition(text: str) -> Condition:
    """Read a condition.

    Raises:
        ConditionError: If the text is not a condition.
    """
    parts = _JOINT.split(text.strip())
    joints = tuple(word.lower() for word in parts[1::2])
    if len(set(joints)) > 1:
        raise ConditionError(f"`{text}` joins with `and` and with `or`; use one of them")
    return Condition(text, tuple(_term(part, text) for part in parts[::2]), joints)


def _term(part: str, text: str) -> Term:
    match = _TERM.fullmatch(part.strip())
    if match is None or match["signal"].lower() in ("not", "and", "or"):
        raise ConditionError(
            f"`{text}` is not a valid condition; expected e.g. `doGrip = 1 and diOpen = 0`"
        )
    relation, value = match["relation"] or "<>", float(match["value"] or 0.0)
    return Term(match["signal"], relation, value, negated=match["not"] is not None)
