"""Repairs of single tokens: a misspelt word, a missing, superfluous or wrong mark.

A repair is accepted only if the tokens after it parse.
"""

from __future__ import annotations

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Span
from rapidsim.syntax import wording
from rapidsim.syntax.blocks import CLOSERS, DIVIDERS, ITEMS, OPENERS
from rapidsim.syntax.lexer import UNKNOWN, lex
from rapidsim.syntax.parse_failure import (
    ParseFailure,
    Patch,
    TokenBuffer,
    deletion,
    insertion,
    replacement,
)
from rapidsim.syntax.recognizer import accepts, in_list
from rapidsim.syntax.spelling import near_words
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import END
from rapidsim.syntax.text_violations import NameWithParentheses, ReservedName, UnknownCharacter
from rapidsim.syntax.violations import (
    MissingSemicolon,
    MissingSymbol,
    MisspeltWord,
    SquareIndex,
    UnexpectedSymbol,
)

BLOCK_WORDS = frozenset({*CLOSERS, *OPENERS, *DIVIDERS, *ITEMS, END})
"""Kinds that determine the position in the structure of a file."""
# In the order tried: separators, closing marks, dividers, beginnings. A comma precedes a
# semicolon because within a line an argument is more likely than a statement.
_MISSING = (
    *("COMMA", "SEMICOLON", "RPAR", "RSQB", "RBRACE"),
    *("THEN", "DO", "BECOMES", "COLON", "EXP"),
    *("LPAR", "BACKSLASH", "PERCENT", "TO", "FROM", "WITH", "NAME"),
)
_VALUES = frozenset({"NAME", "NUMBER", "STRING", "LITERALS"})
"""Kinds of which two in a row are two values; of two equal marks the second is dropped."""
_FOREIGN = {"=>": (">=",), "=<": ("<=",), "==": (":=", "="), "&&": ("AND",), "||": ("OR",)}
"""Marks of other languages, and what they may mean."""
_OPERATORS = frozenset({"PLUS", "MINUS", "STAR", "SLASH"})
_BRACKETS = {"RPAR": "LPAR", "RSQB": "LSQB", "RBRACE": "LBRACE"}
# Number of tokens before the failing one in which the cause is searched. Every attempt costs a
# parse of the statement, and a generated statement may have thousands of tokens.
_FARTHEST = 100
# Names with a part in parentheses: longer ones are more likely something else.
_LONGEST_PART = 8


def foreign_mark(at: ParseFailure) -> Patch | None:
    """Read a mark of another language, such as `==` or `&&`, as the one that is meant."""
    row = at.row
    for first in (at.index - 1, at.index):
        if first < at.statement or not _touch(row, first):
            continue
        span = row.span(first, first + 2)
        for meant in _FOREIGN.get(span.text, ()):
            kind = rapid_table().marks.get(meant, meant)
            before = row.kinds[at.statement : first]
            if accepts(at.statement_stack, [*before, kind, *at.window(first + 2)]):
                where = wording.construct(row, at.statement, at.index)
                violation = UnexpectedSymbol(
                    f"`{span.text}`, read as {wording.symbol(kind)},", where
                )
                fix = written_fix(span.start, row, kind, span.end)
                return replacement(row, first, first + 2, kind, violation, fix)
    return None


def compound_assignment(at: ParseFailure) -> Patch | None:
    """Read `n+=1` as an assignment; the fix writes `n:=n+1`."""
    row = at.row
    operator = at.index if at.kind in _OPERATORS else at.index - 1
    is_compound = row.kinds[operator] in _OPERATORS and _touch(row, operator)
    if not is_compound or row.kinds[operator + 1] != "EQUAL" or operator <= at.statement:
        return None
    before = row.kinds[at.statement : operator]
    if not accepts(at.statement_stack, [*before, "BECOMES", *at.window(operator + 2)]):
        return None
    span = row.span(operator, operator + 2)
    data = row.span(at.statement, operator).text
    edit = Edit(span, f":={data}{row.text(operator)}")
    violation = UnexpectedSymbol(f"`{span.text}`, read as `:=`,", "the assignment")
    fix = Fix(f"Write `{data}{edit.text}`", (edit,), safe=False)
    return replacement(row, operator, operator + 2, "BECOMES", violation, fix)


