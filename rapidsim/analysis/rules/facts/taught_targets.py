"""The target that was taught, of which a move goes beside it: p10 of `Offs(RelTool(p10,..),..)`."""

from __future__ import annotations

from rapidsim.analysis.program_parts import Facts
from rapidsim.library.traits import Does
from rapidsim.syntax import tree


def taught_target(target: tree.Expression, facts: Facts) -> tree.Expression:
    """What stands within functions that answer a target beside the one they are given."""
    while True:
        match target:
            case tree.Parenthesised(inner=inner):
                target = inner
            case tree.FunctionCall(arguments=(tree.Required(value=value), *_)) if (
                Does.OFFSET in facts.does(target)
            ):
                target = value
            case _:
                return target
