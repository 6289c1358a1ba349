"""Rule F411: motion settings that a routine does not restore on every path out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.facts.instruction_questions import as_move
from rapidsim.analysis.rules.facts.modes_in_force import left_in_force
from rapidsim.analysis.rules.facts.reached_routines import may_move, reached
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import Does
from rapidsim.syntax import tree

_HELD = Does.HOLD_ROBOT | Does.HOLD_INTERRUPTS


class ModeLeak(Violation, code="F411"):
    setting: str
    routine: str
    ends: str
    back: str


def find_mode_leaks(facts: Facts) -> Iterator[Diagnostic]:
    """For each routine and mode, the first exit at which the mode may still be on."""
    beginning = _beginning(facts)
    for part in facts.routine_parts:
        routine = part.routine
        if not isinstance(routine, tree.Proc | tree.Func) or routine in beginning:
            continue
        for left in left_in_force(part, facts, _sets_motion):
            later = (call for call in part.all(tree.Call) if call.start > left.call.start)
            if may_move(later, facts):
                shown = " ".join(part.module.span(left.call).text.split())
                violation = ModeLeak(shown, routine.name.text, left.ends, left.back)
                yield part.finding(violation, left.call)


def _sets_motion(row: LibraryRoutine) -> bool:
    return not _HELD & row.does


def _beginning(facts: Facts) -> set[tree.Routine]:
    """The routines whose settings are those of the program: main, and what it begins with.

    They are called from one place only, which main comes to before it moves or loops itself.
    """
    entry = facts.entry
    if entry is None or entry.routine is None:
        return set()
    found: set[tree.Routine] = {entry.routine}
    callers = Counter(
        routine
        for part in facts.routine_parts
        for call in part.calls
        if (routine := facts.routine_called(call)) is not None
    )
    first: list[tree.Node] = []
    for statement in entry.routine.body:
        if isinstance(statement, tree.While | tree.For) or as_move(statement, facts) is not None:
            break
        first.append(statement)
    begun = reached(first, facts)
    for part, bit in facts.bit_of.items():
        if bit & begun and part.routine is not None and callers[part.routine] == 1:
            found.add(part.routine)
    return found
