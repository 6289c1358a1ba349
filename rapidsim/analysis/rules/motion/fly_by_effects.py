"""Effects that a program executes after a fly-by move, including through calls.

A backward analysis: the effects after each place up to the next move or wait, and whether they are
certain. The effects after a fly-by move execute while the robot is in its zone. Each routine is
summarised: its effects before its own first move or wait, whether a move that is active at its call
may still be active when it returns, and which moves are active when it returns.

"Certain" is a judgement about the intention of the text, not about all paths: a path that returns
early, raises an error or ends the program does not make the others less certain, and a loop is
assumed both to repeat and to end.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from typing import TypeAlias

from rapidsim.analysis.flow.graph import ENDED, ENTRY, EXIT, NORMAL, RAISED, FlowEdge
from rapidsim.analysis.flow.solve import backward
from rapidsim.analysis.flow.summaries import resummarise, summarise
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import MoveCall, arguments_of, as_move
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.analysis.rules.facts.reached_routines import mask_of
from rapidsim.diagnostics import Diagnostic
from rapidsim.language.moves import AXES_IN_USE
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class

_MOST_EFFECTS = 16
"""Maximum number of effects in the summary of one routine."""

_Place: TypeAlias = tree.Call | tree.FunctionCall


@value_class(frozen=True, slots=True)
class Effect:
    """A wait, or setting an output."""

    node: _Place
    part: ProgramPart
    waits: bool


@value_class(frozen=True, slots=True)
class EffectAfterMove:
    """An effect after a move that passes its target in a zone."""

    move: tree.Call
    effect: Effect
    place: _Place
    """The effect, or the call that leads to it."""
    part: ProgramPart
    """The routine that contains the place."""


@value_class(frozen=True, slots=True)
class _Ahead:
    """Effects after a place, before the next move or wait."""

    effects: Mapping[tuple[Effect, _Place], bool] = field(default_factory=dict)
    """Effects with the steps that lead to them, each with whether it is certain."""
    end: bool | None = None
    """Whether the end of the routine certainly follows; None if it never does."""
    leaves: bool = False
    """Whether a path returns early, raises an error or ends the program."""

    @property
    def is_wait_certain(self) -> bool:
        """Whether a wait certainly follows."""
        return any(is_sure and effect.waits for (effect, _), is_sure in self.effects.items())


_NOTHING = _Ahead()
_END = _Ahead(end=True)
_EARLY_RETURN = _Ahead(end=True, leaves=True)
_GONE = _Ahead(leaves=True)


@value_class(frozen=True, slots=True)
class _Summary:
    """Effects of a routine on a move that is active when it is called."""

    effects: Mapping[Effect, bool] = field(default_factory=dict)
    """Effects before another move or wait, each with whether it is certain."""
    passes: bool | None = None
    """Whether the move is certainly still active at the end; None if it never is."""
    moves: Mapping[tree.Call, bool] = field(default_factory=dict)
    """Moves of the routine and its callees that may be active at the end."""


@value_class(frozen=True, slots=True, eq=False)
class _Outcome:
    """The analysis of one routine, which holds as long as its callees have the same summaries."""

    callees: tuple[tuple[_Summary, bool], ...]
    """Summaries of the callees, each with whether it can return."""
    summary: _Summary
    effects: Sequence[EffectAfterMove]
    findings: list[Diagnostic] = field(default_factory=list)
    """The findings of these effects, if there are any and they were composed."""


@value_class(frozen=True, slots=True, eq=False)
class _Summaries:
    """The summaries of routines as long as the call graph stays."""

    flying: int
    """The bits of the routines with fly-by moves."""
    relevant: int
    """The bits of the routines with a summary."""
    parts: Sequence[ProgramPart]
    by_part: dict[ProgramPart, _Summary]


def effects_behind_moves(
    facts: Facts,
) -> Iterator[tuple[Sequence[EffectAfterMove], list[Diagnostic]]]:
    """Yield the effects that certainly follow a fly-by move, and every output set after one.

    Those in one routine come together, with the list for their findings.
    """

    def summary_of(part: ProgramPart, known: Mapping[ProgramPart, _Summary]) -> _Summary:
        callees = tuple(
            (known[one], facts.returning[one.routine])
            for one in facts.call_graph[part]
            if one.routine is not None
        )
        outcome: _Outcome | None = part.memo.get(_Outcome)
        if outcome is None or outcome.callees != callees:
            analysis = _RoutineAnalysis(part, facts, known)
            effects = analysis.effects_after_moves()
            outcome = part.memo[_Outcome] = _Outcome(callees, analysis.summary(), effects)
        return outcome.summary

    flying = mask_of(_fly_by_moves, facts)
    known: _Summaries | None = facts.calls_memo.get(_Summaries)
    if known is not None and known.flying == flying and not known.relevant & facts.recursive:
        changed = [part for part in known.parts if _Outcome not in part.memo]
        callers = facts.callers.__getitem__
        resummarise(known.by_part, changed, facts.component_of, callers, summary_of)
    else:
        relevant = _relevant(flying, facts)
        parts = [part for part, bit in facts.bit_of.items() if bit & relevant]
        order = [one for one in facts.components if facts.bit_of[one[0]] & relevant]
        callees = facts.call_graph.__getitem__
        found = summarise(parts, callees, _Summary(), summary_of, order)
        known = facts.calls_memo[_Summaries] = _Summaries(flying, relevant, parts, found)
    for part in known.parts:
        outcome = part.memo[_Outcome]
        if outcome.effects:
            yield outcome.effects, outcome.findings


def homes_of_moves(facts: Facts) -> dict[tree.Call, ProgramPart]:
    """The routine of each fly-by move."""
    return {move: part for part, moves in facts.in_parts(_fly_by_moves) for move in moves}


def _fly_by_moves(part: ProgramPart, facts: Facts) -> list[tree.Call]:
    return [call for call in part.all(tree.Call) if _is_fly_by(call, facts)]


def _relevant(flying: int, facts: Facts) -> int:
    """The bits of the routines with fly-by moves, their callers, and all callees of those."""
    relevant = 0
    for reached in facts.reached_from.values():
        relevant |= reached if reached & flying else 0
    return relevant


class _RoutineAnalysis:
    """Transfer functions of one routine, and the conclusions from their solution."""

    def __init__(
        self, part: ProgramPart, facts: Facts, summaries: Mapping[ProgramPart, _Summary]
    ) -> None:
        self._part = part
        self._facts = facts
        self._summaries = summaries
        self._steps = self._solve()

    def _solve(self) -> list[tuple[tree.Node, _Ahead]]:
        """Reached steps in source order, each with the effects after it."""
        graph = self._facts.flow(self._part)
        at_end = backward(
            graph,
            {EXIT: _END, RAISED: _GONE, ENDED: _GONE},
            self._before,
            lambda index, states: _joined(states, is_loop_test=index in graph.loop_tests),
            self._along,
        )
        steps = []
        self._first = _NOTHING
        for index in graph.reached(NORMAL, graph.entries):
            ahead = at_end.get(index, _NOTHING)
            for node in reversed(graph.blocks[index].steps):
                steps.append((node, ahead))
                ahead = self._before(node, ahead)
            if index == ENTRY:
                self._first = ahead
        return sorted(steps, key=lambda step: step[0].start)

    def effects_after_moves(self) -> list[EffectAfterMove]:
        """Effects that certainly follow a move, and outputs that may follow it."""
        return [
            EffectAfterMove(move, effect, place, self._part)
            for node, ahead in self._steps
            for move, move_is_sure in self._moves_begun(node).items()
            for (effect, place), effect_is_sure in ahead.effects.items()
            if (move_is_sure and effect_is_sure) or (place is effect.node and not effect.waits)
        ]

    def summary(self) -> _Summary:
        """Summary for the routine's callers."""
        effects: dict[Effect, bool] = {}
        for (effect, _), is_sure in self._first.effects.items():
            if effect in effects or len(effects) < _MOST_EFFECTS:
                effects[effect] = effects.get(effect, False) or is_sure
        moves: dict[tree.Call, bool] = {}
        for node, ahead in self._steps:
            if ahead.end is not None:
                for move, is_sure in self._moves_begun(node).items():
                    moves[move] = moves.get(move, False) or (is_sure and ahead.end)
        return _Summary(effects, self._first.end, moves)

    def _along(self, edge: FlowEdge, ahead: _Ahead) -> _Ahead | None:
        if edge.to == EXIT and edge.by is not None:
            return _EARLY_RETURN
        if edge.holds is False and isinstance(edge.by, tree.DataReference):
            is_endless = known_value(edge.by, self._facts, persistents=False) is True
            # A loop on a constant TRUE never ends.
            return None if is_endless else ahead
        return ahead

    def _moves_begun(self, node: tree.Node) -> Mapping[tree.Call, bool]:
        """Moves that are active after a step, each with whether this is certain."""
        callee = self._facts.callee_of(node)
        if callee is not None:
            return self._summaries[callee].moves
        if isinstance(node, tree.Call) and _is_fly_by(node, self._facts):
            return {node: True}
        return {}

    def _before(self, node: tree.Node, ahead: _Ahead) -> _Ahead:
        """State before a step."""
        if isinstance(node, tree.LateCall | tree.InvalidStatement):
            return _NOTHING
        if not isinstance(node, _Place):
            return ahead
        callee = self._facts.callee_of(node)
        if callee is not None:
            return self._before_callee(node, self._summaries[callee], ahead)
        traits = self._facts.does(node)
        if isinstance(node, tree.FunctionCall):
            return self._wait(node) if Trait.WAIT in traits else ahead
        row = self._facts.installed(node)
        if row is None or as_move(node, self._facts) is not None:
            return _NOTHING
        if Trait.WAIT in traits:
            return _NOTHING if _is_no_wait(node, self._facts) else self._wait(node)
        sets = row.sets and AXES_IN_USE.isdisjoint(row.sets)
        lets_pass = ahead if Trait.INSTANT in traits or sets else _NOTHING
        if Trait.OUTPUT not in traits:
            return lets_pass
        effects: dict[tuple[Effect, _Place], bool]
        effects = {(Effect(node, self._part, waits=False), node): True}
        return _Ahead(effects | dict(lets_pass.effects), lets_pass.end, lets_pass.leaves)

    def _wait(self, node: _Place) -> _Ahead:
        return _Ahead({(Effect(node, self._part, waits=True), node): True})

    def _before_callee(self, node: _Place, callee: _Summary, ahead: _Ahead) -> _Ahead:
        effects = {(effect, node): is_sure for effect, is_sure in callee.effects.items()}
        leaves = not self._facts.can_return(node)
        if callee.passes is None:
            return _Ahead(effects, leaves=leaves)
        for key, is_sure in ahead.effects.items():
            effects[key] = effects.get(key, False) or (is_sure and callee.passes)
        end = None if ahead.end is None else ahead.end and callee.passes
        return _Ahead(effects, end, leaves or ahead.leaves)


