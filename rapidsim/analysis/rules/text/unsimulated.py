"""Rule E105: routines that are checked but not simulated."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import LibrarySymbol
from rapidsim.analysis.program_parts import Facts
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.language.controller import ACCEPTED
from rapidsim.library.traits import Trait


class UnsupportedConstruct(Violation, code="E105"):
    routine: str
    treated_as: str

    @property
    def qualifies(self) -> bool:
        """Whether the result of a run differs from a controller's."""
        return not self.treated_as.startswith(ACCEPTED)


def find_unsupported(facts: Facts) -> Iterator[Diagnostic]:
    """Report calls of installed routines that are not simulated."""
    places_parts = facts.analysis.cell.places_parts
    for part in facts.parts:
        for call in part.calls:
            symbol = facts.symbol(call)
            if isinstance(symbol, LibrarySymbol) and symbol.routine.treated_as is not None:
                if places_parts and Trait.SEARCH_PART in symbol.routine.traits:
                    continue
                instead = symbol.routine.treated_as
                violation = UnsupportedConstruct(symbol.name, instead)
                yield part.finding(violation, call.name)
