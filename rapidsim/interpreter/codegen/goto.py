"""GOTO as a state machine at the statement list that holds the label.

    _goto1 = 0
    while True:
        <tick>
        if _goto1 <= 0: ...statements before the first label...
        if _goto1 <= 1: ...statements after it...
        break

A GOTO sets the section to continue with and continues that loop; from inner loops it first breaks
out of each. CONTINUE reaches the next iteration of its loop the same way. A GOTO can only reach
labels of its own list and of enclosing lists, so every jump ends at a loop that encloses it.

Source: Technical reference manual RAPID Overview, "GOTO"; ABB event 40023.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import takewhile

from rapidsim.analysis.tree_walk import statements
from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.syntax import tree

_NEXT_TURN = -1
"""Value of `_jump` before the next iteration of a FOR or WHILE; else the number of a machine."""


@dataclass(slots=True)
class Loop:
    """A Python loop that encloses the statement being translated."""

    number: int = 0
    """Number of a state machine; 0 for a FOR or WHILE."""
    sections: dict[str, int] = field(default_factory=dict)
    """Section behind each label of a state machine."""
    crossed: bool = False
    """Whether a GOTO inside jumps out of the loop."""
    continued: bool = False
    """Whether a CONTINUE inside jumps out of the loop."""


@dataclass(slots=True)
class Jumps:
    """The labels and loops of one routine body during translation."""

    targets: frozenset[str]
    """Folded names of the labels that a GOTO names."""
    _loops: list[Loop] = field(default_factory=list)
    _machines: int = 0

    @property
    def depth(self) -> int:
        """Number of loops that enclose the statement being translated."""
        return len(self._loops)

    def has_target(self, body: tree.Body) -> bool:
        """Whether a statement list holds a label that is the target of a GOTO."""
        return any(
            isinstance(statement, tree.Label) and statement.name.key in self.targets
            for statement in body
        )

    @contextmanager
    def loop(self) -> Iterator[Loop]:
        """Write the body of a FOR or WHILE."""
        loop = Loop()
        self._loops.append(loop)
        yield loop
        self._loops.pop()

    @contextmanager
    def machine(self, body: tree.Body) -> Iterator[Loop]:
        """Write the sections of a statement list with labels."""
        self._machines += 1
        labels = [
            statement.name.key
            for statement in body
            if isinstance(statement, tree.Label) and statement.name.key in self.targets
        ]
        sections = {label: section for section, label in enumerate(labels, 1)}
        loop = Loop(self._machines, sections)
        self._loops.append(loop)
        yield loop
        self._loops.pop()

    def jump(self, label: str, at: AstBuilder) -> list[ast.stmt]:
        """GOTO a label, by folded name."""
        between = 0
        for loop in reversed(self._loops):
            if label in loop.sections:
                break
            between += 1
        else:
            raise KeyError(label)
        go = at.set(f"_goto{loop.number}", at.constant(loop.sections[label]))
        if not between:
            return [go, at.go_on()]
        for crossed in self._loops[-between:]:
            crossed.crossed = True
        return [go, at.set("_jump", at.constant(loop.number)), at.stop()]

    def next_turn(self, at: AstBuilder) -> list[ast.stmt]:
        """CONTINUE: the next iteration of the enclosing FOR or WHILE, leaving inner machines."""
        crossed = list(takewhile(lambda loop: loop.number, reversed(self._loops)))
        if not crossed:
            return [at.go_on()]
        for machine in crossed:
            machine.crossed = machine.continued = True
        return [at.set("_jump", at.constant(_NEXT_TURN)), at.stop()]

    def after(self, loop: Loop, at: AstBuilder) -> list[ast.stmt]:
        """Code after a loop: if a GOTO broke out of it, propagate the jump."""
        if not loop.crossed or not self._loops:
            return []
        outer = self._loops[-1]
        pass_on: list[ast.stmt] = [at.stop()]
        if loop.continued and not outer.number:
            next_turn = at.compare(at.name("_jump"), (ast.Eq(), at.constant(_NEXT_TURN)))
            turn = at.when(next_turn, [at.set("_jump", at.constant(0)), at.go_on()])
            pass_on = [turn, *pass_on]
        if outer.number:
            here = at.compare(at.name("_jump"), (ast.Eq(), at.constant(outer.number)))
            arrive = at.when(here, [at.set("_jump", at.constant(0)), at.go_on()])
            pass_on = (
                [arrive, *pass_on]
                if outer.crossed
                else [
                    at.set("_jump", at.constant(0)),
                    at.go_on(),
                ]
            )
        return [at.when(at.name("_jump"), pass_on)]


def goto_targets(bodies: Sequence[tree.Body]) -> frozenset[str]:
    """Folded names of the labels that the GOTOs in some statement lists target."""
    return frozenset(
        statement.name.key for statement in statements(*bodies) if isinstance(statement, tree.Goto)
    )
