"""Rules F407 and F408: ERROR clauses that do not handle the error."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.analysis.rules.facts import Facts
from rapidsim.diagnostics import Diagnostic, Severity, Violation
from rapidsim.syntax import tree

# Instructions that tell somebody and change nothing.
_MESSAGES = frozenset({"tpwrite", "tperase", "errwrite", "errlog", "tpshow"})


@dataclass(frozen=True)
class RetryWithoutChange(Violation):
    """An ERROR clause answers every error with RETRY and changes nothing before it.

    The same statement fails again, until the retries that the controller allows are used up.

    ## Example

        MODULE example
          VAR num parts:=0;
          PROC main()
            WaitTime 10/parts;
          ERROR RETRY;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num parts:=0;
          PROC main()
            WaitTime 10/parts;
          ERROR parts:=1;
            RETRY;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "F407"
    name: ClassVar[str] = "retry-without-change"
    template: ClassVar[str] = "RETRY repeats what failed, and nothing has changed"
    severity: ClassVar[Severity] = Severity.WARNING

    @property
    def help(self) -> str:
        """The cure."""
        return "remove the cause first, or wait and count the attempts"


@dataclass(frozen=True)
class SwallowedError(Violation):
    """An ERROR clause passes over every error with TRYNEXT and tells nobody.

    A pick that failed or a move that could not be made is then left out in silence.

    ## Example

        MODULE example
          VAR num parts:=0;
          PROC main()
            WaitTime 10/parts;
          ERROR TRYNEXT;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num parts:=0;
          PROC main()
            WaitTime 10/parts;
          ERROR IF ERRNO=ERR_DIVZERO THEN
              TRYNEXT;
            ENDIF
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "F408"
    name: ClassVar[str] = "swallowed-error"
    template: ClassVar[str] = "TRYNEXT passes over every error in silence"
    severity: ClassVar[Severity] = Severity.WARNING

    @property
    def help(self) -> str:
        """The cure."""
        return "test ERRNO for the errors that are meant, or tell the operator"


def find_careless_handlers(facts: Facts) -> Iterator[Diagnostic]:
    """ERROR clauses that repeat or pass over every error."""
    for part in facts.routine_parts:
        handler = None if part.routine is None else part.routine.error
        if handler is None or handler.numbers is not None:
            continue
        said = False
        for statement in handler.body:
            match statement:
                case tree.Retry():
                    yield part.finding(RetryWithoutChange(), statement)
                case tree.TryNext() if not said:
                    yield part.finding(SwallowedError(), statement)
                case tree.Call() if statement.name.key in _MESSAGES:
                    said = True
                    continue
                case tree.Empty() | tree.Label():
                    continue
                case _:
                    pass
            break
