"""Rules E1 about statements and blocks: what does not follow RAPID's syntax.

E104 to E107 are not rules of the syntax. The rules about characters, names and whole files are in
`rapidsim.syntax.text_violations`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Violation


@dataclass(frozen=True)
class BrokenSyntax(Violation):
    """A statement or declaration does not follow RAPID's syntax.

    It is left out; the rest of the file is read as if it were not there. No controller loads a
    module with such an error.

    ## Example

        MODULE example
          PROC main()
            VAR num x;
            x:=(1 2) 3;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR num x;
            x:=(1+2)*3;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E101"
    name: ClassVar[str] = "syntax-error"
    template: ClassVar[str] = "{construct} cannot be read: {problem}"

    construct: str
    problem: str


@dataclass(frozen=True)
class UnclosedBlock(Violation):
    """A block is opened and not closed.

    The place is where the closing word is missing at the latest; the word that opened the block is
    named beside it. Indentation decides which of several blocks is meant.

    ## Example

        MODULE example
          PROC main()
            IF DInput(di1)=1 THEN
              Stop;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            IF DInput(di1)=1 THEN
              Stop;
            ENDIF
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E102"
    name: ClassVar[str] = "unclosed-block"
    template: ClassVar[str] = "{closer} is missing for the {block} of line {line}"

    block: str
    closer: str
    line: int


@dataclass(frozen=True)
class MissingSemicolon(Violation):
    """A statement or declaration does not end in a semicolon.

    A missing semicolon after a call without arguments is no syntax error to a grammar: `Stop` above
    `Home;` reads as a call of Stop with the argument Home. An argument on a later line than
    the name, which could be a statement by itself, is therefore taken for one, unless it is
    indented deeper: then the call goes on there.

    ## Example

        MODULE example
          PROC main()
            VAR num x;
            x:=1
            Stop;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR num x;
            x:=1;
            Stop;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E103"
    name: ClassVar[str] = "missing-semicolon"
    template: ClassVar[str] = "`;` is missing after {construct}"

    construct: str


@dataclass(frozen=True)
class MisspeltWord(Violation):
    """A reserved word is misspelt.

    It is read as the word that is meant. Only a word that makes the statement readable is
    suggested.

    ## Example

        MODULE example
          PROC main()
            IF DInput(di1)=1 THNE
              Stop;
            ENDIF
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            IF DInput(di1)=1 THEN
              Stop;
            ENDIF
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E112"
    name: ClassVar[str] = "misspelt-word"
    template: ClassVar[str] = "`{written}` should read {word}"

    written: str
    word: str


@dataclass(frozen=True)
class MissingSymbol(Violation):
    """A bracket, comma or other mark, a word or a whole expression is left out.

    It is read as if it stood there.

    ## Example

        MODULE example
          PROC main()
            MoveL Offs(p10,0,0,50,v100,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            MoveL Offs(p10,0,0,50),v100,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E113"
    name: ClassVar[str] = "missing-symbol"
    template: ClassVar[str] = "{symbol} is missing in {construct}"

    symbol: str
    construct: str


@dataclass(frozen=True)
class UnexpectedSymbol(Violation):
    """A mark or word stands where the statement has no place for it.

    The statement is read without it.

    ## Example

        MODULE example
          PROC main()
            SetDO doGrip,,1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            SetDO doGrip,1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E114"
    name: ClassVar[str] = "unexpected-symbol"
    template: ClassVar[str] = "{symbol} does not belong in {construct}"

    symbol: str
    construct: str


@dataclass(frozen=True)
class StrayBlockWord(Violation):
    """A word that closes or divides a block stands where no such block is open.

    It is left out. Often the line that opened the block was deleted, or the block was closed twice.

    ## Example

        MODULE example
          PROC main()
            Stop;
            ENDIF
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            Stop;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E115"
    name: ClassVar[str] = "stray-block-word"
    template: ClassVar[str] = "{word} stands here without {opener}"

    word: str
    opener: str


@dataclass(frozen=True)
class BrokenHead(Violation):
    """The head of a module, a routine or a block cannot be read.

    Its body is read nevertheless, with whatever name the head shows.

    ## Example

        MODULE example
          PROC main()
            FOR i=1 TO 3 DO
              Stop;
            ENDFOR
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            FOR i FROM 1 TO 3 DO
              Stop;
            ENDFOR
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E117"
    name: ClassVar[str] = "broken-head"
    template: ClassVar[str] = "{construct} cannot be read: {problem}"

    construct: str
    problem: str


@dataclass(frozen=True)
class RepeatedClause(Violation):
    """A routine has a second ERROR, UNDO or BACKWARD clause.

    Only the first is kept. Tell errors apart inside one ERROR clause with IF or TEST on ERRNO.

    ## Example

        MODULE example
          PROC main()
            Stop;
          UNDO
            Reset doGrip;
          UNDO
            Reset doClamp;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            Stop;
          UNDO
            Reset doGrip;
            Reset doClamp;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E119"
    name: ClassVar[str] = "repeated-clause"
    template: ClassVar[str] = "the routine has an {clause} clause already"

    clause: str


@dataclass(frozen=True)
class SquareIndex(Violation):
    """An element of an array is written with square brackets.

    RAPID writes elements with braces and counts from 1; square brackets make aggregates.

    ## Example

        MODULE example
          VAR num a{3};
          PROC main()
            a{1}:=a[2];
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num a{3};
          PROC main()
            a{1}:=a{2};
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E120"
    name: ClassVar[str] = "square-index"
    template: ClassVar[str] = "an element of `{array}` is written with braces: `{array}{{1}}`"

    array: str


@dataclass(frozen=True)
class StrayStatement(Violation):
    """Statements stand between the routines of a module.

    They are left out. Only declarations stand there; statements belong to a PROC, FUNC or TRAP.
    Often the routine before was closed too early.

    ## Example

        MODULE example
          PROC main()
            Stop;
          ENDPROC
          SetDO doGrip,1;
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            Stop;
            SetDO doGrip,1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E123"
    name: ClassVar[str] = "stray-statement"
    template: ClassVar[str] = "{construct} stands outside every routine"

    construct: str
