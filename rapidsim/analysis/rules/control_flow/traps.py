"""Rules F413 and F424: traps that block other interrupts, interrupts connected twice or never."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import DataSymbol, Storage, Symbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.changed_data import changed_by
from rapidsim.analysis.rules.facts.instruction_questions import arguments_of
from rapidsim.analysis.suggestions import closest
from rapidsim.analysis.tree_walk import descendants
from rapidsim.analysis.types.data_paths import root_of
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.predefined import TYPES
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class

_INTERRUPT = TYPES["intnum"]


class TrapHazard(Violation, code="F413"):
    problem: str
    suggestion: str


class NeverConnected(Violation, code="F424"):
    instruction: str
    interrupt: str
    nearest: str = ""

    @property
    def help(self) -> str:
        """Suggestion of the intended interrupt, or of the missing statement."""
        meant = f"did you mean `{self.nearest}`? else " if self.nearest else ""
        return f"{meant}write `CONNECT {self.interrupt} WITH` and a TRAP before it"


def find_never_connected(facts: Facts) -> Iterator[Diagnostic]:
    """Report interrupts that are ordered but never connected to a trap in the task."""
    if facts.analysis.loads_modules or not facts.is_read:
        return
    uses = facts.in_parts(_interrupts_of)
    connected = {symbol: None for _, one in uses for symbol in one.connected}
    for part, one in uses:
        for call, value, symbol in one.orders:
            if symbol not in connected:
                names = {known.name.lower(): known.name for known in connected}
                nearest = closest(symbol.name.lower(), tuple(names))
                meant = names.get(nearest or "", "")
                yield part.finding(NeverConnected(call.name.text, symbol.name, meant), value)


@value_class(frozen=True, slots=True, eq=False)
class _InterruptUses:
    """Data that a routine may connect to a trap, and the interrupts that it orders."""

    connected: tuple[Symbol, ...]
    orders: tuple[tuple[tree.Call, tree.Expression, Symbol], ...]


def _interrupts_of(part: ProgramPart, facts: Facts) -> _InterruptUses | None:
    kinds = (tree.Connect, tree.Assignment, tree.LateCall)
    connecting: list[tree.Node] = [node for kind in kinds for node in part.all(kind)]
    orders: list[tuple[tree.Call, tree.Expression, Symbol]] = []
    for call in part.calls:
        row = facts.installed(call)
        if row is None:
            # A routine may connect an argument that is passed by reference.
            connecting.append(call)
            continue
        if Trait.DISCONNECT in row.traits or not isinstance(call, tree.Call):
            continue
        for formal, value in arguments_of(call, facts):
            if formal is None or value is None or formal.types[0] != _INTERRUPT:
                continue
            symbol = facts.symbol(root_of(value)) if isinstance(value, tree.DataPath) else None
            if isinstance(symbol, DataSymbol) and symbol.storage is Storage.VAR:
                orders.append((call, value, symbol))
    connected = dict.fromkeys(one for one in changed_by(connecting, facts) if one is not None)
    return _InterruptUses(tuple(connected), tuple(orders)) if connected or orders else None


def find_trap_hazards(facts: Facts) -> Iterator[Diagnostic]:
    """Report waits in traps, and CONNECT in loops that never delete the interrupt."""
    for part in facts.routine_parts:
        if isinstance(part.routine, tree.Trap):
            held = [call.start for call in part.calls if Trait.HOLD_ROBOT in facts.does(call)]
            for call in part.calls:
                # After stopping the robot, a wait is intended.
                if Trait.WAIT in facts.does(call) and call.start < min(held, default=call.end):
                    problem = f"{call.name.text} in a trap holds up program and interrupts"
                    cure = "let the trap set a flag, and wait in the program"
                    yield part.finding(TrapHazard(problem, cure), call)
        if not part.all(tree.Connect):
            continue
        reported: set[tree.Connect] = set()
        bodies = [loop.body for loop in part.all(tree.For)]
        bodies += [loop.body for loop in part.all(tree.While)]
        for body in bodies:
            inside = list(descendants(*body))
            connects = [node for node in inside if isinstance(node, tree.Connect)]
            # A call may execute IDelete; a jump or a return may leave the loop.
            if any(_may_delete(node, facts) for node in inside):
                continue
            for connect in connects:
                if connect not in reported:
                    reported.add(connect)
                    shown = part.module.span(connect.interrupt).one_line
                    problem = f"`{shown}` is connected again each time the loop comes round"
                    cure = f"connect it once before the loop, or `IDelete {shown};` first"
                    yield part.finding(TrapHazard(problem, cure), connect)


def _may_delete(node: tree.Node, facts: Facts) -> bool:
    match node:
        case tree.Call():
            return facts.installed(node) is None or Trait.DISCONNECT in facts.does(node)
        case tree.LateCall() | tree.Goto() | tree.Return() | tree.Exit() | tree.InvalidStatement():
            return True
        case tree.Index():
            # An element of an array may be a different interrupt each time.
            return True
        case _:
            return False
