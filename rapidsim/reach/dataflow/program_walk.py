"""All moves of a program: statically known ones, and the reasons why others are unknown."""

from __future__ import annotations

from rapidsim.analysis.program import Program, does
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.library.traits import Trait
from rapidsim.reach.dataflow.abstract_interpreter import TOO_LONG, AbstractInterpreter
from rapidsim.reach.dataflow.bulk_moves import runs_of, with_rows
from rapidsim.reach.dataflow.known_moves import WalkedProgram
from rapidsim.reach.dataflow.side_effects import ProgramEffects
from rapidsim.reach.dataflow.written_moves import RunNotFollowedError
from rapidsim.syntax import tree
from rapidsim.syntax.garbage_collection import gc_paused


@gc_paused()
def walk_program(program: Program) -> WalkedProgram:
    """Interpret all routines of a program that move the robot.

    Raises:
        RunNotFollowedError: If the moves of bulk statements are unknown, or differ from the text.
            Their rows must then be in the tree.
    """
    runs = runs_of(program)
    written = tuple(
        (one, module)
        for module in program.modules
        for routine in module.routines
        for node in statements(*clauses(routine))
        if isinstance(node, tree.Call) and Trait.MOVE in does(program.symbol_of.get(node))
        for one in with_rows(node, runs)
    )
    effects = ProgramEffects(program)
    walker = AbstractInterpreter(program, effects, runs)
    if written:
        walker.walk_all()
    table = walker.table
    met = {known.call for known in table.moves} | table.unknown.keys()
    for call, _ in written:
        if call not in met:
            table.unknown[call] = table.unreached.get(call, TOO_LONG)
    if not runs.keys() <= met or runs.keys() & (table.unknown.keys() | table.unreached.keys()):
        raise RunNotFollowedError
    settings_set = effects.everything.settings if written else frozenset()
    return WalkedProgram(written, tuple(table.moves), table.unknown, settings_set)
