"""The taught target from which a move's target is derived: p10 of `Offs(RelTool(p10,..),..)`."""

from __future__ import annotations

from rapidsim.analysis.program_parts import Facts
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree


def taught_target(target: tree.Expression, facts: Facts) -> tree.Expression:
    """Innermost target inside functions that displace their argument."""
    while True:
        match target:
            case tree.Parenthesised(inner=inner):
                target = inner
            case tree.FunctionCall(arguments=(tree.RequiredArgument(value=value), *_)) if (
                Trait.OFFSET in facts.does(target)
            ):
                target = value
            case _:
                return target
