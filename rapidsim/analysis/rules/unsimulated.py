"""Rule E105: what is checked and will not be simulated."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.analysis.program import LibrarySymbol
from rapidsim.analysis.rules.facts import Facts
from rapidsim.diagnostics import Diagnostic, Severity, Violation


@dataclass(frozen=True)
class UnsupportedConstruct(Violation):
    """An instruction or function is known, and a run does not do what the controller does.

    The program is right; `rapidsim run` says what it does instead, and times and outputs after it
    may differ from the controller's.

    ## Example

        MODULE example
          PROC main()
            SoftAct 3,20;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            WaitTime 0.5;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E105"
    name: ClassVar[str] = "unsupported-construct"
    template: ClassVar[str] = "`{routine}` is not simulated; instead: {treated_as}"
    severity: ClassVar[Severity] = Severity.NOTE

    routine: str
    treated_as: str


def find_unsupported(facts: Facts) -> Iterator[Diagnostic]:
    """Calls of installed routines that are not simulated."""
    for part in facts.parts:
        for call in part.calls:
            symbol = facts.symbol(call)
            if isinstance(symbol, LibrarySymbol) and symbol.routine.treated_as is not None:
                instead = symbol.routine.treated_as
                violation = UnsupportedConstruct(symbol.name, instead)
                yield part.finding(violation, call.name)
