"""Rule I802: waits for a signal that may never come."""

from __future__ import annotations

from collections.abc import Iterator
from types import MappingProxyType

from rapidsim.analysis.program import LibrarySymbol
from rapidsim.analysis.program_parts import Facts
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.syntax import tree

_TIMED = MappingProxyType(
    {
        **dict.fromkeys(("waitdi", "waitdo", "waituntil", "tpreadfk", "tpreadnum"), "maxtime"),
        **dict.fromkeys(("waitai", "waitao", "waitgi", "waitgo"), "maxtime"),
        "waitsynctask": "timeout",
    }
)
_ASKS_OPERATOR = ("tpreadfk", "tpreadnum")


class WaitWithoutTimeout(Violation, code="I802"):
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
