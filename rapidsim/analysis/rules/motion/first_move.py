"""Rules M512 and M515: a linear first move, and moves without speed."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import MoveCall, as_move, moves
from rapidsim.analysis.rules.facts.known_values import known_value, numbers
from rapidsim.analysis.tree_walk import descendants, statements
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree


class FirstMoveLinear(Violation, code="M512"):
    move: str


class MoveWithoutSpeed(Violation, code="M515"):
    speed: str
    value: float


def find_first_move(facts: Facts) -> Iterator[Diagnostic]:
    """Report the first move that main makes, if it is linear or circular."""
    if facts.entry is None:
        return
    found = _first_move(facts.entry, facts, set())
    if found is None:
        return
    part, move = found
    if Trait.CARTESIAN in move.does and _is_fixed(move, facts):
        yield part.finding(FirstMoveLinear(move.call.name.text), move.call.name)


def find_moves_without_speed(facts: Facts) -> Iterator[Diagnostic]:
    """Report linear and circular moves whose TCP speed is known to be 0."""
    for part in facts.routine_parts:
        for move in moves(part, facts):
            if Trait.CARTESIAN not in move.does or {"v", "t"} & move.arguments.keys():
                continue
            speed = move.arguments.get("speed")
            value = numbers(known_value(speed, facts), 4)
            if speed is None or value is None or value[0] > 0.0:
                continue
            # Without rotation by an external axis, it is no coordinated move either.
            shown = part.module.span(speed).one_line
            yield part.finding(MoveWithoutSpeed(shown, value[0]), speed)


def _is_fixed(move: MoveCall, facts: Facts) -> bool:
    """Whether the target is in the text; a computed one may be close to the robot."""
    target = move.arguments.get("topoint")
    if target is None:
        return False
    for node in descendants(target):
        if isinstance(node, tree.FunctionCall) and Trait.OFFSET not in facts.does(node):
            return False
        symbol = facts.symbol(node) if isinstance(node, tree.DataReference) else None
        if isinstance(node, tree.DataReference) and not isinstance(symbol, DataSymbol):
            return False
        if isinstance(symbol, DataSymbol) and symbol.type.name == "robtarget":
            return symbol.storage is not Storage.VAR
    return True


def _first_move(
    part: ProgramPart, facts: Facts, seen: set[tree.Routine]
) -> tuple[ProgramPart, MoveCall] | None:
    """First move in source order, including calls of the user's procedures."""
    assert part.routine is not None
    seen.add(part.routine)
    for statement in statements(part.routine.body):
        move = as_move(statement, facts)
        if move is not None:
            return part, move
        routine = facts.routine_called(statement)
        if routine is not None and routine in facts.part_of and routine not in seen:
            found = _first_move(facts.part_of[routine], facts, seen)
            if found is not None:
                return found
    return None
