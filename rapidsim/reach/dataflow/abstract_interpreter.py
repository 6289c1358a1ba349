"""Abstract interpreter of a program, which collects the moves whose arguments are static.

Calls are followed from main with their arguments, so a move is known with its predecessor. Both
branches of an unknown condition are interpreted; a loop with known bounds is executed
iteration by iteration, any other once from its entry and once for all further iterations. Jumps
are those of the control-flow graph. Routines without a caller are entries, too. Values that may
have been overwritten are forgotten, never guessed.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from rapidsim.analysis.evaluation import Known, NotStatic
from rapidsim.analysis.program import (
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    Program,
    RoutineSymbol,
    Storage,
    Symbol,
)
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.interpreter.codegen.bound_arguments import match_arguments
from rapidsim.interpreter.codegen.data_access import by_reference
from rapidsim.interpreter.codegen.written_paths import bare
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import Trait
from rapidsim.reach.dataflow.controller_stub import ControllerStub
from rapidsim.reach.dataflow.data_places import empty_data, replaced
from rapidsim.reach.dataflow.jumps import ProgramJumps
from rapidsim.reach.dataflow.known_values import evaluator_of, rounds
from rapidsim.reach.dataflow.motion_settings import KnownSettings
from rapidsim.reach.dataflow.move_instructions import MoveInstructions
from rapidsim.reach.dataflow.move_table import MoveTable, reason_unknown
from rapidsim.reach.dataflow.side_effects import Effects, ProgramEffects, root_of
from rapidsim.reach.dataflow.state import BEGINNING, AbstractFrame, State, joined
from rapidsim.reach.dataflow.transfer_functions import InstructionEffect, perform
from rapidsim.syntax import tree

MOST_STATEMENTS = 100_000
"""After this many statements beyond the text itself, loops and calls are no longer followed."""
MOST_ROUNDS = 2000
"""Largest number of iterations that are interpreted, for a loop with moves."""
MOST_IDLE_ROUNDS = 100
"""Largest number for a loop without moves."""
DEEPEST_CALL = 12
ENTRY = "main"
_IN_LOOP = "`{name}` changes from round to round"
_BY_CALL = "`{name}` is written by a routine that is called in between"
_NO_VALUE = "`{name}` has no initial value; another program sets it"
_ELSEWHERE = "`{name}` is written while the program runs"
_WAY = "`{name}` decides whether this is executed"
TOO_LONG = "the program is too long to be followed to this place"
_START = KnownSettings()


@dataclass(eq=False)
class AbstractInterpreter:
    """Abstract interpreter of the routines of a program."""

    program: Program
    effects: ProgramEffects
    written: MoveInstructions
    state: State = field(default_factory=State)
    _stack: list[AbstractFrame] = field(default_factory=list)
    _entered: set[RoutineSymbol] = field(default_factory=set)
    _constants: dict[Symbol, Known] = field(default_factory=dict)
    _turns: list[tuple[tree.Body, list[State]]] = field(default_factory=list)
    """For each active loop, its body and the states at which CONTINUE ended its iteration."""
    _off_path: set[int] = field(default_factory=set)
    """Statements with which interpretation off the path has begun, by identity."""
    _from_start: bool = False
    """Whether data not written on the current path certainly have their initial values."""
    _conditions: int = 0
    """Number of conditions that are not known, on which the current statement depends."""
    _steps_remaining: int = MOST_STATEMENTS

    def __post_init__(self) -> None:
        self._evaluator = evaluator_of(self.program, self)
        self._jumps = ProgramJumps(self.program, self.effects)
        self.table = MoveTable(self.written)

    # --- routines

    def walk_all(self) -> None:
        """Interpret main first, then routines that nothing calls, then the rest."""
        if (main := self.program.routines.get(ENTRY)) is not None:
            self._from_start = True
            self._walk_alone(main, State(last=BEGINNING))
            self._from_start = False
        uncalled = [each for each in self.effects.routines if each not in self.effects.called]
        for routine in (*uncalled, *self.effects.routines):
            if routine not in self._entered and self.effects.of_routine(routine).moves:
                settings = _START.forgetting(self.effects.everything.settings)
                self._walk_alone(routine, State(settings=settings))
        for routine in self.effects.routines:
            self._walk_clauses(routine)

    def _walk_alone(self, routine: RoutineSymbol, state: State) -> None:
        state.forget(routine.parameters, "parameter `{name}` differs from call to call")
        self.state = state
        for statement in statements(*clauses(routine.node)):
            self._steps_remaining += 1
            if isinstance(statement, tree.Call):
                self._steps_remaining += len(self.written.runs.get(statement, ()))
        self._walk_body(routine)

    def _walk_clauses(self, routine: RoutineSymbol) -> None:
        """Interpret error handlers and similar clauses, entered from anywhere in the body."""
        _, *others = clauses(routine.node)
        for body in others:
            if not self.effects.of_body(body).moves:
                continue
            from_start, self._from_start = self._from_start, False
            state = State(settings=_START.forgetting(self.effects.everything.settings))
            state.forget(self.effects.locals_of(routine), _ELSEWHERE)
            self.state = state
            self._steps_remaining += sum(1 for _ in statements(body))
            self._stack.append(AbstractFrame(routine))
            self._execute(body)
            self._stack.pop()
            self._from_start = from_start

    def _walk_body(self, routine: RoutineSymbol) -> Known:
        """Interpret a routine from the current state; return its result."""
        self._entered.add(routine)
        frame = AbstractFrame(routine)
        self._stack.append(frame)
        self._execute(routine.node.body)
        self._stack.pop()
        self.state = joined([*frame.returns, self.state])
        self.state.alive &= self._jumps.returns(routine)
        results = frame.results
        if results and all(type(one) is type(results[0]) and one == results[0] for one in results):
            return results[0]
        return NotStatic(f"`{routine.name}` returns what depends on the run")

    def call(self, symbol: RoutineSymbol, arguments: Sequence[tree.Argument]) -> Known:
        """Follow a call of a routine of the program; return the result of a function."""
        stacked = any(frame.routine is symbol for frame in self._stack)
        if stacked or len(self._stack) >= DEEPEST_CALL or self._steps_remaining < 0:
            self._forget_effects(self.effects.of_routine(symbol), _BY_CALL)
            self.state.alive &= self._jumps.returns(symbol)
            return NotStatic(f"`{symbol.name}` is not followed so deep")
        given = match_arguments(arguments, symbol.parameters)
        values: dict[Symbol, Known] = {}
        given_back: list[tuple[ParameterSymbol, tree.DataPath]] = []
        for parameter in symbol.parameters:
            one = given.get(parameter.name.lower())
            values[parameter] = (
                (False if parameter.is_switch else NotStatic(f"`{parameter.name}` is not given"))
                if one is None
                else NotStatic(f"`{parameter.name}` is passed on")
                if one.caller_option is not None
                else True
                if one.value is None
                else self._value(one.value)
            )
            path = None if one is None or one.value is None else bare(one.value)
            if by_reference(parameter.mode) and isinstance(
                path, tree.DataReference | tree.Index | tree.ComponentAccess
            ):
                given_back.append((parameter, path))
        self.state.values.update(values)
        result = self._walk_body(symbol)
        written = self.effects.of_routine(symbol).writes
        returned = [(path, self.read(p)) for p, path in given_back if p in written]
        self.state = self.state.without(self.effects.locals_of(symbol))
        for path, value in returned:
            self._store(path, value)
        return result

    # --- data

    def _value(self, expression: tree.Expression) -> Known:
        """Return the value of an expression; if it is unknown, so are the effects of its calls."""
        found = self._evaluator.value(expression)
        if isinstance(found, NotStatic):
            self._forget_effects(self.effects.of_calls(expression), _BY_CALL)
        return found

    def read(self, symbol: Symbol) -> Known:
        """Return the value of data at the current statement."""
        value = self.state.values.get(symbol)
        if value is not None:
            volatile = not isinstance(value, NotStatic) and symbol in self.effects.volatile
            return NotStatic(_ELSEWHERE.format(name=symbol.name)) if volatile else value
        if not isinstance(symbol, DataSymbol):
            return NotStatic(f"`{symbol.name}` is not known")
        if symbol.storage is not Storage.CONST and (
            symbol in self.effects.volatile
            or (not self._from_start and self.effects.is_written(symbol))
        ):
            return NotStatic(_ELSEWHERE.format(name=symbol.name))
        if symbol.node is None:
            return symbol.value
        if symbol not in self._constants:
            self._constants[symbol] = self._initial(symbol)
        return self._constants[symbol]

    def _initial(self, symbol: DataSymbol) -> Known:
        assert symbol.node is not None
        if symbol.node.value is None:
            if symbol.storage is Storage.PERS:
                return NotStatic(_NO_VALUE.format(name=symbol.name))
            return empty_data(symbol)
        return self._evaluator.value(symbol.node.value, symbol.type)

    def _store(self, path: tree.DataPath, value: Known) -> None:
        root = self.program.symbol_of.get(root_of(path))
        if root is not None:
            self.state.values[root] = stored = replaced(self._evaluator, path, value)
            if isinstance(stored, NotStatic):
                self._forget_effects(self.effects.of_calls(path), _BY_CALL)

    def _forget_effects(self, effects: Effects, reason: str) -> None:
        self.state.forget(effects.writes, reason)
        self.state.settings = self.state.settings.forgetting(effects.settings)
        if effects.moves:
            self.state.last = None

    # --- statements

    def _execute(self, body: tree.Body) -> None:
        looked_at = 0
        for position, statement in enumerate(body):
            if isinstance(statement, tree.Label):
                self._arrive(statement)
            elif not self.state.alive and not self._resume(statement):
                if position >= looked_at:
                    rest = enumerate(body[position:], position)
                    ahead = (k for k, one in rest if isinstance(one, tree.Label))
                    looked_at = next(ahead, len(body))
                    self._walk_off_path(body[position:looked_at], None)
                continue
            self._steps_remaining -= 1
            self._statement(statement)

    def _arrive(self, label: tree.Label) -> None:
        """Join the states that come to a label, from above and by GOTO."""
        frame = self._stack[-1]
        jumps = self._jumps.of(frame.routine)
        self.state = frame.arriving(label.name.key, self.state)
        if self.state.alive and not frame.off_path and self._steps_remaining >= 0:
            self._forget_effects(jumps.repeated(label), _IN_LOOP)
        elif self.state.alive or jumps.is_reached(label):
            # From below, or not all states have come that may come.
            self._enter_anywhere(_IN_LOOP)

    def _resume(self, statement: tree.Statement) -> bool:
        """Continue at a statement that only a path through an ERROR clause reaches."""
        if self._jumps.of(self._stack[-1].routine).is_resumed(statement):
            self._enter_anywhere(_ELSEWHERE)
        return self.state.alive

    def _enter_anywhere(self, reason: str) -> None:
        """Forget whatever the routine may have done before the next statement."""
        self.state.alive = True
        self._forget_effects(self.effects.of_routine(self._stack[-1].routine), reason)

    def _walk_off_path(self, body: tree.Body, decided_by: Iterable[tree.Expression] | None) -> None:
        """Collect the moves of statements that the path skips.

        Args:
            body: The statements.
            decided_by: Conditions that decided on the skip; the data in them are forgotten. None
                forgets all that the routine writes.
        """
        if not body or id(body[0]) in self._off_path or not self.effects.of_body(body).moves:
            return
        self._off_path.add(id(body[0]))
        kept, frame = self.state, self._stack[-1]
        self.state = State(dict(kept.values), kept.settings, None)
        for loop, _ in self._turns:
            self._forget_effects(self.effects.of_body(loop), _IN_LOOP)
        if decided_by is None:
            self._enter_anywhere(_ELSEWHERE)
        else:
            self.state.forget(self.effects.variables_in(decided_by), _WAY)
        frame.off_path += 1
        self._execute(body)
        frame.off_path -= 1
        self.state = kept

    def _statement(self, statement: tree.Statement) -> None:
        match statement:
            case tree.Call():
                self._call(statement)
            case tree.Assignment(target=target, value=value):
                found = self._value(value)
                if isinstance(target, tree.DataReference | tree.Index | tree.ComponentAccess):
                    self._store(target, found)
            case tree.If(branches=branches, otherwise=otherwise):
                self._if([(one.condition, one.body) for one in branches], otherwise or ())
            case tree.CompactIf(condition=condition, statement=inner):
                self._if([(condition, (inner,))], ())
            case tree.Test():
                self._test(statement)
            case tree.For():
                self._for(statement)
            case tree.While(condition=condition, body=body):
                self._while(condition, body)
            case tree.Data():
                symbol = self.program.symbol_of.get(statement)
                if isinstance(symbol, DataSymbol) and symbol.storage is not Storage.CONST:
                    self.state.values[symbol] = self._initial(symbol)
            case tree.Return(value=value):
                self._return(value)
            case tree.Goto():
                self._jump(statement)
            case tree.Exit() | tree.Raise() | tree.Retry() | tree.TryNext():
                self.state.alive = False
            case tree.LateCall():
                self._forget_effects(self.effects.everything, _BY_CALL)
            case _:
                pass

    def _return(self, value: tree.Expression | None) -> None:
        result = None if value is None else self._value(value)
        frame = self._stack[-1]
        if not frame.off_path:
            frame.returns.append(self.state.copy())
            frame.results.append(result)
        self.state.alive = False

    def _jump(self, jump: tree.Goto) -> None:
        frame = self._stack[-1]
        # A jump back is foreseen at its label.
        if not frame.off_path and self._jumps.of(frame.routine).is_forward(jump):
            frame.jump(jump.name.key, self.state)
        self.state.alive = False

    def _choose(
        self,
        cases: Iterable[tuple[bool | None, tree.Body, tree.Expression]],
        bodies: Sequence[tree.Body],
        *,
        by_code: bool = False,
    ) -> None:
        """Interpret one branch if it is known which, else all possible ones.

        Args:
            cases: Whether each branch is taken if none before it is, None if unknown; the branch;
                and what decides on it. They are evaluated in turn.
            bodies: All branches; the last is taken if no other is.
            by_code: Whether other branches are taken after any number of messages.
        """
        ends: list[State] = []
        is_open = False
        for position, (known, body, decided_by) in enumerate(cases):
            if known is False:
                self._walk_off_path(body, [decided_by])
                continue
            entry = self.state.copy()
            is_open |= known is None
            self._execute_if(body, is_open=is_open)
            ends.append(self.state)
            self.state = entry
            if known is True:
                for other in bodies[position + 1 :]:
                    self._walk_off_path(other, None if by_code else [decided_by])
                break
        else:
            self._execute_if(bodies[-1], is_open=is_open)
            ends.append(self.state)
        self.state = joined(ends)

    def _execute_if(self, body: tree.Body, *, is_open: bool) -> None:
        self._conditions += is_open
        self._execute(body)
        self._conditions -= is_open

    def _if(self, branches: Sequence[tuple[tree.Expression, tree.Body]], last: tree.Body) -> None:
        cases = (
            (known if isinstance(known := self._value(condition), bool) else None, body, condition)
            for condition, body in branches
        )
        self._choose(cases, [*(body for _, body in branches), last])

    def _test(self, test: tree.Test) -> None:
        subject = self._value(test.subject)
        cases = ((self._is_case(subject, one), one.body, test.subject) for one in test.cases)
        # The subject is often the code of a message.
        self._choose(cases, [*(one.body for one in test.cases), test.default or ()], by_code=True)

    def _is_case(self, subject: Known, case: tree.Case) -> bool | None:
        values = [self._value(value) for value in case.values]
        is_open = isinstance(subject, NotStatic) or any(isinstance(v, NotStatic) for v in values)
        return None if is_open else subject in values

    def _for(self, loop: tree.For) -> None:
        written = (loop.first, loop.last, *([] if loop.step is None else [loop.step]))
        bounds = [self._value(bound) for bound in written]
        counter = self.program.symbol_of[loop]
        effects = self.effects.of_body(loop.body)
        most = MOST_ROUNDS if effects.moves else MOST_IDLE_ROUNDS
        values = rounds(bounds, most + 1) if self._steps_remaining > 0 else []
        if not values or len(values) > most:
            self.state.values[counter] = NotStatic(
                f"`{loop.counter.text}` counts too far to follow"
            )
            self._repeat(loop.body, surely=False)
            return
        for value in values:
            if not self.state.alive or self._steps_remaining < 0:
                self._forget_effects(effects, _IN_LOOP)
                break
            self.state.values[counter] = value
            self._turn(loop.body)

    def _while(self, condition: tree.Expression, body: tree.Body) -> None:
        known = self._value(condition)
        if known is False:
            self._walk_off_path(body, [condition])
            return
        constant = not self.effects.variables_in([condition])
        self._repeat(body, surely=known is True, endless=known is True and constant)

    def _repeat(self, body: tree.Body, *, surely: bool, endless: bool = False) -> None:
        """Interpret a loop of unknown length: its first iteration, then one for all others."""
        effects = self.effects.of_body(body)
        entry = self.state.copy()
        self._conditions += not surely
        after_first: int | None = entry.last
        if effects.moves:
            self._turn(body)
            after_first = self.state.last if self.state.alive else None
        self.state = entry.copy()
        self._forget_effects(effects, _IN_LOOP)
        self.state.last = after_first
        self._turn(body)
        self._conditions -= not surely
        after = self.state
        self.state = entry
        self._forget_effects(effects, _IN_LOOP)
        if effects.moves and surely and after.alive:
            self.state.last = after.last
        self.state.alive = not endless

    def _turn(self, body: tree.Body) -> None:
        """Interpret the body of a loop once, up to its end or to a CONTINUE."""
        self._turns.append((body, []))
        self._execute(body)
        self.state = joined([*self._turns.pop()[1], self.state])

    # --- instructions

    def _call(self, call: tree.Call) -> None:
        match self.program.symbol_of.get(call):
            case RoutineSymbol() as symbol:
                self.call(symbol, call.arguments)
            case LibrarySymbol(routine=routine) if Trait.CALL_BY_NAME in routine.traits:
                self._forget_effects(self.effects.everything, _BY_CALL)
            case LibrarySymbol(routine=routine) if Trait.NEXT_TURN in routine.traits:
                if self._turns and not self._stack[-1].off_path:
                    self._turns[-1][1].append(self.state.copy())
                self.state.alive = False
            case LibrarySymbol(routine=routine):
                self._instruction(call, routine)
            case _:
                self._forget_effects(self.effects.of_bodies((call,)), _BY_CALL)

    def _instruction(self, call: tree.Call, routine: LibraryRoutine) -> None:
        moving, fields = Trait.MOVE in routine.traits, routine.sets
        recorder = ControllerStub(self.state.settings.settings, self.program.cell.places_parts)
        signature = routine.signature
        done: InstructionEffect | str = "only a run can tell"
        before = self.state.last
        if moving or fields or not signature.takes_controller:
            done = perform(routine, call.arguments, self._evaluator, recorder)
        if isinstance(done, InstructionEffect):
            for path, value in done.written:
                self._store(path, value)
            self.state.alive &= done.continues
            uncertain = self.state.settings.uncertain - frozenset(fields)
            self.state.settings = KnownSettings(recorder.settings, uncertain)
        else:
            asked = f"`{{name}}` comes from `{routine.name}`"
            self._forget_effects(self.effects.of_bodies((call,)), asked)
        if Trait.LEAVE_PATH in routine.traits:
            before = self.state.last = None
        if not moving:
            return
        moves, settings = recorder.moves, self.state.settings
        is_off_path = any(frame.off_path for frame in self._stack)
        why = done if isinstance(done, str) and not moves else None
        why = why or reason_unknown(routine.name, moves, settings.uncertain)
        if why is not None:
            (self.table.unreached if is_off_path else self.table.unknown).setdefault(call, why)
            self.state.last = None
            return
        if not (self._conditions or is_off_path):
            self.table.certain.add(call)
        self._steps_remaining -= len(self.written.runs.get(call, ()))
        self.state.last = self.table.add(call, moves[0], self._stack[-1].routine, settings, before)
        if Trait.SEARCH in routine.traits:
            self.state.last = None
