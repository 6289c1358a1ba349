"""Rules N204 and N205: data and routines that nothing uses."""

from __future__ import annotations

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
    by_name = bool(facts.in_parts(_accesses_by_name))
    names_in: dict[tree.Module, Set[str]] = {}
    for part, declared in facts.in_parts(_seemingly_unused):
        is_outside = part.routine is None
        if is_outside and (by_name or part.module.name.key in _PREDEFINED_HOMES):
            continue
        for key, node in declared:
            used: Set[str] = frozenset()
            if is_outside and node.scope == "LOCAL":
                if part.module not in names_in:
                    names_in[part.module] = _names_in(part.module, facts)
                used = names_in[part.module]
            elif is_outside:
                if not facts.is_whole or (node.storage == "PERS" and node.scope != "TASK"):
                    continue
                used = facts.names
            if key in used or key in facts.strings or facts.analysis.may_be_unread(key):
                continue
            yield part.finding(UnusedData(node.name.text, node.type.text), node.name)


def _names_in(module: tree.Module, facts: Facts) -> set[str]:
    return set().union(*(part.names for part in facts.parts if part.module is module))


def _seemingly_unused(part: ProgramPart, facts: Facts) -> list[tuple[str, tree.Data]]:
    """Data that the part itself does not use, by folded name."""
    del facts
    declared = ((node.name.key, node) for node in part.all(tree.Data) if node.name.key)
    return [(key, node) for key, node in declared if key not in part.names]


def _accesses_by_name(part: ProgramPart, facts: Facts) -> bool:
    return any(_BY_NAME & may_do(call, facts) for call in part.calls)


def find_unused_routines(facts: Facts) -> Iterator[Diagnostic]:
    """Report routines that nothing calls, connects, or could name in a string."""
    patterns = late_patterns(facts)
    for part, key in facts.in_parts(_to_be_used):
        assert part.routine is not None
        if part.routine.scope != "LOCAL" and not facts.is_whole:
            continue
        if _is_used_elsewhere(key, part, facts) or key in facts.strings:
            continue
        if facts.analysis.may_be_unread(key) or any(p.fullmatch(key) for p in patterns):
            continue
        yield part.finding(_unused(part.routine), part.routine.name)


def _is_used_elsewhere(key: str, home: ProgramPart, facts: Facts) -> bool:
    """Whether another part than the home of a routine names it."""
    if key not in home.names:
        return key in facts.names
    return any(key in part.names for part in facts.parts if part is not home)


def _to_be_used(part: ProgramPart, facts: Facts) -> str | None:
    """The folded name of a routine; None for one that needs no caller."""
    del facts
    routine = part.routine
    if routine is None or routine.name.key == ENTRY:
        return None
    is_needed = not isinstance(routine, tree.Proc) or bool(routine.parameters)
    return routine.name.key if routine.scope == "LOCAL" or is_needed else None


def _unused(routine: tree.Routine) -> UnusedRoutine:
    match routine:
        case tree.Trap():
            return UnusedRoutine(routine.name.text, "trap", "connected")
        case tree.Func():
            return UnusedRoutine(routine.name.text, "function", "called")
        case _:
            return UnusedRoutine(routine.name.text, "procedure", "called")
