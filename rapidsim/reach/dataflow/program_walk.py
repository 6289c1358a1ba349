"""All moves of a program: statically known ones, and the reasons why others are unknown."""

from __future__ import annotations

from rapidsim.analysis.program import Program, does
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.library.traits import Trait
from rapidsim.reach.dataflow.abstract_interpreter import TOO_LONG, AbstractInterpreter
from rapidsim.reach.dataflow.known_moves import WalkedProgram
from rapidsim.reach.dataflow.move_instructions import MoveInstructions, runs_of
from rapidsim.reach.dataflow.side_effects import ProgramEffects
from rapidsim.reach.dataflow.written_moves import RunNotFollowedError
from rapidsim.syntax import tree
from rapidsim.syntax.garbage_collection import gc_paused


@gc_paused(of_known_program=True)
def walk_program(program: Program) -> WalkedProgram:
    """Interpret all routines of a program that move the robot.

    Raises:
        RunNotFollowedError: If the moves of bulk statements are unknown, or differ from the text.
            Their rows must then be in the tree.
    """
    runs = runs_of(program)
    calls = tuple(
        (node, module)
        for module in program.modules
        for routine in module.routines
        for node in statements(*clauses(routine))
        if isinstance(node, tree.Call) and Trait.MOVE in does(program.symbol_of.get(node))
    )
    written = MoveInstructions(calls, runs)
    effects = ProgramEffects(program)
    walker = AbstractInterpreter(program, effects, written)
    if calls:
        walker.walk_all()
    table = walker.table
    moves = table.moves()
    met = {known.call for known in moves.of_tree} | table.unknown.keys()
    for call, _ in calls:
        if call not in met:
            table.unknown[call] = table.unreached.get(call, TOO_LONG)
    if not runs.keys() <= met or runs.keys() & (table.unknown.keys() | table.unreached.keys()):
        raise RunNotFollowedError
    unknown = {written.number_of[call]: why for call, why in table.unknown.items()}
    in_tree = written.number_of.items()
    conditional = frozenset(number for call, number in in_tree if call not in table.certain)
    settings_set = effects.everything.settings if calls else frozenset()
    return WalkedProgram(
        written, moves, unknown, conditional, _of_written_data(written, effects), settings_set
    )


def _of_written_data(written: MoveInstructions, effects: ProgramEffects) -> frozenset[int]:
    """Return the numbers of the instructions with data that some statement writes."""
    symbol_of = effects.program.symbol_of
    return frozenset(
        number
        for call, number in written.number_of.items()
        for node in descendants(call)
        if isinstance(node, tree.DataReference)
        and (symbol := symbol_of.get(node)) is not None
        and effects.is_written(symbol)
    )
