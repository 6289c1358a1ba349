"""What a program does after a move that passes its target in a zone, including through calls.

Each routine is summarised: what it does before it moves or waits itself, whether the robot may
still be moving when it returns, and with which moves it ends. One dataflow analysis over the call
graph derives this from the effects that the library lists for its routines.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import field
from functools import cached_property
from typing import TypeAlias

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import MoveCall, arguments_of, as_move
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.analysis.tree_walk import clauses
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class

_MOST_MOVES = 8
"""Moves that may be under way at once, from different ways to a place; more tell nothing new."""
_MOST_EFFECTS = 16
_MOST_PASSES = 8
"""Over the calls; only routines that call each other need more than one."""
_LOOPS_TWICE = 3
"""Loops within each other whose end is followed to their beginning."""

_Pending: TypeAlias = "Mapping[tree.Call | None, bool]"
"""The moves that may be under way, each with whether what follows follows on every way.

None stands for the move before the call of the routine.
"""
_NOTHING: _Pending = {}
_ENTERED: _Pending = {None: True}


@value_class(frozen=True, slots=True)
class Effect:
    """A wait, or an output that is set."""

    node: tree.Call | tree.FunctionCall
    part: ProgramPart
    waits: bool


@value_class(frozen=True, slots=True)
class EffectAfterMove:
    """An effect after a move that passes its target in a zone."""

    move: tree.Call
    effect: Effect
    place: tree.Call | tree.FunctionCall
    """The effect, or the call that leads to it."""
    part: ProgramPart
    """Of the place."""


@value_class(frozen=True, slots=True)
class _Summary:
    """What a routine does to a move that is under way when it is called."""

    effects: Mapping[Effect, bool] = field(default_factory=dict)
    """Before another move or wait, each with whether it follows on every way."""
    pending: _Pending | None = None
    """What may be under way when it returns; None if it does not."""


def effects_behind_moves(facts: Facts) -> Iterator[EffectAfterMove]:
    """What certainly follows a fly-by move, and every output set after one, routine by routine."""
    summaries: dict[tree.Routine, _Summary] = {}
    parts = facts.callees_first
    found: dict[ProgramPart, list[EffectAfterMove]] = {}
    for _ in range(_MOST_PASSES):
        before = dict(summaries)
        for part in parts:
            way = _PathWalker(part, facts, summaries)
            assert part.routine is not None
            summaries[part.routine] = way.summary()
            found[part] = way.found
        if summaries == before or not _is_circular(facts):
            break
    for part in facts.routine_parts:
        yield from found.get(part, ())


def _is_circular(facts: Facts) -> bool:
    """Whether a routine stands before one that it calls."""
    return any(
        facts.bit_of[callee] >= facts.bit_of[part]
        for part in facts.callees_first
        for callee in facts.call_graph[part]
    )


class _PathWalker:
    """Follows the ways through one routine."""

    def __init__(
        self, part: ProgramPart, facts: Facts, summaries: Mapping[tree.Routine, _Summary]
    ) -> None:
        self._part = part
        self._facts = facts
        self._summaries = summaries
        self._effects: dict[Effect, bool] = {}
        self._ends: list[_Pending] = []
        self._loops = 0
        self.found: list[EffectAfterMove] = []

    def summary(self) -> _Summary:
        """The summary of a routine; fills `found`."""
        routine = self._part.routine
        assert routine is not None
        body, *others = clauses(routine)
        self._end(self._follow(body, _ENTERED))
        left = _joined([*self._ends], _ENTERED)
        for clause in others:
            self._follow(clause, _NOTHING)
        return _Summary(dict(self._effects), left)

    def _end(self, pending: _Pending | None) -> None:
        if pending is not None:
            self._ends.append(pending)

    def _follow(self, body: tree.Body, pending: _Pending | None) -> _Pending | None:
        """What may be under way behind a list; None where execution never gets there."""
        for statement in body:
            if isinstance(statement, tree.Label):
                pending = _NOTHING
            if pending is None:
                # A label further on may be jumped to.
                continue
            pending = self._step(statement, pending)
        return pending

    def _step(self, statement: tree.Statement, pending: _Pending) -> _Pending | None:
        match statement:
            case tree.Call():
                return self._call(statement, self._evaluate(statement, pending))
            case tree.Assignment():
                return self._evaluate(statement, pending)
            case tree.Return():
                self._end(self._evaluate(statement, pending))
                return None
            case tree.Raise() | tree.Exit() | tree.Retry() | tree.TryNext() | tree.Goto():
                return None
            case tree.If(branches=branches, otherwise=otherwise):
                ways: list[_Pending | None] = []
                for branch in branches:
                    pending = self._evaluate(branch.condition, pending)
                    ways.append(self._follow(branch.body, _perhaps(pending)))
                ways.append(self._follow(otherwise or (), _perhaps(pending)))
                return _joined(ways, pending)
            case tree.CompactIf(condition=condition, statement=inner):
                pending = self._evaluate(condition, pending)
                return _joined([self._step(inner, _perhaps(pending)), pending], pending)
            case tree.Test(subject=subject, cases=cases, default=default):
                pending = self._evaluate(subject, pending)
                ways = [self._follow(case.body, _perhaps(pending)) for case in cases]
                ways.append(self._follow(default or (), _perhaps(pending)))
                return _joined(ways, pending)
            case tree.While(condition=condition, body=body):
                pending = self._evaluate(condition, pending)
                is_endless = known_value(condition, self._facts, persistents=False) is True
                return self._loop(body, pending, is_endless)
            case tree.For(first=first, last=last, body=body):
                pending = self._evaluate(last, self._evaluate(first, pending))
                return self._loop(body, pending, False)
            case tree.LateCall() | tree.InvalidStatement():
                return _NOTHING
            case _:
                return pending

    def _loop(self, body: tree.Body, pending: _Pending, is_endless: bool) -> _Pending | None:
        """What may be under way behind a loop."""
        end = self._follow(body, pending if is_endless else _perhaps(pending))
        self._loops += 1
        if end is not None and self._loops <= _LOOPS_TWICE:
            made = {move: sure for move, sure in end.items() if move not in pending}
            if made:
                # What the end of a round leaves, the beginning of the next one finds.
                end = _joined([end, self._follow(body, made)], pending)
        self._loops -= 1
        return None if is_endless else _joined([pending, end], pending)

    def _evaluate(self, node: tree.Node | None, pending: _Pending) -> _Pending:
        """What is under way behind the functions called in a statement or an expression."""
        if node is None or not pending:
            return pending
        starts, functions = self._functions
        for at in range(bisect_left(starts, node.start), len(starts)):
            if starts[at] >= node.end:
                break
            function = functions[at]
            called = self._called(function, pending)
            if called is not None:
                pending = called
            elif Trait.WAIT in self._facts.does(function):
                self._act(function, pending, waits=True)
                pending = _NOTHING
        return pending

    @cached_property
    def _functions(self) -> tuple[list[int], list[tree.FunctionCall]]:
        """The calls of functions that may do more than answer, with where they begin."""
        functions = sorted(
            (
                call
                for call in self._part.all(tree.FunctionCall)
                if Trait.WAIT in self._facts.does(call) or self._facts.routine_called(call)
            ),
            key=lambda call: call.start,
        )
        return [call.start for call in functions], functions

    def _call(self, call: tree.Call, pending: _Pending) -> _Pending | None:
        move = as_move(call, self._facts)
        if move is not None:
            return {call: True} if flies_by(move, self._facts) else _NOTHING
        routine = self._facts.routine_called(call)
        if routine in self._summaries:
            return self._called(call, pending)
        row = self._facts.installed(call)
        if row is None:
            return _NOTHING
        if Trait.LEAVE in row.traits:
            return None
        if Trait.WAIT in row.traits:
            if not _is_no_wait(call, self._facts):
                self._act(call, pending, waits=True)
            return _NOTHING
        if Trait.OUTPUT in row.traits:
            self._act(call, pending, waits=False)
        return pending if Trait.INSTANT in row.traits or row.sets else _NOTHING

    def _called(self, call: tree.Call | tree.FunctionCall, pending: _Pending) -> _Pending | None:
        """What is under way behind a call of the user's routine; None if it does not return."""
        routine = self._facts.routine_called(call)
        summary = None if routine is None else self._summaries.get(routine)
        if summary is None:
            return None
        for effect, sure in summary.effects.items():
            self._note(effect, call, pending, sure)
        if summary.pending is None:
            return None
        left: dict[tree.Call | None, bool] = {}
        for move, sure in summary.pending.items():
            if move is None:
                left |= {before: sure and was for before, was in pending.items()}
            else:
                left[move] = sure
        return left

    def _act(self, node: tree.Call | tree.FunctionCall, pending: _Pending, *, waits: bool) -> None:
        self._note(Effect(node, self._part, waits), node, pending, True)

    def _note(
        self,
        effect: Effect,
        place: tree.Call | tree.FunctionCall,
        pending: _Pending,
        sure: bool,
    ) -> None:
        """Keep what happens behind each move that may be under way."""
        for move, was_sure in pending.items():
            if move is None:
                if len(self._effects) < _MOST_EFFECTS:
                    self._effects[effect] = self._effects.get(effect, True) and sure and was_sure
            elif (sure and was_sure) or (place is effect.node and not effect.waits):
                self.found.append(EffectAfterMove(move, effect, place, self._part))


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
    """Whether a WaitTime is too short to matter: WaitTime 0 only hands over to other tasks."""
    return any(
        formal is not None
        and formal.key == "time"
        and not formal.optional
        and known_value(value, facts) == 0.0
        for formal, value in arguments_of(call, facts)
    )


def _perhaps(pending: _Pending) -> _Pending:
    """What is under way where only some ways lead."""
    return dict.fromkeys(pending, False)


def _joined(states: list[_Pending | None], before: _Pending) -> _Pending | None:
    """What may be under way where ways meet that parted with `before`."""
    arriving = [way for way in states if way is not None]
    if not arriving:
        return None
    count = Counter(move for way in arriving for move in way)
    joined: dict[tree.Call | None, bool] = {}
    for way in arriving:
        for move, sure in way.items():
            if move in before:
                joined[move] = before[move] and count[move] == len(arriving)
            elif len(joined) < _MOST_MOVES:
                joined[move] = joined.get(move, True) and sure
    return joined
