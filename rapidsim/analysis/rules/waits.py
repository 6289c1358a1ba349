"""Rule I802: waits for a signal that may never come."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar

from rapidsim.analysis.program import LibrarySymbol
from rapidsim.analysis.rules.facts import Facts
from rapidsim.diagnostics import Diagnostic, Severity, Violation
from rapidsim.syntax import tree

_TIMED = MappingProxyType(
    {
        **dict.fromkeys(("waitdi", "waitdo", "waituntil", "tpreadfk", "tpreadnum"), "maxtime"),
        **dict.fromkeys(("waitai", "waitao", "waitgi", "waitgo"), "maxtime"),
        "waitsynctask": "timeout",
    }
)
_ASKS_OPERATOR = ("tpreadfk", "tpreadnum")


@dataclass(frozen=True)
class WaitWithoutTimeout(Violation):
    r"""The program waits for a signal or a condition as long as it takes.

    If it never comes, the cell stands, and nobody is told why. With `\MaxTime` the wait raises
    ERR_WAIT_MAXTIME after that many seconds, or sets `\TimeFlag`.

    ## Example

        MODULE example
          VAR signaldi part_there;
          PROC main()
            WaitDI part_there,1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR signaldi part_there;
          PROC main()
            WaitDI part_there,1\MaxTime:=30;
          ERROR IF ERRNO=ERR_WAIT_MAXTIME THEN
              TPWrite "No part within 30 s";
              RETRY;
            ENDIF
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "I802"
    name: ClassVar[str] = "wait-without-timeout"
    template: ClassVar[str] = "{wait} without `\\{option}` waits for ever if nothing happens"
    severity: ClassVar[Severity] = Severity.NOTE
    cf: ClassVar[str] = "ABB 40501"

    wait: str
    option: str


def find_waits_without_timeout(facts: Facts) -> Iterator[Diagnostic]:
    """Waits for signals, conditions and other tasks that have no limit of time."""
    for part in facts.routine_parts:
        for call in part.all(tree.Call):
            option = _TIMED.get(call.name.key)
            if option is None or call.name.key in _ASKS_OPERATOR:
                continue
            if not isinstance(facts.symbol(call), LibrarySymbol):
                continue
            given = {
                one.name.key
                for one in call.arguments
                if isinstance(one, tree.Optional | tree.Conditional)
            }
            if option not in given:
                shown = "TimeOut" if option == "timeout" else "MaxTime"
                yield part.finding(WaitWithoutTimeout(call.name.text, shown), call.name)
