"""The statement and the call around an offset, from the text before it.

Read from tokens, not from the tree: while a call is typed, its text is broken, and a repair may
have moved its parts.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from rapidsim.values import value_class

_FARTHEST = 4000
"""Number of characters before an offset that are read; a statement is shorter."""
_TOKEN = re.compile(
    r'"(?:[^"\r\n]|"")*"?|![^\r\n]*|\d[\w.]*|\w+|<\w+>|:=|<>|[<>]=|[^\s\w]', re.UNICODE
)
_ENDS = frozenset(
    {";", "THEN", "DO", "ELSE", "DEFAULT", "ERROR", "UNDO", "BACKWARD", "ENDMODULE", "ENDPROC"}
    | {"ENDFUNC", "ENDTRAP", "ENDRECORD", "ENDIF", "ENDFOR", "ENDWHILE", "ENDTEST"}
)
"""Tokens after which a statement begins."""
_HEADS = frozenset({"PROC", "FUNC", "TRAP"})
_OPENING, _CLOSING = frozenset("([{"), frozenset(")]}")


@value_class(frozen=True, slots=True)
class Token:
    """A token before an offset."""

    text: str
    start: int

    @property
    def is_name(self) -> bool:
        """Whether it is a name or a word."""
        return self.text[0].isalpha() or self.text[0] == "_"

    @property
    def end(self) -> int:
        """Offset past its last character."""
        return self.start + len(self.text)


@value_class(frozen=True, slots=True)
class CallContext:
    """A call of which an argument is being written."""

    name: Token
    is_function: bool
    required: int
    """Index of the required argument; meaningless inside an option."""
    option: str | None = None
    """Name of the option whose value is written, without backslash."""
    written: tuple[str, ...] = ()
    """Folded names of the options that the call has already."""


@value_class(frozen=True, slots=True)
class StatementContext:
    """The text of a statement up to an offset."""

    tokens: tuple[Token, ...]
    """Tokens before the name that is being written."""
    prefix: str
    """Part of a name directly before the offset."""
    is_text: bool = False
    """Whether the offset is inside a string or a comment."""

    @property
    def is_start(self) -> bool:
        """Whether a statement begins here."""
        return not self.tokens

    @property
    def previous(self) -> str:
        """Text of the last token; empty at the beginning of a statement."""
        return self.tokens[-1].text if self.tokens else ""


def statement_context(text: str, offset: int) -> StatementContext:
    """Return the statement around an offset, up to the offset."""
    begin = max(0, offset - _FARTHEST)
    begin = text.rfind("\n", 0, begin) + 1 if begin else 0
    tokens: list[Token] = []
    depth = 0
    for match in _TOKEN.finditer(text, begin, offset):
        token = Token(match.group(), match.start())
        if token.text[0] == "!":
            if match.end() == offset:
                return StatementContext((), "", is_text=True)
            continue
        word = token.text.upper()
        if word == ")" and depth == 1 and _is_head(tokens):
            tokens, depth = [], 0
            continue
        depth += (token.text in _OPENING) - (token.text in _CLOSING)
        is_written = token.is_name and match.end() == offset
        if (word in _ENDS and not is_written) or (word == ":" and _is_label(tokens)):
            tokens, depth = [], 0
            continue
        tokens.append(token)
    last = tokens[-1] if tokens else None
    if last is not None and last.end == offset:
        if last.text[0] == '"' and not _is_closed(last.text):
            return StatementContext((), "", is_text=True)
        if last.is_name:
            return StatementContext(tuple(tokens[:-1]), last.text)
    return StatementContext(tuple(tokens), "")


def call_context(
    tokens: Sequence[Token], is_procedure: Callable[[str], bool]
) -> CallContext | None:
    """Return the innermost call in which the text after some tokens is an argument.

    Args:
        tokens: The tokens of a statement.
        is_procedure: Whether a name can be called as a statement.
    """
    opened: list[int] = []
    for index, token in enumerate(tokens):
        if token.text in _OPENING:
            opened.append(index)
        elif token.text in _CLOSING and opened:
            opened.pop()
    for index in reversed(opened):
        if tokens[index].text == "(" and index > 0 and tokens[index - 1].is_name:
            return _call(tokens[index - 1], tokens[index + 1 :], is_function=True)
        if tokens[index].text != "(":
            # An element of an aggregate or an index, not an argument.
            return None
    for index, token in enumerate(tokens):
        before = tokens[index - 1].text if index else ")"
        follows = before in _CLOSING or before[0].isalnum() or before[0] in '_"'
        if token.is_name and follows and is_procedure(token.text.lower()):
            return _call(token, tokens[index + 1 :], is_function=False)
    return None


def _call(name: Token, arguments: Sequence[Token], *, is_function: bool) -> CallContext:
    depth = commas = 0
    option: str | None = None
    written: list[str] = []
    for index, token in enumerate(arguments):
        depth += (token.text in _OPENING) - (token.text in _CLOSING)
        if depth:
            continue
        if token.text == ",":
            commas += 1
            option = None
        elif token.text == "\\" and index + 1 < len(arguments):
            option = arguments[index + 1].text
            written.append(option.lower())
    begins_with_option = bool(arguments) and arguments[0].text == "\\"
    required = max(0, commas - begins_with_option)
    return CallContext(name, is_function, required, option, tuple(written))


def _is_head(tokens: Sequence[Token]) -> bool:
    return any(token.text.upper() in _HEADS for token in tokens[:2])


def _is_label(tokens: Sequence[Token]) -> bool:
    first = tokens[0].text.upper() if tokens else ""
    return len(tokens) == 1 or first == "CASE"


def _is_closed(text: str) -> bool:
    return len(text) > 1 and text.endswith('"') and text.count('"') % 2 == 0
