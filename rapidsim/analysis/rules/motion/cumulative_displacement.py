"""Rule M517: persistent targets that are displaced from their own position."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.changed_data import changed_by
from rapidsim.analysis.rules.facts.taught_targets import taught_target
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.syntax import tree


class DriftingTarget(Violation, code="M517"):
    target: str


def find_drifting_targets(facts: Facts) -> Iterator[Diagnostic]:
    """Report `p:=Offs(p,..)` on a PERS without any other assignment in the program."""
    found: dict[DataSymbol, list[tuple[tree.Node, Diagnostic]]] = {}
    for _, own_drifts in facts.in_parts(_drifts):
        for symbol, assignment, finding in own_drifts:
            found.setdefault(symbol, []).append((assignment, finding))
    for symbol, drifts in found.items():
        own = {assignment for assignment, _ in drifts}
        others = (
            node
            for part in facts.routine_parts
            for node in (*part.all(tree.Assignment), *part.calls)
            if node not in own
        )
        if not any(symbol is changed for changed in changed_by(others, facts)):
            yield from (finding for _, finding in drifts)


def _drifts(
    part: ProgramPart, facts: Facts
) -> list[tuple[DataSymbol, tree.Assignment, Diagnostic]]:
    """Persistents that a part displaces from themselves; findings if nothing else sets them."""
    found: list[tuple[DataSymbol, tree.Assignment, Diagnostic]] = []
    for assignment in part.all(tree.Assignment):
        target, value = assignment.target, assignment.value
        if not isinstance(target, tree.DataReference) or not isinstance(value, tree.FunctionCall):
            continue
        symbol = facts.symbol(target)
        if not isinstance(symbol, DataSymbol) or symbol.storage is not Storage.PERS:
            continue
        taught = taught_target(value, facts)
        if taught is not value and facts.symbol(taught) is symbol:
            finding = part.finding(DriftingTarget(symbol.name), assignment)
            found.append((symbol, assignment, finding))
    return found