def unknown_character(at: ParseFailure) -> Patch | None:
    """Drop characters that RAPID does not have."""
    row, stop = at.row, at.index
    while row.kinds[stop] == UNKNOWN and (
        stop == at.index or row.starts[stop] == row.ends[stop - 1]
    ):
        stop += 1
    if stop == at.index:
        return None
    characters = row.span(at.index, stop).text
    return deletion(row, at.index, stop, UnknownCharacter(characters))


def misspelt_word(at: ParseFailure) -> Patch | None:
    """Correct the name in the statement that is a misspelt reserved word."""
    return _respelt(at, at.window(at.index)) or _split_word(at)


def half_readable_word(at: ParseFailure) -> Patch | None:
    """Correct a misspelt reserved word although another error follows soon."""
    return _respelt(at, [at.kind])


def _respelt(at: ParseFailure, window: list[str]) -> Patch | None:
    """Respell the nearest name such that the failing token and those after it parse."""
    row = at.row
    kinds = [*row.kinds[at.statement : at.index], *window]
    best: tuple[int, int, str] | None = None
    for index in range(max(at.statement, at.index - _FARTHEST), at.index + 1):
        if row.kinds[index] != "NAME" or row.starts[index] == row.ends[index]:
            continue
        for slips, word in near_words(row.text(index)):
            respelt = list(kinds)
            respelt[index - at.statement] = rapid_table().words[word]
            if accepts(at.statement_stack, respelt):
                best = min(best, (slips, -index, word)) if best else (slips, -index, word)
    if best is None:
        return None
    _, index, word = best
    return respelling(row, -index, 1 - index, word)


def respelling(row: TokenBuffer, start: int, stop: int, word: str) -> Patch:
    """Replace tokens by a reserved word."""
    span = row.span(start, stop)
    # The intended word is a guess; behind a backslash it may be spelt right already.
    is_spelt = span.text.upper() == word
    fix = None if is_spelt else Fix(f"Write {word}", (Edit(span, word),), safe=False)
    violation = MisspeltWord(" ".join(span.text.split()), word)
    return replacement(row, start, stop, rapid_table().words[word], violation, fix)


def _split_word(at: ParseFailure) -> Patch | None:
    """Join `END IF` to ENDIF."""
    row = at.row
    for first in (at.index, at.index - 1):
        if first < at.statement or row.kinds[first] != "NAME" or row.kinds[first + 1] == END:
            continue
        word = (row.text(first) + row.text(first + 1)).upper()
        kind = rapid_table().words.get(word)
        if kind and accepts(at.statement_stack, [*row.kinds[at.statement : first], kind]):
            return respelling(row, first, first + 2, word)
    return None


def missing_semicolon(at: ParseFailure) -> Patch | None:
    """Insert a semicolon at the end of a line, if the next line then parses."""
    row = at.row
    candidates = [
        index
        for index in range(at.index, max(at.statement, at.index - _FARTHEST), -1)
        if row.first_on_line(index) or (index == at.index and row.kinds[index] in BLOCK_WORDS)
    ]
    for index in candidates:
        before = row.kinds[at.statement : index]
        after = [*row.kinds[index : at.index], *at.window(at.index)]
        stack_takes = accepts(at.statement_stack, [*before, "SEMICOLON", *after])
        if stack_takes and not _ends_statement(before):
            return semicolon_before(row, at.statement, index)
    return None


def semicolon_before(row: TokenBuffer, statement: int, index: int) -> Patch:
    """End the statement that begins at one token before another token."""
    place = row.place_before(index)
    span = Span(row.source, place, place)
    patch = insertion(
        row, index, "SEMICOLON", MissingSemicolon(wording.construct(row, statement, index))
    )
    fix = Fix("Add `;`", (Edit(span, ";"),))
    diagnostic = Diagnostic(patch.diagnostic.violation, span, fix=fix)
    return Patch(patch.start, patch.stop, patch.tokens, diagnostic)


