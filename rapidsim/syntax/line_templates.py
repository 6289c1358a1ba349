"""Line templates: the driver's steps for a sequence of token kinds, compiled to one function.

The steps of an LALR parser from a state depend only on the kinds of the tokens, not on their text.
For a frequent sequence of kinds, a statement or the head of a block, the steps are therefore taken
once without building anything; the nodes that they would build are recorded as one Python
expression. It calls the same functions with the same arguments in the same order.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from typing import Any, TypeAlias

from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import ACCEPT
from rapidsim.syntax.terminals import TERMINALS
from rapidsim.values import value_class

LONGEST = 60
"""Maximum number of tokens of a template."""
_OFTEN = 12
"""Number of lines after which their template is compiled, which costs as much as twelve."""
_MOST = 1000
_ENDS = frozenset({"SEMICOLON", "THEN", "DO", "COLON"})
"""Last tokens of templates."""

Build: TypeAlias = Callable[[Sequence[Any], list[int], list[int], str, int], list[Any]]
"""Signature `build(builds, starts, ends, text, position)`; returns the values to push."""
_Symbol: TypeAlias = "str | list[str]"
"""An expression, or the expressions gathered for the enclosing rule."""


@value_class(frozen=True, slots=True, eq=False)
class LineTemplate:
    """Values and states that the driver pushes for the tokens of a statement."""

    build: Build
    firsts: tuple[int, ...]
    """Index of the first token of each value, relative to the statement."""
    states: tuple[int, ...]


class LineTemplates:
    """Templates of one text, compiled as the driver encounters them."""

    def __init__(self, kinds: list[str]) -> None:
        """Take the kinds of the tokens of a text."""
        self._kinds = kinds
        self._ends = [number for number, kind in enumerate(kinds) if kind in _ENDS]
        self._ends.append(len(kinds) + LONGEST)
        self._next = 0
        """Index of the first end that is not before the last position."""
        self._met: dict[tuple[str, ...], int] = {}
        self._known: dict[tuple[int, tuple[str, ...]], LineTemplate | None] = {}

    def at(self, position: int, state: int) -> tuple[int, LineTemplate] | None:
        """Template of the line that begins at a token, and its number of tokens.

        Args:
            position: Number of the token; not less than in the last call.
            state: State of the driver.
        """
        ends = self._ends
        while ends[self._next] < position:
            self._next += 1
        stop = ends[self._next] + 1
        if stop - position > LONGEST:
            return None
        kinds = tuple(self._kinds[position:stop])
        key = (state, kinds)
        shape = self._known.get(key)
        if shape is not None:
            return stop - position, shape
        met = self._met[kinds] = self._met.get(kinds, 0) + 1
        if met >= _OFTEN and key not in self._known:
            shape = self._known[key] = _shape(*key)
        return None if shape is None else (stop - position, shape)


@cache
def beginnings() -> frozenset[int]:
    """States of the driver that accept the first token of a statement or a declaration."""
    actions = rapid_table().actions
    return frozenset(
        k for k, of in enumerate(actions) if of.get("GOTO", 0) > 0 or of.get("CONST", 0) > 0
    )


@lru_cache(_MOST)
def _shape(state: int, kinds: tuple[str, ...]) -> LineTemplate | None:
    """Take the steps for some tokens, and those that follow whatever the next token is.

    Returns:
        None at an error, or if a construct that began before them ends.
    """
    table = rapid_table()
    states, values, firsts = [state], list[_Symbol](), list[int]()
    position = 0
    while True:
        kind = kinds[position] if position < len(kinds) else ""
        action = table.actions[states[-1]].get(kind) if kind else _only_action(states[-1])
        if action is None or action == ACCEPT:
            break
        if action > 0:
            firsts.append(position)
            place = f"s[p+{position}],e[p+{position}]"
            text = f"t[s[p+{position}]:e[p+{position}]]"
            values.append(f"make_{kind}({place},{text})" if kind in TERMINALS else "None")
            position += 1
            reached = action - 1
        else:
            rule = table.rules[-action - 1]
            if rule.length > len(values):
                break
            cut = len(values) - rule.length
            first = firsts[cut] if rule.length else position
            popped = values[cut:]
            del values[cut:], firsts[cut:], states[cut + 1 :]
            values.append(_reduced(-action - 1, popped, first, position))
            firsts.append(first)
            reached = table.gotos[states[-1]][rule.origin]
        if position < len(kinds):
            reached = after_passes(states[-1], reached, kinds[position])
        states.append(reached)
    if position < len(kinds) or any(isinstance(value, list) for value in values):
        return None
    return LineTemplate(_compiled(",".join(map(str, values))), tuple(firsts), tuple(states[1:]))


def _only_action(state: int) -> int | None:
    """Return the reduction of a state without any other action; None for that to a list."""
    table = rapid_table()
    first, *others = set(table.actions[state].values())
    return first if not others and first < 0 and table.rules[-first - 1].build != "" else None


@lru_cache(_MOST)
def _compiled(values: str) -> Build:
    """Compile the expressions of values: names of the grammar and indices, no text of a file."""
    names: dict[str, Any] = {f"make_{kind}": make for kind, make in TERMINALS.items()}
    build: Build = eval(f"lambda b,s,e,t,p:[{values}]", names)
    return build


def _reduced(number: int, popped: list[_Symbol], first: int, position: int) -> _Symbol:
    """Expression that a rule builds from symbols, as the driver does with values."""
    rule = rapid_table().rules[number]
    if rule.build is None:
        return popped[rule.children[0] or 0]
    if rule.build == "":
        kept = [popped[child] for child in rule.children if child is not None]
        return _flat(kept)
    chosen = ["None" if child is None else popped[child] for child in rule.children]
    arguments = [f"s[p+{first}]", f"e[p+{position - 1}]", *_flat(chosen)]
    return f"b[{number}]({','.join(arguments)})"


def _flat(symbols: Sequence[_Symbol]) -> list[str]:
    return [
        part for symbol in symbols for part in (symbol if isinstance(symbol, list) else [symbol])
    ]


def after_passes(below: int, state: int, kind: str) -> int:
    """Return the state after reducing every rule that only passes its single symbol on.

    From a number to a whole expression there are eight such rules, all without effect.
    """
    table = rapid_table()
    while True:
        action = table.actions[state].get(kind)
        if action is None or action >= 0:
            return state
        rule = table.rules[-action - 1]
        if rule.length != 1 or rule.build is not None:
            return state
        state = table.gotos[below][rule.origin]
