"""Rules M507 to M509: tools, work objects and loads that do not fit each other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.analysis.program import DataSymbol, Storage, Symbol
from rapidsim.analysis.rules.facts import Facts, Part
from rapidsim.analysis.rules.instructions import Move, moves
from rapidsim.analysis.rules.known_values import known_value, numbers
from rapidsim.diagnostics import Diagnostic, Related, Severity, Violation
from rapidsim.syntax import tree

_UNIDENTIFIED = -1.0
"""The mass that a new tool has until somebody defines it."""


@dataclass(frozen=True)
class ToolOrWobjMissing(Violation):
    r"""A move to a target uses tool0 and another one a tool, or they use two work objects.

    A target is the place of one TCP in one work object. With another tool or work object the robot
    goes somewhere else.

    ## Example

        MODULE example
          PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
          CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,pen;
            MoveL p10,v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
          CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,pen;
            MoveL p10,v500,fine,pen;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M507"
    name: ClassVar[str] = "tool-or-wobj-missing"
    template: ClassVar[str] = "`{target}` is reached with {here} here and with {there} elsewhere"
    severity: ClassVar[Severity] = Severity.WARNING

    target: str
    here: str
    there: str


@dataclass(frozen=True)
class BadLoadData(Violation):
    """A load has no mass, a negative moment of inertia, or a centre that is not set.

    The controller plans accelerations with the load. A wrong one wears the gears, lets collision
    detection trip, and a mass of 0 or less is refused.

    ## Example

        MODULE example
          PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[0,[0,0,60],[1,0,0,0],0,0,0]];
          CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,pen;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[0.8,[0,0,60],[1,0,0,0],0,0,0]];
          CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,pen;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M508"
    name: ClassVar[str] = "bad-load-data"
    template: ClassVar[str] = "the load of `{data}` {problem}"
    severity: ClassVar[Severity] = Severity.WARNING

    data: str
    problem: str

    @property
    def help(self) -> str:
        """Where good values come from."""
        return "take mass and centre from the drawing, or run LoadIdentify on the robot"


@dataclass(frozen=True)
class StationaryToolMismatch(Violation):
    r"""Tool and work object are both held by the robot, or neither is.

    Either the robot holds the tool (robhold TRUE) and the work object stands (robhold FALSE), or
    the tool stands and the robot holds the work object.

    ## Example

        MODULE example
          PERS tooldata grinder:=[FALSE,[[900,0,500],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
          CONST robtarget p10:=[[0,0,100],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,grinder;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PERS tooldata grinder:=[FALSE,[[900,0,500],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
          PERS wobjdata part:=[TRUE,TRUE,"",[[0,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
          CONST robtarget p10:=[[0,0,100],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,grinder\WObj:=part;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M509"
    name: ClassVar[str] = "stationary-tool-mismatch"
    template: ClassVar[str] = "`{tool}` and `{wobj}`: {problem}"
    severity: ClassVar[Severity] = Severity.WARNING

    tool: str
    wobj: str
    problem: str


@dataclass(frozen=True, slots=True)
class _Use:
    """A move to a named target, with names of tool and work object."""

    part: Part
    move: Move
    tool: str
    wobj: str


def find_mixed_frames(facts: Facts) -> Iterator[Diagnostic]:
    """Moves to a target whose tool or work object differs from that of its first move."""
    uses: dict[Symbol, list[_Use]] = {}
    for part in facts.routine_parts:
        for move in moves(part, facts):
            target = move.arguments.get("topoint")
            symbol = facts.symbol(target)
            if isinstance(symbol, DataSymbol) and symbol.storage is not Storage.VAR:
                use = _Use(part, move, _name(move, "tool", "tool0"), _name(move, "wobj", "wobj0"))
                uses.setdefault(symbol, []).append(use)
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


def find_bad_loads(facts: Facts) -> Iterator[Diagnostic]:
    """Declared tools and loads whose numbers cannot be."""
    for part in facts.parts:
        for node in part.all(tree.Data):
            kind = node.type.key
            if kind not in ("tooldata", "loaddata") or node.dimensions or node.value is None:
                continue
            value = known_value(node.value, facts)
            if not isinstance(value, tuple):
                continue
            if kind == "tooldata":
                # What a stationary tool weighs does not matter.
                if len(value) != 3 or value[0] is not True:
                    continue
                value = value[2]
            problem = _load_problem(value)
            if problem is not None:
                yield part.finding(BadLoadData(node.name.text, problem), node.name)


def find_holding_mismatch(facts: Facts) -> Iterator[Diagnostic]:
    """Moves whose tool and work object are held by the same or by none."""
    for part in facts.routine_parts:
        for move in moves(part, facts):
            tool = move.arguments.get("tool")
            wobj = move.arguments.get("wobj")
            tool_held = _robhold(tool, facts)
            wobj_held = False if "wobj" not in move.arguments else _robhold(wobj, facts)
            if tool_held is None or wobj_held is None or tool_held is not wobj_held:
                continue
            if move.name == "moveabsj":
                continue
            problem = "the robot holds both" if tool_held else "the robot holds neither"
            names = _name(move, "tool", "tool0"), _name(move, "wobj", "wobj0")
            place = tool if tool is not None else move.call
            yield part.finding(StationaryToolMismatch(*names, problem), place)


def _load_problem(load: object) -> str | None:
    """What is wrong with a load; None if nothing is to be seen."""
    if not isinstance(load, tuple) or len(load) != 6:
        return None
    mass, centre, inertia = load[0], numbers(load[1], 3), numbers(load[3:], 3)
    if not isinstance(mass, float) or centre is None or inertia is None:
        return None
    if mass == _UNIDENTIFIED:
        return "has mass -1: nobody has defined it yet"
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


def _name(move: Move, parameter: str, default: str) -> str:
    """The name an argument is written with; another text where it is no plain name."""
    if parameter not in move.arguments:
        return default
    match move.arguments[parameter]:
        case tree.Reference(name=name):
            return name.key
        case _:
            return "another"