def reserved_name(at: ParseFailure) -> Patch | None:
    """Interpret a reserved word as a name where only a name is valid."""
    row, index = at.row, at.index
    word = row.text(index).upper()
    if word not in rapid_table().words or row.first_on_line(index):
        return None
    only_a_name = accepts(at.stack, ["NAME"]) and not accepts(at.stack, ["NUMBER"])
    if not only_a_name or in_list(at.stack) or not at.accepts_after(["NAME"], index + 1):
        return None
    return replacement(row, index, index + 1, "NAME", ReservedName(row.text(index)))


def name_with_parentheses(at: ParseFailure) -> Patch | None:
    """Drop the part in parentheses of a declared name such as `grip(open)`."""
    row, index = at.row, at.index
    if at.kind != "LPAR" or row.kinds[index - 1] != "NAME":
        return None
    closing = next(
        (
            i
            for i in range(index + 1, min(index + _LONGEST_PART, len(row.kinds)))
            if row.kinds[i] == "RPAR"
        ),
        None,
    )
    if closing is None or not at.accepts_after([], closing + 1):
        return None
    span = row.span(index - 1, closing + 1)
    return Patch(index, closing + 1, (), Diagnostic(NameWithParentheses(span.text), span))


def square_index(at: ParseFailure) -> Patch | None:
    """Correct `a[1]` to `a{1}`."""
    row = at.row
    for opening in range(at.index, max(at.index - 8, at.statement), -1):
        if (
            row.kinds[opening] not in {"LITERALS", "LSQB"}
            or row.kinds[opening - 1] != "NAME"
            or row.starts[opening] != row.ends[opening - 1]
        ):
            continue
        stop = opening + 1
        if row.kinds[opening] == "LITERALS":
            first = row.starts[opening] + 1
            inner = lex(row.text(opening)[1:-1])
            indices = [
                (kind, first + start, first + end)
                for kind, start, end in zip(inner.kinds, inner.starts, inner.ends, strict=True)
            ][:-1]
        else:
            while row.kinds[stop - 1] not in {"RSQB", "SEMICOLON", END}:
                stop += 1
            if row.kinds[stop - 1] == END:
                continue
            indices = [row.token(index) for index in range(opening + 1, stop - 1)]
        span = row.span(opening, stop)
        tokens = (
            ("LBRACE", span.start, span.start + 1),
            *indices,
            ("RBRACE", span.end - 1, span.end),
        )
        kinds = [kind for kind, _, _ in tokens]
        before = row.kinds[at.statement : opening]
        if accepts(at.statement_stack, [*before, *kinds, *row.kinds[stop : stop + 2]]):
            diagnostic = Diagnostic(SquareIndex(row.text(opening - 1)), span)
            return Patch(opening, stop, tokens, diagnostic)
    return None


def doubled_token(at: ParseFailure) -> Patch | None:
    """Drop the second of two equal marks, before an expression is inserted between them."""
    row, index = at.row, at.index
    doubled = index > at.statement and at.kind == row.kinds[index - 1] and at.kind not in _VALUES
    if not doubled or at.kind in BLOCK_WORDS or not at.accepts_after([], index + 1):
        return None
    where = wording.construct(row, at.statement, index)
    patch = deletion(row, index, index + 1, UnexpectedSymbol(wording.token(row, index), where))
    return patch.with_fix(_without(row, index))


def missing_token(at: ParseFailure) -> Patch | None:
    """Insert the single token that lets the parse continue."""
    row, index = at.row, at.index
    for kind in _MISSING:
        # A label is rarely what is meant: ELSE and CASE of other languages end in a colon.
        if (kind, at.kind) == ("NAME", "COLON") or not at.accepts_after([kind], index):
            continue
        if kind == "SEMICOLON":
            if in_list(at.stack) or _glued_to_number(row, index):
                continue
            return semicolon_before(row, at.statement, index)
        violation = MissingSymbol(wording.symbol(kind), wording.construct(row, at.statement, index))
        patch = insertion(row, index, kind, violation, _opening(at, kind))
        return patch.with_fix(written_fix(row.place_before(index), row, kind))
    return None


