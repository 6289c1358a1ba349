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
    conditional = {call for call, _ in calls} - table.certain
    changing = frozenset(written.number_of[call] for call in conditional & table.unknown.keys())
    set_elsewhere = frozenset(
        written.number_of[call] for call in conditional if _has_written_data(call, effects)
    )
    settings_set = effects.everything.settings if calls else frozenset()
    return WalkedProgram(written, moves, unknown, changing, set_elsewhere, settings_set)


def _has_written_data(call: tree.Call, effects: ProgramEffects) -> bool:
    """Whether some statement of the program writes data of an instruction."""
    named = (node for node in descendants(call) if isinstance(node, tree.DataReference))
    symbols = map(effects.program.symbol_of.get, named)
    return any(symbol is not None and effects.is_written(symbol) for symbol in symbols)
