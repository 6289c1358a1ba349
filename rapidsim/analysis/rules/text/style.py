"""Rules S901 and S908 to S910: style of statements; all are off by default."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.facts.instruction_questions import moves
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Span, Violation
from rapidsim.syntax import tree
from rapidsim.syntax.lexer import lex

_LONGEST_ROUTINE = 100
_STATEMENT = re.compile(
    r"!+\s*(?:(?:\w+(?:\{[^}]*\}|\.\w+)*\s*:=.*|(?:Move[LJC]|MoveAbsJ|WaitTime|WaitDI|SetDO|Set|Reset|"
    r"TPWrite|ConfL|ConfJ)\b[^;]*|\w+);|(?:IF\b.*\bTHEN|ENDIF|ENDWHILE|ENDFOR|ENDPROC|ENDTEST)\s*$)",
)


class KeywordCase(Violation, code="S901"):
    word: str
    capitals: str


class LongRoutine(Violation, code="S908"):
    routine: str
    count: int

    @property
    def help(self) -> str:
        """Suggestion to split the routine."""
        return f"divide it; {_LONGEST_ROUTINE} can be looked over"


class CommentedOutCode(Violation, code="S909"):
    pass


class InlineTarget(Violation, code="S910"):
    pass


def find_keyword_case(facts: Facts) -> Iterator[Diagnostic]:
    """Report reserved words with lower-case letters, each with the edit that capitalises it."""
    for file in facts.files:
        tokens = lex(file.source.text)
        for kind, start, end in zip(tokens.kinds, tokens.starts, tokens.ends, strict=True):
            span = Span(file.source, start, end)
            if kind in ("NAME", "LITERALS", "STRING") or not span.text[:1].isalpha():
                continue
            capitals = span.text.upper()
            if capitals == span.text:
                continue
            fix = Fix("write capitals", (Edit(span, capitals),))
            yield Diagnostic(KeywordCase(span.text, capitals), span, fix=fix)


def find_long_routines(facts: Facts) -> Iterator[Diagnostic]:
    """Report routines with too many statements to read at once."""
    for part in facts.routine_parts:
        assert part.routine is not None
        count = sum(
            not isinstance(statement, tree.Data | tree.Empty)
            for statement in statements(*clauses(part.routine))
        )
        if count > _LONGEST_ROUTINE:
            name = part.routine.name
            yield part.finding(LongRoutine(name.text, count), name)


def find_commented_out(facts: Facts) -> Iterator[Diagnostic]:
    """Report comments that look like statements."""
    for file in facts.files:
        for comment in file.comments:
            if _STATEMENT.match(comment.text):
                end = comment.start + len(comment.text)
                yield Diagnostic(CommentedOutCode(), Span(file.source, comment.start, end))


def find_inline_targets(facts: Facts) -> Iterator[Diagnostic]:
    """Report moves with an inline target."""
    for part in facts.routine_parts:
        for move in moves(part, facts):
            target = move.arguments.get("topoint") or move.arguments.get("tojointpos")
            if isinstance(target, tree.LiteralAggregate | tree.Aggregate):
                yield part.finding(InlineTarget(), target)
