"""Construction of the control-flow graph of a routine from its tree.

The builder walks the statements once and carries the current block. A statement that
control does not continue past (RETURN, GOTO, EXIT) leaves a new block without a predecessor. Only a
routine with an ERROR clause has ERROR edges: there, each statement that can fail gets a separate
block.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Sequence

from rapidsim.analysis.flow.graph import (
    ENDED,
    ENTRY,
    EXIT,
    RAISED,
    Block,
    ControlFlowGraph,
    EdgeKind,
    FlowEdge,
)
from rapidsim.analysis.tree_walk import descendants
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree


def build_graph(
    routine: tree.Routine,
    traits_of: Callable[[tree.Call], Trait],
    functions: Sequence[tree.FunctionCall] | None = None,
) -> ControlFlowGraph:
    """Build the control-flow graph of a routine.

    Args:
        routine: The routine.
        traits_of: Returns the traits of the instruction that a call invokes.
        functions: The function calls of the routine in source order; searched for if None.
    """
    if functions is None:
        functions = [one for one in descendants(routine) if isinstance(one, tree.FunctionCall)]
    return _Builder(traits_of, functions).build(routine)


class _Builder:
    def __init__(
        self,
        traits_of: Callable[[tree.Call], Trait],
        functions: Sequence[tree.FunctionCall],
    ) -> None:
        self._traits_of = traits_of
        self._functions = functions
        self._function_starts = [call.start for call in functions]
        self._blocks = [Block() for _ in (ENTRY, EXIT, RAISED, ENDED)]
        self._block_of: dict[tree.Node, int] = {}
        self._labels: dict[str, int] = {}
        self._jumps: list[tuple[int, tree.Goto]] = []
        self._unread: list[int] = []
        self._loop_tests: list[int] = []
        self._open_loops: list[int] = []
        self._resumes = 0
        self._has_handler = self._in_handler = False
        self._fallible: list[tuple[int, int]] = []
        """Start of each statement that can fail, with the block after it."""

    def build(self, routine: tree.Routine) -> ControlFlowGraph:
        handler = None if routine.error is None else routine.error.body
        self._has_handler = handler is not None
        self._edge(self._body(routine.body, ENTRY), EXIT, EdgeKind.RETURN)
        self._has_handler = False
        clauses = []
        entry_of_handler = None
        for clause in (routine.backward, handler, routine.undo):
            if clause is not None:
                self._in_handler = clause is handler
                clauses.append(self._new())
                self._edge(self._body(clause, clauses[-1]), EXIT, EdgeKind.RETURN)
                if self._in_handler:
                    entry_of_handler = clauses[-1]
                    self._connect_handler(entry_of_handler)
        self._connect_jumps()
        return ControlFlowGraph(
            self._blocks,
            self._block_of,
            tuple(clauses),
            entry_of_handler,
            frozenset(self._loop_tests),
        )

    def _connect_handler(self, handler: int) -> None:
        """Add the edges into the ERROR clause, and the edges of RETRY and TRYNEXT out of it."""
        for begin, behind in self._fallible:
            self._edge(begin, handler, EdgeKind.ERROR)
            if self._resumes & EdgeKind.RETRY:
                self._edge(begin, begin, EdgeKind.RETRY)
            if self._resumes & EdgeKind.TRYNEXT:
                self._edge(begin, behind, EdgeKind.TRYNEXT)

    def _connect_jumps(self) -> None:
        for block, jump in self._jumps:
            label = self._labels.get(jump.name.key)
            if label is not None:
                self._edge(block, label, EdgeKind.JUMP, jump)
        if self._unread:
            hub = self._new()
            for block in self._unread:
                self._edge(block, hub, EdgeKind.UNREAD)
            for to in (*self._labels.values(), EXIT):
                self._edge(hub, to, EdgeKind.UNREAD)

    def _new(self) -> int:
        self._blocks.append(Block())
        return len(self._blocks) - 1

    def _edge(
        self,
        block: int,
        to: int,
        kind: EdgeKind,
        by: tree.Node | None = None,
        holds: bool | None = None,
    ) -> None:
        self._blocks[block].edges.append(FlowEdge(to, kind, by, holds))

    def _after(
        self,
        block: int,
        kind: EdgeKind = EdgeKind.NEXT,
        by: tree.Node | None = None,
        holds: bool | None = None,
    ) -> int:
        """Return a new block that follows a block."""
        new = self._new()
        self._edge(block, new, kind, by, holds)
        return new

    def _evaluate(self, block: int, *nodes: tree.Node | None) -> None:
        """Append nodes as steps, each after the function calls in it."""
        steps, starts = self._blocks[block].steps, self._function_starts
        for node in nodes:
            if node is None:
                continue
            first = bisect_left(starts, node.start)
            while first < len(starts) and starts[first] < node.end:
                steps.append(self._functions[first])
                first += 1
            steps.append(node)

    def _body(self, body: tree.Body, block: int) -> int:
        """Add a statement list; return the block after it."""
        for statement in body:
            if self._has_handler and _can_fail(statement):
                begin = self._after(block) if self._blocks[block].steps else block
                end = self._statement(statement, begin)
                block = self._after(end) if end == begin else end
                self._fallible.append((begin, block))
            else:
                block = self._statement(statement, block)
        return block

    def _statement(self, statement: tree.Statement, block: int) -> int:
        self._block_of[statement] = block
        match statement:
            case tree.Label():
                block = self._block_of[statement] = self._after(block)
                self._labels.setdefault(statement.name.key, block)
                return block
            case tree.Goto():
                self._jumps.append((block, statement))
                return self._new()
            case tree.Return():
                return self._leave(statement, block, EXIT, EdgeKind.RETURN)
            case tree.Raise():
                return self._leave(statement, block, RAISED)
            case tree.Exit():
                return self._leave(statement, block, ENDED)
            case tree.Retry() | tree.TryNext():
                return self._resume(statement, block)
            case tree.Call():
                return self._call(statement, block)
            case tree.InvalidStatement() | tree.Placeholder():
                self._blocks[block].steps.append(statement)
                self._unread.append(block)
                return self._after(block, EdgeKind.UNREAD)
            case tree.If() | tree.CompactIf() | tree.Test():
                return self._choice(statement, block)
            case tree.While(condition=condition, body=body):
                self._evaluate(block, condition)
                is_endless = isinstance(condition, tree.BoolLiteral) and condition.value
                return self._loop(body, block, condition, is_endless=is_endless)
            case tree.For(first=first, last=last, step=step, body=body):
                self._evaluate(block, first, last, step)
                self._blocks[block].steps.append(statement)
                return self._loop(body, block, statement, is_endless=False)
            case _:
                self._evaluate(block, statement)
                return block

    def _leave(
        self, statement: tree.Statement, block: int, to: int, kind: EdgeKind = EdgeKind.NEXT
    ) -> int:
        self._evaluate(block, statement)
        self._edge(block, to, kind, statement)
        return self._new()

    def _resume(self, statement: tree.Retry | tree.TryNext, block: int) -> int:
        if not self._in_handler:
            # Misplaced, which another check reports.
            return block
        is_retry = isinstance(statement, tree.Retry)
        self._resumes |= EdgeKind.RETRY if is_retry else EdgeKind.TRYNEXT
        return self._new()

    def _call(self, call: tree.Call, block: int) -> int:
        traits = self._traits_of(call)
        if Trait.LEAVE in traits:
            return self._leave(call, block, ENDED)
        if Trait.NEXT_TURN in traits and self._open_loops:
            self._edge(block, self._open_loops[-1], EdgeKind.BACK, call)
            return self._new()
        self._evaluate(block, call)
        return block

    def _choice(self, statement: tree.If | tree.CompactIf | tree.Test, block: int) -> int:
        ends = []
        match statement:
            case tree.If(branches=branches, otherwise=otherwise):
                for branch in branches:
                    self._evaluate(block, branch.condition)
                    ends.append(self._body(branch.body, self._when(block, branch.condition, True)))
                    block = self._when(block, branch.condition, False)
                ends.append(self._body(otherwise or (), block))
            case tree.CompactIf(condition=condition, statement=inner):
                self._evaluate(block, condition)
                ends.append(self._body((inner,), self._when(block, condition, True)))
                ends.append(self._when(block, condition, False))
            case tree.Test(subject=subject, cases=cases, default=default):
                self._evaluate(block, subject)
                for case in cases:
                    self._evaluate(block, *case.values)
                    ends.append(self._body(case.body, self._after(block, by=case)))
                ends.append(self._body(default or (), self._after(block, by=statement)))
        join = self._new()
        for end in ends:
            self._edge(end, join, EdgeKind.NEXT)
        return join

    def _loop(self, body: tree.Body, block: int, test: tree.Node, *, is_endless: bool) -> int:
        """Add a loop whose first test is the last step of a block; return the block after it."""
        again, inside = self._new(), self._when(block, test, True)
        self._loop_tests.append(again)
        self._open_loops.append(again)
        self._edge(self._body(body, inside), again, EdgeKind.BACK)
        self._open_loops.pop()
        if isinstance(test, tree.For):
            self._blocks[again].steps.append(test)
        else:
            self._evaluate(again, test)
        self._edge(again, inside, EdgeKind.NEXT, test, True)
        after = self._new()
        if not is_endless:
            self._edge(block, after, EdgeKind.NEXT, test, False)
            self._edge(again, after, EdgeKind.NEXT, test, False)
        return after

    def _when(self, block: int, condition: tree.Node, holds: bool) -> int:
        return self._after(block, by=condition, holds=holds)


def _can_fail(statement: tree.Statement) -> bool:
    """Whether the statement itself, not one inside it, can raise an error."""
    match statement:
        case tree.Exit() | tree.Goto() | tree.Label() | tree.Empty() | tree.Data():
            return False
        case tree.Retry() | tree.TryNext() | tree.Return(value=None):
            return False
        case tree.While(condition=tree.BoolLiteral()):
            return False
        case _:
            return True
