"""Rule T310: optional parameters that are used without asking whether they are there."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import ParameterSymbol
from rapidsim.analysis.program_parts import Facts, Part
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Does
from rapidsim.syntax import tree


class AbsentOptionalUsed(Violation, code="T310"):
    parameter: str


def find_absent_optionals(facts: Facts) -> Iterator[Diagnostic]:
    """The first use of each optional parameter that nothing asks for."""
    for part in facts.routine_parts:
        optionals = _optionals(part)
        if not optionals:
            continue
        asked = _asked(part, facts)
        reported: set[str] = set()
        for node in part.all(tree.Reference):
            key = node.name.key
            if key not in optionals or key in reported:
                continue
            if not isinstance(facts.symbol(node), ParameterSymbol):
                continue
            # Of parameters that exclude each other, asking for one answers for the other.
            if optionals[key].isdisjoint(asked):
                reported.add(key)
                place = part.place(_declared(part, key), "declared as optional here")
                yield part.finding(AbsentOptionalUsed(node.name.text), node, place)


def _optionals(part: Part) -> dict[str, frozenset[str]]:
    """Optional parameters that are no switches, each with all names of its group."""
    return {
        parameter.name.key: names
        for group in part.all(tree.OptionalGroup)
        for names in [frozenset(one.name.key for one in _alternatives(group))]
        for parameter in _alternatives(group)
        if parameter.type.key != "switch"
    }


def _alternatives(group: tree.OptionalGroup) -> list[tree.Parameter]:
    """The parameters of a group; unfinished code may hold something else."""
    return [one for one in group.alternatives if isinstance(one, tree.Parameter)]


def _asked(part: Part, facts: Facts) -> set[str]:
    return {
        argument.value.name.key
        for call in part.all(tree.FunctionCall)
        if Does.TEST_PRESENT in facts.does(call)
        for argument in call.arguments
        if isinstance(argument, tree.Required) and isinstance(argument.value, tree.Reference)
    }


def _declared(part: Part, key: str) -> tree.Node:
    return next(
        parameter.name
        for group in part.all(tree.OptionalGroup)
        for parameter in _alternatives(group)
        if parameter.name.key == key
    )
