"""The user routines that nodes may cause to run."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_LEAVES = (tree.Return, tree.Exit, tree.Goto, tree.Raise, tree.InvalidStatement)


def reached(nodes: Iterable[tree.Node], facts: Facts) -> int:
    """The bits of the routines that nodes, without nested ones, may call, also indirectly."""
    bits = 0
    for node in nodes:
        routine = facts.routine_called(node)
        if routine is not None and routine in facts.part_of:
            bits |= facts.reached_from[facts.part_of[routine]]
    return bits


def may_move(nodes: Collection[tree.Node], facts: Facts) -> bool:
    """Whether nodes without nested ones move the robot, or the routines that they may call."""
    return any(Trait.MOVE in facts.does(node) for node in nodes) or bool(
        reached(nodes, facts) & facts.moving
    )


def may_leave(body: tree.Body, part: ProgramPart, facts: Facts) -> bool:
    """Whether a statement of a list, or of a block in it, may leave the list."""
    return any(True for _ in part.inside(body, *_LEAVES)) or any(
        Trait.LEAVE in facts.does(call) for call in part.inside(body, tree.Call)
    )


def mask_of(function: Callable[[ProgramPart, Facts], object], facts: Facts) -> int:
    """Return the bits of the routines for which a function of one part has a result."""
    return facts.bits_of(part for part, _ in facts.in_parts(function))