def _joined(states: Sequence[_Ahead], *, is_loop_test: bool) -> _Ahead:
    """Join the states of several paths."""
    if len(states) == 1:
        return states[0]
    # Early exits do not make the effects of the remaining paths less certain.
    staying = [one for one in states if one.effects or not one.leaves]
    decide = any if is_loop_test else all
    # If every path waits, one of the waits certainly follows.
    all_wait = all(one.is_wait_certain for one in staying)
    effects = {
        key: (any if all_wait and key[0].waits else decide)(
            one.effects.get(key, False) for one in staying
        )
        for state in states
        for key in state.effects
    }
    ends = [one.end for one in states if one.end is not None]
    end = None if not ends else decide(one.end or False for one in states)
    return _Ahead(effects, end, any(one.leaves for one in states) if is_loop_test else not staying)


def _is_fly_by(call: tree.Call, facts: Facts) -> bool:
    move = as_move(call, facts)
    return move is not None and flies_by(move, facts)


def flies_by(move: MoveCall, facts: Facts) -> bool:
    """Whether a move is known to pass its target in a zone."""
    if {"inpos", "conc"} & move.arguments.keys():
        return False
    if "z" in move.arguments:
        size = known_value(move.arguments["z"], facts)
        return isinstance(size, float) and size > 0
    zone = known_value(move.arguments.get("zone"), facts)
    return isinstance(zone, tuple) and len(zone) == 7 and zone[0] is False


def _is_no_wait(call: tree.Call | tree.FunctionCall, facts: Facts) -> bool:
    """Whether a WaitTime is too short to matter: WaitTime 0 only lets other tasks run."""
    return any(
        formal is not None
        and formal.key == "time"
        and not formal.optional
        and known_value(value, facts) == 0.0
        for formal, value in arguments_of(call, facts)
    )
