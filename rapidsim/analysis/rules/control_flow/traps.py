"""Rule F413: traps that block other interrupts, and interrupts connected twice."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Does
from rapidsim.syntax import tree


class TrapHazard(Violation, code="F413"):
    problem: str
    cure: str


def find_trap_hazards(facts: Facts) -> Iterator[Diagnostic]:
    """Waits in traps; CONNECT in loops that never delete the interrupt."""
    for part in facts.routine_parts:
        if isinstance(part.routine, tree.Trap):
            held = [call.start for call in part.calls if Does.HOLD_ROBOT in facts.does(call)]
            for call in part.calls:
                # Who has stopped the robot means to wait.
                if Does.WAIT in facts.does(call) and call.start < min(held, default=call.end):
                    problem = f"{call.name.text} in a trap holds up program and interrupts"
                    cure = "let the trap set a flag, and wait in the program"
                    yield part.finding(TrapHazard(problem, cure), call)
        reported: set[tree.Connect] = set()
        bodies = [loop.body for loop in part.all(tree.For)]
        bodies += [loop.body for loop in part.all(tree.While)]
        for body in bodies:
            inside = list(descendants(*body))
            connects = [node for node in inside if isinstance(node, tree.Connect)]
            # A call may lead to IDelete, a jump or a return may leave the loop at once.
            if any(_may_delete(node, facts) for node in inside):
                continue
            for connect in connects:
                if connect not in reported:
                    reported.add(connect)
                    shown = part.module.span(connect.interrupt).text
                    problem = f"`{shown}` is connected again each time the loop comes round"
                    cure = f"connect it once before the loop, or `IDelete {shown};` first"
                    yield part.finding(TrapHazard(problem, cure), connect)


def _may_delete(node: tree.Node, facts: Facts) -> bool:
    match node:
        case tree.Call():
            return facts.installed(node) is None or Does.DISCONNECT in facts.does(node)
        case tree.LateCall() | tree.Goto() | tree.Return() | tree.Exit() | tree.Broken():
            return True
        case tree.Index():
            # An element of an array may be another interrupt each time.
            return True
        case _:
            return False
