"""Facts about calls: the parameter of each argument, and the calls that move the robot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.parameters import Formal
from rapidsim.analysis.program import LibrarySymbol, RoutineSymbol, does
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.types.callees import callee_of_installed
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class MoveCall:
    """A call that moves the robot, with the arguments that rules examine."""

    call: tree.Call
    arguments: Mapping[str, tree.Expression | None]
    """Argument by folded parameter name; None for a switch."""
    does: Trait


def arguments_of(
    call: tree.Call | tree.FunctionCall, facts: Facts
) -> list[tuple[Formal | None, tree.Expression | None]]:
    """Return each argument with its parameter; None if the routine or the parameter is unknown."""
    symbol = facts.symbol(call)
    formals: tuple[Formal, ...] = ()
    if isinstance(symbol, LibrarySymbol):
        formals = callee_of_installed(symbol).parameters
    elif isinstance(symbol, RoutineSymbol) and symbol in facts.analysis.callees:
        formals = facts.analysis.callees[symbol].parameters
    required = (formal for formal in formals if not formal.optional)
    found: list[tuple[Formal | None, tree.Expression | None]] = []
    for argument in call.arguments:
        match argument:
            case tree.RequiredArgument(value=value):
                found.append((next(required, None), value))
            case tree.OptionalArgument(name=name, value=value):
                found.append((_named(name.key, formals), value))
            case tree.ConditionalArgument(name=name):
                found.append((_named(name.key, formals), None))
    return found


def _named(key: str, formals: Sequence[Formal]) -> Formal | None:
    return next((formal for formal in formals if formal.key == key), None)


def may_do(call: tree.Call | tree.FunctionCall, facts: Facts) -> Trait:
    """Traits of a call, from its name only if names are not resolved.

    Of two routines with one name only the first is considered.
    """
    return does(facts.symbol(call) or installed_symbol(call.name.key))


def moves(part: ProgramPart, facts: Facts) -> Sequence[MoveCall]:
    """Return the calls of installed move instructions, in source order."""
    return facts.of_part(_moves, part)


def _moves(part: ProgramPart, facts: Facts) -> tuple[MoveCall, ...]:
    found = (as_move(call, facts) for call in part.all(tree.Call))
    return tuple(move for move in found if move is not None)


def as_move(statement: tree.Node, facts: Facts) -> MoveCall | None:
    """Interpret a statement as a move; None if it is not one."""
    if not isinstance(statement, tree.Call) or Trait.MOVE not in (what := facts.does(statement)):
        return None
    # Most rules request all moves.
    move: MoveCall | None = facts.memo.get(statement)
    if move is None:
        named = arguments_of(statement, facts)
        arguments = {formal.key: value for formal, value in named if formal is not None}
        move = facts.memo[statement] = MoveCall(statement, arguments, what)
    return move
