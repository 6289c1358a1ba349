"""Changes of data: assignments, and calls that may modify their arguments."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rapidsim.analysis.parameters import Formal
from rapidsim.analysis.program import Symbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import arguments_of
from rapidsim.analysis.types.data_paths import root_of
from rapidsim.language.annotations import ParameterMode
from rapidsim.library.predefined import TYPES
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_TRIGGER = TYPES["triggdata"]
CHANGES = (tree.Assignment, tree.Connect, tree.Call, tree.FunctionCall, tree.LateCall)
"""Nodes that change data or call routines."""
_PATHS = (tree.DataReference, tree.Index, tree.ComponentAccess)


def changed_in(part: ProgramPart, facts: Facts) -> tuple[Symbol, ...]:
    """Data that a routine changes itself, or passes to calls that may change them, each once."""
    kinds = (tree.Assignment, tree.Connect, tree.LateCall)
    nodes = [*(node for kind in kinds for node in part.all(kind)), *part.calls]
    return tuple(dict.fromkeys(one for one in changed_by(nodes, facts) if one is not None))


def changed_by(nodes: Iterable[tree.Node], facts: Facts) -> Iterator[Symbol | None]:
    """Data that nodes change themselves, without nested nodes and called routines."""
    for node in nodes:
        match node:
            case tree.Assignment(target=target) if isinstance(target, _PATHS):
                yield facts.symbol(root_of(target))
            case tree.Connect(interrupt=interrupt) if isinstance(interrupt, _PATHS):
                yield facts.symbol(root_of(interrupt))
            case tree.Call() | tree.FunctionCall():
                is_move = Trait.MOVE in facts.does(node)
                for formal, value in arguments_of(node, facts):
                    if not isinstance(value, _PATHS):
                        continue
                    if formal is None or (
                        formal.mode is not ParameterMode.IN
                        and not (is_move and _is_trigger(formal))
                    ):
                        yield facts.symbol(root_of(value))
            case tree.LateCall(arguments=arguments):
                for argument in arguments:
                    if isinstance(argument, tree.RequiredArgument) and isinstance(
                        argument.value, _PATHS
                    ):
                        yield facts.symbol(root_of(argument.value))
            case _:
                pass


def _is_trigger(formal: Formal) -> bool:
    """Whether a parameter takes trigger data, which moves take by reference but only read."""
    return formal.types[0] == _TRIGGER
