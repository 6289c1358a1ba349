"""Rules F4: the order in which statements are executed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class UnreachableCode(Violation):
    """A statement can never be executed: the one before it always leads elsewhere.

    Moves that are never made mislead whoever reads the program. A lone RETURN is not reported; it
    often stands at the end of a function for safety.

    ## Example

        MODULE example
          PROC main()
            TPErase;
            RETURN;
            TPWrite "done";
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TPErase;
            TPWrite "done";
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "F401"
    name: ClassVar[str] = "unreachable-code"
    template: ClassVar[str] = "this is never executed"
    severity: ClassVar[Severity] = Severity.WARNING


@dataclass(frozen=True)
class MissingReturn(Violation):
    """A function can reach its end without giving a value. The call then fails.

    ## Example

        MODULE example
          FUNC num larger(num a,num b)
            IF a>b THEN
              RETURN a;
            ENDIF
          ENDFUNC
        ENDMODULE

    ## Fix

        MODULE example
          FUNC num larger(num a,num b)
            IF a>b THEN
              RETURN a;
            ENDIF
            RETURN b;
          ENDFUNC
        ENDMODULE
    """

    code: ClassVar[str] = "F404"
    name: ClassVar[str] = "missing-return"
    template: ClassVar[str] = "`{function}` can end without RETURN"
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str] = "ABB 40197"

    function: str
    type: str

    @property
    def help(self) -> str:
        """Where the value is missing."""
        return f"end it with RETURN and a value of type {self.type}"


@dataclass(frozen=True)
class GotoTarget(Violation):
    """GOTO names a label that is not there, or one inside another block.

    A jump stays in its routine. It may leave a block such as IF or FOR, never enter one.

    ## Example

        MODULE example
          PROC main()
            GOTO again;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR num count:=0;
            again:
            count:=count+1;
            IF count<3 GOTO again;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "F405"
    name: ClassVar[str] = "goto-target"
    template: ClassVar[str] = "{problem}"
    cf: ClassVar[str] = "ABB 40023"

    problem: str
    nearest: str | None = None

    @property
    def help(self) -> str | None:
        """The nearest label."""
        return f"did you mean `{self.nearest}`?" if self.nearest else None


@dataclass(frozen=True)
class RaiseRetryPlacement(Violation):
    """RETRY, TRYNEXT, StartMoveRetry or RAISE without a number stands outside an ERROR clause.

    They answer an error, and only an ERROR clause has one to answer.

    ## Example

        MODULE example
          PROC main()
            VAR num parts:=0;
            IF parts=0 RETRY;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR num parts:=0;
            VAR num each;
            each:=10/parts;
          ERROR parts:=1;
            RETRY;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "F406"
    name: ClassVar[str] = "raise-retry-placement"
    template: ClassVar[str] = "{statement} stands outside an ERROR clause"
    cf: ClassVar[str] = "ABB 40096"

    statement: str

    @property
    def help(self) -> str | None:
        """What can stand here."""
        if self.statement == "RAISE without a number":
            return "give RAISE an error number to raise an error of your own"
        return None


@dataclass(frozen=True)
class ReturnValue(Violation):
    """RETURN gives a value where none is taken, or none where one is.

    A function returns a value; a procedure and a trap return nothing.

    ## Example

        MODULE example
          PROC main()
            RETURN 1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            RETURN;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "F415"
    name: ClassVar[str] = "return-value"
    template: ClassVar[str] = "{problem}"
    cf: ClassVar[str] = "ABB 40052"

    problem: str
    cure: str

    @property
    def help(self) -> str:
        """What to write."""
        return self.cure


@dataclass(frozen=True)
class BadConnect(Violation):
    """CONNECT takes a variable of type intnum and the name of a TRAP routine.

    ## Example

        MODULE example
          VAR intnum part_seen;
          PROC main()
            CONNECT part_seen WITH count;
          ENDPROC
          PROC count()
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR intnum part_seen;
          PROC main()
            CONNECT part_seen WITH count;
          ENDPROC
          TRAP count
          ENDTRAP
        ENDMODULE
    """

    code: ClassVar[str] = "F416"
    name: ClassVar[str] = "bad-connect"
    template: ClassVar[str] = "CONNECT takes {wanted}; `{given}` is {kind}"
    cf: ClassVar[str] = "ABB 40125"

    wanted: str
    given: str
    kind: str
