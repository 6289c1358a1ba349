"""Rules S901 and S908 to S910: house style in statements. None is looked for unasked."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.analysis.rules.facts import Facts
from rapidsim.analysis.rules.instructions import moves
from rapidsim.analysis.walk import clauses, statements
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Severity, Span, Violation
from rapidsim.syntax import tree
from rapidsim.syntax.lexer import lex

_LONGEST_ROUTINE = 100
_STATEMENT = re.compile(
    r"!+\s*(?:(?:\w+(?:\{[^}]*\}|\.\w+)*\s*:=.*|(?:Move[LJC]|MoveAbsJ|WaitTime|WaitDI|SetDO|Set|Reset|"
    r"TPWrite|ConfL|ConfJ)\b[^;]*|\w+);|(?:IF\b.*\bTHEN|ENDIF|ENDWHILE|ENDFOR|ENDPROC|ENDTEST)\s*$)",
)


@dataclass(frozen=True)
class KeywordCase(Violation):
    """A reserved word is not written in capitals.

    RAPID takes any case; the controller's editor writes capitals. `--fix` writes them.

    ## Example

        MODULE example
          PROC main()
            if TRUE then
            endif
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            IF TRUE THEN
            ENDIF
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "S901"
    name: ClassVar[str] = "keyword-case"
    template: ClassVar[str] = "`{word}` is written `{capitals}`"
    severity: ClassVar[Severity] = Severity.NOTE
    on_by_default: ClassVar[bool] = False

    word: str
    capitals: str


@dataclass(frozen=True)
class LongRoutine(Violation):
    """A routine has more statements than one can look over: 100."""

    code: ClassVar[str] = "S908"
    name: ClassVar[str] = "long-routine"
    template: ClassVar[str] = "`{routine}` has {count} statements"
    severity: ClassVar[Severity] = Severity.NOTE
    on_by_default: ClassVar[bool] = False

    routine: str
    count: int

    @property
    def help(self) -> str:
        """The cure."""
        return f"divide it; {_LONGEST_ROUTINE} can be looked over"


@dataclass(frozen=True)
class CommentedOutCode(Violation):
    """A comment is a statement that was taken out.

    Version control remembers what was there; a reader wonders whether it shall come back.

    ## Example

        MODULE example
          PROC main()
            ! WaitTime 5;
            WaitTime 1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            ! The glue needs a second;
            WaitTime 1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "S909"
    name: ClassVar[str] = "commented-out-code"
    template: ClassVar[str] = "this comment is code"
    severity: ClassVar[Severity] = Severity.NOTE
    on_by_default: ClassVar[bool] = False


@dataclass(frozen=True)
class InlineTarget(Violation):
    """A target is written in the move and has no name.

    Nobody can touch it up by name, use it again, or say what it is for.

    ## Example

        MODULE example
          PROC main()
            MoveJ [[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "S910"
    name: ClassVar[str] = "inline-target"
    template: ClassVar[str] = "this target has no name"
    severity: ClassVar[Severity] = Severity.NOTE
    on_by_default: ClassVar[bool] = False


def find_keyword_case(facts: Facts) -> Iterator[Diagnostic]:
    """Reserved words with small letters, each with the edit that writes capitals."""
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
    """Routines of more statements than can be looked over."""
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
    """Comments that read like statements."""
    for file in facts.files:
        for comment in file.comments:
            if _STATEMENT.match(comment.text):
                end = comment.start + len(comment.text)
                yield Diagnostic(CommentedOutCode(), Span(file.source, comment.start, end))


def find_inline_targets(facts: Facts) -> Iterator[Diagnostic]:
    """Moves to a target that is written out."""
    for part in facts.routine_parts:
        for move in moves(part, facts):
            target = move.arguments.get("topoint") or move.arguments.get("tojointpos")
            if isinstance(target, tree.LiteralAggregate | tree.Aggregate):
                yield part.finding(InlineTarget(), target)
