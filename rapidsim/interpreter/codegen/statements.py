"""Statements in generated code.

Each RAPID statement becomes Python statements on its line. Under an ERROR clause, statements that
may raise are wrapped in a loop of `error_handling`; conditions are evaluated inside such a loop,
and the bodies they select are outside it. Loops take a tick per iteration, which lets virtual time
pass.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Sequence, Set
from dataclasses import dataclass
from math import prod
from typing import NoReturn

from rapidsim.analysis.program import (
    DataSymbol,
    ParameterSymbol,
    RoutineSymbol,
    Storage,
    does,
)
from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.codegen.bulk_loops import with_loops
from rapidsim.interpreter.codegen.call_ticks import tick
from rapidsim.interpreter.codegen.counter_positions import position_once
from rapidsim.interpreter.codegen.data_access import whole_number
from rapidsim.interpreter.codegen.error_handling import protected
from rapidsim.interpreter.codegen.expression_code import (
    Code,
    comparable,
    finished,
    finished_integer,
)
from rapidsim.interpreter.codegen.expressions import Expressions
from rapidsim.interpreter.codegen.goto import Jumps
from rapidsim.interpreter.codegen.inlined_instructions import (
    assigned_in_place,
    is_start_move_retry,
    value_in_place,
)
from rapidsim.interpreter.codegen.intervals import Interval, counted, step_direction
from rapidsim.interpreter.codegen.written_paths import declaration
from rapidsim.interpreter.limits import MAX_BRANCHES, MAX_LOOPS, NotExecutableError
from rapidsim.interpreter.runtime.bulk_execution import ROW
from rapidsim.interpreter.runtime.local_arrays import LEAST_COUNTED
from rapidsim.language.initial_values import initial_value
from rapidsim.language.types import ArrayOf, resolved
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

ANSWERED = "_answered"
"""Python variable: whether a statement of an ERROR clause has answered the error."""


@dataclass(slots=True)
class Statements:
    """Translates a statement list of a routine and everything nested in it."""

    expressions: Expressions
    jumps: Jumps
    persistents: Set[tree.Node]
    """Parameters that may be bound to a persistent."""
    is_protected: bool
    """Whether the routine has an ERROR clause and this is outside it."""
    in_handler: bool = False
    """Whether this is the ERROR clause."""
    routine: tree.Node | None = None
    """Routine that contains the statements."""
    answering: Collection[tree.Node] = ()
    """The statements of an ERROR clause that answer an error; other errors fall through."""

    def body(self, body: tree.Body) -> list[ast.stmt]:
        """Translate a statement list."""
        if self.jumps.has_target(body):
            return self._machine(body)
        return [python for part in self._parts(body) for python in self._part(part)]

    def _parts(self, body: tree.Body) -> Iterator[tree.Statement | tree.BulkStatements]:
        module = self.expressions.names.module
        return with_loops(body, module.runs, module.module.source.text)

    def _part(self, part: tree.Statement | tree.BulkStatements) -> list[ast.stmt]:
        return self._run(part) if isinstance(part, tree.BulkStatements) else self.statement(part)

    def statement(self, statement: tree.Statement) -> list[ast.stmt]:
        """Translate one statement."""
        at = self.expressions.statement = self.expressions.positions.at(statement)
        translated = self._translated(statement, at)
        if statement in self.answering:
            return [at.set(ANSWERED, at.constant(True)), *translated]
        return translated

    def _translated(self, statement: tree.Statement, at: AstBuilder) -> list[ast.stmt]:
        match statement:
            case tree.Assignment():
                return self._assignment(statement, at)
            case tree.Call():
                return self._call(statement, at)
            case tree.LateCall():
                return self._guard(self.expressions.calls.late(statement, at), at)
            case tree.If(branches=branches, otherwise=otherwise):
                conditions = [branch.condition for branch in branches]
                bodies = [branch.body for branch in branches]
                return self._if(statement, conditions, bodies, otherwise or (), at)
            case tree.CompactIf(condition=condition, statement=inner):
                return self._if(statement, [condition], [(inner,)], (), at)
            case tree.For():
                return self._for(statement, at)
            case tree.While():
                return self._while(statement, at)
            case tree.Test():
                return self._test(statement, at)
            case tree.Label():
                return []
            case tree.Connect():
                return self._connect(statement, at)
            case tree.Empty():
                return [at.nothing()]
            case tree.Data():
                return self._data(statement, at)
            case tree.Placeholder():
                return self._guard([at.do(at.call("_unfinished"))], at)
            case tree.InvalidStatement():
                self._refuse("a part with syntax errors", statement)
            case _:
                return self._transfer(statement, at)

    def _transfer(
        self,
        statement: tree.Goto | tree.Return | tree.Raise | tree.Exit | tree.Retry | tree.TryNext,
        at: AstBuilder,
    ) -> list[ast.stmt]:
        """Translate a statement that passes control elsewhere."""
        match statement:
            case tree.Goto(name=name):
                return self.jumps.jump(name.key, at)
            case tree.Return(value=value):
                return self._return(value, at)
            case tree.Raise(number=number):
                return self._raise(number, at)
            case tree.Exit():
                return [at.throw(at.call("_ProgramReset", [at.constant("EXIT")]))]
            case tree.Retry():
                return [at.leave(at.constant(1))]
            case tree.TryNext():
                return [at.leave(at.constant(0))]

    def _guard(
        self, body: Sequence[ast.stmt], at: AstBuilder, *, else_body: Sequence[ast.stmt] = ()
    ) -> list[ast.stmt]:
        """Protect statements that may raise, if there is an ERROR clause."""
        return protected(body, at, else_body=else_body) if self.is_protected else list(body)

    def _assignment(self, statement: tree.Assignment, at: AstBuilder) -> list[ast.stmt]:
        if isinstance(statement.target, tree.Placeholder):
            return self._guard([at.do(at.call("_unfinished"))], at)
        # Whole arrays are copied element by element at the target.
        paths = self.expressions.paths
        value = self._value_for(statement.target, statement.value)
        body = [
            *paths.write(statement.target, value, at),
            *self._serve_persistent_interrupts(statement.target, at),
        ]
        is_array = isinstance(resolved(paths.type_of(statement.target)), ArrayOf)
        may_raise = value.may_raise or is_array or paths.may_raise(statement.target)
        return self._guard(body, at) if may_raise else body

    def _value_for(self, target: tree.DataPath, value: tree.Expression) -> Code:
        """Value that an assignment stores; an array is not copied."""
        home = declaration(target, self.expressions.program)
        if home in self.expressions.integers:
            return self.expressions.copy(value, home)
        return self.expressions.value(value)

    def _call(self, statement: tree.Call, at: AstBuilder) -> list[ast.stmt]:
        program = self.expressions.program
        if Trait.NEXT_TURN in does(program.symbol_of[statement]):
            return self.jumps.next_turn(at)
        variable = assigned_in_place(statement, program)
        if variable is None:
            called = self._guard(self.expressions.calls.procedure(statement, at), at)
            # The checker permits StartMoveRetry in ERROR clauses only.
            retries = is_start_move_retry(statement, program)
            return [*called, at.leave(at.constant(1))] if retries else called
        paths = self.expressions.paths
        value = value_in_place(statement, variable, self.expressions, paths, at)
        return self._guard(
            [*paths.write(variable, value, at), *self._serve_persistent_interrupts(variable, at)],
            at,
        )

    def _run(self, run: tree.BulkStatements) -> list[ast.stmt]:
        """Execute bulk moves, and the calls between them, in a loop, one per iteration."""
        at = self.expressions.statement = self.expressions.positions.at(run.like)
        rows, move = self.expressions.calls.rows(run, at)
        turn = self._guard(move, at)
        for number, one in enumerate(run.between):
            at_call = self.expressions.statement = self.expressions.positions.at(one.like)
            call = self._guard(self.expressions.calls.repeated(one.like, at_call), at_call)
            is_this = at.compare(at.attribute(ROW, "call"), (ast.Eq(), at.constant(number)))
            turn = [at.when(is_this, call, turn)]
        loop = at.each(at.store(ROW), rows, turn)
        return [loop, at.set(ROW, at.constant(None))]

    def _serve_persistent_interrupts(self, target: tree.DataPath, at: AstBuilder) -> list[ast.stmt]:
        """Serve the interrupts that wait for a change of a persistent."""
        match self.expressions.paths.symbol(target):
            case DataSymbol(storage=Storage.PERS):
                pass
            case ParameterSymbol(node=node) if node in self.persistents:
                pass
            case _:
                return []
        watches = at.attribute("_clock", "watches")
        return [
            at.when(watches, [at.do(at.call(at.attribute("_clock", "serve_persistent_changes")))])
        ]

    def _if(
        self,
        statement: tree.Node,
        conditions: Sequence[tree.Expression],
        bodies: Sequence[tree.Body],
        else_body: tree.Body,
        at: AstBuilder,
    ) -> list[ast.stmt]:
        if len(conditions) > MAX_BRANCHES:
            self._refuse(f"an IF with more than {MAX_BRANCHES} branches", statement)
        places = [at, *(self._line_of(condition) for condition in conditions[1:])]
        tests = []
        for place, condition in zip(places, conditions, strict=True):
            self.expressions.statement = place
            tests.append(self.expressions.condition(condition))
        return self._choose(tests, places, bodies, else_body, at)

    def _line_of(self, condition: tree.Expression) -> AstBuilder:
        """Position of a branch's condition, which is on the line of its ELSEIF."""
        return self.expressions.positions.at(condition)

    def _choose(
        self,
        tests: Sequence[Code],
        places: Sequence[AstBuilder],
        bodies: Sequence[tree.Body],
        else_body: tree.Body,
        at: AstBuilder,
        before: Sequence[ast.stmt] = (),
        *,
        may_raise: bool = False,
    ) -> list[ast.stmt]:
        """Branch by conditions; `before` evaluates their common parts."""
        if not self.is_protected or not (may_raise or any(test.may_raise for test in tests)):
            nodes = [test.node for test in tests]
            return [*before, *self._branches(nodes, places, bodies, else_body)]
        number: ast.expr = at.constant(0)
        for position in range(len(tests), 0, -1):
            place = places[position - 1]
            number = place.choice(tests[position - 1].node, place.constant(position), number)
        # RETRY decides again from the first condition, TRYNEXT continues after the statement.
        decide = self._guard(
            [*before, at.set("_branch", number)],
            at,
            else_body=[at.set("_branch", at.constant(-1))],
        )
        nodes = [
            at.compare(at.name("_branch"), (ast.Eq(), at.constant(position)))
            for position in range(1, len(tests) + 1)
        ]
        chosen = [at] * len(tests)
        if not else_body:
            return [*decide, *self._branches(nodes, chosen, bodies, ())]
        none_holds = at.compare(at.name("_branch"), (ast.Eq(), at.constant(0)))
        return [
            *decide,
            *self._branches([*nodes, none_holds], [*chosen, at], [*bodies, else_body], ()),
        ]

    def _branches(
        self,
        tests: Sequence[ast.expr],
        places: Sequence[AstBuilder],
        bodies: Sequence[tree.Body],
        else_body: tree.Body,
    ) -> list[ast.stmt]:
        """Python's `if`, `elif`, `else`; bodies in source order."""
        written = [self.body(body) for body in bodies]
        chain = self.body(else_body)
        for place, test, body in reversed(list(zip(places, tests, written, strict=True))):
            chain = [place.when(test, body, chain)]
        return chain

    def _test(self, statement: tree.Test, at: AstBuilder) -> list[ast.stmt]:
        if len(statement.cases) > MAX_BRANCHES:
            self._refuse(f"a TEST with more than {MAX_BRANCHES} cases", statement)
        subject = self.expressions.value(statement.subject)
        before = [at.set("_case", subject.node)]
        if not statement.cases:
            decide = self._guard(before, at) if subject.may_raise else before
            return [*decide, *self.body(statement.default or ())]
        tests = []
        places = []
        for case in statement.cases:
            place = self.expressions.statement = self.expressions.positions.at(case.values[0])
            values = [self.expressions.value(value) for value in case.values]
            equal: list[ast.expr] = [
                place.compare(place.name("_case"), (ast.Eq(), value.node)) for value in values
            ]
            node = equal[0] if len(equal) == 1 else place.both_or_either(ast.Or(), *equal)
            tests.append(Code(node, may_raise=any(value.may_raise for value in values)))
            places.append(place)
        bodies = [case.body for case in statement.cases]
        return self._choose(
            tests,
            places,
            bodies,
            statement.default or (),
            at,
            before,
            may_raise=subject.may_raise,
        )

    def _while(self, statement: tree.While, at: AstBuilder) -> list[ast.stmt]:
        self._refuse_depth(statement)
        condition = self.expressions.condition(statement.condition)
        with self.jumps.loop() as loop:
            body = self.body(statement.body)
        turn = tick(at)
        if not (self.is_protected and condition.may_raise):
            return [at.repeat(condition.node, [*turn, *body]), *self.jumps.after(loop, at)]
        decide = self._guard(
            [at.set("_condition", condition.node)],
            at,
            else_body=[at.set("_condition", at.constant(False))],
        )
        done = at.when(at.unary(ast.Not(), at.name("_condition")), [at.stop()])
        return [at.forever([*turn, *decide, done, *body]), *self.jumps.after(loop, at)]

    def _for(self, statement: tree.For, at: AstBuilder) -> list[ast.stmt]:
        self._refuse_depth(statement)
        values, interval, may_raise = self._counter_values(statement, at)
        names, counters = self.expressions.names, self.expressions.counters
        symbol = self.expressions.program.symbol_of[statement]
        with names.counter(symbol, statement.counter.text) as name, self.jumps.loop() as loop:
            if interval is not None:
                counters[name] = interval
            body = self.body(statement.body)
            if counters.pop(name, None) is not None:
                body = position_once(body, name, at)
        before: list[ast.stmt] = []
        if may_raise and self.is_protected:
            before = self._guard(
                [at.set("_values", values)], at, else_body=[at.set("_values", at.tuple_of([]))]
            )
            values = at.name("_values")
        turn = at.each(at.store(name), values, [*tick(at), *body])
        return [*before, turn, *self.jumps.after(loop, at)]

    def _counter_values(
        self, statement: tree.For, at: AstBuilder
    ) -> tuple[ast.expr, Interval | None, bool]:
        """Values of a FOR, the interval of its counter if integer, and whether they may raise."""
        parts = [statement.first, statement.last, statement.step]
        codes = [self.expressions.code(part) for part in parts if part is not None]
        may_raise = any(finished(code, at).may_raise for code in codes)
        first, last = codes[0], codes[1]
        step = whole_number(statement.step)
        if first.integer is None or (statement.step is not None and step is None):
            return at.call("_steps", [finished(code, at).node for code in codes]), None, may_raise
        ends = last.integer if _exact(last) else None
        direction = step_direction(first.integer, ends) if step is None else step
        interval = counted(first.integer, ends, direction)
        nodes = [finished_integer(first, at).node, *(at.constant(step) for _ in codes[2:])]
        if ends is None or not direction or not first.integer.exact:
            nodes.insert(1, comparable(last, at).node)
            return at.call("_count", nodes), interval, may_raise
        past = 1 if direction > 0 else -1
        if last.literal is not None:
            nodes.insert(1, at.constant(int(last.literal) + past))
        else:
            nodes.insert(1, at.operation(last.node, ast.Add(), at.constant(past)))
        if direction < 0 and step is None:
            nodes.append(at.constant(-1))
        return at.call("_range", nodes), interval, may_raise

    def _machine(self, body: tree.Body) -> list[ast.stmt]:
        """A statement list with labels that GOTOs name: see `goto`."""
        at = self.expressions.positions.at(body[0])
        self._refuse_depth(body[0])
        sections: list[list[ast.stmt]] = [[]]
        starts = [at]
        with self.jumps.machine(body) as machine:
            for part in self._parts(body):
                if isinstance(part, tree.Label) and part.name.key in machine.sections:
                    sections.append([])
                    starts.append(self.expressions.positions.at(part))
                sections[-1].extend(self._part(part))
        state = f"_goto{machine.number}"
        guarded: list[ast.stmt] = []
        for number, (section, start) in enumerate(zip(sections, starts, strict=True)):
            if section:
                reached = start.compare(start.name(state), (ast.LtE(), start.constant(number)))
                guarded.append(start.when(reached, section))
        reset = [at.set("_jump", at.constant(0)), at.set(state, at.constant(0))]
        turn = at.forever([*tick(at), *guarded, starts[-1].stop()])
        return [*reset, turn, *self.jumps.after(machine, at)]

    def _return(self, value: tree.Expression | None, at: AstBuilder) -> list[ast.stmt]:
        if self.in_handler:
            node = at.constant(None) if value is None else self._returned(value).node
            return [at.throw(at.call("_Leave", [node]))]
        if value is None:
            return [at.leave()]
        code = self._returned(value)
        body: list[ast.stmt] = [at.leave(code.node)]
        return self._guard(body, at) if code.may_raise else body

    def _returned(self, value: tree.Expression) -> Code:
        return self.expressions.copy(value, self.routine)

    def _raise(self, number: tree.Expression | None, at: AstBuilder) -> list[ast.stmt]:
        node = self.expressions.value(number).node if number is not None else at.constant(None)
        written = at.constant("" if number is None else self.expressions.span(number).text)
        if self.in_handler:
            return [at.throw(at.call("_propagate", [at.name("_e"), node, written]))]
        return self._guard([at.throw(at.call("_raised", [node, written]))], at)

    def _connect(self, statement: tree.Connect, at: AstBuilder) -> list[ast.stmt]:
        if isinstance(statement.interrupt, tree.Placeholder):
            return self._guard([at.do(at.call("_unfinished"))], at)
        symbol = self.expressions.program.symbol_of.get(statement)
        number = self.expressions.paths.read(statement.interrupt).node
        if isinstance(symbol, RoutineSymbol):
            function = at.name(self.expressions.names.module.routine(symbol))
            node = at.call("_connect", [number, function, at.constant(symbol.name)])
        elif isinstance(statement.trap, tree.Name):
            self._refuse(f"CONNECT with `{statement.trap.text}`, which is not a trap,", statement)
        else:
            name = self.expressions.value(statement.trap).node
            node = at.call("_connect_late", [number, name])
        value = Code(node, may_raise=True, calls=True)
        return self._guard(self.expressions.paths.write(statement.interrupt, value, at), at)

    def _data(self, statement: tree.Data, at: AstBuilder) -> list[ast.stmt]:
        """Assign a local variable its initial value at each call."""
        if statement.storage != "VAR":
            return []
        symbol = self.expressions.program.symbol_of[statement]
        names = self.expressions.names
        name = names.get(symbol)
        assert isinstance(symbol, DataSymbol)
        assert name is not None
        node: ast.expr
        if statement.value is not None:
            node = source = self.expressions.copy(statement.value, statement).node
        else:
            zero = 0 if statement in self.expressions.integers else initial_value(symbol.type)
            if isinstance(zero, float | int | str):
                node = at.constant(zero)
            else:
                node = at.name(names.module.constant(zero))
            source = node
            if isinstance(zero, list):
                node = at.call("_copy_array", [node])
        of = resolved(symbol.type)
        if isinstance(of, ArrayOf) and prod(size or 0 for size in of.dimensions) >= LEAST_COUNTED:
            node = at.call("_local_array", [source, at.constant(name)])
        if symbol in names.in_cell:
            node = at.call("_Box", [node])
        return [at.set(name, node)]

    def _refuse_depth(self, statement: tree.Node) -> None:
        if self.jumps.depth >= MAX_LOOPS:
            self._refuse(f"a loop inside {MAX_LOOPS} others", statement)

    def _refuse(self, subject: str, node: tree.Node) -> NoReturn:
        raise NotExecutableError(subject, self.expressions.span(node))


def _exact(code: Code) -> bool:
    """Whether it is an integer that a single represents."""
    return code.integer is not None and code.integer.exact
