"""Rules M507 to M509: tools, work objects and loads that are inconsistent."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import DataSymbol, Storage, Symbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import MoveCall, moves
from rapidsim.analysis.rules.facts.known_values import known_value, numbers
from rapidsim.analysis.rules.facts.taught_targets import taught_target
from rapidsim.diagnostics import Diagnostic, Related, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class

_UNIDENTIFIED = -1.0
"""Mass of a new tool before it is defined."""


class ToolOrWobjMissing(Violation, code="M507"):
    target: str
    actual: str
    usual: str


class BadLoadData(Violation, code="M508"):
    data: str
    problem: str


class StationaryToolMismatch(Violation, code="M509"):
    tool: str
    wobj: str
    problem: str


@value_class(frozen=True, slots=True)
class _Use:
    """A move to a named target, with the names of tool and work object."""

    part: ProgramPart
    move: MoveCall
    tool: str
    wobj: str


def find_mixed_frames(facts: Facts) -> Iterator[Diagnostic]:
    """Report moves to a target whose tool or work object differs from its first move."""
    first: dict[Symbol, _Use] = {}
    uses: dict[Symbol, list[_Use]] = {}
    for _, found in facts.in_parts(_uses_of_targets):
        for symbol, use in found:
            other = first.setdefault(symbol, use)
            if use.tool != other.tool or use.wobj != other.wobj:
                uses[symbol] = []
    for _, found in facts.in_parts(_uses_of_targets) if uses else ():
        for symbol, use in found:
            if symbol in uses:
                uses[symbol].append(use)
    for symbol, moved in uses.items():
        usual = next((use for use in moved if use.tool != "tool0"), moved[0])
        for use in moved:
            if use.tool == "tool0" != usual.tool:
                pair = "tool0", f"`{usual.tool}`"
                place = use.move.arguments.get("tool") or use.move.call
            elif use.wobj != moved[0].wobj:
                usual = moved[0]
                pair = f"`{use.wobj}`", f"`{usual.wobj}`"
                place = use.move.arguments.get("wobj") or use.move.call
            else:
                continue
            elsewhere = Related(usual.part.module.span(usual.move.call), "the other move")
            violation = ToolOrWobjMissing(symbol.name, pair[0], pair[1])
            yield use.part.finding(violation, place, elsewhere)


def _uses_of_targets(part: ProgramPart, facts: Facts) -> list[tuple[Symbol, _Use]]:
    found: list[tuple[Symbol, _Use]] = []
    for move in moves(part, facts):
        target = move.arguments.get("topoint")
        if target is None or "tool" not in move.arguments:
            # A call without a tool is reported as another error.
            continue
        symbol = facts.symbol(taught_target(target, facts))
        if isinstance(symbol, DataSymbol) and symbol.storage is not Storage.VAR:
            use = _Use(part, move, _name(move, "tool", "tool0"), _name(move, "wobj", "wobj0"))
            found.append((symbol, use))
    return found


def find_bad_loads(facts: Facts) -> Iterator[Diagnostic]:
    """Report declared tools and loads with impossible values."""
    for part in facts.parts:
        for node in part.all(tree.Data):
            kind = node.type.key
            if kind not in ("tooldata", "loaddata") or node.dimensions or node.value is None:
                continue
            value = known_value(node.value, facts)
            if not isinstance(value, tuple):
                continue
            if kind == "tooldata":
                # The mass of a stationary tool does not matter.
                if len(value) != 3 or value[0] is not True:
                    continue
                value = value[2]
            elif value[0] == 0.0:
                # As in load0: no load, or the program weighs the part first.
                continue
            problem = _load_problem(value)
            if problem is not None:
                yield part.finding(BadLoadData(node.name.text, problem), node.name)


def find_holding_mismatch(facts: Facts) -> Iterator[Diagnostic]:
    """Report moves whose tool and work object are both held by the robot, or neither."""
    for part in facts.routine_parts:
        for move in moves(part, facts):
            tool = move.arguments.get("tool")
            wobj = move.arguments.get("wobj")
            tool_held = _robhold(tool, facts)
            wobj_held = False if "wobj" not in move.arguments else _robhold(wobj, facts)
            if tool_held is None or wobj_held is None or tool_held is not wobj_held:
                continue
            if Trait.AXES in move.does:
                continue
            problem = "the robot holds both" if tool_held else "the robot holds neither"
            names = _name(move, "tool", "tool0"), _name(move, "wobj", "wobj0")
            place = tool if tool is not None else move.call
            yield part.finding(StationaryToolMismatch(*names, problem), place)


def _load_problem(load: object) -> str | None:
    """Description of the error in a load; None if it has no visible error."""
    if not isinstance(load, tuple) or len(load) != 6:
        return None
    mass, centre, inertia = load[0], numbers(load[1], 3), numbers(load[3:], 3)
    if not isinstance(mass, float) or centre is None or inertia is None:
        return None
    if mass == _UNIDENTIFIED:
        return "has mass -1: it has not been defined yet"
    if mass <= 0.0:
        return f"has mass {mass:g} kg"
    if min(inertia) < 0.0:
        return f"has a moment of inertia of {min(inertia):g} kgm2"
    return None


def _robhold(expression: tree.Expression | None, facts: Facts) -> bool | None:
    value = known_value(expression, facts)
    if isinstance(value, tuple) and value and isinstance(value[0], bool):
        return value[0]
    return None


def _name(move: MoveCall, parameter: str, default: str) -> str:
    """Name of an argument in the text; other text if it is not a plain name."""
    if parameter not in move.arguments:
        return default
    match move.arguments[parameter]:
        case tree.DataReference(name=name):
            return name.key
        case _:
            return "another"
