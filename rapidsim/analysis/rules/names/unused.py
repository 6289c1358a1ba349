"""Rules N204 and N205: data and routines that nothing uses."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Set

from rapidsim.analysis.program_parts import ENTRY, Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import may_do
from rapidsim.analysis.rules.names.late_names import late_patterns
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_PREDEFINED_HOMES = ("user", "base")
"""Modules shipped with the controller; a program need not use their contents."""
_BY_NAME = Trait.READ_BY_NAME | Trait.WRITE_BY_NAME


class UnusedData(Violation, code="N204"):
    data: str
    type: str


class UnusedRoutine(Violation, code="N205"):
    routine: str
    kind: str
    used: str


def find_unused_data(facts: Facts) -> Iterator[Diagnostic]:
    """Report data that nothing uses in the text where they are visible."""
    by_name = any(facts.of_part(_accesses_by_name, part) for part in facts.parts)
    names_in: dict[tree.Module, set[str]] = {}
    for part in facts.parts:
        names_in.setdefault(part.module, set()).update(part.names)
    for part in facts.parts:
        for node in part.all(tree.Data):
            used: Set[str]
            if part.routine is not None:
                used = part.names
            elif by_name or part.module.name.key in _PREDEFINED_HOMES:
                continue
            elif node.scope == "LOCAL":
                used = names_in[part.module]
            elif facts.is_whole and (node.storage != "PERS" or node.scope == "TASK"):
                used = facts.names
            else:
                continue
            key = node.name.key
            if key in used or key in facts.strings or facts.analysis.may_be_unread(key):
                continue
            yield facts.of_part(_unused_data, part)[node]


def _unused_data(part: ProgramPart, facts: Facts) -> dict[tree.Node, Diagnostic]:
    """A finding for each declaration, to be reported if nothing uses it."""
    del facts
    return {
        node: part.finding(UnusedData(node.name.text, node.type.text), node.name)
        for node in part.all(tree.Data)
    }


def _accesses_by_name(part: ProgramPart, facts: Facts) -> bool:
    return any(_BY_NAME & may_do(call, facts) for call in part.calls)


def find_unused_routines(facts: Facts) -> Iterator[Diagnostic]:
    """Report routines that nothing calls, connects, or could name in a string."""
    patterns = late_patterns(facts)
    declared = {part.routine.name.key for part in facts.routine_parts if part.routine is not None}
    used_elsewhere = Counter(name for part in facts.parts for name in part.names & declared)
    for part in facts.routine_parts:
        routine = part.routine
        assert routine is not None
        key = routine.name.key
        if key == ENTRY or key in facts.strings or facts.analysis.may_be_unread(key):
            continue
        own_call = key in part.names
        if used_elsewhere[key] > own_call or any(p.fullmatch(key) for p in patterns):
            continue
        if routine.scope == "LOCAL" or (facts.is_whole and _needs_a_caller(part)):
            yield facts.of_part(_unused_routine, part)


def _needs_a_caller(part: ProgramPart) -> bool:
    return not isinstance(part.routine, tree.Proc) or bool(part.routine.parameters)


def _unused_routine(part: ProgramPart, facts: Facts) -> Diagnostic:
    """The finding of a routine, to be reported if nothing uses it."""
    del facts
    assert part.routine is not None
    return part.finding(_unused(part.routine), part.routine.name)


def _unused(routine: tree.Routine) -> UnusedRoutine:
    match routine:
        case tree.Trap():
            return UnusedRoutine(routine.name.text, "trap", "connected")
        case tree.Func():
            return UnusedRoutine(routine.name.text, "function", "called")
        case _:
            return UnusedRoutine(routine.name.text, "procedure", "called")
