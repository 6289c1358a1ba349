"""Rule N217: world zones declared inside a routine."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import DataSymbol
from rapidsim.analysis.program_parts import Facts
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.language.types import ArrayOf, resolved
from rapidsim.library.predefined import TYPES
from rapidsim.syntax import tree

_ZONES = (resolved(TYPES["wzstationary"]), resolved(TYPES["wztemporary"]))


class WorldZoneOfRoutine(Violation, code="N217"):
    data: str
    type: str


def find_world_zones(facts: Facts) -> Iterator[Diagnostic]:
    """Declarations of world zones inside routines."""
    for part in facts.routine_parts:
        for node in part.all(tree.Data):
            symbol = facts.symbol(node)
            if not isinstance(symbol, DataSymbol):
                continue
            of = resolved(symbol.type)
            if (resolved(of.element) if isinstance(of, ArrayOf) else of) in _ZONES:
                yield part.finding(WorldZoneOfRoutine(node.name.text, node.type.text), node.name)