def written_fix(start: int, row: TokenBuffer, kind: str, stop: int | None = None) -> Fix | None:
    """Write a mark or a reserved word over a range, or at its start; None for other kinds.

    The place and the mark are a guess: the parser only knows that the text can be read then.
    """
    written = wording.mark(kind)
    if written is None:
        return None
    span = Span(row.source, start, start if stop is None else stop)
    text = row.source.text
    before, after = text[max(start - 1, 0) : start], text[span.end : span.end + 1]
    is_word = written.isalpha()
    left = " " * (is_word and (before.isalnum() or stop is None))
    right = " " * (is_word and after.isalnum())
    return Fix(f"Write `{written}`", (Edit(span, f"{left}{written}{right}"),), safe=False)


def wrong_token(at: ParseFailure) -> Patch | None:
    """Drop one token, or replace it by another."""
    row, index = at.row, at.index
    if at.kind == END:
        return None
    where = wording.construct(row, at.statement, index)
    written = wording.token(row, index)
    condition = row.kinds[at.statement] in {"IF", "ELSEIF", "WHILE"}
    if at.kind == "BECOMES" and condition and at.accepts_after(["EQUAL"], index + 1):
        violation = UnexpectedSymbol("`:=`, which assigns where `=` compares,", where)
        return _replaced(row, index, "EQUAL", violation)
    if at.kind == "EQUAL" and at.accepts_after(["BECOMES"], index + 1):
        violation = UnexpectedSymbol("`=`, which compares where `:=` gives a value,", where)
        return _replaced(row, index, "BECOMES", violation)
    if at.kind in BLOCK_WORDS:
        return None
    if at.accepts_after([], index + 1):
        patch = deletion(row, index, index + 1, UnexpectedSymbol(written, where))
        return patch if at.kind in _VALUES else patch.with_fix(_without(row, index))
    for kind in ("COMMA", "BECOMES", "COLON", "RPAR", "RBRACE", "RSQB", "LPAR", "FROM", "EXP"):
        if at.accepts_after([kind], index + 1):
            violation = UnexpectedSymbol(f"{written}, read as {wording.symbol(kind)},", where)
            return _replaced(row, index, kind, violation)
    return None


def _replaced(row: TokenBuffer, index: int, kind: str, violation: UnexpectedSymbol) -> Patch:
    """Replace a token by another one."""
    fix = written_fix(row.starts[index], row, kind, row.ends[index])
    return replacement(row, index, index + 1, kind, violation, fix)


def _without(row: TokenBuffer, index: int) -> Fix:
    """Remove a token."""
    span = row.span(index, index + 1)
    return Fix(f"Remove `{span.text}`", (Edit(span, ""),), safe=False)


def _touch(row: TokenBuffer, index: int) -> bool:
    """Whether a token is followed by another one without a blank."""
    return index + 1 < len(row.kinds) and row.starts[index + 1] == row.ends[index]


def _glued_to_number(row: TokenBuffer, index: int) -> bool:
    """Whether a token touches a number, as in `10mm`, and so ends no statement."""
    return row.kinds[index - 1] == "NUMBER" and row.starts[index] == row.ends[index - 1]


def _ends_statement(kinds: list[str]) -> bool:
    return not kinds or kinds[-1] == "SEMICOLON"


def _opening(at: ParseFailure, closing: str) -> tuple[Related, ...]:
    """Location of the bracket that a missing one would close."""
    opener = _BRACKETS.get(closing)
    depth = 0
    for index in range(at.index - 1, at.statement - 1, -1):
        kind = at.row.kinds[index]
        depth += (kind == closing) - (kind == opener)
        if opener and depth < 0:
            return (Related(at.row.span(index, index + 1), "opened here"),)
    return ()
