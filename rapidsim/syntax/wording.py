"""Descriptions of tokens, statements and expectations in a robot programmer's terms."""

from __future__ import annotations

from rapidsim.syntax.parse_failure import ParseFailure, TokenBuffer
from rapidsim.syntax.recognizer import accepts
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import END

_LONGEST = 24

# Name of a statement or head by its first word.
_CONSTRUCTS = {
    "MODULE": "the head of MODULE",
    "PROC": "the head of PROC",
    "FUNC": "the head of FUNC",
    "TRAP": "the head of TRAP",
    "RECORD": "the head of RECORD",
    "ALIAS": "the ALIAS declaration",
    "IF": "the IF statement",
    "ELSEIF": "the ELSEIF condition",
    "FOR": "the head of the FOR loop",
    "WHILE": "the condition of the WHILE loop",
    "TEST": "the TEST statement",
    "CASE": "the CASE",
    "GOTO": "the GOTO statement",
    "RETURN": "the RETURN statement",
    "RAISE": "the RAISE statement",
    "CONNECT": "the CONNECT statement",
    "ERROR": "the ERROR clause",
    "PERCENT": "the late bound call",
}


def token(row: TokenBuffer, index: int) -> str:
    """Describe a token in a message: its text in backquotes, shortened."""
    if row.kinds[index] == END:
        return "the end of the text"
    text = row.text(index)
    if row.kinds[index] == "STRING" and len(text) > _LONGEST:
        return "the string"
    return f"`{text[:_LONGEST]}...`" if len(text) > _LONGEST else f"`{text}`"


def symbol(kind: str) -> str:
    """Describe a kind of token in a message: the mark in backquotes or the word in capitals."""
    if kind == "EXP":
        return "an expression"
    if kind == "NAME":
        return "a name"
    text = mark(kind)
    return kind if text in (None, kind) else f"`{text}`"


def mark(kind: str) -> str | None:
    """Text of a mark or a reserved word; None for other kinds."""
    if kind in rapid_table().words:
        return kind
    marks = rapid_table().marks.items()
    return next((text for text, terminal in marks if terminal == kind and kind != "EXP"), None)


def construct(row: TokenBuffer, first: int, stop: int) -> str:
    """Describe the statement or declaration of these tokens, such as "the call of `P`"."""
    kinds = row.kinds
    while first < stop and kinds[first] in {"LOCAL", "TASK"}:
        first += 1
    kind = kinds[first]
    if kind in {"VAR", "PERS", "CONST"}:
        named = first + 2 < stop and kinds[first + 2] == "NAME"
        return f"the declaration of {token(row, first + 2)}" if named else "the declaration"
    if kind in _CONSTRUCTS:
        called = _CONSTRUCTS[kind]
        if called.startswith("the head of") and first + 1 < stop and kinds[first + 1] == "NAME":
            if kind == "FUNC" and first + 2 < stop and kinds[first + 2] == "NAME":
                return f"{called} {token(row, first + 2)}"
            if kind not in {"FOR", "FUNC"}:
                return f"{called} {token(row, first + 1)}"
        return called
    if kind == "NAME":
        if any(
            kinds[index] in {"BECOMES", "EQUAL"}
            for index in range(first, _target_end(row, first, stop))
        ):
            return f"the assignment to {token(row, first)}"
        return f"the call of {token(row, first)}"
    return "the statement"


def problem(situation: ParseFailure) -> str:
    """Describe the token that does not fit, and the expected one."""
    row, index = situation.row, situation.index
    expected = _expected(situation)
    found = token(row, index)
    if expected:
        return f"{found} where {expected} is expected"
    return f"{found} does not fit"


def _expected(situation: ParseFailure) -> str | None:
    """Describe the only valid alternative; None if there are several."""
    if accepts(situation.stack, ["EXP"]):
        return "an expression"
    if accepts(situation.stack, ["NAME"]):
        return "a name"
    fitting = [
        kind
        for kind in (
            "SEMICOLON",
            "COMMA",
            "RPAR",
            "RBRACE",
            "RSQB",
            "BECOMES",
            "THEN",
            "DO",
            "TO",
            "FROM",
            "WITH",
            "COLON",
        )
        if accepts(situation.stack, [kind])
    ]
    if 1 <= len(fitting) <= 3:
        return " or ".join(symbol(kind) for kind in fitting)
    return None


def _target_end(row: TokenBuffer, first: int, stop: int) -> int:
    """Index after the mark that may follow the target of an assignment."""
    depth = 0
    for index in range(first, stop):
        kind = row.kinds[index]
        depth += (kind == "LBRACE") - (kind == "RBRACE")
        if depth == 0 and kind not in {"NAME", "DOT", "RBRACE"}:
            return index + 1
        if depth == 0 and kind == "NAME" and index > first and row.kinds[index - 1] != "DOT":
            return index
    return stop
