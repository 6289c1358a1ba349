"""Rules M502 and M503: what a program does while the robot is still on its way through a zone."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts, Part
from rapidsim.analysis.rules.facts.instruction_questions import Move, arguments_of, as_move
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.analysis.tree_walk import blocks, clauses, descendants
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Violation
from rapidsim.library.traits import Does
from rapidsim.syntax import tree


class ZoneBeforeWait(Violation, code="M502"):
    move: str
    zone: str
    wait: str


class OutputInZone(Violation, code="M503"):
    output: str
    target: str
    zone: str


def find_behind_zones(facts: Facts) -> Iterator[Diagnostic]:
    """Waits and outputs that follow a fly-by move in the same list of statements."""
    for part in facts.routine_parts:
        assert part.routine is not None
        for body in clauses(part.routine):
            yield from _in_body(body, part, facts)


def _in_body(body: tree.Body, part: Part, facts: Facts) -> Iterator[Diagnostic]:
    before: Move | None = None
    for statement in body:
        for block in blocks(statement):
            yield from _in_body(block, part, facts)
        move = as_move(statement, facts)
        if move is not None:
            before = move if _flies_by(move, facts) else None
            continue
        if before is None:
            continue
        wait = _wait(statement, facts)
        if wait is not None:
            yield _waits(before, wait, part)
            before = None
            continue
        match statement:
            case tree.Call():
                does = facts.does(statement)
                if Does.OUTPUT in does:
                    yield _acts(before, statement, part)
                elif Does.INSTANT not in does:
                    before = None
            case tree.Assignment() | tree.Empty():
                continue
            case _:
                before = None


def _flies_by(move: Move, facts: Facts) -> bool:
    """Whether a move is known to pass its target in a zone."""
    if {"inpos", "conc"} & move.arguments.keys():
        return False
    if "z" in move.arguments:
        size = known_value(move.arguments["z"], facts)
        return isinstance(size, float) and size > 0
    zone = known_value(move.arguments.get("zone"), facts)
    return isinstance(zone, tuple) and len(zone) == 7 and zone[0] is False


def _wait(statement: tree.Statement, facts: Facts) -> tree.Call | tree.FunctionCall | None:
    """What an instruction or an assignment waits for: itself, or a function in it."""
    if not isinstance(statement, tree.Call | tree.Assignment):
        return None
    for node in descendants(statement):
        if isinstance(node, tree.Call | tree.FunctionCall) and Does.WAIT in facts.does(node):
            return None if _is_no_wait(node, facts) else node
    return None


def _is_no_wait(call: tree.Call | tree.FunctionCall, facts: Facts) -> bool:
    """Whether a WaitTime is too short to matter: WaitTime 0 only hands over to other tasks."""
    return any(
        formal is not None
        and formal.key == "time"
        and not formal.optional
        and known_value(value, facts) == 0.0
        for formal, value in arguments_of(call, facts)
    )


def _waits(move: Move, wait: tree.Call | tree.FunctionCall, part: Part) -> Diagnostic:
    zone = move.arguments.get("zone")
    place = move.call if zone is None else zone
    written = part.module.span(place).text
    violation = ZoneBeforeWait(move.call.name.text, written, wait.name.text)
    fix = (
        None
        if zone is None
        else Fix("stop at the target", (Edit(part.module.span(zone), "fine"),), safe=False)
    )
    return part.finding(violation, place, part.place(wait, "the program waits here"), fix=fix)


def _acts(move: Move, output: tree.Call, part: Part) -> Diagnostic:
    target = move.arguments.get("topoint") or move.arguments.get("tojointpos")
    zone = move.arguments.get("zone")
    shown = "the target" if target is None else " ".join(part.module.span(target).text.split())
    size = "" if zone is None else f"`{part.module.span(zone).text}`"
    violation = OutputInZone(output.name.text, shown if len(shown) < 40 else "the target", size)
    return part.finding(violation, output, part.place(move.call, "the move"))
