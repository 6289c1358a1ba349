"""Run the LALR automaton over the tokens of a file without syntax errors, and build its tree.

A loop of our own instead of Lark's engine: it needs no Lark at run time, takes parallel lists
instead of token objects, and skips chains of rules that only pass their child on.
"""

from __future__ import annotations

import keyword
from functools import cache
from typing import Any, NamedTuple

from rapidsim.syntax import tree
from rapidsim.syntax.builder import Build, Builder
from rapidsim.syntax.lexer import Tokens
from rapidsim.syntax.line_templates import LineTemplates, after_passes
from rapidsim.syntax.line_templates import beginnings as beginnings_of_statements
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import ACCEPT
from rapidsim.syntax.terminals import TERMINALS

_FIRST_OF_LINE = frozenset(
    {"NAME", "CONST", "VAR", "PERS", "LOCAL", "RETURN", "IF", "ELSEIF", "WHILE", "FOR", "CASE"}
)
"""First tokens of the lines that have templates: statements, data, heads of blocks."""
_CLAUSES = frozenset({"ELSEIF", "CASE"})
"""Those that no statement begins with."""


class _Reduction(NamedTuple):
    """An executable rule; exactly one of `build`, `gather` and `only` applies."""

    origin: str
    length: int
    build: Build | None
    gather: bool
    only: int
    """Index of the popped value to pass on, if nothing is built."""
    children: tuple[int | None, ...] | None
    """Indices of the popped values that are children; None for all."""


def build_tree(tokens: Tokens, builder: Builder) -> tuple[tree.Module, ...] | None:
    """Parse tokens.

    Returns:
        The modules, or None if the tokens do not match the grammar.
    """
    table = rapid_table()
    actions, gotos = table.actions, table.gotos
    kinds, starts, ends, text = tokens.kinds, tokens.starts, tokens.ends, builder.text
    reductions = _reductions(builder)
    settled = _settled()
    states = [0]
    values: list[Any] = []
    firsts: list[int] = []  # start offset of each value
    position = 0
    kind = kinds[0]
    templates, beginnings = LineTemplates(kinds), beginnings_of_statements()
    builds = [reduction.build for reduction in reductions]
    while True:
        action = actions[states[-1]].get(kind)
        if action is None:
            return None
        if action > 0:
            if kind in _FIRST_OF_LINE and (states[-1] in beginnings or kind in _CLAUSES):
                found = templates.at(position, states[-1])
                if found is not None:
                    length, template = found
                    values += template.build(builds, starts, ends, text, position)
                    firsts += [starts[position + first] for first in template.firsts]
                    states += template.states
                    position += length
                    kind = kinds[position]
                    continue
            start = starts[position]
            firsts.append(start)
            make = TERMINALS.get(kind)
            if make is None:
                values.append(None)
            else:
                end = ends[position]
                values.append(make(start, end, text[start:end]))
            position += 1
            kind = kinds[position]
            state = action - 1
        elif action == ACCEPT:
            modules: tuple[tree.Module, ...] = values[0]
            return modules
        else:
            origin, length, build, gather, only, children = reductions[-action - 1]
            if length:
                popped = values[-length:]
                start = firsts[-length]
                del values[-length:], firsts[-length:], states[-length:]
            else:
                popped = []
                start = starts[position]
            if build is not None:
                if children is not None:
                    popped = [None if child is None else popped[child] for child in children]
                value = build(start, ends[position - 1], *_flattened(popped))
            elif gather:
                value = _gathered(popped, children)
            else:
                value = popped[only]
            values.append(value)
            firsts.append(start)
            state = gotos[states[-1]][origin]
        key = (states[-1], state, kind)
        final = settled.get(key)
        if final is None:
            final = settled[key] = after_passes(*key)
        states.append(final)


class _Gathered(list[Any]):
    """Children of a repeated part, to be added to the rule that contains it."""


def _gathered(popped: list[Any], children: tuple[int | None, ...] | None) -> _Gathered:
    if children is not None:
        popped = [popped[child] for child in children if child is not None]
    if type(popped[0]) is _Gathered:
        gathered = popped[0]
        gathered.extend(popped[1:])
        return gathered
    return _Gathered(popped)


def _flattened(children: list[Any]) -> list[Any]:
    for child in children:
        if type(child) is _Gathered:
            break
    else:
        return children
    flat: list[Any] = []
    for child in children:
        if type(child) is _Gathered:
            flat += child
        else:
            flat.append(child)
    return flat


@cache
def _settled() -> dict[tuple[int, int, str], int]:
    """Cache of `after_passes`; at most one entry for each state, goto and terminal."""
    return {}


def _reductions(builder: Builder) -> list[_Reduction]:
    return [
        _Reduction(
            origin=rule.origin,
            length=rule.length,
            build=getattr(builder, _function(rule.build)) if rule.build else None,
            gather=rule.build == "",
            only=rule.children[0] or 0 if rule.build is None else 0,
            children=None if rule.children == tuple(range(rule.length)) else rule.children,
        )
        for rule in rapid_table().rules
    ]


def _function(rule: str) -> str:
    return f"{rule}_" if keyword.iskeyword(rule) else rule
