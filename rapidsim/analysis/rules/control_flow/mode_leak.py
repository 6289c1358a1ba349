"""Rule F411: motion settings that a routine does not restore on every path out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import as_move
from rapidsim.analysis.rules.facts.modes_in_force import (
    routines_with,
    settings_of,
    unrestored_modes,
)
from rapidsim.analysis.rules.facts.reached_routines import may_move, reached
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Severity, Violation
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_BY_SWITCH = "\\"
"""Mark of calls that restore a path mode, such as `ConfL\\On`; a speed or a frame is restored by
numbers, or by a separate instruction.
"""
_HELD = Trait.HOLD_ROBOT | Trait.HOLD_INTERRUPTS


class ModeLeak(Violation, code="F411"):
    setting: str
    routine: str
    ends: str
    back: str
    is_shared: bool = False
    """Whether nothing in the program restores the mode, so that it seems to be meant for all."""

    @property
    def severity(self) -> Severity:
        """Note for a mode that the program intends to keep."""
        return Severity.NOTE if self.is_shared else self.rule.severity

    @property
    def is_reported_once(self) -> bool:
        """Whether all such findings are merged into one of the program."""
        return self.is_shared

    def with_others(self, merged: Sequence[Violation]) -> Violation:
        """Merge findings into the first, with the number of other routines."""
        routines = {one.routine for one in (self, *merged) if isinstance(one, ModeLeak)}
        more = len(routines) - 1
        ends = f"{self.ends}, as in {more} more routine{'s' * (more != 1)}" if more else self.ends
        return ModeLeak(self.setting, self.routine, ends, self.back, is_shared=True)


def find_mode_leaks(facts: Facts) -> Iterator[Diagnostic]:
    """Report, for each routine and mode, the first exit at which the mode may still be set."""
    beginning: set[tree.Routine] | None = None
    kept: dict[str, bool] = {}
    for part, _ in facts.in_parts(settings_of):
        routine = part.routine
        if not isinstance(routine, tree.Proc | tree.Func):
            continue
        for left in unrestored_modes(part, facts, _sets_motion):
            beginning = _beginning(facts) if beginning is None else beginning
            if routine in beginning:
                break
            later = (call for call in part.all(tree.Call) if call.start > left.call.start)
            if may_move(list(descendants(*later)), facts):
                shown = part.module.span(left.call).one_line
                if left.back not in kept:
                    kept[left.back] = _is_shared(left.back, facts)
                where = routine.name.text, left.ends, left.back
                violation = ModeLeak(shown, *where, is_shared=kept[left.back])
                yield part.finding(violation, left.call)


def _is_shared(mode: str, facts: Facts) -> bool:
    """Whether several routines set a mode, and none restores it."""
    if _BY_SWITCH not in mode or routines_with(mode, facts, back=True):
        return False
    return routines_with(mode, facts, back=False).bit_count() > 1


def _sets_motion(row: LibraryRoutine) -> bool:
    return not _HELD & row.traits


def _called(part: ProgramPart, facts: Facts) -> list[tree.Routine]:
    """The routines of the user that the calls of a part invoke, one for each call."""
    return list(filter(None, map(facts.routine_called, part.calls)))


def _beginning(facts: Facts) -> set[tree.Routine]:
    """Return the routines whose settings apply to the program: main, and its initialisation.

    Those are called from one place only, which main reaches before it moves or loops itself.
    """
    entry = facts.entry
    if entry is None or entry.routine is None:
        return set()
    found: set[tree.Routine] = {entry.routine}
    callers = Counter[tree.Routine]()
    for _, called in facts.in_parts(_called):
        callers.update(called)
    first: list[tree.Node] = []
    for statement in entry.routine.body:
        if isinstance(statement, tree.While | tree.For) or as_move(statement, facts) is not None:
            break
        first.append(statement)
    begun = reached(descendants(*first), facts)
    for part, bit in facts.bit_of.items():
        if bit & begun and part.routine is not None and callers[part.routine] == 1:
            found.add(part.routine)
    return found
