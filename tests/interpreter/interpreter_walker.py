"""A second, naive interpreter for a part of RAPID: the semantics that generated code must have.

It walks the tree, keeps nums as NumPy singles where they are stored or compared, and knows num and
bool data, arrays, branches, loops, references to whole variables, and ERROR clauses.
"""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rapidsim.syntax import tree


class Failed(Exception):  # noqa: N818 - RAPID's word
    """A RAPID error; only that there is one matters here."""


class Returned(Exception):  # noqa: N818 - RAPID's word
    """The routine ends."""


class Handled(Exception):  # noqa: N818 - RAPID's word
    """What an ERROR clause decided."""


@dataclass
class Slot:
    value: Any


@dataclass
class Walker:
    module: tree.Module
    memory: dict[str, Slot] = field(default_factory=dict)

    def routine(self, name: str) -> tree.Routine:
        return next(r for r in self.module.routines if r.name.key == name)

    def call(self, name: str, arguments: list[Slot]) -> None:
        routine = self.routine(name)
        names = [p.name.key for p in routine.parameters if isinstance(p, tree.ParameterDeclaration)]
        frame = dict(zip(names, arguments, strict=True))
        with contextlib.suppress(Returned):
            self.body(routine.body, frame, routine.error)

    def body(self, body: tree.Body, frame: dict[str, Slot], handler: Any) -> None:
        for statement in body:
            self.statement(statement, frame, handler)

    def guard(self, action: Any, frame: dict[str, Slot], handler: Any, otherwise: Any) -> Any:
        """Do something under an ERROR clause."""
        tries = 0
        while True:
            try:
                return action()
            except Failed:
                if handler is None:
                    raise
                try:
                    self.body(handler.body, frame, None)
                except Handled as handled:
                    if handled.args[0] == "trynext":
                        return otherwise
                    tries += 1
                    if tries > 4:
                        raise Failed from None
                    continue
                raise Returned from None

    def statement(self, s: tree.Statement, frame: dict[str, Slot], h: Any) -> None:
        match s:
            case tree.Data():
                frame[s.name.key] = Slot(0.0)
            case tree.Assignment():
                self.guard(lambda: self.assign(s, frame), frame, h, None)
            case tree.If():

                def decide() -> tree.Body:
                    for branch in s.branches:
                        if self.value(branch.condition, frame):
                            return branch.body
                    return s.otherwise or ()

                self.body(self.guard(decide, frame, h, ()), frame, h)
            case tree.CompactIf():
                if self.guard(lambda: self.value(s.condition, frame), frame, h, False):
                    self.statement(s.statement, frame, h)
            case tree.While():
                while self.guard(lambda: self.value(s.condition, frame), frame, h, False):
                    self.body(s.body, frame, h)
            case tree.For():

                def bounds() -> list[float]:
                    first, last = self.value(s.first, frame), self.value(s.last, frame)
                    step = self.value(s.step, frame) if s.step else (1.0 if last >= first else -1.0)
                    counts = []
                    while first <= last if step > 0 else first >= last:
                        counts.append(first)
                        first = float(np.float32(first + step))
                    return counts

                for count in self.guard(bounds, frame, h, []):
                    self.body(s.body, {**frame, s.counter.key: Slot(count)}, h)
            case tree.Test():

                def choose() -> tree.Body:
                    subject = self.value(s.subject, frame)
                    for case in s.cases:
                        if any(subject == self.value(value, frame) for value in case.values):
                            return case.body
                    return s.default or ()

                self.body(self.guard(choose, frame, h, ()), frame, h)
            case tree.Call():

                def call() -> None:
                    arguments = []
                    parameters = self.routine(s.name.key).parameters
                    for given, wanted in zip(s.arguments, parameters, strict=True):
                        assert isinstance(given, tree.RequiredArgument)
                        assert isinstance(wanted, tree.ParameterDeclaration)
                        if wanted.mode == "INOUT":
                            assert isinstance(given.value, tree.DataReference)
                            arguments.append(self.slot(given.value.name.key, frame))
                        else:
                            arguments.append(Slot(self.value(given.value, frame)))
                    self.call(s.name.key, arguments)

                self.guard(call, frame, h, None)
            case tree.Return():
                raise Returned
            case tree.Retry():
                raise Handled("retry")
            case tree.TryNext():
                raise Handled("trynext")
            case _:
                raise NotImplementedError(type(s))

    def slot(self, key: str, frame: dict[str, Slot]) -> Slot:
        return frame[key] if key in frame else self.memory[key]

    def assign(self, s: tree.Assignment, frame: dict[str, Slot]) -> None:
        value = self.value(s.value, frame)
        if isinstance(s.target, tree.Index):
            array, index = self.element(s.target, frame)
            array[index] = value
        else:
            assert isinstance(s.target, tree.DataReference)
            self.slot(s.target.name.key, frame).value = value

    def element(self, path: tree.Index, frame: dict[str, Slot]) -> tuple[list[float], int]:
        assert isinstance(path.array, tree.DataReference)
        array = self.slot(path.array.name.key, frame).value
        index = self.value(path.indices[0], frame)
        if index != int(index) or not 1 <= index <= len(array):
            raise Failed
        return array, int(index) - 1

    def value(self, e: tree.Expression, frame: dict[str, Slot]) -> Any:
        """A value as it would be stored."""
        raw = self.raw(e, frame)
        if isinstance(raw, bool):
            return raw
        if abs(raw) > 3.4028234663852886e38:
            raise Failed
        return float(np.float32(raw))

    def raw(self, e: tree.Expression, frame: dict[str, Slot]) -> Any:
        match e:
            case tree.NumberLiteral(value=value):
                return float(np.float32(value))
            case tree.BoolLiteral(value=value):
                return value
            case tree.DataReference(name=name):
                return self.slot(name.key, frame).value
            case tree.Index():
                array, index = self.element(e, frame)
                return array[index]
            case tree.Parenthesised(inner=inner):
                return self.raw(inner, frame)
            case tree.Unary(operator="NOT", operand=operand):
                return not self.raw(operand, frame)
            case tree.Unary(operator="-", operand=operand):
                return -self.raw(operand, frame)
            case tree.Binary(operator="AND", left=left, right=right):
                return self.raw(left, frame) and self.raw(right, frame)
            case tree.Binary(operator="OR", left=left, right=right):
                return self.raw(left, frame) or self.raw(right, frame)
            case tree.Binary():
                return self.binary(e, frame)
            case _:
                raise NotImplementedError(type(e))

    def binary(self, e: tree.Binary, frame: dict[str, Slot]) -> Any:
        if e.operator in ("DIV", "MOD", "=", "<>", "<", "<=", ">", ">=", "XOR"):
            a, b = self.value(e.left, frame), self.value(e.right, frame)
        else:
            a, b = self.raw(e.left, frame), self.raw(e.right, frame)
        match e.operator:
            case "+":
                return a + b
            case "-":
                return a - b
            case "*":
                return a * b
            case "/":
                if b == 0:
                    raise Failed
                return a / b
            case "DIV" | "MOD":
                if b == 0 or a != int(a) or b != int(b):
                    raise Failed
                quotient = int(abs(a)) // int(abs(b))
                quotient = quotient if (a < 0) == (b < 0) else -quotient
                return float(quotient if e.operator == "DIV" else int(a) - quotient * int(b))
            case "=":
                return a == b
            case "<>" | "XOR":
                return a != b
            case "<":
                return a < b
            case "<=":
                return a <= b
            case ">":
                return a > b
            case _:
                return a >= b
