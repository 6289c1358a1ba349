"""Whether anything in a program can raise an error at run time."""

from __future__ import annotations

from rapidsim.analysis.program import LibrarySymbol, Program
from rapidsim.analysis.tree_walk import descendants
from rapidsim.language.types import STRING, resolved
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

FAILING = (
    *(tree.Raise, tree.Index, tree.Connect, tree.Placeholder),
    *(tree.LateCall, tree.LateFunctionCall),
)
FAILING_OPERATORS = frozenset({"/", "DIV", "MOD"})


def can_fail(program: Program) -> bool:
    """Whether a statement calls, divides, indexes, concatenates strings or raises.

    Pure arithmetic, comparison and output cannot fail, so no trial run is needed.
    """
    return any(
        _can_fail(node, program) for module in program.modules for node in descendants(module)
    )


def _can_fail(node: tree.Node, program: Program) -> bool:
    match node:
        case tree.Call() | tree.FunctionCall():
            symbol = program.symbol_of.get(node)
            return not (isinstance(symbol, LibrarySymbol) and Trait.TELL in symbol.routine.traits)
        case tree.Binary(operator=operator):
            of = program.type_of.get(node)
            return operator in FAILING_OPERATORS or of is None or resolved(of) == STRING
        case _:
            return isinstance(node, FAILING)
