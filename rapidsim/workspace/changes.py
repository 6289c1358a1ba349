"""A change of a text, and its consequences."""

from __future__ import annotations

from collections.abc import Iterable

from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TextChange:
    """Replacement of a part of a text; offsets count the characters of the text before."""

    start: int
    end: int
    """Offset past the last replaced character."""
    text: str


@value_class(frozen=True, slots=True)
class Changed:
    """Consequences of a change."""

    paths: frozenset[str]
    """Files whose findings changed, and the changed file."""
    is_local: bool = False
    """Whether only a part of the file was read again."""


def changed_text(text: str, changes: Iterable[TextChange]) -> str:
    """Return a text after changes, each of which refers to the text that the previous ones left.

    Raises:
        ValueError: If a change refers to characters that the text does not have.
    """
    for one in changes:
        if not 0 <= one.start <= one.end <= len(text):
            raise ValueError(
                f"the text has {len(text)} characters, so {one.start} to {one.end} is no part of it"
            )
        text = f"{text[: one.start]}{one.text}{text[one.end :]}"
    return text
