"""Rules E1 about the text itself: characters, names, strings, numbers, contents of the file."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class LimitExceeded(Violation, code="E108"):
    subject: str
    extent: str
    limit: str


class UnterminatedString(Violation, code="E109"):
    pass


class TextOutsideModule(Violation, code="E110"):
    pass


class TextBehindModule(Violation, code="E124"):
    pass


class NoModule(Violation, code="E111"):
    pass


class BadEscape(Violation, code="E116"):
    pass


class UnknownCharacter(Violation, code="E118"):
    characters: str


class ReservedName(Violation, code="E121"):
    word: str


class NameWithParentheses(Violation, code="E122"):
    written: str
