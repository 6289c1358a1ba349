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


def text_difference(before: str, after: str) -> TextChange | None:
    """Return the change that makes one text another; None if they are equal."""
    if before == after:
        return None
    start = _shared(before, after)
    # The ends are those of the rest, or a doubled line would count twice.
    end = _shared(before[start:][::-1], after[start:][::-1])
    return TextChange(start, len(before) - end, after[start : len(after) - end])


def _shared(text: str, second: str) -> int:
    """Number of equal characters at the beginning of two texts."""
    pairs = enumerate(zip(text, second, strict=False))
    return next((k for k, (a, b) in pairs if a != b), min(len(text), len(second)))
