"""Rules M502 and M503: effects that execute during a fly-by."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import MoveCall, as_move
from rapidsim.analysis.rules.motion.fly_by_effects import (
    EffectAfterMove,
    effects_behind_moves,
    homes_of_moves,
)
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
    """Report waits and outputs after fly-by moves: each move and each output once."""
    homes: dict[tree.Call, ProgramPart] = {}
    for effects, findings in effects_behind_moves(facts):
        if not findings:
            homes = homes or homes_of_moves(facts)
            findings += _of_routine(effects, homes, facts)
        yield from findings


def _of_routine(
    effects: Sequence[EffectAfterMove], homes: Mapping[tree.Call, ProgramPart], facts: Facts
) -> Iterator[Diagnostic]:
    """Report the effects in one routine, which alone contains the places of their mistakes."""
    reported: set[tree.Node] = set()
    for one in effects:
        home = homes[one.move]
        mistake = one.move if one.effect.waits and home is one.part else one.place
        if mistake in reported:
            continue
        reported.add(mistake)
        move = as_move(one.move, facts)
        assert move is not None
        yield (_waits if one.effect.waits else _acts)(one, move, home)


def _waits(effect: EffectAfterMove, move: MoveCall, home: ProgramPart) -> Diagnostic:
    """Finding at the zone of the move; at the wait if the move is in another routine."""
    zone = move.arguments.get("zone")
    place = move.call if zone is None else zone
    violation = ZoneBeforeWait(
        move.call.name.text, home.module.span(place).one_line, _describe(effect)
    )
    wait = effect.effect.part.place(effect.effect.node, "the program waits here")
    if home is not effect.part:
        return effect.part.finding(
            violation, effect.place, home.place(place, "the move"), *_more(effect)
        )
    fix = (
        None
        if zone is None
        else Fix("stop at the target", (Edit(home.module.span(zone), "fine"),), safe=False)
    )
    return home.finding(violation, place, wait, fix=fix)


def _acts(effect: EffectAfterMove, move: MoveCall, home: ProgramPart) -> Diagnostic:
    target = move.arguments.get("topoint") or move.arguments.get("tojointpos")
    zone = move.arguments.get("zone")
    shown = "the target" if target is None else home.module.span(target).one_line
    size = "" if zone is None else f"`{home.module.span(zone).one_line}`"
    violation = OutputInZone(_describe(effect), shown if len(shown) < 40 else "the target", size)
    return effect.part.finding(
        violation, effect.place, home.place(move.call, "the move"), *_more(effect)
    )


def _describe(effect: EffectAfterMove) -> str:
    """Describe the instruction, with the call that leads to it."""
    name = effect.effect.node.name.text
    return name if effect.place is effect.effect.node else f"{name} in `{effect.place.name.text}`"


def _more(effect: EffectAfterMove) -> tuple[Related, ...]:
    """Location of the instruction if a call leads to it."""
    if effect.place is effect.effect.node:
        return ()
    return (effect.effect.part.place(effect.effect.node, "it stands here"),)
