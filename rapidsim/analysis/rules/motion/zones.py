"""Rules M502 and M503: what a program does while the robot is still moving through a zone."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts, Part
from rapidsim.analysis.rules.facts.instruction_questions import MoveCall, as_move
from rapidsim.analysis.rules.motion.fly_by_effects import BehindMove, effects_behind_moves
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Violation
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
    """Waits and outputs after fly-by moves: each move and each output once."""
    part_of = {call: part for part in facts.routine_parts for call in part.all(tree.Call)}
    reported: set[tree.Node] = set()
    for one in effects_behind_moves(facts):
        home = part_of[one.move]
        mistake = one.move if one.effect.waits and home is one.part else one.place
        if mistake in reported:
            continue
        reported.add(mistake)
        move = as_move(one.move, facts)
        assert move is not None
        yield (_waits if one.effect.waits else _acts)(one, move, home)


def _waits(one: BehindMove, move: MoveCall, home: Part) -> Diagnostic:
    """The finding at the zone of the move; at the wait where the move is in another routine."""
    zone = move.arguments.get("zone")
    place = move.call if zone is None else zone
    violation = ZoneBeforeWait(move.call.name.text, home.module.span(place).text, _shown(one))
    wait = one.effect.part.place(one.effect.node, "the program waits here")
    if home is not one.part:
        return one.part.finding(violation, one.place, home.place(place, "the move"), *_more(one))
    fix = (
        None
        if zone is None
        else Fix("stop at the target", (Edit(home.module.span(zone), "fine"),), safe=False)
    )
    return home.finding(violation, place, wait, fix=fix)


def _acts(one: BehindMove, move: MoveCall, home: Part) -> Diagnostic:
    target = move.arguments.get("topoint") or move.arguments.get("tojointpos")
    zone = move.arguments.get("zone")
    shown = "the target" if target is None else " ".join(home.module.span(target).text.split())
    size = "" if zone is None else f"`{home.module.span(zone).text}`"
    violation = OutputInZone(_shown(one), shown if len(shown) < 40 else "the target", size)
    return one.part.finding(violation, one.place, home.place(move.call, "the move"), *_more(one))


def _shown(one: BehindMove) -> str:
    """The instruction, with the call that leads to it."""
    name = one.effect.node.name.text
    return name if one.place is one.effect.node else f"{name} in `{one.place.name.text}`"


def _more(one: BehindMove) -> tuple[Related, ...]:
    """Where the instruction stands, if a call leads to it."""
    if one.place is one.effect.node:
        return ()
    return (one.effect.part.place(one.effect.node, "it stands here"),)
