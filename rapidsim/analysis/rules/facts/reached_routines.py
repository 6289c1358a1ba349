"""The user routines that nodes may cause to run."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.tree_walk import descendants
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree


def reached(nodes: Iterable[tree.Node], facts: Facts) -> int:
    """The bits of the routines that nodes may call, directly or indirectly."""
    bits = 0
    for node in descendants(*nodes):
        routine = facts.routine_called(node)
        if routine is not None and routine in facts.part_of:
            bits |= facts.reached_from[facts.part_of[routine]]
    return bits


def may_move(nodes: Iterable[tree.Node], facts: Facts) -> bool:
    """Whether nodes move the robot, themselves or by the routines that they may call."""
    listed = list(descendants(*nodes))
    return any(Trait.MOVE in facts.does(node) for node in listed) or bool(
        reached(listed, facts) & facts.moving
    )


def mask_of(function: Callable[[ProgramPart, Facts], object], facts: Facts) -> int:
    """Return the bits of the routines for which a function of one part has a result."""
    return facts.bits_of(part for part, _ in facts.in_parts(function))
