"""Rule T310: optional parameters that are used without checking that they are present."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rapidsim.analysis.program import ParameterSymbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class


class AbsentOptionalUsed(Violation, code="T310"):
    parameter: str


def find_absent_optionals(facts: Facts) -> Iterator[Diagnostic]:
    """Report the first use of each optional parameter whose presence is never checked."""
    calls: dict[tree.Routine, list[_Caller]] | None = None
    for part, optionals in facts.in_parts(_optionals):
        asked = _tested_present(part.all(tree.FunctionCall), facts)
        guarded = _guarded(part, facts)
        reported: set[str] = set()
        for node in part.all(tree.DataReference):
            key = node.name.key
            if key not in optionals or key in reported:
                continue
            if not isinstance(facts.symbol(node), ParameterSymbol):
                continue
            # Of parameters that exclude each other, checking one also decides about the other; and
            # parameters that are always passed together are decided by a check of any of them.
            if not optionals[key].isdisjoint(asked) or _names_at(node, guarded):
                continue
            reported.add(key)
            calls = _calls(facts) if calls is None else calls
            assert part.routine is not None
            callers = calls.get(part.routine, [])
            if not callers or not all(_gives(one, key, facts) for one in callers):
                place = part.place(_declared(part, key), "declared as optional here")
                yield part.finding(AbsentOptionalUsed(node.name.text), node, place)


def _optionals(part: ProgramPart, facts: Facts) -> dict[str, frozenset[str]]:
    """Optional parameters other than switches, each with all names of its group."""
    del facts
    return {
        parameter.name.key: names
        for group in part.all(tree.OptionalGroup)
        for names in [frozenset(one.name.key for one in _alternatives(group))]
        for parameter in _alternatives(group)
        if parameter.type.key != "switch"
    }


def _alternatives(group: tree.OptionalGroup) -> list[tree.ParameterDeclaration]:
    """Parameters of a group; unfinished code may contain other nodes."""
    return [one for one in group.alternatives if isinstance(one, tree.ParameterDeclaration)]


@value_class(frozen=True, slots=True)
class _Caller:
    """A call of a user routine."""

    call: tree.Call | tree.FunctionCall
    part: ProgramPart


def _calls(facts: Facts) -> dict[tree.Routine, list[_Caller]]:
    """Calls of each routine."""
    found: dict[tree.Routine, list[_Caller]] = {}
    for part in facts.routine_parts:
        for call in part.calls:
            routine = facts.routine_called(call)
            if routine is not None:
                found.setdefault(routine, []).append(_Caller(call, part))
    return found


def _gives(caller: _Caller, key: str, facts: Facts) -> bool:
    """Whether a call certainly passes an optional argument."""
    for argument in caller.call.arguments:
        match argument:
            case tree.OptionalArgument(name=name) if name.key == key:
                return True
            case tree.ConditionalArgument(name=name, present=present) if name.key == key:
                return present.key in _names_at(caller.call, _guarded(caller.part, facts))
    return False


@value_class(frozen=True, slots=True)
class _Guarded:
    """Text that executes only if a condition holds that checks the presence of parameters."""

    start: int
    end: int
    names: frozenset[str]


def _guarded(part: ProgramPart, facts: Facts) -> list[_Guarded]:
    ways = [
        *((node.condition, node.body) for node in part.all(tree.Branch)),
        *((node.condition, (node.statement,)) for node in part.all(tree.CompactIf)),
    ]
    found: list[_Guarded] = []
    for condition, body in ways:
        functions = [n for n in descendants(condition) if isinstance(n, tree.FunctionCall)]
        names = frozenset(_tested_present(functions, facts))
        if names and body:
            found.append(_Guarded(body[0].start, body[-1].end, names))
    return found


def _names_at(node: tree.Node, guarded: list[_Guarded]) -> frozenset[str]:
    """Parameters whose presence has been checked at a node."""
    around = (one.names for one in guarded if one.start <= node.start < one.end)
    return frozenset().union(*around)


def _tested_present(functions: Iterable[tree.FunctionCall], facts: Facts) -> set[str]:
    return {
        argument.value.name.key
        for call in functions
        if Trait.TEST_PRESENT in facts.does(call)
        for argument in call.arguments
        if isinstance(argument, tree.RequiredArgument)
        and isinstance(argument.value, tree.DataReference)
    }


def _declared(part: ProgramPart, key: str) -> tree.Node:
    return next(
        parameter.name
        for group in part.all(tree.OptionalGroup)
        for parameter in _alternatives(group)
        if parameter.name.key == key
    )
